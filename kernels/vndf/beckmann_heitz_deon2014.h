// Beckmann visible normals by slopes, in three branches that are computed as one.
//
// Source: Heitz & d'Eon, Importance Sampling Microfacet-Based BSDFs with the Distribution of Visible Normals, 2014,
//     supplement 1, Algorithms 1 and 2 (omega_i = wo, omega_m = wm), without its thresholds; its CDF with tan(theta_i).
#ifndef VNDF_BECKMANN_HEITZ_DEON2014_H
#define VNDF_BECKMANN_HEITZ_DEON2014_H

#include "beckmann.h"
#include "impl/beckmann_lobe.h"

VNDF_BEGIN

// The slope x with its distance y from the edge, and of the second number u2, used again where it chose the sign of x:
// 1 - 2 u2 and u2 (1 - u2).
struct vndf_impl_folded_slope {
    struct vndf_impl_visible_slope slope;
    VNDF_REAL difference, product;
};

// The masses, times the area A: edge = e^(-a^2) / (2 sqrt(pi)) and plateau = a erfc(a) / 2 for x < -a; the rest lies in
// |x| < a, both signs at once. One quotient, logarithm, root and erfinv serve all branches: what they take is selected first.
VNDF_FN struct vndf_impl_folded_slope vndf_impl_beckmann_fold(struct vndf_impl_incidence_slopes i,
                                                              VNDF_REAL u1, VNDF_REAL u2) {
    struct vndf_impl_folded_slope fold;
    VNDF_REAL a = vndf_impl_max(i.a, VNDF_IMPL_ROOT_LEAST);
    VNDF_REAL beyond = i.erfcx * i.gaussian;  // erfc(a)
    VNDF_REAL edge = VNDF_R(0.5) * VNDF_1_SQRT_PI * i.gaussian, plateau = VNDF_R(0.5) * a * beyond;
    VNDF_REAL mass = u1 * i.area, mass_above = (VNDF_R(1.0) - u1) * i.area;
    // mass - edge; the area is edge + a - plateau, which above u1 = 1/2 keeps the digits of 1 - u1.
    int shallow = u1 > VNDF_R(0.5);
    VNDF_REAL excess = shallow ? a - (mass_above + plateau) : mass - edge;
    int at_edge = excess <= VNDF_R(0.0), outer = excess <= plateau;
    VNDF_REAL within = VNDF_R(1.0) - beyond, rest = excess - plateau;
    int left = mass_above > VNDF_R(0.5) * a * within;

    // At the edge x^2 = a^2 - log(mass / edge); elsewhere |x| = erfinv(p), p = 1 - q.
    VNDF_REAL centre = left ? rest : mass_above;
    VNDF_REAL part =
        at_edge ? (shallow ? excess : mass) : (outer ? excess : vndf_impl_max(centre, VNDF_R(0.0)));
    VNDF_REAL share = VNDF_DIVIDE(part, at_edge ? edge : a);
    VNDF_REAL q = VNDF_FMA(VNDF_R(2.0), share, outer ? VNDF_R(0.0) : beyond);
    VNDF_REAL p = VNDF_FMA(VNDF_R(-2.0), share, outer ? VNDF_R(1.0) : within);
    VNDF_REAL ratio = shallow ? VNDF_R(1.0) + share : share;
    // Of a q that is next to nothing rounding has left no digit.
    VNDF_REAL square = vndf_impl_max(q, VNDF_DOUBLE ? VNDF_R(1e-36) : VNDF_R(1e-18)) * (VNDF_R(1.0) + p);
    VNDF_REAL w = -vndf_impl_log_of_share(at_edge ? ratio : square);
    // The rounding error of 1 + share.
    w -= shallow && at_edge ? ((VNDF_R(1.0) - ratio) + share) * (VNDF_R(1.0) - share) : VNDF_R(0.0);
    w = vndf_impl_max(w, VNDF_R(0.0));
    VNDF_REAL root = VNDF_SQRT(at_edge ? VNDF_FMA(a, a, w) : w);
    VNDF_REAL inner = p * vndf_impl_erfinv_ratio_of_log(w, root);
    VNDF_REAL size = at_edge ? root : (outer ? inner : vndf_impl_min(inner, a));
    VNDF_REAL x = outer || left ? -size : size;

    // How far |x| is from a; where that is little, by the first terms of erf a - erf |x| = 2 share.
    VNDF_REAL linear = VNDF_DIVIDE(VNDF_SQRT_PI * share, i.gaussian);
    int close = !outer && linear * (VNDF_R(1.0) + a) <
                              (VNDF_DOUBLE ? VNDF_R(1.9073486328125e-06) : VNDF_R(0.001953125));
    VNDF_REAL gap = close ? VNDF_FMA(-a * linear, linear, linear) : a - size, wide = a + size;

    // The sign of x by its share of the projected area, all times 2 a.
    VNDF_REAL first = VNDF_R(2.0) * a * u2, second = VNDF_R(2.0) * a * (VNDF_R(1.0) - u2);
    VNDF_REAL keep = outer || left ? wide : gap, swap = outer || left ? gap : wide;
    int mirror = !outer && first > keep;
    VNDF_REAL reach = mirror ? swap : keep;
    VNDF_REAL rcp = VNDF_DIVIDE(VNDF_R(1.0), reach);
    VNDF_REAL low = (mirror ? first - keep : first) * rcp, high = (mirror ? second : keep - first) * rcp;
    fold.slope.x = mirror ? -x : x;
    fold.slope.y = reach;
    fold.difference = outer ? VNDF_FMA(VNDF_R(-2.0), u2, VNDF_R(1.0)) : high - low;
    fold.product = outer ? u2 * (VNDF_R(1.0) - u2) : low * high;
    return fold;
}

