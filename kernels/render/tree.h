// Rays through the tree of boxes: eight boxes and eight triangles at a time.
//
// Whether a triangle is hit, where, and which of two hits counts are decided by the triangle and the ray alone, never by the
// order of the boxes: the nearest hit, and of two at the same distance that of the lower number. So every tree over the same
// mesh, and every way through it, has the same hits. Boxes are tested with a margin above all that rounding can do.
#ifndef VNDF_RENDER_TREE_H
#define VNDF_RENDER_TREE_H

#include "language.h"
#include "queues.h"
#include "random.h"
#include "texture.h"

#define VNDF_STACK (7 * VNDF_TREE_DEPTH + 1)
// A node's planes come in pairs: a ray that meets one of them first leaves by the sum less it.
#define VNDF_NODE_PAIR_X (VNDF_NODE_LOW_X + VNDF_NODE_HIGH_X)
#define VNDF_NODE_PAIR_Y (VNDF_NODE_LOW_Y + VNDF_NODE_HIGH_Y)
#define VNDF_NODE_PAIR_Z (VNDF_NODE_LOW_Z + VNDF_NODE_HIGH_Z)

struct vndf_render_ray {
    float x, y, z;
    float inverse_x, inverse_y, inverse_z;  // of the direction; finite
    int near_x, near_y, near_z;             // the planes of a node that the ray meets first
    int kx, ky, kz;                         // axes: kz the largest of the direction
    float shear_x, shear_y, shear_z;
};

struct vndf_render_hit {
    float t, b1, b2;
    uint triangle;
};

// What lets some rays pass: how surfaces look, and a number of the ray.
struct vndf_render_veil {
#if VNDF_RENDER_ALPHA
    struct vndf_render_looks looks;
    uint ray;
#else
    int none;
#endif
};

// Whether a ray goes on at a triangle that it meets.
VNDF_FN int vndf_render_passes(struct vndf_render_veil veil, uint triangle, float b1, float b2) {
#if VNDF_RENDER_ALPHA
    const uint bits = vndf_render_hash(veil.ray ^ (triangle * 0x9e3779b9u));
    return vndf_render_lets_pass(veil.looks, triangle, b1, b2, vndf_render_unit(bits >> 8));
#else
    (void)veil;
    (void)triangle;
    (void)b1;
    (void)b2;
    return 0;
#endif
}

// Eight numbers by one comparison; a NaN in b gives a.
VNDF_FN float8 vndf_render_least8(float8 a, float8 b) {
    return b < a ? b : a;
}
VNDF_FN float8 vndf_render_most8(float8 a, float8 b) {
    return b > a ? b : a;
}

// Of lanes that are a byte of ones each: the last, and those before a lane.
VNDF_FN int vndf_render_last_lane(ulong lanes) {
    return 7 - VNDF_RENDER_CLZ(lanes) / 8;
}
VNDF_FN ulong vndf_render_lanes_below(ulong lanes, int lane) {
    return lanes & (((ulong)1 << 8 * lane) - 1);
}

// A component too small to divide by counts as one that moves the ray by nothing within any scene.
VNDF_FN float vndf_render_inverse(float d) {
    const float size = vndf_impl_max(vndf_impl_abs(d), 1e-18f);
    return 1.0f / (d < 0.0f ? -size : size);
}

VNDF_FN struct vndf_render_ray vndf_render_ray_of(float x, float y, float z, float dx, float dy, float dz) {
    struct vndf_render_ray ray;
    ray.x = x;
    ray.y = y;
    ray.z = z;
    ray.inverse_x = vndf_render_inverse(dx);
    ray.inverse_y = vndf_render_inverse(dy);
    ray.inverse_z = vndf_render_inverse(dz);
    ray.near_x = dx < 0.0f ? VNDF_NODE_HIGH_X : VNDF_NODE_LOW_X;
    ray.near_y = dy < 0.0f ? VNDF_NODE_HIGH_Y : VNDF_NODE_LOW_Y;
    ray.near_z = dz < 0.0f ? VNDF_NODE_HIGH_Z : VNDF_NODE_LOW_Z;
    const float size_x = vndf_impl_abs(dx), size_y = vndf_impl_abs(dy), size_z = vndf_impl_abs(dz);
    ray.kz = size_x > size_y ? (size_x > size_z ? 0 : 2) : (size_y > size_z ? 1 : 2);
    const float major = ray.kz == 0 ? dx : ray.kz == 1 ? dy : dz;
    // The other two in the order that keeps the triangle's orientation.
    const int next = ray.kz == 2 ? 0 : ray.kz + 1, last = ray.kz == 0 ? 2 : ray.kz - 1;
    ray.kx = major < 0.0f ? last : next;
    ray.ky = major < 0.0f ? next : last;
    ray.shear_z = 1.0f / major;
    ray.shear_x = (ray.kx == 0 ? dx : ray.kx == 1 ? dy : dz) * ray.shear_z;
    ray.shear_y = (ray.ky == 0 ? dx : ray.ky == 1 ? dy : dz) * ray.shear_z;
    return ray;
}

