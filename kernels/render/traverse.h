// Stages: the first hit of each path's ray, and the light that reaches a path past whatever may stand before the lights.
#ifndef VNDF_RENDER_TRAVERSE_H
#define VNDF_RENDER_TRAVERSE_H

#include "packet.h"

VNDF_FN struct vndf_render_ray vndf_render_path_ray(VNDF_RENDER_FROM(float) path, uint stride, uint i) {
    return vndf_render_ray_of(path[VNDF_PATH_X * stride + i], path[VNDF_PATH_Y * stride + i],
                              path[VNDF_PATH_Z * stride + i], path[VNDF_PATH_DX * stride + i],
                              path[VNDF_PATH_DY * stride + i], path[VNDF_PATH_DZ * stride + i]);
}

VNDF_FN void vndf_render_store_hit(struct vndf_render_hit found, uint stride, uint i,
                                   VNDF_RENDER_TO(float) hit, VNDF_RENDER_TO(uint) triangle) {
    hit[VNDF_HIT_B1 * stride + i] = found.b1;
    hit[VNDF_HIT_B2 * stride + i] = found.b2;
    triangle[i] = found.triangle;
}

VNDF_RENDER_KERNEL vndf_render_traverse(VNDF_RENDER_IN(float) nodes, VNDF_RENDER_IN(float) leaves,
                                        VNDF_RENDER_IN(float) path, const uint count, const uint stride,
                                        VNDF_RENDER_OUT(float) hit, VNDF_RENDER_OUT(uint) triangle) {
    const uint i = VNDF_RENDER_ITEM;
    if (i >= count) return;
    // A path that carries nothing has ended.
    const int ended = path[VNDF_PATH_RED * stride + i] == 0.0f &&
                      path[VNDF_PATH_GREEN * stride + i] == 0.0f && path[VNDF_PATH_BLUE * stride + i] == 0.0f;
    const struct vndf_render_hit found =
        ended ? vndf_render_no_hit()
              : vndf_render_trace(nodes, leaves, vndf_render_path_ray(path, stride, i), 0);
    vndf_render_store_hit(found, stride, i, hit, triangle);
}

#if VNDF_PACKET > 1

// The same for a packet of paths to an item.
VNDF_RENDER_KERNEL vndf_render_packets(VNDF_RENDER_IN(float) nodes, VNDF_RENDER_IN(float) leaves,
                                       VNDF_RENDER_IN(float) path, const uint count, const uint stride,
                                       VNDF_RENDER_OUT(float) hit, VNDF_RENDER_OUT(uint) triangle) {
    const uint first = VNDF_PACKET * VNDF_RENDER_ITEM;
    if (first >= count) return;
    struct vndf_render_packet packet;
    // What is left of the last packet is filled with the last ray.
    for (int k = 0; k < VNDF_PACKET; ++k)
        vndf_render_add(&packet, k,
                        vndf_render_path_ray(path, stride, first + k < count ? first + k : count - 1));
    if (vndf_render_together(&packet))
        vndf_render_trace_packet(nodes, leaves, &packet);
    else
        for (int k = 0; k < VNDF_PACKET; ++k)
            packet.hit[k] = vndf_render_trace(nodes, leaves, packet.ray[k], 0);
    for (uint k = 0; k < VNDF_PACKET && first + k < count; ++k)
        vndf_render_store_hit(packet.hit[k], stride, first + k, hit, triangle);
}

#endif

VNDF_RENDER_KERNEL vndf_render_shadow(VNDF_RENDER_IN(float) nodes, VNDF_RENDER_IN(float) leaves,
                                      VNDF_RENDER_IN(float) path, VNDF_RENDER_IN(float) lights,
                                      VNDF_RENDER_IN(uint) slot, const uint count, const uint stride,
                                      VNDF_RENDER_OUT(float) light) {
    const uint i = VNDF_RENDER_ITEM;
    if (i >= count) return;
    const float red = lights[VNDF_LIGHT_RED * stride + i], green = lights[VNDF_LIGHT_GREEN * stride + i],
                blue = lights[VNDF_LIGHT_BLUE * stride + i];
    if (red == 0.0f && green == 0.0f && blue == 0.0f) return;
    const struct vndf_render_ray ray =
        vndf_render_ray_of(path[VNDF_PATH_X * stride + i], path[VNDF_PATH_Y * stride + i],
                           path[VNDF_PATH_Z * stride + i], lights[VNDF_LIGHT_DX * stride + i],
                           lights[VNDF_LIGHT_DY * stride + i], lights[VNDF_LIGHT_DZ * stride + i]);
    if (vndf_render_trace(nodes, leaves, ray, 1).triangle != VNDF_MISS) return;
    light[slot[i]] += red;
    light[stride + slot[i]] += green;
    light[2 * stride + slot[i]] += blue;
}

#endif
