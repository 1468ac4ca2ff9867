// Stages: what a surface does with the light of the direction that was chosen for it, and where the path turns.
//
// Stages of their own, since one that evaluates a material twice is not vectorised across work-items: LLVM packs the halves.
#ifndef VNDF_RENDER_SHADE_H
#define VNDF_RENDER_SHADE_H

#include "lights.h"
#include "media.h"
#include "vector.h"

// Three planes of a queue as an argument of the library.
VNDF_FN VNDF_REAL3 vndf_render_argument(VNDF_RENDER_FROM(float) planes, uint k, uint stride, uint i) {
    return VNDF_MAKE3(planes[k * stride + i], planes[(k + 1) * stride + i], planes[(k + 2) * stride + i]);
}
// The channel of a path that carries one.
VNDF_FN int vndf_render_channel(VNDF_RENDER_FROM(float) path, uint stride, uint i) {
#if VNDF_DIELECTRIC && VNDF_DISPERSION
    const int green = path[VNDF_PATH_GREEN * stride + i] > 0.0f;
    return path[VNDF_PATH_RED * stride + i] > 0.0f ? 0 : (green ? 1 : 2);
#else
    (void)path;
    (void)stride;
    (void)i;
    return 0;
#endif
}
VNDF_FN struct vndf_bsdf vndf_render_bsdf_at(struct vndf_render_sizes sizes,
                                             VNDF_RENDER_FROM(float) materials, uint number,
                                             VNDF_RENDER_FROM(float) look, VNDF_RENDER_FROM(float) surface,
                                             VNDF_RENDER_FROM(float) path, float turn, uint stride, uint i) {
    const struct vndf_bsdf table = vndf_render_bsdf_of(
        materials, vndf_render_row_of(sizes, number), vndf_render_channel(path, stride, i),
        turn * surface[VNDF_SURFACE_GEOMETRIC * stride + i],
        turn * surface[(VNDF_SURFACE_GEOMETRIC + 1) * stride + i],
        surface[(VNDF_SURFACE_GEOMETRIC + 2) * stride + i]);
    return vndf_render_dressed(table, vndf_render_look_of(look, stride, i));
}

// The frame of a surface is turned to where the path comes from, that of a material is not: -1 where they differ, which only a
// dielectric has to know, and what z, and the geometric normal across it, are multiplied by.
VNDF_FN float vndf_render_turn(VNDF_RENDER_FROM(float) surface, uint stride, uint i) {
#if VNDF_DIELECTRIC
    return surface[VNDF_SURFACE_OFFSET * stride + i] < 0.0f ? -1.0f : 1.0f;
#else
    (void)surface;
    (void)stride;
    (void)i;
    return 1.0f;
#endif
}
VNDF_FN VNDF_REAL3 vndf_render_turned(VNDF_REAL3 w, float turn) {
    return VNDF_MAKE3(w.x, w.y, turn * w.z);
}

#if VNDF_RENDER_EMISSION
// What surfaces shine by themselves, beside what samples of them as lights bring. densities: of each triangle, its chance as a
// light per unit of area.
VNDF_RENDER_KERNEL vndf_render_glow(const struct vndf_render_sizes sizes, const struct vndf_render_sky sky,
                                    VNDF_RENDER_IN(float) materials, VNDF_RENDER_IN(uint) material,
                                    VNDF_RENDER_IN(float) look, VNDF_RENDER_IN(float) densities,
                                    VNDF_RENDER_IN(uint) triangle, VNDF_RENDER_IN(float) surface,
                                    VNDF_RENDER_IN(float) path, VNDF_RENDER_IN(uint) slot, const uint count,
                                    const uint stride, VNDF_RENDER_OUT(float) light) {
    const uint i = VNDF_RENDER_ITEM;
    struct vndf_rgb emission = vndf_render_rgb_at(
        materials, vndf_render_row_of(sizes, i < count ? material[i] : 0), VNDF_MATERIAL_EMISSION);
#if VNDF_RENDER_EMISSION_TEXTURE || VNDF_RENDER_VERTEX_COLOUR
    emission = vndf_render_times(emission, vndf_render_look_of(look, stride, i), VNDF_LOOK_EMISSION);
#else
    (void)look;
#endif
#if VNDF_RENDER_LAMP
    const float density = densities[i < count && sky.lamps > 0 ? triangle[i] : 0];
    const float pdf =
        sky.lamp_share * vndf_impl_min(density * surface[VNDF_SURFACE_SOLID * stride + i], 1e30f);
    const float weight = vndf_render_mis(pdf / vndf_render_path_pdf(path, stride, i));
#else
    (void)sky;
    (void)densities;
    (void)triangle;
    (void)surface;
    const float weight = 1.0f;
#endif
    vndf_render_add_light(vndf_render_vector_of(emission.r, emission.g, emission.b),
                          i < count ? weight : 0.0f, path, slot, count, stride, i, light);
}
#endif

