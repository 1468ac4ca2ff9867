// The rough dielectric with every scattering between its facets: a random walk on the Smith microsurface, reflected and
// transmitted, which leaves it above or below.
//
// Source: Heitz, Hanika, d'Eon & Dachsbacher, Multiple-Scattering Microfacet BSDFs with the Smith Model, 2016, Section 5.2. Below
//     its facets the surface is what it is above them, turned upside down.
//
// VNDF_NDF holds. The walk carries energy: radiance is this over eta^2 where it passes from above to below. As walk_conductor.h
// it is exempt from vectorisation.
#ifndef VNDF_WALK_DIELECTRIC_H
#define VNDF_WALK_DIELECTRIC_H

#include "fresnel_dielectric.h"
#include "geometry.h"
#include "walk_surface.h"

VNDF_BEGIN

// A ray within the surface, in the frame of the side that it is on: `side` -1 has turned all directions around.
struct vndf_impl_walk_dielectric {
    struct vndf_impl_walk ray;
    VNDF_REAL side;
    VNDF_REAL eta;  // of the other side over this one
};
VNDF_FN struct vndf_impl_walk_dielectric vndf_impl_walk_dielectric_of(VNDF_REAL3 wo, VNDF_REAL eta,
                                                                      struct vndf_walk_random random,
                                                                      VNDF_REAL2 alpha) {
    struct vndf_impl_walk_dielectric walk;
    walk.side = wo.z < VNDF_R(0.0) ? VNDF_R(-1.0) : VNDF_R(1.0);
    walk.eta = walk.side < VNDF_R(0.0) ? VNDF_DIVIDE(VNDF_R(1.0), eta) : eta;
    walk.ray =
        vndf_impl_walk_of(VNDF_MAKE3(walk.side * wo.x, walk.side * wo.y, walk.side * wo.z), random, alpha);
    return walk;
}

// Mirrored at its facet, or through it to the other side; and on to the next.
VNDF_FN struct vndf_impl_walk_dielectric vndf_impl_walk_dielectric_onward(
    struct vndf_impl_walk_dielectric walk, VNDF_REAL2 alpha) {
    VNDF_REAL3 back = VNDF_MAKE3(-walk.ray.x, -walk.ray.y, -walk.ray.z);
    struct vndf_impl_sample m = vndf_impl_walk_normal(back, alpha, VNDF_MAKE2(walk.ray.u.b, walk.ray.u.c));
    VNDF_REAL3 wm = VNDF_MAKE3(m.x, m.y, m.z);
    VNDF_REAL cosine = vndf_impl_dot(back.x, back.y, back.z, m.x, m.y, m.z);
    int mirrored = walk.ray.u.d <= vndf_fresnel_dielectric(cosine, walk.eta);
    VNDF_REAL3 through = vndf_refract(back, wm, walk.eta), reflected = vndf_reflect(back, wm);
    // What rounding took for total reflection is that.
    mirrored = mirrored ||
               vndf_impl_dot(through.x, through.y, through.z, through.x, through.y, through.z) == VNDF_R(0.0);
    VNDF_REAL x = mirrored ? reflected.x : -through.x, y = mirrored ? reflected.y : -through.y,
              z = mirrored ? reflected.z : -through.z;
    VNDF_REAL rcp =
        VNDF_DIVIDE(VNDF_R(1.0), VNDF_SQRT(VNDF_FMA(x, x, VNDF_FMA(y, y, z * z))));  // no error adds up
    walk.ray.x = x * rcp;
    walk.ray.y = y * rcp;
    walk.ray.z = z * rcp;
    walk.ray.depth = mirrored ? walk.ray.depth : vndf_impl_walk_other_depth(walk.ray.depth);
    walk.side = mirrored ? walk.side : -walk.side;
    walk.eta = mirrored ? walk.eta : VNDF_DIVIDE(VNDF_R(1.0), walk.eta);
    walk.ray = vndf_impl_walk_next(walk.ray, alpha);
    return walk;
}

