// GGX visible normals by slopes: the published sampler with its rational fit, and the same map made exact.
//
// Source: Heitz & d'Eon, Importance Sampling Microfacet-Based BSDFs with the Distribution of Visible Normals,
//     2014, supplement 1, Algorithms 1 and 3 (omega_i = wo, omega_m = wm), without its thresholds.
#ifndef VNDF_GGX_HEITZ_DEON2014_H
#define VNDF_GGX_HEITZ_DEON2014_H

#include "ggx.h"
#include "impl/lobe.h"
#include "impl/slopes.h"

VNDF_BEGIN

// What both forms share: the polar angle of the lobe, and the slope in the plane of incidence.
struct vndf_impl_incidence {
    VNDF_REAL alpha_x, alpha_y, ex, ey, sqrt_p;
    struct vndf_impl_slope slope;
};
VNDF_FN struct vndf_impl_incidence vndf_impl_ggx_incidence(struct vndf_ggx_lobe lobe, VNDF_REAL u1) {
    struct vndf_impl_polar polar = vndf_impl_polar_of(lobe);
    struct vndf_impl_incidence i;
    i.slope = vndf_impl_ggx_slope(polar.z, polar.sine, polar.p, polar.q, polar.sqrt_p, vndf_impl_u(u1));
    i.alpha_x = lobe.alpha_x;
    i.alpha_y = lobe.alpha_y;
    i.ex = polar.x;
    i.ey = polar.y;
    i.sqrt_p = polar.sqrt_p;
    return i;
}

// The normal of the slopes tan(psi) along and tan(lambda) sqrt(1 + tan(psi)^2) across the plane of incidence,
// times cos(psi) cos(lambda): no division, no infinity. `across` is sin(lambda) with `scale` cos(lambda).
VNDF_FN struct vndf_impl_sample vndf_impl_ggx_slope_normal(struct vndf_impl_incidence i, VNDF_REAL across,
                                                           VNDF_REAL scale, VNDF_REAL weight) {
    VNDF_REAL along = i.slope.sin_psi * scale;
    // Products are negated, not `along`: g++ 12 makes one instruction of -fma(a, b, c), which turns -0 into 0.
    VNDF_REAL hx = VNDF_FMA(across, i.ey, -(along * i.ex)), hy = VNDF_FMA(-across, i.ex, -(along * i.ey));
    // Made dependent on hy, which is a number, so that LLVM's SLP pass does not pack this quotient with another one.
    VNDF_REAL visible = hy <= VNDF_REAL_MAX ? i.slope.visible : VNDF_R(1.0);
    return vndf_impl_ggx_unstretch(
        hx, hy, i.slope.cos_psi * scale, i.alpha_x, i.alpha_y,
        i.sqrt_p > VNDF_R(0.0) ? VNDF_DIVIDE(weight * visible, i.sqrt_p) : VNDF_R(0.0));
}

// The conditional distribution of z = tan(lambda) has the tail (eta - sin eta) / (2 pi), eta = pi - 2
// |lambda|.
VNDF_FN struct vndf_impl_sample vndf_impl_ggx_heitz_deon2014_exact(struct vndf_ggx_lobe lobe, VNDF_REAL2 u) {
    struct vndf_impl_incidence i = vndf_impl_ggx_incidence(lobe, u.x);
    VNDF_REAL u2 = vndf_impl_u(u.y);
    int upper = u2 > VNDF_R(0.5);
    VNDF_REAL kappa = vndf_impl_kepler_k(upper ? VNDF_R(1.0) - u2 : u2);
    VNDF_REAL cos_lambda = vndf_impl_kepler_sin_half(kappa), sin_lambda = vndf_impl_kepler_cos_half(kappa);
    return vndf_impl_ggx_slope_normal(i, upper ? sin_lambda : -sin_lambda, cos_lambda,
                                      VNDF_R(2.0) * cos_lambda);
}

// The published fit z(U), U = |2 u2 - 1|, of numerator N and denominator D, re-expanded in w = 1 - U, where
// its denominator, which falls to 4.92e-4 at U = 1, is a sum instead of a difference.
VNDF_FN struct vndf_impl_sample vndf_impl_ggx_heitz_deon2014(struct vndf_ggx_lobe lobe, VNDF_REAL2 u) {
    struct vndf_impl_incidence i = vndf_impl_ggx_incidence(lobe, u.x);
    VNDF_REAL u2 = vndf_impl_u(u.y);
    int upper = u2 > VNDF_R(0.5);
    VNDF_REAL w = VNDF_R(2.0) * (upper ? VNDF_R(1.0) - u2 : u2);
    VNDF_REAL big_u = VNDF_R(1.0) - w;
    VNDF_REAL n1 = VNDF_FMA(VNDF_FMA(VNDF_R(0.27385), w, VNDF_R(0.18599)), w, VNDF_R(0.00357));
    VNDF_REAL d2 = VNDF_FMA(VNDF_FMA(VNDF_R(-0.093073), w, VNDF_R(0.588639)), w, VNDF_R(0.101941));
    VNDF_REAL n = big_u * n1, d = VNDF_FMA(d2, w, VNDF_R(0.000492));
    // The density of z is 1 / (2 z'(U)) = D^2 / (2 (N' D - N D')), derivatives by U = 1 - w.
    VNDF_REAL dn = n1 - big_u * VNDF_FMA(VNDF_R(0.5477), w, VNDF_R(0.18599));
    VNDF_REAL dd = -VNDF_FMA(VNDF_FMA(VNDF_R(-0.279219), w, VNDF_R(1.177278)), w, VNDF_R(0.101941));
    VNDF_REAL slope_density = VNDF_DIVIDE(VNDF_R(0.5) * d * d, VNDF_FMA(dn, d, -n * dd));
    VNDF_REAL across = VNDF_DIVIDE(n, d), length2 = VNDF_FMA(across, across, VNDF_R(1.0));
    struct vndf_impl_sample m = vndf_impl_ggx_slope_normal(i, upper ? across : -across, VNDF_R(1.0),
                                                           VNDF_PI * slope_density * length2 * length2);
    return vndf_impl_where(lobe.wo_z >= VNDF_R(0.0), m);
}

