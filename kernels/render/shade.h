// Stages: what a surface does with the light of the direction that was chosen for it, and where the path turns.
//
// Stages of their own, since one that evaluates a material twice is not vectorised across work-items: LLVM packs the halves.
#ifndef VNDF_RENDER_SHADE_H
#define VNDF_RENDER_SHADE_H

#include "lights.h"
#include "material.h"
#include "vector.h"

// Three planes of a queue as an argument of the library.
VNDF_FN VNDF_REAL3 vndf_render_argument(VNDF_RENDER_FROM(float) planes, uint k, uint stride, uint i) {
    return VNDF_MAKE3(planes[k * stride + i], planes[(k + 1) * stride + i], planes[(k + 2) * stride + i]);
}
VNDF_FN struct vndf_bsdf vndf_render_bsdf_at(struct vndf_render_sizes sizes,
                                             VNDF_RENDER_FROM(float) materials, uint number,
                                             VNDF_RENDER_FROM(float) surface, uint stride, uint i) {
    struct vndf_render_row row;
    row.count = sizes.materials;
    row.number = number == VNDF_MISS ? 0 : number;
    row.one = sizes.one;
    return vndf_render_bsdf_of(materials, row, surface[VNDF_SURFACE_GEOMETRIC * stride + i],
                               surface[(VNDF_SURFACE_GEOMETRIC + 1) * stride + i],
                               surface[(VNDF_SURFACE_GEOMETRIC + 2) * stride + i]);
}

// The light of the direction chosen becomes what of it arrives at the eye if nothing is in its way.
VNDF_RENDER_KERNEL vndf_render_connect(const struct vndf_render_sizes sizes, VNDF_RENDER_IN(float) materials,
                                       VNDF_RENDER_IN(uint) material, VNDF_RENDER_IN(float) surface,
                                       VNDF_RENDER_IN(float) path, const uint stride,
                                       VNDF_RENDER_OUT(float) lights) {
    const uint i = VNDF_RENDER_ITEM;
    const struct vndf_bsdf bsdf = vndf_render_bsdf_at(sizes, materials, material[i], surface, stride, i);
    const struct vndf_render_value value =
        vndf_render_evaluate(vndf_render_argument(surface, VNDF_SURFACE_WO, stride, i),
                             vndf_render_argument(lights, VNDF_LIGHT_X, stride, i), bsdf);
    // f / q times the power heuristic 1 / (1 + (p / q)^2) with f = weight p and the light's density q.
    const float light_pdf = lights[VNDF_LIGHT_PDF * stride + i];
    const float ratio = vndf_impl_min(value.pdf / vndf_impl_max(light_pdf, 1e-12f), 1e15f);
    const float share = material[i] != VNDF_MISS && light_pdf > 0.0f ? ratio * vndf_render_mis(ratio) : 0.0f;
    lights[VNDF_LIGHT_RED * stride + i] *= path[VNDF_PATH_RED * stride + i] * (share * value.weight.r);
    lights[VNDF_LIGHT_GREEN * stride + i] *= path[VNDF_PATH_GREEN * stride + i] * (share * value.weight.g);
    lights[VNDF_LIGHT_BLUE * stride + i] *= path[VNDF_PATH_BLUE * stride + i] * (share * value.weight.b);
}

// The path turns into a direction drawn from the material.
VNDF_RENDER_KERNEL vndf_render_scatter(const struct vndf_render_sizes sizes, VNDF_RENDER_IN(float) materials,
                                       VNDF_RENDER_IN(uint) material, VNDF_RENDER_IN(float) surface,
                                       VNDF_RENDER_IN(uint) words, const uint quad, VNDF_RENDER_IN(uint) slot,
                                       const uint first, const uint stride, VNDF_RENDER_OUT(float) path) {
    const uint i = VNDF_RENDER_ITEM;
    const struct vndf_bsdf bsdf = vndf_render_bsdf_at(sizes, materials, material[i], surface, stride, i);
    const struct vndf_render_quad u = vndf_render_random(words + VNDF_QUAD_WORDS * quad, first + slot[i]);
    const struct vndf_render_direction wi = vndf_render_draw(
        vndf_render_argument(surface, VNDF_SURFACE_WO, stride, i), bsdf, VNDF_MAKE2(u.a, u.b), u.c);
    vndf_render_store(vndf_render_vector_of(wi.x, wi.y, wi.z), path, VNDF_PATH_DX, stride, i);
    path[VNDF_PATH_RED * stride + i] *= wi.value.weight.r;
    path[VNDF_PATH_GREEN * stride + i] *= wi.value.weight.g;
    path[VNDF_PATH_BLUE * stride + i] *= wi.value.weight.b;
    path[VNDF_PATH_PDF * stride + i] = vndf_impl_min(vndf_impl_max(wi.value.pdf, 1e-12f), 1e30f);
}

#endif