// The light of the direction chosen becomes what of it arrives at the eye if nothing is in its way.
VNDF_RENDER_KERNEL vndf_render_connect(const struct vndf_render_sizes sizes, VNDF_RENDER_IN(float) materials,
                                       VNDF_RENDER_IN(uint) material, VNDF_RENDER_IN(float) look,
                                       VNDF_RENDER_IN(float) surface, VNDF_RENDER_IN(float) path,
                                       const uint stride, VNDF_RENDER_OUT(float) lights) {
    const uint i = VNDF_RENDER_ITEM;
    const float turn = vndf_render_turn(surface, stride, i);
    const struct vndf_bsdf bsdf =
        vndf_render_bsdf_at(sizes, materials, material[i], look, surface, path, turn, stride, i);
    const VNDF_REAL3 wi = vndf_render_argument(lights, VNDF_LIGHT_X, stride, i);
    const struct vndf_render_value value = vndf_render_evaluate(
        vndf_render_turned(vndf_render_argument(surface, VNDF_SURFACE_WO, stride, i), turn),
        vndf_render_turned(wi, turn), bsdf);
    // f / q times the power heuristic 1 / (1 + (p / q)^2) with f = weight p and the light's density q.
    float light_pdf = lights[VNDF_LIGHT_PDF * stride + i];
#if VNDF_RENDER_LONE_LIGHT
    const int point = light_pdf < 0.0f;
    light_pdf = vndf_impl_abs(light_pdf);
#endif
    const float ratio = vndf_impl_min(value.pdf / vndf_impl_max(light_pdf, 1e-12f), 1e15f);
#if VNDF_DIELECTRIC
    // Through the surface lights are not sampled, see vndf_render_scatter.
    const int reached = light_pdf > 0.0f && wi.z > 0.0f;
#else
    const int reached = light_pdf > 0.0f;
#endif
    const float alone = vndf_render_mis(ratio);
#if VNDF_RENDER_CONES
    // Or the path finds it itself.
    const int counts = reached && value.pdf <= lights[VNDF_LIGHT_MOST * stride + i];
#else
    const int counts = reached;
#endif
#if VNDF_RENDER_LONE_LIGHT
    const float share = counts ? ratio * (point ? 1.0f : alone) : 0.0f;
#else
    const float share = counts ? ratio * alone : 0.0f;
#endif
    struct vndf_rgb weight = value.weight;
#if VNDF_DIELECTRIC && VNDF_ABSORPTION
    // The light comes from forever away.
    weight = vndf_impl_rgb_product(
        weight, vndf_render_left(sizes, materials, path[VNDF_PATH_BODY * stride + i], VNDF_RENDER_FOREVER));
#endif
    lights[VNDF_LIGHT_RED * stride + i] *= path[VNDF_PATH_RED * stride + i] * (share * weight.r);
    lights[VNDF_LIGHT_GREEN * stride + i] *= path[VNDF_PATH_GREEN * stride + i] * (share * weight.g);
    lights[VNDF_LIGHT_BLUE * stride + i] *= path[VNDF_PATH_BLUE * stride + i] * (share * weight.b);
}

