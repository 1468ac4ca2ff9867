// Stages: the first hit of each path's ray, and the light that reaches a path past whatever may stand before the lights.
#ifndef VNDF_RENDER_TRAVERSE_H
#define VNDF_RENDER_TRAVERSE_H

#include "tree.h"

VNDF_RENDER_KERNEL vndf_render_traverse(VNDF_RENDER_IN(float) nodes, VNDF_RENDER_IN(float) leaves,
                                        VNDF_RENDER_IN(float) path, const uint count, const uint stride,
                                        VNDF_RENDER_OUT(float) hit, VNDF_RENDER_OUT(uint) triangle) {
    const uint i = VNDF_RENDER_ITEM;
    if (i >= count) return;
    const struct vndf_render_ray ray = vndf_render_ray_of(
        path[VNDF_PATH_X * stride + i], path[VNDF_PATH_Y * stride + i], path[VNDF_PATH_Z * stride + i],
        path[VNDF_PATH_DX * stride + i], path[VNDF_PATH_DY * stride + i], path[VNDF_PATH_DZ * stride + i]);
    const struct vndf_render_hit first = vndf_render_trace(nodes, leaves, ray, 0);
    hit[VNDF_HIT_B1 * stride + i] = first.b1;
    hit[VNDF_HIT_B2 * stride + i] = first.b2;
    triangle[i] = first.triangle;
}

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
