// The rough conductor with every scattering between its facets: a random walk on the Smith microsurface, the ground truth of
// what energy.h approximates.
//
// Source: Heitz, Hanika, d'Eon & Dachsbacher, Multiple-Scattering Microfacet BSDFs with the Smith Model, 2016, Algorithms 2
//     and 3. Their h is -log C1(h) here (walk_surface.h).
//
// Of the material (bsdf.h) it takes alpha, the reflectance and the tint; VNDF_NDF holds, VNDF_MASKING is correlated, which is
// what the walk has after one facet. A walk loops until it leaves: no compiler vectorises it across work-items, and nothing
// here is asked to be.
#ifndef VNDF_WALK_CONDUCTOR_H
#define VNDF_WALK_CONDUCTOR_H

#include "bsdf.h"
#include "walk_surface.h"

#if VNDF_CONDUCTOR

VNDF_BEGIN

// A ray within the surface, and what it has left of the light.
struct vndf_impl_walk_conductor {
    struct vndf_impl_walk ray;
    struct vndf_rgb weight;
};
VNDF_FN struct vndf_impl_walk_conductor vndf_impl_walk_conductor_of(VNDF_REAL3 wo,
                                                                    struct vndf_walk_random random,
                                                                    VNDF_REAL2 alpha) {
    struct vndf_impl_walk_conductor walk;
    walk.ray = vndf_impl_walk_of(wo, random, alpha);
    walk.weight = vndf_impl_rgb(VNDF_R(1.0), VNDF_R(1.0), VNDF_R(1.0));
    return walk;
}

// Mirrored at its facet, and on to the next.
VNDF_FN struct vndf_impl_walk_conductor vndf_impl_walk_conductor_onward(struct vndf_impl_walk_conductor walk,
                                                                        struct vndf_bsdf bsdf,
                                                                        VNDF_REAL2 alpha) {
    VNDF_REAL3 back = VNDF_MAKE3(-walk.ray.x, -walk.ray.y, -walk.ray.z);
    struct vndf_impl_sample s = vndf_impl_walk_mirrored(back, alpha, VNDF_MAKE2(walk.ray.u.b, walk.ray.u.c));
    VNDF_REAL cosine = vndf_impl_half_cosine(back, VNDF_MAKE3(s.x, s.y, s.z));
    walk.weight = vndf_impl_rgb_product(walk.weight, vndf_impl_bsdf_reflectance(bsdf, cosine));
    walk.ray.x = s.x;
    walk.ray.y = s.y;
    walk.ray.z = s.z;
    walk.ray = vndf_impl_walk_next(walk.ray, alpha);
    return walk;
}

// A direction drawn from the conductor by a walk.
// wo: unit vector, local frame.
// random: vndf_walk_random_of(...), or what the last result holds.
// return: unit vector wi, wi.z > 0, with the weight BSDF times cos(theta_i) over its density, which is not known. Weight 0 for
//     wo.z <= 0 and where a walk takes more than VNDF_WALK_FACETS facets.
// Accuracy: unbiased but for the walks given up; all light is reflected by a perfect mirror within the error of 2^20 walks
//     ("a walk loses no light").
VNDF_FN struct vndf_walk_direction vndf_walk_conductor_sample(VNDF_REAL3 wo, struct vndf_bsdf bsdf,
                                                              struct vndf_walk_random random) {
    VNDF_REAL2 alpha = vndf_impl_bsdf_alpha(bsdf);
    struct vndf_impl_walk_conductor walk = vndf_impl_walk_conductor_of(wo, random, alpha);
    struct vndf_walk_direction d;
    int front = wo.z > VNDF_R(0.0);
    d.facets = 0;
    while (front && walk.ray.depth >= VNDF_R(0.0) && d.facets < VNDF_WALK_FACETS) {
        walk = vndf_impl_walk_conductor_onward(walk, bsdf, alpha);
        ++d.facets;
    }
    int left = front && walk.ray.depth < VNDF_R(0.0);
    d.wi_x = left ? walk.ray.x : VNDF_R(0.0);
    d.wi_y = left ? walk.ray.y : VNDF_R(0.0);
    d.wi_z = left ? walk.ray.z : VNDF_R(1.0);
    d.weight = vndf_impl_rgb_scaled(walk.weight, left ? VNDF_R(1.0) : VNDF_R(0.0));
    d.random = walk.ray.random;
    return d;
}

// One walk's estimate of the BSDF times cos(theta_i): what each of its facets sends along wi out of the surface.
// wo, wi: unit vectors, local frame.
// random: as of vndf_walk_conductor_sample.
// return: f for each channel, whose mean over walks is the BSDF; >= 0, of finite variance; 0 unless both are above the horizon.
VNDF_FN struct vndf_walk_value vndf_walk_conductor_eval(VNDF_REAL3 wo, VNDF_REAL3 wi, struct vndf_bsdf bsdf,
                                                        struct vndf_walk_random random) {
    VNDF_REAL2 alpha = vndf_impl_bsdf_alpha(bsdf);
    struct vndf_impl_walk_conductor walk = vndf_impl_walk_conductor_of(wo, random, alpha);
    struct vndf_walk_value value;
    int above = wo.z > VNDF_R(0.0) && wi.z > VNDF_R(0.0);
    value.f = vndf_impl_rgb(VNDF_R(0.0), VNDF_R(0.0), VNDF_R(0.0));
    for (int facets = 0; above && walk.ray.depth >= VNDF_R(0.0) && facets < VNDF_WALK_FACETS; ++facets) {
        VNDF_REAL3 back = VNDF_MAKE3(-walk.ray.x, -walk.ray.y, -walk.ray.z);
        VNDF_REAL sent =
            vndf_impl_walk_mirrored_pdf(back, wi, alpha) * vndf_impl_walk_leaving(walk.ray.depth, wi, alpha);
        struct vndf_rgb reflectance = vndf_impl_rgb_product(
            walk.weight, vndf_impl_bsdf_reflectance(bsdf, vndf_impl_half_cosine(back, wi)));
        value.f =
            vndf_impl_rgb(VNDF_FMA(sent, reflectance.r, value.f.r), VNDF_FMA(sent, reflectance.g, value.f.g),
                          VNDF_FMA(sent, reflectance.b, value.f.b));
        walk = vndf_impl_walk_conductor_onward(walk, bsdf, alpha);
    }
    value.random = walk.ray.random;
    return value;
}

VNDF_END

#endif

#endif
