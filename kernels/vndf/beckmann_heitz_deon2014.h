// Beckmann visible normals by slopes, in three branches that are computed as one.
//
// Source: Heitz & d'Eon, Importance Sampling Microfacet-Based BSDFs with the Distribution of Visible Normals, 2014,
//     supplement 1, Algorithms 1 and 2 (omega_i = wo, omega_m = wm), without its thresholds; its CDF with tan(theta_i).
#ifndef VNDF_BECKMANN_HEITZ_DEON2014_H
#define VNDF_BECKMANN_HEITZ_DEON2014_H

#include "beckmann.h"
#include "impl/beckmann_slopes.h"

VNDF_BEGIN

// The slope x, and of the second number u2, used again where it chose the sign of x: 1 - 2 u2 and u2 (1 - u2).
struct vndf_impl_folded_slope {
    VNDF_REAL x, difference, product;
};

// The masses before division by sigma: edge = s e^(-a^2) / (2 sqrt(pi)) and plateau = c erfc(a) / 2 for x < -a; the rest
// lies in |x| < a, both signs at once. One logarithm and one erfinv serve all branches: what they take is selected first.
VNDF_FN struct vndf_impl_folded_slope vndf_impl_beckmann_fold(struct vndf_impl_incidence_slopes i,
                                                              VNDF_REAL u1, VNDF_REAL u2) {
    struct vndf_impl_folded_slope fold;
    VNDF_REAL beyond = vndf_impl_erfcx(i.a) * i.gaussian;  // erfc(a)
    VNDF_REAL within = vndf_impl_erf_of(i.a, beyond);
    VNDF_REAL edge = VNDF_R(0.5) * VNDF_1_SQRT_PI * i.s * i.gaussian, plateau = VNDF_R(0.5) * i.c * beyond;
    VNDF_REAL mass = u1 * i.sigma, mass_above = (VNDF_R(1.0) - u1) * i.sigma;
    // mass - edge; sigma is edge + c - plateau, which above u1 = 1/2 keeps the digits of 1 - u1.
    int shallow = u1 > VNDF_R(0.5);
    VNDF_REAL excess = shallow ? i.c - (mass_above + plateau) : mass - edge;
    int at_edge = excess <= VNDF_R(0.0), outer = excess <= plateau;

    // |x| < a: U and 1 - U share |2 U - 1| = 1 - 2 less.
    VNDF_REAL central = i.c * within, centre_mass = central > VNDF_R(0.0) ? central : VNDF_R(1.0);
    VNDF_REAL upper = mass_above / centre_mass, lower = (excess - plateau) / centre_mass;
    int left = upper > VNDF_R(0.5);
    VNDF_REAL less = vndf_impl_max(left ? lower : upper, VNDF_R(0.0));
    VNDF_REAL centre = VNDF_R(1.0) - VNDF_R(2.0) * less;

    // |x| = erfinv(p) with p = 1 - q; at the edge, sqrt(a^2 - log(mass / edge)), the logarithm with the rounding error of
    // its argument 1 + r. Rounding must not carry the excess beyond the plateau: x would pass the edge of the visible.
    // Masses that are next to nothing hold no sample: their quotients are kept finite.
    VNDF_REAL edge_mass = vndf_impl_max(edge, VNDF_IMPL_ROOT_LEAST * VNDF_EPSILON),
              plateau_mass = vndf_impl_max(plateau, VNDF_IMPL_ROOT_LEAST * VNDF_EPSILON);
    VNDF_REAL r = excess / edge_mass, rest = shallow ? VNDF_R(1.0) + r : mass / edge_mass;
    VNDF_REAL q = outer ? vndf_impl_min(excess / plateau_mass, VNDF_R(1.0)) * beyond
                        : VNDF_FMA(centre, beyond, VNDF_R(2.0) * less);
    VNDF_REAL p = outer ? VNDF_R(1.0) - q : centre * within;
    VNDF_REAL w = -vndf_impl_log(at_edge ? rest : q * (VNDF_R(1.0) + p));
    VNDF_REAL size = p * vndf_impl_erfinv_ratio_of_log(w);
    w -= shallow ? ((VNDF_R(1.0) - rest) + r) / rest : VNDF_R(0.0);
    size = at_edge ? VNDF_SQRT(VNDF_FMA(i.a, i.a, vndf_impl_max(w, VNDF_R(0.0)))) : size;
    VNDF_REAL x = outer || left ? -size : size;

    // The sign of x by its share of the projected area.
    VNDF_REAL ratio = VNDF_R(0.5) * (x / vndf_impl_max(i.a, VNDF_IMPL_ROOT_LEAST));
    VNDF_REAL keep = VNDF_R(0.5) - ratio, swap = VNDF_R(0.5) + ratio;
    int mirror = u2 > keep;
    VNDF_REAL rcp = VNDF_R(1.0) / (mirror ? swap : keep);
    VNDF_REAL low = mirror ? u2 - keep : u2, high = mirror ? VNDF_R(1.0) - u2 : keep - u2;
    fold.x = !outer && mirror ? -x : x;
    fold.difference = outer ? VNDF_FMA(VNDF_R(-2.0), u2, VNDF_R(1.0)) : (high - low) * rcp;
    fold.product = outer ? u2 * (VNDF_R(1.0) - u2) : low * rcp * rcp * high;
    return fold;
}