// A visible normal by the published slope sampler: approximate. Its fit of the conditional distribution is
// cut at |z| = 7.256 and off by up to 5.4e-4 in probability; `clvndf check` measures and reports this bias.
// wo: unit vector, local frame, wo.z >= 0. The method is not defined below the
//     horizon: (0, 0, 1) with density 0.
// alpha: in [1e-8, 1e3] each.
// u: u.x the slope in the plane of incidence, u.y the one across.
// return: unit vector wm, wm.z >= 0. vndf_ggx_pdf_wm is only near its density: the _with_pdf form has it.
// Accuracy: angle to the published map, 99th percentile: 1 eps (1 + condition number); double 1.
VNDF_FN VNDF_REAL3 vndf_ggx_sample_wm_heitz_deon2014(VNDF_REAL3 wo, VNDF_REAL2 alpha, VNDF_REAL2 u) {
    return vndf_impl_direction(vndf_impl_ggx_heitz_deon2014(vndf_ggx_lobe_of(wo, alpha), u));
}

// The same; w: the density per steradian of wm of the map as it is, fit included.
VNDF_FN VNDF_REAL4 vndf_ggx_sample_wm_heitz_deon2014_with_pdf(VNDF_REAL3 wo, VNDF_REAL2 alpha, VNDF_REAL2 u) {
    return vndf_impl_direction_pdf(vndf_impl_ggx_heitz_deon2014(vndf_ggx_lobe_of(wo, alpha), u));
}

// The same for many u and one wo and alpha.
// Accuracy: angle to the published map, 99th percentile: 1 eps (1 + condition number); double 1.
VNDF_FN VNDF_REAL3 vndf_ggx_sample_wm_heitz_deon2014_lobe(struct vndf_ggx_lobe lobe, VNDF_REAL2 u) {
    return vndf_impl_direction(vndf_impl_ggx_heitz_deon2014(lobe, u));
}

// The same; w: the density of the map as it is, fit included.
VNDF_FN VNDF_REAL4 vndf_ggx_sample_wm_heitz_deon2014_lobe_with_pdf(struct vndf_ggx_lobe lobe, VNDF_REAL2 u) {
    return vndf_impl_direction_pdf(vndf_impl_ggx_heitz_deon2014(lobe, u));
}

// A visible normal by slopes, with the exact conditional inverse.
// wo: unit vector, local frame, anywhere on the sphere. At wo = -z, where nothing
//     is visible: a unit vector on the horizon with density 0.
// alpha, u: as above.
// return: unit vector wm, wm.z >= 0, with density vndf_ggx_pdf_wm(wo, wm, alpha).
// Accuracy: angle to the exact map, 99th percentile: 1 eps (1 + condition number), 1.25 behind the surface; double 1, 1.25.
VNDF_FN VNDF_REAL3 vndf_ggx_sample_wm_heitz_deon2014_exact(VNDF_REAL3 wo, VNDF_REAL2 alpha, VNDF_REAL2 u) {
    return vndf_impl_direction(vndf_impl_ggx_heitz_deon2014_exact(vndf_ggx_lobe_of(wo, alpha), u));
}

// The same; w: its density per steradian of wm, from the sampler's own terms.
VNDF_FN VNDF_REAL4 vndf_ggx_sample_wm_heitz_deon2014_exact_with_pdf(VNDF_REAL3 wo, VNDF_REAL2 alpha,
                                                                    VNDF_REAL2 u) {
    return vndf_impl_direction_pdf(vndf_impl_ggx_heitz_deon2014_exact(vndf_ggx_lobe_of(wo, alpha), u));
}

// The same for many u and one wo and alpha.
// Accuracy: angle to the exact map, 99th percentile: 1 eps (1 + condition number), 1.25 behind the surface; double 1, 1.25.
VNDF_FN VNDF_REAL3 vndf_ggx_sample_wm_heitz_deon2014_exact_lobe(struct vndf_ggx_lobe lobe, VNDF_REAL2 u) {
    return vndf_impl_direction(vndf_impl_ggx_heitz_deon2014_exact(lobe, u));
}

// The same; w: its density, from the sampler's own terms.
VNDF_FN VNDF_REAL4 vndf_ggx_sample_wm_heitz_deon2014_exact_lobe_with_pdf(struct vndf_ggx_lobe lobe,
                                                                         VNDF_REAL2 u) {
    return vndf_impl_direction_pdf(vndf_impl_ggx_heitz_deon2014_exact(lobe, u));
}

VNDF_END

#endif
