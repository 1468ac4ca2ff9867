// The microsurface that a walk goes over: its optical depth, and what the distribution that VNDF_NDF chooses supplies.
//
// Source: Heitz, Hanika, d'Eon & Dachsbacher, Multiple-Scattering Microfacet BSDFs with the Smith Model, 2016. A ray at height
//     h has the part C1(h)^Lambda of its way up before it (Equation 12). Heights enter as C1 alone, so that their distribution does
//     not matter; and as the depth -log C1, in which the surface is an exponential medium: going by e / Lambda with an
//     exponential e leads to the next facet (their Algorithm 1), down where Lambda < 0, and above 0 out of the surface.
#ifndef VNDF_WALK_SURFACE_H
#define VNDF_WALK_SURFACE_H

#include "effects.h"
#include "fresnel.h"
#include "walk_random.h"
#if VNDF_CHOSEN(VNDF_NDF, beckmann)
#include "beckmann_jakob2014.h"
#include "impl/mirror.h"
#else
#include "ggx_dupuy2023.h"
#endif

// A walk that takes longer is given up, with weight 0. Of 3 10^5 walks none takes more than 12 facets at alpha = 1, and 56 at 10.
#ifndef VNDF_WALK_FACETS
#define VNDF_WALK_FACETS 1024
#endif

VNDF_BEGIN

// Where a walk left the surface, what it has left of the light, after how many facets, and the random numbers behind it.
struct vndf_walk_direction {
    VNDF_REAL wi_x, wi_y, wi_z;
    struct vndf_rgb weight;
    int facets;
    struct vndf_walk_random random;
};

// An estimate of BSDF times |cos(theta_i)|.
struct vndf_walk_value {
    struct vndf_rgb f;
    struct vndf_walk_random random;
};

// --- The distribution ---

VNDF_FN VNDF_REAL vndf_impl_walk_lambda(VNDF_REAL3 w, VNDF_REAL2 alpha) {
#if VNDF_CHOSEN(VNDF_NDF, beckmann)
    return vndf_beckmann_lambda(w, alpha);
#else
    return vndf_ggx_lambda(w, alpha);
#endif
}

// A normal visible from w, anywhere on the sphere.
VNDF_FN struct vndf_impl_sample vndf_impl_walk_normal(VNDF_REAL3 w, VNDF_REAL2 alpha, VNDF_REAL2 u) {
#if VNDF_CHOSEN(VNDF_NDF, beckmann)
    return vndf_impl_beckmann_jakob2014(vndf_beckmann_lobe_of(w, alpha), u);
#else
    return vndf_impl_ggx_dupuy2023(vndf_ggx_lobe_of(w, alpha), u);
#endif
}
VNDF_FN VNDF_REAL vndf_impl_walk_normal_pdf(VNDF_REAL3 w, VNDF_REAL3 wm, VNDF_REAL2 alpha) {
#if VNDF_CHOSEN(VNDF_NDF, beckmann)
    return vndf_beckmann_pdf_wm(w, wm, alpha);
#else
    return vndf_ggx_pdf_wm(w, wm, alpha);
#endif
}

// w mirrored at a normal visible from it.
VNDF_FN struct vndf_impl_sample vndf_impl_walk_mirrored(VNDF_REAL3 w, VNDF_REAL2 alpha, VNDF_REAL2 u) {
#if VNDF_CHOSEN(VNDF_NDF, beckmann)
    struct vndf_impl_sample m = vndf_impl_walk_normal(w, alpha, u);
    return vndf_impl_mirrored(w.x, w.y, w.z, m);
#else
    struct vndf_ggx_lobe lobe = vndf_ggx_lobe_of(w, alpha);
    return vndf_impl_lobe_reflection(lobe, lobe.axis.height, vndf_impl_cap_half(lobe, u));
#endif
}
VNDF_FN VNDF_REAL vndf_impl_walk_mirrored_pdf(VNDF_REAL3 w, VNDF_REAL3 mirrored, VNDF_REAL2 alpha) {
#if VNDF_CHOSEN(VNDF_NDF, beckmann)
    return vndf_beckmann_pdf_wi(w, mirrored, alpha);
#else
    return vndf_ggx_pdf_wi(w, mirrored, alpha);
#endif
}

// --- Rays ---

// The depth of the next facet on a ray; -1 where there is none, and the ray leaves the surface.
VNDF_FN VNDF_REAL vndf_impl_walk_depth(VNDF_REAL depth, VNDF_REAL3 ray, VNDF_REAL2 alpha, VNDF_REAL u) {
    VNDF_REAL lambda = vndf_impl_walk_lambda(ray, alpha), way = -vndf_impl_log_of_share(u);
    int leaves = lambda > VNDF_R(-0.5) && way >= depth * lambda;  // down it is -1 at most
    VNDF_REAL next = depth - VNDF_DIVIDE(way, leaves ? VNDF_R(1.0) : lambda);
    return leaves ? VNDF_R(-1.0) : vndf_impl_max(next, VNDF_R(0.0));  // below 0 by rounding
}

// A ray within the surface.
struct vndf_impl_walk {
    VNDF_REAL x, y, z, depth;
    struct vndf_impl_quad u;  // of its next facet
    struct vndf_walk_random random;
};

// From its facet to the next, at `depth`.
VNDF_FN struct vndf_impl_walk vndf_impl_walk_next(struct vndf_impl_walk walk, VNDF_REAL2 alpha) {
    walk.u = vndf_impl_walk_quad(walk.random);
    ++walk.random.drawn;
    walk.depth = vndf_impl_walk_depth(walk.depth, VNDF_MAKE3(walk.x, walk.y, walk.z), alpha, walk.u.a);
    return walk;
}
// To the first, against wo, which is above the surface.
VNDF_FN struct vndf_impl_walk vndf_impl_walk_of(VNDF_REAL3 wo, struct vndf_walk_random random,
                                                VNDF_REAL2 alpha) {
    struct vndf_impl_walk walk;
    walk.x = -wo.x;
    walk.y = -wo.y;
    walk.z = -wo.z;
    walk.depth = VNDF_R(0.0);
    walk.random = random;
    return vndf_impl_walk_next(walk, alpha);
}

// The part of the light along w that leaves the surface from there: 0 for w below the horizon.
VNDF_FN VNDF_REAL vndf_impl_walk_leaving(VNDF_REAL depth, VNDF_REAL3 w, VNDF_REAL2 alpha) {
    VNDF_REAL optical = depth * vndf_impl_walk_lambda(w, alpha);
    return w.z > VNDF_R(0.0) ? vndf_impl_exp(-optical) : VNDF_R(0.0);
}

// The depth of the same place seen from the other side, where C1 is 1 less what it is here.
VNDF_FN VNDF_REAL vndf_impl_walk_other_depth(VNDF_REAL depth) {
    // 1 - e^-d by its series where the difference would cancel; depth 0 is not below every facet.
    VNDF_REAL series = depth * VNDF_FMA(VNDF_R(-0.5), depth, VNDF_R(1.0));
    VNDF_REAL rest = depth < VNDF_R(1e-3) ? series : VNDF_R(1.0) - vndf_impl_exp(-depth);
    return -vndf_impl_log_of_share(vndf_impl_max(rest, VNDF_R(2.3283064365386963e-10)));
}

VNDF_END

#endif