// A direction drawn from the dielectric by a walk.
// wo: unit vector, local frame, anywhere on the sphere.
// alpha: in [1e-8, 1e3] each.
// eta: index of refraction below the surface over that above it, in [1e-3, 1e3].
// random: vndf_walk_random_of(...), or what the last result holds.
// return: unit vector wi, anywhere on the sphere, whose density is BSDF times |cos(theta_i)|: weight 1, and 0 where a walk takes
//     more than VNDF_WALK_FACETS facets.
// Accuracy: as of vndf_walk_conductor_sample.
VNDF_FN struct vndf_walk_direction vndf_walk_dielectric_sample(VNDF_REAL3 wo, VNDF_REAL2 alpha, VNDF_REAL eta,
                                                               struct vndf_walk_random random) {
    struct vndf_impl_walk_dielectric walk = vndf_impl_walk_dielectric_of(wo, eta, random, alpha);
    struct vndf_walk_direction d;
    d.facets = 0;
    while (walk.ray.depth >= VNDF_R(0.0) && d.facets < VNDF_WALK_FACETS) {
        walk = vndf_impl_walk_dielectric_onward(walk, alpha);
        ++d.facets;
    }
    VNDF_REAL left = walk.ray.depth < VNDF_R(0.0) ? VNDF_R(1.0) : VNDF_R(0.0);
    d.wi_x = walk.side * walk.ray.x;
    d.wi_y = walk.side * walk.ray.y;
    d.wi_z = walk.side * walk.ray.z;
    d.weight = vndf_impl_rgb(left, left, left);
    d.random = walk.ray.random;
    return d;
}

// What a facet at `depth` sends along wi, in its frame, out of the surface: mirrored, or through it.
VNDF_FN VNDF_REAL vndf_impl_walk_dielectric_sent(struct vndf_impl_walk_dielectric walk, VNDF_REAL3 wi,
                                                 VNDF_REAL2 alpha) {
    VNDF_REAL3 back = VNDF_MAKE3(-walk.ray.x, -walk.ray.y, -walk.ray.z);
    int above = wi.z > VNDF_R(0.0);
    VNDF_REAL other = above ? VNDF_R(1.0) : walk.eta;
    VNDF_REAL x = VNDF_FMA(other, wi.x, back.x), y = VNDF_FMA(other, wi.y, back.y),
              z = VNDF_FMA(other, wi.z, back.z);
    VNDF_REAL length2 = VNDF_FMA(x, x, VNDF_FMA(y, y, z * z));
    // Through a facet h points to the side of the lesser index, and a facet's normal up.
    VNDF_REAL rcp = VNDF_DIVIDE(VNDF_R(1.0), VNDF_SQRT(length2 > VNDF_R(0.0) ? length2 : VNDF_R(1.0)));
    rcp = z < VNDF_R(0.0) ? -rcp : rcp;
    VNDF_REAL3 wm = VNDF_MAKE3(x * rcp, y * rcp, z * rcp);
    VNDF_REAL cosine = vndf_impl_dot(back.x, back.y, back.z, wm.x, wm.y, wm.z),
              passing = vndf_impl_dot(wi.x, wi.y, wi.z, wm.x, wm.y, wm.z);
    VNDF_REAL reflectance = vndf_fresnel_dielectric(cosine, walk.eta);
    VNDF_REAL normal_pdf = vndf_impl_walk_normal_pdf(back, wm, alpha);
    VNDF_REAL mirrored = reflectance * vndf_impl_walk_mirrored_pdf(back, wi, alpha) *
                         vndf_impl_walk_leaving(walk.ray.depth, wi, alpha);
    VNDF_REAL through = (VNDF_R(1.0) - reflectance) * normal_pdf * vndf_jacobian_refract(back, wi, walk.eta) *
                        vndf_impl_walk_leaving(vndf_impl_walk_other_depth(walk.ray.depth),
                                               VNDF_MAKE3(-wi.x, -wi.y, -wi.z), alpha);
    int refracted = cosine > VNDF_R(0.0) && passing < VNDF_R(0.0);
    return above ? mirrored : refracted ? through : VNDF_R(0.0);
}

// One walk's estimate of the BSDF times |cos(theta_i)|.
// wo, wi: unit vectors, local frame, anywhere on the sphere.
// alpha, eta, random: as of vndf_walk_dielectric_sample.
// return: f, the same for each channel, whose mean over walks is the BSDF; >= 0.
VNDF_FN struct vndf_walk_value vndf_walk_dielectric_eval(VNDF_REAL3 wo, VNDF_REAL3 wi, VNDF_REAL2 alpha,
                                                         VNDF_REAL eta, struct vndf_walk_random random) {
    struct vndf_impl_walk_dielectric walk = vndf_impl_walk_dielectric_of(wo, eta, random, alpha);
    struct vndf_walk_value value;
    VNDF_REAL f = VNDF_R(0.0);
    for (int facets = 0; walk.ray.depth >= VNDF_R(0.0) && facets < VNDF_WALK_FACETS; ++facets) {
        VNDF_REAL3 seen = VNDF_MAKE3(walk.side * wi.x, walk.side * wi.y, walk.side * wi.z);
        f += vndf_impl_walk_dielectric_sent(walk, seen, alpha);
        walk = vndf_impl_walk_dielectric_onward(walk, alpha);
    }
    value.f = vndf_impl_rgb(f, f, f);
    value.random = walk.ray.random;
    return value;
}

VNDF_END

#endif
