// Camera rays through the tree in packets: they run so close together that one test of a node's boxes serves them all. What a
// ray hits in a leaf is found as for a single one, and so to the same bits (tree.h).
#ifndef VNDF_RENDER_PACKET_H
#define VNDF_RENDER_PACKET_H

#include "tree.h"

// Rays of a packet, a multiple of eight; 1: there are no packets.
#ifndef VNDF_PACKET
#define VNDF_PACKET 8
#endif

#if VNDF_PACKET > 1

struct vndf_render_packet {
    struct vndf_render_ray ray[VNDF_PACKET];
    struct vndf_render_hit hit[VNDF_PACKET];
    // Of each once more, for eight at a time.
    float inverse_x[VNDF_PACKET], inverse_y[VNDF_PACKET], inverse_z[VNDF_PACKET], t[VNDF_PACKET];
    struct vndf_render_veil veil[VNDF_PACKET];
};

// All rays from a point whose inverse directions lie between two of the same signs.
struct vndf_render_beam {
    struct vndf_render_ray least;
    float most_x, most_y, most_z;
    float t;  // how far they go
};

VNDF_FN void vndf_render_add(struct vndf_render_packet* packet, int k, struct vndf_render_ray ray,
                             struct vndf_render_veil veil) {
    packet->veil[k] = veil;
    packet->ray[k] = ray;
    packet->hit[k] = vndf_render_no_hit();
    packet->inverse_x[k] = ray.inverse_x;
    packet->inverse_y[k] = ray.inverse_y;
    packet->inverse_z[k] = ray.inverse_z;
    packet->t[k] = packet->hit[k].t;
}

// Whether the packet's rays have one origin and one sign on each axis: then they make a beam.
VNDF_FN int vndf_render_together(const struct vndf_render_packet* packet) {
    const struct vndf_render_ray a = packet->ray[0];
    int together = 1;
    for (int k = 1; k < VNDF_PACKET; ++k) {
        const struct vndf_render_ray b = packet->ray[k];
        together &= a.x == b.x && a.y == b.y && a.z == b.z && a.near_x == b.near_x && a.near_y == b.near_y &&
                    a.near_z == b.near_z;
    }
    return together;
}

VNDF_FN struct vndf_render_beam vndf_render_beam_of(const struct vndf_render_packet* packet) {
    struct vndf_render_beam beam;
    beam.least = packet->ray[0];
    beam.most_x = beam.least.inverse_x;
    beam.most_y = beam.least.inverse_y;
    beam.most_z = beam.least.inverse_z;
    beam.t = packet->t[0];
    for (int k = 1; k < VNDF_PACKET; ++k) {
        beam.least.inverse_x = vndf_impl_min(beam.least.inverse_x, packet->inverse_x[k]);
        beam.least.inverse_y = vndf_impl_min(beam.least.inverse_y, packet->inverse_y[k]);
        beam.least.inverse_z = vndf_impl_min(beam.least.inverse_z, packet->inverse_z[k]);
        beam.most_x = vndf_impl_max(beam.most_x, packet->inverse_x[k]);
        beam.most_y = vndf_impl_max(beam.most_y, packet->inverse_y[k]);
        beam.most_z = vndf_impl_max(beam.most_z, packet->inverse_z[k]);
    }
    return beam;
}

// The least and the greatest distance of a beam's rays to eight planes.
VNDF_FN float8 vndf_render_nearest(VNDF_RENDER_FROM(float) planes, float from, float least, float most) {
    const float8 way = vload8(0, planes) - from;
    return vndf_render_least8(way * least, way * most);
}
VNDF_FN float8 vndf_render_farthest(VNDF_RENDER_FROM(float) planes, float from, float least, float most) {
    const float8 way = vload8(0, planes) - from;
    return vndf_render_most8(way * least, way * most);
}

