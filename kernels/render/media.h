// Stage: what the body that a path went through has left of its light, and where it meets a surface with a dispersion, the channel
// that it goes on with (kernels/vndf/bsdf.h). Only in programs with one of these effects.
//
// A path is in the body whose surface it went through last, and outside after it came out of any: bodies do not overlap, and the
// camera is outside.
#ifndef VNDF_RENDER_MEDIA_H
#define VNDF_RENDER_MEDIA_H

#include "material.h"
#include "random.h"
#include "surface.h"
#include "vector.h"

#if VNDF_DIELECTRIC && (VNDF_ABSORPTION || VNDF_DISPERSION)

#define VNDF_RENDER_FOREVER 1e18f

VNDF_RENDER_KERNEL vndf_render_media(const struct vndf_render_sizes sizes, VNDF_RENDER_IN(float) vertices,
                                     VNDF_RENDER_IN(uint) triangles, VNDF_RENDER_IN(float) materials,
                                     VNDF_RENDER_IN(float) hit, VNDF_RENDER_IN(uint) triangle,
                                     VNDF_RENDER_IN(uint) words, const uint quad, VNDF_RENDER_IN(uint) slot,
                                     const uint first, const uint count, const uint stride,
                                     VNDF_RENDER_OUT(float) path) {
    const uint i = VNDF_RENDER_ITEM;
    const int met = i < count && triangle[i] != VNDF_MISS;
    const uint number = met ? triangle[i] : 0;
    struct vndf_rgb carried =
        vndf_impl_rgb(path[VNDF_PATH_RED * stride + i], path[VNDF_PATH_GREEN * stride + i],
                      path[VNDF_PATH_BLUE * stride + i]);
#if VNDF_ABSORPTION
    const struct vndf_render_vector from = vndf_render_vector_at(path, VNDF_PATH_X, stride, i);
    const struct vndf_render_vector way =
        vndf_render_sum(vndf_render_mix(vndf_render_corner(sizes, vertices, triangles, number, 0),
                                        vndf_render_corner(sizes, vertices, triangles, number, 1),
                                        vndf_render_corner(sizes, vertices, triangles, number, 2),
                                        hit[VNDF_HIT_B1 * stride + i], hit[VNDF_HIT_B2 * stride + i]),
                        -1.0f, from);
    const float length = met ? VNDF_SQRT(vndf_render_dot(way, way)) : VNDF_RENDER_FOREVER;
    carried = vndf_impl_rgb_product(
        carried, vndf_render_left(sizes, materials, path[VNDF_PATH_BODY * stride + i], length));
#else
    (void)vertices;
    (void)hit;
#endif
#if VNDF_DISPERSION
    const struct vndf_render_quad u = vndf_render_random(words + VNDF_QUAD_WORDS * quad, first + slot[i]);
    const uint surface = triangles[VNDF_TRIANGLE_MATERIAL * sizes.triangles + number];
    // In proportion to what each carries: of one channel alone it is that one.
    const float sum = carried.r + carried.g + carried.b, place = u.d * sum;
    const int disperses =
        met && materials[VNDF_MATERIAL_DISPERSION * sizes.materials + surface] > 0.0f && sum > 0.0f;
    const int red = place < carried.r;
    const int blue = carried.b > 0.0f && place >= carried.r + carried.g;
    const int green = !red && !blue;
    carried.r = disperses ? (red ? sum : 0.0f) : carried.r;
    carried.g = disperses ? (green ? sum : 0.0f) : carried.g;
    carried.b = disperses ? (blue ? sum : 0.0f) : carried.b;
#else
    (void)words;
    (void)quad;
    (void)slot;
    (void)first;
#endif
    path[VNDF_PATH_RED * stride + i] = carried.r;
    path[VNDF_PATH_GREEN * stride + i] = carried.g;
    path[VNDF_PATH_BLUE * stride + i] = carried.b;
}

#endif

#endif
