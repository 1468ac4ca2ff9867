// Geometry of every distribution: reflection, refraction, Jacobians.
#ifndef VNDF_GEOMETRY_H
#define VNDF_GEOMETRY_H

#include "impl/exact.h"
#include "impl/range.h"

VNDF_BEGIN

// The mirror direction of wo about wm.
// Source: Walter et al., Microfacet Models for Refraction through Rough Surfaces, 2007, Equation 39 (i = wo,
//     o = the result).
// wo, wm: unit vectors, any frame, any orientation.
// return: 2 (wo . wm) wm - wo, unit to the rounding of the arguments; below the surface where it falls there.
// Accuracy: 1 eps (1 + condition number); double 1.
VNDF_FN VNDF_REAL3 vndf_reflect(VNDF_REAL3 wo, VNDF_REAL3 wm) {
    VNDF_REAL twice = VNDF_R(2.0) * vndf_impl_dot(wo.x, wo.y, wo.z, wm.x, wm.y, wm.z);
    VNDF_REAL x = VNDF_FMA(twice, wm.x, -wo.x), y = VNDF_FMA(twice, wm.y, -wo.y),
              z = VNDF_FMA(twice, wm.z, -wo.z);
    // Beyond the range of numbers the zero vector; NaN for NaN.
    VNDF_REAL none = vndf_impl_zero(wo.x, wo.y, wo.z) + vndf_impl_zero(wm.x, wm.y, wm.z);
    int finite = vndf_impl_zero(x, y, z) == VNDF_R(0.0);
    return VNDF_MAKE3(finite ? x : none, finite ? y : none, finite ? z : none);
}

// The refracted direction of wo through a facet wm.
// Source: Walter et al. 2007, Equation 40 (i = wo, o = the result, n = wm, eta_i / eta_o = 1 / eta).
// wo, wm: unit vectors, any frame, wo . wm > 0.
// eta: index of refraction on the far side over the index on wo's side, > 0.
// return: unit vector on the far side of the facet; the zero vector on total internal reflection, for
//     wo . wm <= 0 and for eta <= 0.
// Accuracy: 2 eps (1 + condition number); double 2.
//     The transmitted cosine is formed without cancellation in eta - 1; its error grows as its inverse towards
//     the critical angle, as does its derivative.
VNDF_FN VNDF_REAL3 vndf_refract(VNDF_REAL3 wo, VNDF_REAL3 wm, VNDF_REAL eta) {
    VNDF_REAL c = vndf_impl_dot(wo.x, wo.y, wo.z, wm.x, wm.y, wm.z);
    // Below 2^-64 (double: 2^-512) the contrast would be no number, and every ray is reflected.
    int thick = eta > VNDF_IMPL_ROOT_LEAST;
    VNDF_REAL rcp_eta = VNDF_DIVIDE(VNDF_R(1.0), thick ? eta : VNDF_R(1.0));
    // A dot product of rounded unit vectors can exceed 1.
    VNDF_REAL c1 = vndf_impl_min(c, VNDF_R(1.0));
    VNDF_REAL sin2 = VNDF_FMA(-c1, c1, VNDF_R(1.0));
    VNDF_REAL contrast = ((eta - VNDF_R(1.0)) * rcp_eta) * ((eta + VNDF_R(1.0)) * rcp_eta);
    VNDF_REAL cos2 = VNDF_FMA(sin2, contrast, c1 * c1);
    int valid = c > VNDF_R(0.0) && thick && cos2 >= VNDF_R(0.0);
    VNDF_REAL k = VNDF_FMA(c, rcp_eta, -VNDF_SQRT(cos2 > VNDF_R(0.0) ? cos2 : VNDF_R(0.0)));
    VNDF_REAL x = VNDF_FMA(k, wm.x, -wo.x * rcp_eta);
    VNDF_REAL y = VNDF_FMA(k, wm.y, -wo.y * rcp_eta);
    VNDF_REAL z = VNDF_FMA(k, wm.z, -wo.z * rcp_eta);
    valid = valid & (vndf_impl_zero(x, y, z) == VNDF_R(0.0));
    return VNDF_MAKE3(valid ? x : VNDF_R(0.0), valid ? y : VNDF_R(0.0), valid ? z : VNDF_R(0.0));
}