VNDF_FN float vndf_render_axis(struct vndf_render_ray ray, int axis) {
    return axis == 0 ? ray.x : axis == 1 ? ray.y : ray.z;
}

// Where eight rays enter eight boxes, from the distances to the boxes' planes: negative for those that do not before t.
VNDF_FN float8 vndf_render_enter(float8 near_x, float8 near_y, float8 near_z, float8 far_x, float8 far_y,
                                 float8 far_z, float8 t) {
    // Relative to what it is a sum of, a distance to a plane is off by 2^-22 at most, one to a hit by a few times that.
    const float less = 0.99999f, more = 1.00001f;
    const float8 enter = less * vndf_render_most8(vndf_render_most8(near_x, near_y),
                                                  vndf_render_most8(near_z, VNDF_RENDER_8(0.0f)));
    const float8 leave =
        more * vndf_render_least8(vndf_render_least8(far_x, far_y), vndf_render_least8(far_z, t));
    return enter <= leave ? enter : VNDF_RENDER_8(-1.0f);
}

// The same of one ray and the boxes of a node.
VNDF_FN float8 vndf_render_boxes(VNDF_RENDER_FROM(float) node, struct vndf_render_ray ray, float t) {
    return vndf_render_enter((vload8(0, node + ray.near_x) - ray.x) * ray.inverse_x,
                             (vload8(0, node + ray.near_y) - ray.y) * ray.inverse_y,
                             (vload8(0, node + ray.near_z) - ray.z) * ray.inverse_z,
                             (vload8(0, node + VNDF_NODE_PAIR_X - ray.near_x) - ray.x) * ray.inverse_x,
                             (vload8(0, node + VNDF_NODE_PAIR_Y - ray.near_y) - ray.y) * ray.inverse_y,
                             (vload8(0, node + VNDF_NODE_PAIR_Z - ray.near_z) - ray.z) * ray.inverse_z,
                             VNDF_RENDER_8(t));
}

// The nearest of `hit` and what the ray meets in a leaf.
// Source: Woop, Benthin & Wald, Watertight Ray/Triangle Intersection, 2013. A ray through an edge meets both its triangles,
//     since the two have the same number for it but for the sign; both ends included, no third test is needed.
VNDF_FN struct vndf_render_hit vndf_render_leaf(VNDF_RENDER_FROM(float) leaf, struct vndf_render_ray ray,
                                                struct vndf_render_hit hit, struct vndf_render_veil veil) {
    const float ox = vndf_render_axis(ray, ray.kx), oy = vndf_render_axis(ray, ray.ky),
                oz = vndf_render_axis(ray, ray.kz);
    VNDF_RENDER_FROM(float) const at_x = leaf + 8 * ray.kx;
    VNDF_RENDER_FROM(float) const at_y = leaf + 8 * ray.ky;
    VNDF_RENDER_FROM(float) const at_z = leaf + 8 * ray.kz;
    const float8 az = vload8(0, at_z + VNDF_LEAF_CORNER(0)) - oz;
    const float8 bz = vload8(0, at_z + VNDF_LEAF_CORNER(1)) - oz;
    const float8 cz = vload8(0, at_z + VNDF_LEAF_CORNER(2)) - oz;
    const float8 ax = vload8(0, at_x + VNDF_LEAF_CORNER(0)) - ox - ray.shear_x * az;
    const float8 ay = vload8(0, at_y + VNDF_LEAF_CORNER(0)) - oy - ray.shear_y * az;
    const float8 bx = vload8(0, at_x + VNDF_LEAF_CORNER(1)) - ox - ray.shear_x * bz;
    const float8 by = vload8(0, at_y + VNDF_LEAF_CORNER(1)) - oy - ray.shear_y * bz;
    const float8 cx = vload8(0, at_x + VNDF_LEAF_CORNER(2)) - ox - ray.shear_x * cz;
    const float8 cy = vload8(0, at_y + VNDF_LEAF_CORNER(2)) - oy - ray.shear_y * cz;
    const float8 u = cx * by - cy * bx, v = ax * cy - ay * cx, w = bx * ay - by * ax;
    const float8 determinant = u + v + w;
    const float8 zero = VNDF_RENDER_8(0.0f);
    const float8 least = vndf_render_least8(vndf_render_least8(u, v), w),
                 most = vndf_render_most8(vndf_render_most8(u, v), w);
    const float8 inverse = VNDF_RENDER_8(1.0f) / (determinant != zero ? determinant : VNDF_RENDER_8(1.0f));
    const float8 t = (u * az + v * bz + w * cz) * ray.shear_z * inverse;
    const int8 met =
        ((least >= zero) | (most <= zero)) & (determinant != zero) & (t > zero) & (t <= VNDF_RENDER_8(hit.t));
    ulong lanes = VNDF_RENDER_BYTES(met);
    if (lanes == 0) return hit;
    float ts[8], b1[8], b2[8];
    vstore8(t, 0, ts);
    vstore8(v * inverse, 0, b1);
    vstore8(w * inverse, 0, b2);
    while (lanes != 0) {
        const int i = vndf_render_last_lane(lanes);
        lanes = vndf_render_lanes_below(lanes, i);
        const uint triangle = VNDF_RENDER_BITS(leaf[VNDF_LEAF_TRIANGLE + i]);
        if ((ts[i] < hit.t || (ts[i] == hit.t && triangle < hit.triangle)) &&
            !vndf_render_passes(veil, triangle, b1[i], b2[i])) {
            hit.t = ts[i];
            hit.b1 = b1[i];
            hit.b2 = b2[i];
            hit.triangle = triangle;
        }
    }
    return hit;
}

