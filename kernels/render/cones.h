// Stage: lights that fill a cap of directions, spheres and the sun, by the reflections of GGX facets into the cap and no other
// (kernels/vndf/ggx_cone2026.h). Only in programs with VNDF_RENDER_CONES.
//
// What else the material sends there, diffusely, is found by even samples of the cap: one sample of a mixture of both, whose shares
// are about what each brings. Its density is that of both together, which is positive wherever there is light: whatever the shares,
// and whatever is in the way, the mean is right. Where the material's own samples are far denser than even ones they count alone
// (vndf_render_own_above), and under a coat both are weighed as without cones.
// Source of the mixture: Veach & Guibas, Optimally Combining Sampling Techniques for Monte Carlo Rendering, 1995, the balance
// heuristic for one sample.
#ifndef VNDF_RENDER_CONES_H
#define VNDF_RENDER_CONES_H

#include "material.h"
#include "shade.h"
#include "spheres.h"

#if VNDF_RENDER_CONES

VNDF_RENDER_KERNEL vndf_render_cones(const struct vndf_render_sizes sizes, VNDF_RENDER_IN(float) materials,
                                     VNDF_RENDER_IN(uint) material, VNDF_RENDER_IN(float) look,
                                     VNDF_RENDER_IN(float) surface, VNDF_RENDER_IN(float) path,
                                     VNDF_RENDER_IN(uint) words, const uint quad, const uint pick_quad,
                                     VNDF_RENDER_IN(uint) slot, const uint first, const uint stride,
                                     VNDF_RENDER_OUT(float) light) {
    const uint i = VNDF_RENDER_ITEM;
    const float cap = light[VNDF_LIGHT_GAP * stride + i];
    const struct vndf_render_quad u = vndf_render_random(words + VNDF_QUAD_WORDS * quad, first + slot[i]);
    const float which = vndf_render_random(words + VNDF_QUAD_WORDS * pick_quad, first + slot[i]).c;
    const float turn = vndf_render_turn(surface, stride, i);
    const struct vndf_bsdf bsdf =
        vndf_render_bsdf_at(sizes, materials, material[i], look, surface, path, turn, stride, i);
    const VNDF_REAL3 wo = vndf_render_argument(surface, VNDF_SURFACE_WO, stride, i),
                     axis = vndf_render_argument(light, VNDF_LIGHT_X, stride, i);
    const int alone = vndf_render_caps_alone(bsdf);
    const float part = vndf_render_facets_part(vndf_render_turned(wo, turn), vndf_render_turned(axis, turn),
                                               cap, bsdf),
                share = alone ? part : 0.0f;
    const struct vndf_ggx_cone2026 cone = vndf_ggx_cone2026_lobe(wo, axis, cap, vndf_impl_bsdf_alpha(bsdf));
    const VNDF_REAL3 reflected = vndf_ggx_sample_wi_cone2026_lobe(cone, VNDF_MAKE2(u.c, u.b));
    struct vndf_render_toward to;
    to.axis = vndf_render_vector_of(axis.x, axis.y, axis.z);
    to.gap = u.b * cap;
    const int by_cone = which < share;
    const struct vndf_render_vector even = vndf_render_about(to, u.c);
    const struct vndf_render_vector wi =
        vndf_render_either(vndf_render_vector_of(reflected.x, reflected.y, reflected.z), even, by_cone);
    const float facets = vndf_ggx_pdf_wi_cone2026_lobe(cone, VNDF_MAKE3(wi.x, wi.y, wi.z));
    const float evenly = 1.0f / (2.0f * VNDF_PI * vndf_impl_max(cap, 1e-30f));
    // Reflections that leave the cone, where it is none, have density 0.
    const float mixed = by_cone && !(facets > 0.0f) ? 0.0f : VNDF_FMA(share, facets, (1.0f - share) * evenly);
    const float picked = light[VNDF_LIGHT_PDF * stride + i];
    const float pdf = picked * vndf_impl_min(mixed, 1e30f);
    const int caps = cap > 0.0f;
    const struct vndf_render_vector world =
        vndf_render_world(vndf_render_vector_at(surface, VNDF_SURFACE_NORMAL, stride, i),
                          vndf_render_vector_at(surface, VNDF_SURFACE_TANGENT, stride, i), wi);
    const struct vndf_render_vector was = vndf_render_vector_at(light, VNDF_LIGHT_DX, stride, i);
    vndf_render_store(vndf_render_either(wi, to.axis, caps), light, VNDF_LIGHT_X, stride, i);
    vndf_render_store(vndf_render_either(world, was, caps), light, VNDF_LIGHT_DX, stride, i);
    light[VNDF_LIGHT_PDF * stride + i] = caps ? (alone ? -pdf : pdf) : picked;
    const float most = vndf_render_own_above(vndf_impl_min(picked * evenly, 1e30f), picked);
    light[VNDF_LIGHT_MOST * stride + i] = caps && alone ? most : 3e38f;
#if VNDF_RENDER_SPHERE_LIGHT
    const float distance = light[VNDF_LIGHT_DISTANCE * stride + i];
    const float way = vndf_render_sphere_way(distance, cap, vndf_render_gap(to.axis, wi));
    light[VNDF_LIGHT_DISTANCE * stride + i] = caps ? way : distance;
#endif
}

#endif

#endif
