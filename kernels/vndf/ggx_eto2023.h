// GGX reflections by the bounded spherical cap: fewer reflections below the horizon; and its density.
//
// Source: Eto & Tokuyoshi, Bounded VNDF Sampling for Smith-GGX Reflections, 2023, Listings 1 and 2, Equations
//     5 to 8 (i = wo, o = wi). Public code that cites Tokuyoshi & Eto, Bounded VNDF Sampling for the Smith-GGX BRDF,
//     2024, takes k = (1 - a^2) s^2 / (s^2 + a^2 wo.z^2), a = min(alpha_x, alpha_y, 1), s = 1 + |wo_xy|: the k of
//     Equation 6, for every alpha, and so of this file.
#ifndef VNDF_GGX_ETO2023_H
#define VNDF_GGX_ETO2023_H

#include "ggx.h"
#include "impl/caps.h"
#include "impl/mirror.h"

VNDF_BEGIN

// Equations 5 and 6: 1 - k without a difference; k counts beside 1. The conservative alpha is at most 1.
struct vndf_impl_bound {
    VNDF_REAL k, rest;
};
VNDF_FN struct vndf_impl_bound vndf_impl_ggx_bound(VNDF_REAL alpha_x, VNDF_REAL alpha_y, VNDF_REAL sine,
                                                   VNDF_REAL z2, int front) {
    struct vndf_impl_bound bound;
    VNDF_REAL a = vndf_impl_min(vndf_impl_min(alpha_x, alpha_y), VNDF_R(1.0)), a2 = a * a;
    VNDF_REAL s = VNDF_R(1.0) + sine, s2 = s * s;
    VNDF_REAL rcp = VNDF_R(1.0) / VNDF_FMA(a2, z2, s2);
    bound.rest = front ? a2 * (s2 + z2) * rcp : VNDF_R(0.0);
    bound.k = VNDF_R(1.0) - bound.rest;
    return bound;
}

// The cap of ggx_dupuy2023.h with b = 1 + k z for P and 2 - b = k Q + (1 - k) for Q; the half vector, divided
// by sqrt(b), has the height (1 - u2 + (1 - k) z / b) sqrt(b). k = 1 for wo.z <= 0, where this is the plain cap: b_front
// and n_front = k wo.z + |v| count above the surface alone. wo2 = |wo|^2.
VNDF_FN struct vndf_impl_sample vndf_impl_ggx_bounded(VNDF_REAL3 wo, struct vndf_impl_view v,
                                                      struct vndf_impl_cap cap, struct vndf_impl_bound bound,
                                                      VNDF_REAL b_front, VNDF_REAL n_front, VNDF_REAL wo2,
                                                      VNDF_REAL2 u) {
    struct vndf_impl_sample o;
    VNDF_REAL u1 = vndf_impl_u(u.x), u2 = vndf_impl_u(u.y), rest = VNDF_R(1.0) - u2;
    int front = v.z > VNDF_R(0.0);
    VNDF_REAL b = front ? b_front : cap.p;
    VNDF_REAL complement = VNDF_FMA(bound.k, cap.q, bound.rest);
    VNDF_REAL sqrt_b = front ? VNDF_SQRT(b) : cap.sqrt_p, rcp_b = VNDF_R(1.0) / sqrt_b;
    VNDF_REAL tangent = front ? cap.sine * rcp_b : cap.sqrt_q;
    VNDF_REAL height = front ? VNDF_FMA(bound.rest * cap.z * rcp_b, rcp_b, rest) : rest;
    VNDF_REAL square = u2 * VNDF_FMA(rest, b, complement), sin_o = VNDF_SQRT(square);
    struct vndf_impl_cap_half h = vndf_impl_cap_half_of(
        vndf_impl_azimuth_x(v), vndf_impl_azimuth_y(v), tangent, tangent * tangent,
        sin_o * vndf_impl_circle_cos(u1), sin_o * vndf_impl_circle_sin(u1), square,
        height * vndf_impl_cap_excess(u2, rest, b, cap.q, VNDF_FMA(bound.k, cap.z, cap.z)), height * sqrt_b);
    struct vndf_impl_mirror m = vndf_impl_mirror_of(wo.x, wo.y, wo.z, h.x, h.y, h.z, v.alpha_x, v.alpha_y);
    VNDF_REAL o2 = VNDF_FMA(m.x, m.x, VNDF_FMA(m.y, m.y, m.z * m.z)), rcp = VNDF_R(1.0) / VNDF_SQRT(o2);
    o.x = m.x * rcp;
    o.y = m.y * rcp;
    o.z = m.z * rcp;
    VNDF_REAL n = (front ? n_front : vndf_impl_hidden_area(v)) / VNDF_SQRT(wo2);
    VNDF_REAL pdf = vndf_impl_reflection_density(m.ratio, n, v.alpha_x, v.alpha_y);
    o.pdf = m.defined && n > VNDF_R(0.0) ? vndf_impl_finite(pdf) : VNDF_R(0.0);
    return vndf_impl_where(o2 > VNDF_R(0.0) && o2 <= VNDF_REAL_MAX, o);
}