VNDF_FN struct vndf_impl_sample vndf_impl_beckmann_heitz_deon2014(struct vndf_beckmann_lobe lobe,
                                                                  VNDF_REAL2 u) {
    // Below the horizon, where this is not used, as on it: no quotient of it overflows.
    struct vndf_impl_incidence_slopes i = lobe.slopes;
    int front = i.front;
    i.front = 1;
    i.steep = front ? i.steep : VNDF_R(0.0);
    i.a = front ? i.a : VNDF_R(0.0);
    i.gaussian = front ? i.gaussian : VNDF_R(1.0);
    i.erfcx = front ? i.erfcx : VNDF_R(1.0);
    i.area = front ? i.area : VNDF_R(0.5) * VNDF_1_SQRT_PI;
    lobe.slopes = i;
    struct vndf_impl_folded_slope r = vndf_impl_beckmann_fold(i, vndf_impl_u(u.x), vndf_impl_u(u.y));
    // The slope across is erfinv(2 u2 - 1); the normal leans against it. The product is at least that of the clamp:
    // rounding may bring a used number to 0.
    VNDF_REAL product = vndf_impl_max(r.product, VNDF_U_MIN);
    VNDF_REAL across = r.difference * vndf_impl_erfinv_ratio(VNDF_R(4.0) * product);
    return vndf_impl_where(front, vndf_impl_beckmann_normal(lobe, r.slope, across));
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
    return vndf_impl_direction(vndf_impl_beckmann_heitz_deon2014(vndf_beckmann_lobe_of(wo, alpha), u));
}

// The same; w: its density per steradian of wm, from the sampler's own terms.
VNDF_FN VNDF_REAL4 vndf_beckmann_sample_wm_heitz_deon2014_with_pdf(VNDF_REAL3 wo, VNDF_REAL2 alpha,
                                                                   VNDF_REAL2 u) {
    return vndf_impl_direction_pdf(vndf_impl_beckmann_heitz_deon2014(vndf_beckmann_lobe_of(wo, alpha), u));
}

// The same for many u and one wo and alpha.
// Accuracy: angle to the exact map, 99th percentile: 1 eps (1 + condition number); double 1.
VNDF_FN VNDF_REAL3 vndf_beckmann_sample_wm_heitz_deon2014_lobe(struct vndf_beckmann_lobe lobe, VNDF_REAL2 u) {
    return vndf_impl_direction(vndf_impl_beckmann_heitz_deon2014(lobe, u));
}

// The same; w: its density, from the sampler's own terms.
VNDF_FN VNDF_REAL4 vndf_beckmann_sample_wm_heitz_deon2014_lobe_with_pdf(struct vndf_beckmann_lobe lobe,
                                                                        VNDF_REAL2 u) {
    return vndf_impl_direction_pdf(vndf_impl_beckmann_heitz_deon2014(lobe, u));
}

VNDF_END

#endif
