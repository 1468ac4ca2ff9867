// Stage: a path that has turned goes on in the world, or ends: then it carries nothing. Those that carry little end early, the
// more often the less they carry, and the others carry more for it.
#ifndef VNDF_RENDER_SURVIVE_H
#define VNDF_RENDER_SURVIVE_H

#include "random.h"
#include "vector.h"

VNDF_RENDER_KERNEL vndf_render_survive(VNDF_RENDER_IN(float) surface, VNDF_RENDER_IN(uint) words,
                                       const uint quad, VNDF_RENDER_IN(uint) slot, const uint first,
                                       const uint stride, const int roulette, VNDF_RENDER_OUT(float) path) {
    const uint i = VNDF_RENDER_ITEM;
    const struct vndf_render_quad u = vndf_render_random(words + VNDF_QUAD_WORDS * quad, first + slot[i]);
    const struct vndf_render_vector wi = vndf_render_vector_at(path, VNDF_PATH_DX, stride, i),
                                    normal = vndf_render_vector_at(surface, VNDF_SURFACE_NORMAL, stride, i),
                                    tangent = vndf_render_vector_at(surface, VNDF_SURFACE_TANGENT, stride, i);
    const struct vndf_render_vector on = vndf_render_unit_vector(vndf_render_world(normal, tangent, wi));
    const struct vndf_render_vector carried = vndf_render_vector_at(path, VNDF_PATH_RED, stride, i);
    const float luminance = VNDF_FMA(0.2126f, carried.x, VNDF_FMA(0.7152f, carried.y, 0.0722f * carried.z));
    const float chance = roulette ? vndf_impl_min(luminance, 1.0f) : 1.0f;
    const int goes_on = luminance > 0.0f && u.d < chance;
    const float raised = 1.0f / (goes_on ? chance : 1.0f);
    vndf_render_store(on, path, VNDF_PATH_DX, stride, i);
    path[VNDF_PATH_RED * stride + i] = goes_on ? raised * carried.x : 0.0f;
    path[VNDF_PATH_GREEN * stride + i] = goes_on ? raised * carried.y : 0.0f;
    path[VNDF_PATH_BLUE * stride + i] = goes_on ? raised * carried.z : 0.0f;
}

#endif