VNDF_FN struct vndf_impl_sample vndf_impl_beckmann_heitz_deon2014(VNDF_REAL3 wo, VNDF_REAL2 alpha,
                                                                  VNDF_REAL2 u) {
    // Below the horizon, where this is not used, as above it: no quotient of it overflows.
    struct vndf_impl_beckmann_frame f =
        vndf_impl_beckmann_frame_of(VNDF_MAKE3(wo.x, wo.y, vndf_impl_abs(wo.z)), alpha);
    struct vndf_impl_folded_slope r = vndf_impl_beckmann_fold(f.slopes, vndf_impl_u(u.x), vndf_impl_u(u.y));
    // The slope across is erfinv(2 u2 - 1); the normal leans against it. The product is at least that of the clamp:
    // rounding may bring a used number to 0.
    VNDF_REAL product = vndf_impl_max(r.product, VNDF_U_MIN);
    VNDF_REAL y = r.difference * vndf_impl_erfinv_ratio(VNDF_R(4.0) * product);
    return vndf_impl_where(wo.z >= VNDF_R(0.0), vndf_impl_beckmann_normal(f, 0, -r.x, y, 0));
}

// A visible normal by the published slope sampler. Two values of u give each normal: its density is exact, but the map
// folds, and stratified u do not stay stratified; jakob2014 is monotone.
// wo: unit vector, local frame, wo.z >= 0. The method is not defined below the horizon:
//     (0, 0, 1) with density 0.
// alpha: in [1e-8, 1e3] each.
// u: u.x the slope in the plane of incidence, u.y its sign and the slope across.
// return: unit vector wm, wm.z >= 0, with density vndf_beckmann_pdf_wm(wo, wm, alpha).
// Accuracy: angle to the exact map, 99th percentile: 1 eps (1 + condition number); double 1.
VNDF_FN VNDF_REAL3 vndf_beckmann_sample_wm_heitz_deon2014(VNDF_REAL3 wo, VNDF_REAL2 alpha, VNDF_REAL2 u) {
    return vndf_impl_direction(vndf_impl_beckmann_heitz_deon2014(wo, alpha, u));
}

// The same; w: its density per steradian of wm, from the sampler's own terms.
VNDF_FN VNDF_REAL4 vndf_beckmann_sample_wm_heitz_deon2014_with_pdf(VNDF_REAL3 wo, VNDF_REAL2 alpha,
                                                                   VNDF_REAL2 u) {
    return vndf_impl_direction_pdf(vndf_impl_beckmann_heitz_deon2014(wo, alpha, u));
}

VNDF_END

#endif