// |d wm / d wi| of reflection: multiply a density per steradian of wm by it to get one per steradian of wi.
// Source: Walter et al. 2007, Equation 14.
// wo, wm: unit vectors, any frame.
// return: 1 / (4 |wo . wm|), per steradian over steradian; the largest finite number where wo . wm is 0.
// Accuracy: 2.5 eps; double 2.5.
VNDF_FN VNDF_REAL vndf_jacobian_reflect(VNDF_REAL3 wo, VNDF_REAL3 wm) {
    VNDF_REAL c = vndf_impl_abs(vndf_impl_dot(wo.x, wo.y, wo.z, wm.x, wm.y, wm.z));
    return vndf_impl_finite(vndf_impl_bounded_quotient(VNDF_R(0.25), c));
}

// |d wm / d wi| of refraction, for wm along h = wo + eta wi.
// Source: Walter et al. 2007, Equation 17 (i = wo, o = wi, eta_o / eta_i = eta); as wo . m + eta wi . m = |h|
//     for m = h / |h|, it is eta^2 |wi . m| / |h|^2.
// wo, wi: unit vectors on either side of the facet, any frame.
// eta: index of refraction on wi's side over the index on wo's side, > 0; 1 and anything near it included.
// return: > 0, per steradian over steradian: by how much the direction of h turns with wi, for every pair. A pair with
//     (wo . h)(wi . h) >= 0 is refracted by no facet and has this value all the same: give it no weight. A |wi . m| below
//     2^-48 (double: 2^-106) counts as that, so that nothing that vndf_refract returns has the density 0. The largest
//     finite number where h is 0 (eta = 1, wi = -wo: no facet is defined there).
// Accuracy: 16 eps; double 19.
//     Where |wi . m| is above one unit; below, the rounding of wi has left nothing of it.
VNDF_FN VNDF_REAL vndf_jacobian_refract(VNDF_REAL3 wo, VNDF_REAL3 wi, VNDF_REAL eta) {
    // Each component is made dependent on the one before, so that LLVM's SLP pass does not pack the alike sums
    // (impl/stretch.h); the second choice is never taken.
    struct vndf_impl_pair x = vndf_impl_eta_sum(wo.x, eta, wi.x);
    struct vndf_impl_pair y = vndf_impl_eta_sum(wo.y, x.head <= VNDF_REAL_MAX ? eta : VNDF_R(1.0), wi.y);
    struct vndf_impl_pair z = vndf_impl_eta_sum(wo.z, y.head <= VNDF_REAL_MAX ? eta : VNDF_R(1.0), wi.z);
    // h times a power of two, since its square may underflow.
    VNDF_REAL largest = vndf_impl_max(vndf_impl_abs(x.head), y.head);
    largest = vndf_impl_max(vndf_impl_max(largest, -y.head), vndf_impl_abs(z.head));
    VNDF_REAL scale = vndf_impl_scale(largest), hx = x.head * scale, hy = y.head * scale, hz = z.head * scale;
    VNDF_REAL h = VNDF_SQRT(VNDF_FMA(hx, hx, VNDF_FMA(hy, hy, hz * hz)));
    // wi . h in twice the precision: it vanishes at grazing transmission.
    struct vndf_impl_pair dot = vndf_impl_dot_pair(wi.x, wi.y, wi.z, hx, hy, hz);
    VNDF_REAL low = VNDF_FMA(wi.x, x.tail, VNDF_FMA(wi.y, y.tail, wi.z * z.tail));
    VNDF_REAL wi_h = vndf_impl_abs(dot.head + VNDF_FMA(low, scale, dot.tail));
    VNDF_REAL rcp = VNDF_DIVIDE(VNDF_R(1.0), largest > VNDF_R(0.0) ? h : VNDF_R(1.0)),
              cosine = vndf_impl_max(wi_h * rcp, VNDF_EPSILON * VNDF_EPSILON);
    VNDF_REAL ratio = eta * scale * rcp;
    VNDF_REAL jacobian = vndf_impl_bounded_product(ratio * cosine, ratio);
    return largest > VNDF_R(0.0) ? vndf_impl_finite(jacobian) : VNDF_REAL_MAX;
}

VNDF_END

#endif