// Where the beam enters the boxes of a node.
VNDF_FN float8 vndf_render_beam_boxes(VNDF_RENDER_FROM(float) node, struct vndf_render_beam b) {
    const struct vndf_render_ray r = b.least;
    return vndf_render_enter(
        vndf_render_nearest(node + r.near_x, r.x, r.inverse_x, b.most_x),
        vndf_render_nearest(node + r.near_y, r.y, r.inverse_y, b.most_y),
        vndf_render_nearest(node + r.near_z, r.z, r.inverse_z, b.most_z),
        vndf_render_farthest(node + VNDF_NODE_PAIR_X - r.near_x, r.x, r.inverse_x, b.most_x),
        vndf_render_farthest(node + VNDF_NODE_PAIR_Y - r.near_y, r.y, r.inverse_y, b.most_y),
        vndf_render_farthest(node + VNDF_NODE_PAIR_Z - r.near_z, r.z, r.inverse_z, b.most_z),
        VNDF_RENDER_8(b.t));
}

// Where eight rays of the packet enter the box of a leaf.
VNDF_FN float8 vndf_render_leaf_box(VNDF_RENDER_FROM(float) leaf, const struct vndf_render_packet* packet,
                                    int eight) {
    const struct vndf_render_ray r = packet->ray[0];
    const int low = VNDF_LEAF_LOW, high = VNDF_LEAF_HIGH;
    const int near_x = r.near_x == VNDF_NODE_LOW_X ? low : high,
              near_y = r.near_y == VNDF_NODE_LOW_Y ? low : high,
              near_z = r.near_z == VNDF_NODE_LOW_Z ? low : high;
    const float8 x = vload8(eight, packet->inverse_x), y = vload8(eight, packet->inverse_y),
                 z = vload8(eight, packet->inverse_z);
    return vndf_render_enter((leaf[near_x] - r.x) * x, (leaf[near_y + 1] - r.y) * y,
                             (leaf[near_z + 2] - r.z) * z, (leaf[low + high - near_x] - r.x) * x,
                             (leaf[low + high - near_y + 1] - r.y) * y,
                             (leaf[low + high - near_z + 2] - r.z) * z, vload8(eight, packet->t));
}

// The packet in a leaf. return: how far its rays go on.
VNDF_FN float vndf_render_packet_leaf(VNDF_RENDER_FROM(float) leaf, struct vndf_render_packet* packet) {
    for (int eight = 0; eight < VNDF_PACKET / 8; ++eight) {
        ulong lanes = VNDF_RENDER_BYTES(vndf_render_leaf_box(leaf, packet, eight) >= VNDF_RENDER_8(0.0f));
        while (lanes != 0) {
            const int lane = vndf_render_last_lane(lanes), k = 8 * eight + lane;
            packet->hit[k] = vndf_render_leaf(leaf, packet->ray[k], packet->hit[k], packet->veil[k]);
            packet->t[k] = packet->hit[k].t;
            lanes = vndf_render_lanes_below(lanes, lane);
        }
    }
    float t = 0.0f;
    for (int k = 0; k < VNDF_PACKET; ++k) t = vndf_impl_max(t, packet->t[k]);
    return t;
}

VNDF_FN void vndf_render_trace_packet(VNDF_RENDER_FROM(float) nodes, VNDF_RENDER_FROM(float) leaves,
                                      struct vndf_render_packet* packet) {
    struct vndf_render_beam beam = vndf_render_beam_of(packet);
    struct vndf_render_stack stack;
    stack.size = 0;
    int child = 0;
    for (;;) {
        int next = VNDF_NO_CHILD;
        if (child < 0) {
            beam.t = vndf_render_packet_leaf(vndf_render_leaf_at(leaves, child), packet);
        } else {
            VNDF_RENDER_FROM(float) const node = vndf_render_node_at(nodes, child);
            next = vndf_render_push(&stack, node, vndf_render_beam_boxes(node, beam), 0);
        }
        child = next == VNDF_NO_CHILD ? vndf_render_pop(&stack, beam.t) : next;
        if (child == VNDF_NO_CHILD) return;
    }
}

#endif

#endif
