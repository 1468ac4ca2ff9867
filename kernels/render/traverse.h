// Stages: the first hit of each path's ray, and the light that reaches a path past whatever may stand before the lights.
#ifndef VNDF_RENDER_TRAVERSE_H
#define VNDF_RENDER_TRAVERSE_H

#include "packet.h"

VNDF_FN struct vndf_render_ray vndf_render_path_ray(VNDF_RENDER_FROM(float) path, uint stride, uint i) {
    return vndf_render_ray_of(path[VNDF_PATH_X * stride + i], path[VNDF_PATH_Y * stride + i],
                              path[VNDF_PATH_Z * stride + i], path[VNDF_PATH_DX * stride + i],
                              path[VNDF_PATH_DY * stride + i], path[VNDF_PATH_DZ * stride + i]);
}

// What of the scene lets a ray of this path pass. salt: of the sample and of what the ray is for.
VNDF_FN struct vndf_render_veil vndf_render_veil_of(struct vndf_render_looks looks,
                                                    VNDF_RENDER_FROM(uint) slot, uint first, uint salt,
                                                    uint i) {
    struct vndf_render_veil veil;
#if VNDF_RENDER_ALPHA
    veil.looks = looks;
    veil.ray = vndf_render_hash(salt + first + slot[i]);
#else
    (void)looks;
    (void)slot;
    (void)first;
    (void)salt;
    (void)i;
    veil.none = 0;
#endif
    return veil;
}

VNDF_FN void vndf_render_store_hit(struct vndf_render_hit found, uint stride, uint i,
                                   VNDF_RENDER_TO(float) hit, VNDF_RENDER_TO(uint) triangle) {
    hit[VNDF_HIT_B1 * stride + i] = found.b1;
    hit[VNDF_HIT_B2 * stride + i] = found.b2;
    triangle[i] = found.triangle;
#if VNDF_RENDER_SPHERE_LIGHT
    hit[VNDF_HIT_WAY * stride + i] = found.t;
#endif
}

VNDF_RENDER_KERNEL vndf_render_traverse(VNDF_RENDER_IN(float) nodes, VNDF_RENDER_IN(float) leaves,
                                        const struct vndf_render_sizes sizes, VNDF_RENDER_IN(float) vertices,
                                        VNDF_RENDER_IN(uint) triangles, VNDF_RENDER_IN(float) dressings,
                                        VNDF_RENDER_IN(uint) textures, VNDF_RENDER_IN(uint) texels,
                                        VNDF_RENDER_IN(uint) slot, const uint first, const uint salt,
                                        VNDF_RENDER_IN(float) path, const uint count, const uint stride,
                                        VNDF_RENDER_OUT(float) hit, VNDF_RENDER_OUT(uint) triangle) {
    const uint i = VNDF_RENDER_ITEM;
    if (i >= count) return;
    const struct vndf_render_looks looks =
        vndf_render_looks_of(sizes, vertices, triangles, dressings, textures, texels);
    // A path that carries nothing has ended.
    const int ended = path[VNDF_PATH_RED * stride + i] == 0.0f &&
                      path[VNDF_PATH_GREEN * stride + i] == 0.0f && path[VNDF_PATH_BLUE * stride + i] == 0.0f;
    const struct vndf_render_hit found =
        ended ? vndf_render_no_hit()
              : vndf_render_trace(nodes, leaves, vndf_render_path_ray(path, stride, i), VNDF_RENDER_ANYWHERE,
                                  0, vndf_render_veil_of(looks, slot, first, salt, i));
    vndf_render_store_hit(found, stride, i, hit, triangle);
}

#if VNDF_PACKET > 1