// Children of nodes that are still to be looked at, and where they are entered.
struct vndf_render_stack {
    int size;
    int child[VNDF_STACK];
    float enter[VNDF_STACK];
};

// No child has this number.
#define VNDF_NO_CHILD ((int)0x80000000)

// The nearest of a node's children that are entered, or any where `any` is not 0; the others wait as they come.
VNDF_FN int vndf_render_push(struct vndf_render_stack* stack, VNDF_RENDER_FROM(float) node, float8 enter,
                             int any) {
    ulong lanes = VNDF_RENDER_BYTES(enter >= VNDF_RENDER_8(0.0f));
    if (lanes == 0) return VNDF_NO_CHILD;
    float at[8];
    vstore8(enter, 0, at);
    int lane = vndf_render_last_lane(lanes), nearest = (int)VNDF_RENDER_BITS(node[VNDF_NODE_CHILD + lane]);
    float least = at[lane];
    while ((lanes = vndf_render_lanes_below(lanes, lane)) != 0) {
        lane = vndf_render_last_lane(lanes);
        const int child = (int)VNDF_RENDER_BITS(node[VNDF_NODE_CHILD + lane]),
                  nearer = !any && at[lane] < least;
        stack->child[stack->size] = nearer ? nearest : child;
        stack->enter[stack->size++] = nearer ? least : at[lane];
        nearest = nearer ? child : nearest;
        least = nearer ? at[lane] : least;
    }
    return nearest;
}

// The next child that is entered before t.
VNDF_FN int vndf_render_pop(struct vndf_render_stack* stack, float t) {
    while (stack->size != 0)
        if (stack->enter[--stack->size] <= t * 1.00001f) return stack->child[stack->size];
    return VNDF_NO_CHILD;
}

VNDF_FN VNDF_RENDER_FROM(float) vndf_render_node_at(VNDF_RENDER_FROM(float) nodes, int child) {
    return nodes + (size_t)VNDF_NODE_SIZE * (uint)child;
}
VNDF_FN VNDF_RENDER_FROM(float) vndf_render_leaf_at(VNDF_RENDER_FROM(float) leaves, int child) {
    return leaves + (size_t)VNDF_LEAF_SIZE * (uint)~child;
}

VNDF_FN struct vndf_render_hit vndf_render_no_hit(void) {
    struct vndf_render_hit hit;
    hit.t = VNDF_RENDER_ANYWHERE;
    hit.b1 = 0.0f;
    hit.b2 = 0.0f;
    hit.triangle = VNDF_MISS;
    return hit;
}

// The first hit of a ray before `far`, or any at all where `any` is not 0: then the nearest box is no better than another, and mostly the
// ray's own surroundings.
VNDF_FN struct vndf_render_hit vndf_render_trace(VNDF_RENDER_FROM(float) nodes,
                                                 VNDF_RENDER_FROM(float) leaves, struct vndf_render_ray ray,
                                                 float far, int any, struct vndf_render_veil veil) {
    struct vndf_render_hit hit = vndf_render_no_hit();
    hit.t = far;
    struct vndf_render_stack stack;
    stack.size = 0;
    int child = 0;
    for (;;) {
        int next = VNDF_NO_CHILD;
        if (child < 0) {
            hit = vndf_render_leaf(vndf_render_leaf_at(leaves, child), ray, hit, veil);
            if (any && hit.triangle != VNDF_MISS) return hit;
        } else {
            VNDF_RENDER_FROM(float) const node = vndf_render_node_at(nodes, child);
            next = vndf_render_push(&stack, node, vndf_render_boxes(node, ray, hit.t), any);
        }
        child = next == VNDF_NO_CHILD ? vndf_render_pop(&stack, hit.t) : next;
        if (child == VNDF_NO_CHILD) return hit;
    }
}

#endif