#if VNDF_DIELECTRIC
// From as far above the surface as rays begin to as far below it.
VNDF_FN void vndf_render_pass(VNDF_RENDER_FROM(float) surface, int crosses, VNDF_RENDER_TO(float) path,
                              uint stride, uint i) {
    const struct vndf_render_vector normal = vndf_render_vector_at(surface, VNDF_SURFACE_NORMAL, stride, i),
                                    tangent = vndf_render_vector_at(surface, VNDF_SURFACE_TANGENT, stride, i),
                                    face = vndf_render_vector_at(surface, VNDF_SURFACE_GEOMETRIC, stride, i);
    const struct vndf_render_vector geometric = vndf_render_world(normal, tangent, face);
    const float offset = surface[VNDF_SURFACE_OFFSET * stride + i];
    const float step = crosses ? -2.0f * vndf_impl_abs(offset) : 0.0f;
    vndf_render_store(vndf_render_sum(vndf_render_vector_at(path, VNDF_PATH_X, stride, i), step, geometric),
                      path, VNDF_PATH_X, stride, i);
}
#endif

// The path turns into a direction drawn from the material.
VNDF_RENDER_KERNEL vndf_render_scatter(const struct vndf_render_sizes sizes, VNDF_RENDER_IN(float) materials,
                                       VNDF_RENDER_IN(uint) material, VNDF_RENDER_IN(float) look,
                                       VNDF_RENDER_IN(float) surface, VNDF_RENDER_IN(uint) words,
                                       const uint quad, VNDF_RENDER_IN(uint) slot, const uint first,
                                       const uint stride, VNDF_RENDER_OUT(float) path) {
    const uint i = VNDF_RENDER_ITEM;
    const float turn = vndf_render_turn(surface, stride, i);
    const struct vndf_bsdf bsdf =
        vndf_render_bsdf_at(sizes, materials, material[i], look, surface, path, turn, stride, i);
    const struct vndf_render_quad u = vndf_render_random(words + VNDF_QUAD_WORDS * quad, first + slot[i]);
    const struct vndf_render_direction wi =
        vndf_render_draw(vndf_render_turned(vndf_render_argument(surface, VNDF_SURFACE_WO, stride, i), turn),
                         bsdf, VNDF_MAKE2(u.a, u.b), u.c);
    const float z = turn * wi.z;
    vndf_render_store(vndf_render_vector_of(wi.x, wi.y, z), path, VNDF_PATH_DX, stride, i);
    path[VNDF_PATH_RED * stride + i] *= wi.value.weight.r;
    path[VNDF_PATH_GREEN * stride + i] *= wi.value.weight.g;
    path[VNDF_PATH_BLUE * stride + i] *= wi.value.weight.b;
    float pdf = vndf_impl_min(vndf_impl_max(wi.value.pdf, 1e-12f), 1e30f);
#if VNDF_RENDER_CAPS_ALONE
    pdf = vndf_render_caps_alone(bsdf) ? -pdf : pdf;
#endif
#if VNDF_DIELECTRIC
    // Through the surface the path goes on from its other side. A light in its way counts in full: none was sampled there.
    const int crosses = z < 0.0f;
    vndf_render_pass(surface, crosses, path, stride, i);
#if VNDF_ABSORPTION
    const float body = path[VNDF_PATH_BODY * stride + i],
                entered = turn > 0.0f ? (float)(int)material[i] + 1.0f : 0.0f;
#if VNDF_THIN_WALLED
    const int enters = crosses && !bsdf.thin_walled;
#else
    const int enters = crosses;
#endif
    path[VNDF_PATH_BODY * stride + i] = enters ? entered : body;
#endif
    path[VNDF_PATH_PDF * stride + i] = crosses ? 1e30f : pdf;
#else
    path[VNDF_PATH_PDF * stride + i] = pdf;
#endif
}

#endif
