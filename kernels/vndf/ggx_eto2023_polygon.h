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
// The gap 1 - k is 1 / R. k may be negative where alpha_y >= 1: there 1 + k comes from the same terms, as does 1 + k cos
// theta, from r + z and r - z.
VNDF_FN struct vndf_impl_bound vndf_impl_ggx_polygon(struct vndf_ggx_lobe v) {
    struct vndf_impl_bound bound;
    VNDF_REAL tangent2 = VNDF_FMA(v.wo_x, v.wo_x, v.wo_y * v.wo_y);
    // Only the direction of wo counts: its length is divided out.
    VNDF_REAL wo2 = VNDF_FMA(v.wo_z, v.wo_z, tangent2), rcp_o = VNDF_DIVIDE(VNDF_R(1.0), VNDF_SQRT(wo2));
    VNDF_REAL x = v.wo_x * rcp_o, y = v.wo_y * rcp_o, z2 = vndf_impl_square(v.wo_z * rcp_o);
    // Made dependent on the root before, so that the two are not packed (impl/stretch.h).
    VNDF_REAL sine = VNDF_SQRT(tangent2 * (rcp_o * rcp_o));
    int swap = v.alpha_x < v.alpha_y;
    VNDF_REAL low = swap ? v.alpha_x : v.alpha_y, high = swap ? v.alpha_y : v.alpha_x, a2 = low * low;
    VNDF_REAL along = vndf_impl_abs(swap ? x : y), across = swap ? y : x;
    VNDF_REAL s = VNDF_R(1.0) + sine, side = VNDF_R(1.0) + along, side2 = side * side;
    // s^2 - side^2, sin theta - |wo.y| being wo.x^2 over the sum.
    VNDF_REAL sum = sine + along, slant = across * VNDF_DIVIDE(low, high);
    VNDF_REAL corner =
        VNDF_DIVIDE(slant * slant * (VNDF_R(2.0) + sum), sum > VNDF_R(0.0) ? sum : VNDF_R(1.0));
    int wide = low >= VNDF_R(1.0);
    VNDF_REAL steep = VNDF_FMA(a2 * s, s, z2), flat = VNDF_FMA(a2, z2, side2);
    VNDF_REAL top = wide ? VNDF_R(2.0) * s : side2 + z2, bottom = wide ? steep : flat;
    VNDF_REAL other_top = VNDF_R(2.0) * s, other_bottom = corner + flat;
    int other = !wide && other_top * bottom < top * other_bottom;
    top = other ? other_top : top;
    bottom = other ? other_bottom : bottom;
    int front = v.wo_z > VNDF_R(0.0);
    VNDF_REAL rcp = VNDF_DIVIDE(VNDF_R(1.0), bottom), gap = front ? a2 * top * rcp : VNDF_R(0.0);
    bound.gap_z = gap * v.axis.z;
    VNDF_REAL other_z = VNDF_FMA(VNDF_R(2.0), v.axis.z, -bound.gap_z), height = v.axis.height - bound.gap_z;
    VNDF_REAL l2 = VNDF_FMA(v.x, v.x, v.y * v.y), part = a2 * s;
    VNDF_REAL wide_z = VNDF_R(2.0) * VNDF_FMA(part, sine, z2) * rcp * v.axis.z;
    VNDF_REAL wide_height = VNDF_FMA(v.axis.height, VNDF_FMA(part, sine, z2),
                                     part * VNDF_DIVIDE(l2, front ? v.axis.height : VNDF_R(1.0))) *
                            rcp;
    bound.other_z = wide && front ? wide_z : other_z;
    bound.height = wide && front ? wide_height : height;
    return bound;
}

VNDF_FN struct vndf_impl_sample vndf_impl_ggx_eto2023_polygon(struct vndf_ggx_lobe v, VNDF_REAL2 u) {
    struct vndf_impl_bound bound = vndf_impl_ggx_polygon(v);
    return vndf_impl_lobe_reflection(v, bound.height, vndf_impl_bounded_half(v, bound, u));
}

// A reflection of wo by the cap under the polygon bound.
// wo: unit vector, local frame, anywhere on the sphere. For wo.z <= 0 the plain
//     cap. At wo = -z, where nothing is visible: a unit vector with density 0.
// alpha: in [1e-8, 1e3] each.
// u: u.x the azimuth of the cap, u.y its height.
// return: unit vector wi, with density vndf_ggx_pdf_wi_eto2023_polygon(wo, wi, alpha). It may still fall below the
//     horizon: give it no weight there. For reflection alone: refraction needs a plain visible normal.
// Accuracy: angle to the exact map, 99th percentile: 2 eps (1 + condition number), 1.25 behind the surface; double 2, 1.25.
VNDF_FN VNDF_REAL3 vndf_ggx_sample_wi_eto2023_polygon(VNDF_REAL3 wo, VNDF_REAL2 alpha, VNDF_REAL2 u) {
    return vndf_impl_direction(vndf_impl_ggx_eto2023_polygon(vndf_ggx_lobe_of(wo, alpha), u));
}

// The same; w: its density per steradian of wi, from the sampler's own terms.
VNDF_FN VNDF_REAL4 vndf_ggx_sample_wi_eto2023_polygon_with_pdf(VNDF_REAL3 wo, VNDF_REAL2 alpha,
                                                               VNDF_REAL2 u) {
    return vndf_impl_direction_pdf(vndf_impl_ggx_eto2023_polygon(vndf_ggx_lobe_of(wo, alpha), u));
}

// The same for many u and one wo and alpha.
// Accuracy: angle to the exact map, 99th percentile: 2 eps (1 + condition number), 1.25 behind the surface; double 2, 1.25.
VNDF_FN VNDF_REAL3 vndf_ggx_sample_wi_eto2023_polygon_lobe(struct vndf_ggx_lobe lobe, VNDF_REAL2 u) {
    return vndf_impl_direction(vndf_impl_ggx_eto2023_polygon(lobe, u));
}

// The same; w: its density, from the sampler's own terms.
VNDF_FN VNDF_REAL4 vndf_ggx_sample_wi_eto2023_polygon_lobe_with_pdf(struct vndf_ggx_lobe lobe, VNDF_REAL2 u) {
    return vndf_impl_direction_pdf(vndf_impl_ggx_eto2023_polygon(lobe, u));
}

// The density of the cap under the polygon bound: D / (2 (k wo.z + t)); for wo.z <= 0 that of the plain cap.
// wo, wi: unit vectors, local frame, anywhere on the sphere.
// return: per steradian of wi; 0 outside the cap, which is judged with a slack for the rounding of wi.
// Accuracy: 16 eps; double 19.
//     Below alpha = 1e-2 the rounding of wi moves the density by more than that: use the sampler's _with_pdf
//     form there.
VNDF_FN VNDF_REAL vndf_ggx_pdf_wi_eto2023_polygon(VNDF_REAL3 wo, VNDF_REAL3 wi, VNDF_REAL2 alpha) {
    struct vndf_ggx_lobe lobe = vndf_ggx_lobe_of(wo, alpha);
    return vndf_impl_ggx_bounded_pdf(lobe, wi, vndf_impl_ggx_polygon(lobe));
}

// The same for many wi and one wo and alpha.
// Accuracy: 16 eps; double 19.
VNDF_FN VNDF_REAL vndf_ggx_pdf_wi_eto2023_polygon_lobe(struct vndf_ggx_lobe lobe, VNDF_REAL3 wi) {
    return vndf_impl_ggx_bounded_pdf(lobe, wi, vndf_impl_ggx_polygon(lobe));
}

VNDF_END

#endif