// The same for a packet of paths to an item.
VNDF_RENDER_KERNEL vndf_render_packets(VNDF_RENDER_IN(float) nodes, VNDF_RENDER_IN(float) leaves,
                                       const struct vndf_render_sizes sizes, VNDF_RENDER_IN(float) vertices,
                                       VNDF_RENDER_IN(uint) triangles, VNDF_RENDER_IN(float) dressings,
                                       VNDF_RENDER_IN(uint) textures, VNDF_RENDER_IN(uint) texels,
                                       VNDF_RENDER_IN(uint) slot, const uint first, const uint salt,
                                       VNDF_RENDER_IN(float) path, const uint count, const uint stride,
                                       VNDF_RENDER_OUT(float) hit, VNDF_RENDER_OUT(uint) triangle) {
    const uint begin = VNDF_PACKET * VNDF_RENDER_ITEM;
    if (begin >= count) return;
    const struct vndf_render_looks looks =
        vndf_render_looks_of(sizes, vertices, triangles, dressings, textures, texels);
    struct vndf_render_packet packet;
    // What is left of the last packet is filled with the last ray.
    for (int k = 0; k < VNDF_PACKET; ++k) {
        const uint i = begin + k < count ? begin + k : count - 1;
        vndf_render_add(&packet, k, vndf_render_path_ray(path, stride, i),
                        vndf_render_veil_of(looks, slot, first, salt, i));
    }
    if (vndf_render_together(&packet))
        vndf_render_trace_packet(nodes, leaves, &packet);
    else
        for (int k = 0; k < VNDF_PACKET; ++k)
            packet.hit[k] =
                vndf_render_trace(nodes, leaves, packet.ray[k], VNDF_RENDER_ANYWHERE, 0, packet.veil[k]);
    for (uint k = 0; k < VNDF_PACKET && begin + k < count; ++k)
        vndf_render_store_hit(packet.hit[k], stride, begin + k, hit, triangle);
}

#endif

VNDF_RENDER_KERNEL vndf_render_shadow(VNDF_RENDER_IN(float) nodes, VNDF_RENDER_IN(float) leaves,
                                      const struct vndf_render_sizes sizes, VNDF_RENDER_IN(float) vertices,
                                      VNDF_RENDER_IN(uint) triangles, VNDF_RENDER_IN(float) dressings,
                                      VNDF_RENDER_IN(uint) textures, VNDF_RENDER_IN(uint) texels,
                                      VNDF_RENDER_IN(float) path, VNDF_RENDER_IN(float) lights,
                                      VNDF_RENDER_IN(uint) slot, const uint first, const uint salt,
                                      const uint count, const uint stride, VNDF_RENDER_OUT(float) light) {
    const uint i = VNDF_RENDER_ITEM;
    if (i >= count) return;
    const float red = lights[VNDF_LIGHT_RED * stride + i], green = lights[VNDF_LIGHT_GREEN * stride + i],
                blue = lights[VNDF_LIGHT_BLUE * stride + i];
    if (red == 0.0f && green == 0.0f && blue == 0.0f) return;
    const struct vndf_render_ray ray =
        vndf_render_ray_of(path[VNDF_PATH_X * stride + i], path[VNDF_PATH_Y * stride + i],
                           path[VNDF_PATH_Z * stride + i], lights[VNDF_LIGHT_DX * stride + i],
                           lights[VNDF_LIGHT_DY * stride + i], lights[VNDF_LIGHT_DZ * stride + i]);
#if VNDF_RENDER_NEAR_LIGHT
    // Short of the light itself.
    const float far = 0.9999f * lights[VNDF_LIGHT_DISTANCE * stride + i];
#else
    const float far = VNDF_RENDER_ANYWHERE;
#endif
    const struct vndf_render_looks looks =
        vndf_render_looks_of(sizes, vertices, triangles, dressings, textures, texels);
    const struct vndf_render_veil veil = vndf_render_veil_of(looks, slot, first, salt, i);
    if (vndf_render_trace(nodes, leaves, ray, far, 1, veil).triangle != VNDF_MISS) return;
    light[slot[i]] += red;
    light[stride + slot[i]] += green;
    light[2 * stride + slot[i]] += blue;
}

#endif
