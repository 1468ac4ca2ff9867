// What a path brings of a light that it meets, beside what samples of that light bring.
#ifndef VNDF_RENDER_MEET_H
#define VNDF_RENDER_MEET_H

#include "effects.h"
#include "language.h"
#include "queues.h"
#include "vector.h"

// The weight of a sample with the density p beside one that has q in the same direction, by the power heuristic: from the
// ratio, since densities reach 1e38 and their squares nothing that is a number.
// Source: Veach & Guibas, Optimally Combining Sampling Techniques for Monte Carlo Rendering, 1995.
VNDF_FN float vndf_render_mis(float q_over_p) {
    const float ratio = vndf_impl_min(q_over_p, 1e15f);
    return 1.0f / VNDF_FMA(ratio, ratio, 1.0f);
}

// The density of a path's ray (VNDF_PATH_PDF).
VNDF_FN float vndf_render_path_pdf(VNDF_RENDER_FROM(float) path, uint stride, uint i) {
#if VNDF_RENDER_CAPS_ALONE
    return vndf_impl_abs(path[VNDF_PATH_PDF * stride + i]);
#else
    return path[VNDF_PATH_PDF * stride + i];
#endif
}

#if VNDF_RENDER_CONES
// The density of the material's own samples above which they alone count, of a light that fills a cap: where the lobe is much narrower
// than the light nearly all of them meet it, while samples of the light have the noise of the choice between lights, of which it is
// picked with a chance. q: the density of even samples, that chance within.
VNDF_FN float vndf_render_own_above(float q, float picked) {
    return picked < 1.0f ? vndf_impl_min(64.0f * q / (1.0f - picked), 3e38f) : 3e38f;
}
#endif

// The weight with which a path meets a light that fills a cap. q: the density of even samples of it, of which the chance that it is
// picked is a part.
VNDF_FN float vndf_render_meets_cap(float q, float picked, VNDF_RENDER_FROM(float) path, uint stride,
                                    uint i) {
    const float own = vndf_render_path_pdf(path, stride, i);
    const float weight = vndf_render_mis(q / own);
#if VNDF_RENDER_CONES
    const float rest = own > vndf_render_own_above(q, picked) ? 1.0f : 0.0f;
#else
    const float rest = 0.0f;
    (void)picked;
#endif
#if VNDF_RENDER_CAPS_ALONE
    return path[VNDF_PATH_PDF * stride + i] < 0.0f ? rest : weight;
#else
    (void)rest;
    return weight;
#endif
}

// Adds to the light of a path's pixel what it carries of this much. Items beyond the count have a slot of their own, which nobody
// reads.
VNDF_FN void vndf_render_add_light(struct vndf_render_vector radiance, float kept,
                                   VNDF_RENDER_FROM(float) path, VNDF_RENDER_FROM(uint) slot, uint count,
                                   uint stride, uint i, VNDF_RENDER_TO(float) light) {
    const uint to = i < count ? slot[i] : stride - 1;
    light[to] += kept * path[VNDF_PATH_RED * stride + i] * radiance.x;
    light[stride + to] += kept * path[VNDF_PATH_GREEN * stride + i] * radiance.y;
    light[2 * stride + to] += kept * path[VNDF_PATH_BLUE * stride + i] * radiance.z;
}

#endif
