// GGX reflections by a bounded cap that knows both alphas; and its density.
//
// Source: the cap of Eto & Tokuyoshi, Bounded VNDF Sampling for Smith-GGX Reflections, 2023, with a bound of this package
//     in place of Equation 6 (proof: ggx_conic2026.md). Never looser than Equation 6, equal to the exact Equation 5 for
//     one alpha up to 1, and below it by far for alphas above 1, where Equation 6 gives up.
#ifndef VNDF_GGX_ETO2023_POLYGON_H
#define VNDF_GGX_ETO2023_POLYGON_H

#include "ggx_eto2023.h"

VNDF_BEGIN

// On the horizon the reflection has the height (1 / R - 1) z in stretched space, R the largest ratio
// (X / alpha_x^2 + Y / alpha_y^2 + z^2) / (X + Y + z^2) of the polygon in which X = (wo.x + cos phi)^2 and
// Y = (wo.y + sin phi)^2 lie. With y the axis of the smaller alpha and s = 1 + sin theta it is attained
//     for alpha_y < 1 at (0, (1 + |wo.y|)^2) or at (s^2 - (1 + |wo.y|)^2, (1 + |wo.y|)^2),
//     for alpha_y >= 1 at (0, (1 - sin theta)^2).
// rest = 1 - k = 1 / R; b = 1 + k cosine, cosine and p = 1 + cosine, q = 1 - cosine of the stretched wo.
struct vndf_impl_polygon {
    struct vndf_impl_bound bound;
    VNDF_REAL b;
};
VNDF_FN struct vndf_impl_polygon vndf_impl_ggx_polygon(VNDF_REAL alpha_x, VNDF_REAL alpha_y, VNDF_REAL x,
                                                       VNDF_REAL y, VNDF_REAL sine, VNDF_REAL z2,
                                                       struct vndf_impl_cap cap, int front) {
    struct vndf_impl_polygon polygon;
    int swap = alpha_x < alpha_y;
    VNDF_REAL low = swap ? alpha_x : alpha_y, high = swap ? alpha_y : alpha_x, l2 = low * low;
    VNDF_REAL along = vndf_impl_abs(swap ? x : y), across = swap ? y : x;
    VNDF_REAL s = VNDF_R(1.0) + sine, side = VNDF_R(1.0) + along, side2 = side * side;
    // s^2 - side^2, sin theta - |wo.y| being wo.x^2 over the sum.
    VNDF_REAL sum = sine + along, beyond = across * across * (VNDF_R(2.0) + sum);
    VNDF_REAL slant = low / high, corner = sum > VNDF_R(0.0) ? slant * (beyond / sum) * slant : VNDF_R(0.0);
    int wide = low >= VNDF_R(1.0);
    VNDF_REAL top = wide ? VNDF_R(2.0) * s : side2 + z2,
              bottom = wide ? VNDF_FMA(l2 * s, s, z2) : VNDF_FMA(l2, z2, side2);
    VNDF_REAL other_top = VNDF_R(2.0) * s, other_bottom = corner + VNDF_FMA(l2, z2, side2);
    int other = !wide && other_top * bottom < top * other_bottom;
    top = other ? other_top : top;
    bottom = other ? other_bottom : bottom;
    VNDF_REAL rcp = VNDF_R(1.0) / bottom, rest = l2 * top * rcp;
    VNDF_REAL b = VNDF_FMA(cap.p, z2, l2 * s * VNDF_FMA(sine, cap.p, cap.q)) * rcp;
    polygon.bound.rest = front ? rest : VNDF_R(0.0);
    polygon.bound.k = VNDF_R(1.0) - polygon.bound.rest;
    polygon.b = wide ? b : VNDF_FMA(polygon.bound.k, cap.z, VNDF_R(1.0));
    return polygon;
}

VNDF_FN struct vndf_impl_sample vndf_impl_ggx_eto2023_polygon(VNDF_REAL3 wo, VNDF_REAL2 alpha, VNDF_REAL2 u) {
    struct vndf_impl_view v = vndf_impl_stretch(wo, alpha);
    struct vndf_impl_cap cap = vndf_impl_cap_of(v);
    // Only the direction of wo counts: its length is divided out.
    VNDF_REAL tangent2 = VNDF_FMA(wo.x, wo.x, wo.y * wo.y), wo2 = VNDF_FMA(wo.z, wo.z, tangent2);
    VNDF_REAL rcp = VNDF_R(1.0) / VNDF_SQRT(wo2);
    struct vndf_impl_polygon polygon =
        vndf_impl_ggx_polygon(v.alpha_x, v.alpha_y, wo.x * rcp, wo.y * rcp, VNDF_SQRT(tangent2) * rcp,
                              wo.z * wo.z / wo2, cap, v.z > VNDF_R(0.0));
    return vndf_impl_ggx_bounded(wo, v, cap, polygon.bound, polygon.b, v.r * polygon.b, wo2, u);
}

// A reflection of wo by the cap under the polygon bound.
// wo: unit vector, local frame, anywhere on the sphere. For wo.z <= 0 the plain
//     cap. At wo = -z, where nothing is visible: a unit vector with density 0.
// alpha: in [1e-8, 1e3] each.
// u: u.x the azimuth of the cap, u.y its height.
// return: unit vector wi, with density vndf_ggx_pdf_wi_eto2023_polygon(wo, wi, alpha). It may still fall below the
//     horizon: give it no weight there. For reflection alone: refraction needs a plain visible normal.
// Accuracy: angle to the exact map, 99th percentile: 2 eps (1 + condition number), 2 behind the surface; double 2, 2.
VNDF_FN VNDF_REAL3 vndf_ggx_sample_wi_eto2023_polygon(VNDF_REAL3 wo, VNDF_REAL2 alpha, VNDF_REAL2 u) {
    return vndf_impl_direction(vndf_impl_ggx_eto2023_polygon(wo, alpha, u));
}

// The same; w: its density per steradian of wi, from the sampler's own terms.
VNDF_FN VNDF_REAL4 vndf_ggx_sample_wi_eto2023_polygon_with_pdf(VNDF_REAL3 wo, VNDF_REAL2 alpha,
                                                               VNDF_REAL2 u) {
    return vndf_impl_direction_pdf(vndf_impl_ggx_eto2023_polygon(wo, alpha, u));
}

// The density of the cap under the polygon bound: D / (2 (k wo.z + t)); for wo.z <= 0 that of the plain cap.
// wo, wi: unit vectors, local frame, anywhere on the sphere.
// return: per steradian of wi; 0 outside the cap, which is judged with a slack for the rounding of wi.
// Accuracy: 16 eps; double 19.
//     Below alpha = 1e-2 the rounding of wi moves the density by more than that: use the sampler's _with_pdf
//     form there.
VNDF_FN VNDF_REAL vndf_ggx_pdf_wi_eto2023_polygon(VNDF_REAL3 wo, VNDF_REAL3 wi, VNDF_REAL2 alpha) {
    struct vndf_impl_view v = vndf_impl_stretch(wo, alpha);
    VNDF_REAL sine = VNDF_SQRT(VNDF_FMA(wo.x, wo.x, wo.y * wo.y));
    struct vndf_impl_polygon polygon = vndf_impl_ggx_polygon(
        v.alpha_x, v.alpha_y, wo.x, wo.y, sine, wo.z * wo.z, vndf_impl_cap_of(v), wo.z > VNDF_R(0.0));
    return vndf_impl_ggx_bounded_pdf(wo, wi, v, polygon.bound.rest, v.r * polygon.b);
}

VNDF_END

#endif