VNDF_FN struct vndf_impl_sample vndf_impl_ggx_eto2023(VNDF_REAL3 wo, VNDF_REAL2 alpha, VNDF_REAL2 u) {
    struct vndf_impl_view v = vndf_impl_stretch(wo, alpha);
    struct vndf_impl_cap cap = vndf_impl_cap_of(v);
    // Only the direction of wo counts: its length is divided out where the listing takes it for 1.
    VNDF_REAL tangent2 = VNDF_FMA(wo.x, wo.x, wo.y * wo.y), wo2 = VNDF_FMA(wo.z, wo.z, tangent2);
    struct vndf_impl_bound bound = vndf_impl_ggx_bound(v.alpha_x, v.alpha_y, VNDF_SQRT(tangent2 / wo2),
                                                       wo.z * wo.z / wo2, v.z > VNDF_R(0.0));
    return vndf_impl_ggx_bounded(wo, v, cap, bound, VNDF_FMA(bound.k, cap.z, VNDF_R(1.0)),
                                 VNDF_FMA(bound.k, v.z, v.r), wo2, u);
}

// A reflection of wo by the bounded cap: the visible normal and the mirror step in one.
// wo: unit vector, local frame, anywhere on the sphere. For wo.z <= 0 the plain
//     cap. At wo = -z, where nothing is visible: a unit vector with density 0.
// alpha: in [1e-8, 1e3] each. For min(alpha) >= 1 the bound is valid but loose.
// u: u.x the azimuth of the cap, u.y its height.
// return: unit vector wi, with density vndf_ggx_pdf_wi_eto2023(wo, wi, alpha). It may still fall below the
//     horizon: give it no weight there. For reflection alone: refraction needs a plain visible normal.
// Accuracy: angle to the exact map, 99th percentile: 2 eps (1 + condition number), 2 behind the surface; double 2, 2.
VNDF_FN VNDF_REAL3 vndf_ggx_sample_wi_eto2023(VNDF_REAL3 wo, VNDF_REAL2 alpha, VNDF_REAL2 u) {
    return vndf_impl_direction(vndf_impl_ggx_eto2023(wo, alpha, u));
}

// The same; w: its density per steradian of wi, from the sampler's own terms.
VNDF_FN VNDF_REAL4 vndf_ggx_sample_wi_eto2023_with_pdf(VNDF_REAL3 wo, VNDF_REAL2 alpha, VNDF_REAL2 u) {
    return vndf_impl_direction_pdf(vndf_impl_ggx_eto2023(wo, alpha, u));
}

// The density of a cap of reflections above o_z = -k z, n_front as above.
VNDF_FN VNDF_REAL vndf_impl_ggx_bounded_pdf(VNDF_REAL3 wo, VNDF_REAL3 wi, struct vndf_impl_view v,
                                            VNDF_REAL gap, VNDF_REAL n_front) {
    struct vndf_impl_half h = vndf_impl_half_of(wo, wi, v.alpha_x, v.alpha_y);
    // The stretched reflection has height 2 (m . v) m.z / r - z / r > -k z / r, where h . wo = |h|^2 / 2.
    VNDF_REAL limit = gap * wo.z * h.scale;
    VNDF_REAL excess = VNDF_FMA(h.length2, h.z, -limit * h.q);
    // Rounding moves each component of wi, and so of h, by 2^-24, a sampler by little more: four times the effect on both
    // terms.
    VNDF_REAL slack = VNDF_R(4.0) * VNDF_EPSILON * h.scale *
                      (h.length2 + VNDF_R(4.0) * h.z + VNDF_R(2.0) * limit * h.q_slope);
    int inside = wo.z <= VNDF_R(0.0) || excess > -slack;
    VNDF_REAL n = wo.z > VNDF_R(0.0) ? n_front : vndf_impl_hidden_area(v);
    VNDF_REAL pdf = vndf_impl_ggx_reflection_pdf(h, n, v.alpha_x, v.alpha_y);
    return inside ? pdf : VNDF_R(0.0);
}

// The density of the bounded cap.
// Source: Eto & Tokuyoshi 2023, Listing 2 and Equation 8, with the Heaviside function that the listing omits,
//     so that it is a density over the whole sphere; for wo.z <= 0 that of the plain cap in the stable form.
// wo, wi: unit vectors, local frame, anywhere on the sphere.
// return: per steradian of wi; 0 outside the cap, which is judged with a slack for the rounding of wi.
// Accuracy: 16 eps; double 19.
//     Below alpha = 1e-2 the rounding of wi moves the density by more than that: use the sampler's _with_pdf
//     form there.
VNDF_FN VNDF_REAL vndf_ggx_pdf_wi_eto2023(VNDF_REAL3 wo, VNDF_REAL3 wi, VNDF_REAL2 alpha) {
    struct vndf_impl_view v = vndf_impl_stretch(wo, alpha);
    struct vndf_impl_bound bound = vndf_impl_ggx_bound(
        v.alpha_x, v.alpha_y, VNDF_SQRT(VNDF_FMA(wo.x, wo.x, wo.y * wo.y)), wo.z * wo.z, wo.z > VNDF_R(0.0));
    return vndf_impl_ggx_bounded_pdf(wo, wi, v, bound.rest, VNDF_FMA(bound.k, wo.z, v.r));
}

VNDF_END

#endif
