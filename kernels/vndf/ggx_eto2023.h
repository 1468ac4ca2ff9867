// GGX reflections by the bounded spherical cap: fewer reflections below the horizon; and its density.
//
// Source: Eto & Tokuyoshi, Bounded VNDF Sampling for Smith-GGX Reflections, 2023, Listings 1 and 2, Equations
//     5 to 8 (i = wo, o = wi). Public code that cites Tokuyoshi & Eto, Bounded VNDF Sampling for the Smith-GGX BRDF,
//     2024, takes k = (1 - a^2) s^2 / (s^2 + a^2 wo.z^2), a = min(alpha_x, alpha_y, 1), s = 1 + |wo_xy|: the k of
//     Equation 6, for every alpha, and so of this file.
#ifndef VNDF_GGX_ETO2023_H
#define VNDF_GGX_ETO2023_H

#include "ggx.h"
#include "impl/lobe.h"
#include "impl/mirror.h"

VNDF_BEGIN

// A cap above -k cos theta, by its gap 1 - k: gap z and (1 + k) z in a lobe's numbers, and height - gap z, which stands for 1 +
// k cos theta.
struct vndf_impl_bound {
    VNDF_REAL gap_z, other_z, height;
};

// Equations 5 and 6: 1 - k without a difference. The conservative alpha is at most 1, and k = 1 below the surface.
// s^2 + z^2 and s^2 for s = |wo| + |wo_xy|, whatever the length of wo.
VNDF_FN struct vndf_impl_bound vndf_impl_ggx_bound(struct vndf_ggx_lobe v) {
    struct vndf_impl_bound bound;
    VNDF_REAL a = vndf_impl_min(vndf_impl_min(v.alpha_x, v.alpha_y), VNDF_R(1.0)), a2 = a * a;
    VNDF_REAL z2 = v.wo_z * v.wo_z, sine2 = VNDF_FMA(v.wo_x, v.wo_x, v.wo_y * v.wo_y);
    VNDF_REAL s2 = VNDF_FMA(VNDF_R(2.0), sine2 + VNDF_SQRT(sine2 * (sine2 + z2)), z2);
    VNDF_REAL gap = VNDF_DIVIDE(a2 * (s2 + z2), VNDF_FMA(a2, z2, s2));
    gap = v.wo_z > VNDF_R(0.0) ? gap : VNDF_R(0.0);
    bound.gap_z = gap * v.axis.z;
    bound.other_z = VNDF_FMA(VNDF_R(2.0), v.axis.z, -bound.gap_z);
    bound.height = v.axis.height - bound.gap_z;
    return bound;
}

// The cap of impl/lobe.h above o_z = -k cos theta: h.z = rest b + (1 - k) z and R^2 = u2 (rest b^2 + l^2 + (1 - k^2) z^2), b =
// the height of the bound.
VNDF_FN struct vndf_impl_vector vndf_impl_bounded_half(struct vndf_ggx_lobe v, struct vndf_impl_bound b,
                                                       VNDF_REAL2 u) {
    VNDF_REAL u1 = vndf_impl_u(u.x), u2 = vndf_impl_u(u.y), rest = VNDF_R(1.0) - u2;
    VNDF_REAL l2 = VNDF_FMA(v.x, v.x, v.y * v.y), rest_b = rest * b.height;
    VNDF_REAL part = VNDF_FMA(rest_b, b.height, b.gap_z * b.other_z);
    return vndf_impl_cap_sum(v, l2, u1, rest_b + b.gap_z, u2 * (part + l2), VNDF_FMA(u2, part, -rest * l2));
}

VNDF_FN struct vndf_impl_sample vndf_impl_ggx_eto2023(struct vndf_ggx_lobe v, VNDF_REAL2 u) {
    struct vndf_impl_bound bound = vndf_impl_ggx_bound(v);
    return vndf_impl_lobe_reflection(v, bound.height, vndf_impl_bounded_half(v, bound, u));
}

// A reflection of wo by the bounded cap: the visible normal and the mirror step in one.
// wo: unit vector, local frame, anywhere on the sphere. For wo.z <= 0 the plain
//     cap. At wo = -z, where nothing is visible: a unit vector with density 0.
// alpha: in [1e-8, 1e3] each. For min(alpha) >= 1 the bound is valid but loose.
// u: u.x the azimuth of the cap, u.y its height.
// return: unit vector wi, with density vndf_ggx_pdf_wi_eto2023(wo, wi, alpha). It may still fall below the
//     horizon: give it no weight there. For reflection alone: refraction needs a plain visible normal.
// Accuracy: angle to the exact map, 99th percentile: 2 eps (1 + condition number), 1.25 behind the surface; double 2, 1.25.
VNDF_FN VNDF_REAL3 vndf_ggx_sample_wi_eto2023(VNDF_REAL3 wo, VNDF_REAL2 alpha, VNDF_REAL2 u) {
    return vndf_impl_direction(vndf_impl_ggx_eto2023(vndf_ggx_lobe_of(wo, alpha), u));
}

// The same; w: its density per steradian of wi, from the sampler's own terms.
VNDF_FN VNDF_REAL4 vndf_ggx_sample_wi_eto2023_with_pdf(VNDF_REAL3 wo, VNDF_REAL2 alpha, VNDF_REAL2 u) {
    return vndf_impl_direction_pdf(vndf_impl_ggx_eto2023(vndf_ggx_lobe_of(wo, alpha), u));
}

// The same for many u and one wo and alpha.
// Accuracy: angle to the exact map, 99th percentile: 2 eps (1 + condition number), 1.25 behind the surface; double 2, 1.25.
VNDF_FN VNDF_REAL3 vndf_ggx_sample_wi_eto2023_lobe(struct vndf_ggx_lobe lobe, VNDF_REAL2 u) {
    return vndf_impl_direction(vndf_impl_ggx_eto2023(lobe, u));
}

// The same; w: its density, from the sampler's own terms.
VNDF_FN VNDF_REAL4 vndf_ggx_sample_wi_eto2023_lobe_with_pdf(struct vndf_ggx_lobe lobe, VNDF_REAL2 u) {
    return vndf_impl_direction_pdf(vndf_impl_ggx_eto2023(lobe, u));
}

// The density of a cap of reflections above o_z = -k z: D / (2 n), n as above.
VNDF_FN VNDF_REAL vndf_impl_ggx_bounded_half_pdf(struct vndf_ggx_lobe v, struct vndf_impl_half h,
                                                 struct vndf_impl_bound b) {
    // The stretched reflection has height 2 (m . v) m.z / r - z / r > -k z / r, where h . wo = |h|^2 / 2.
    VNDF_REAL limit = b.gap_z * VNDF_R(7.450580596923828125e-09) * h.scale;
    VNDF_REAL excess = VNDF_FMA(h.length2, h.z, -limit * h.q);
    // Rounding moves each component of wi, and so of h, by 2^-24, a sampler by little more: four times the effect on both
    // terms.
    VNDF_REAL slack = VNDF_R(4.0) * VNDF_EPSILON * h.scale *
                      (h.length2 + VNDF_R(4.0) * h.z + VNDF_R(2.0) * limit * h.q_slope);
    int inside = v.wo_z <= VNDF_R(0.0) || excess > -slack;
    VNDF_REAL n = VNDF_DIVIDE(b.height * VNDF_R(7.450580596923828125e-09), v.axis.weight);
    VNDF_REAL pdf = vndf_impl_ggx_reflection_pdf(h, n, v.alpha_x, v.alpha_y);
    return inside ? pdf : VNDF_R(0.0);
}
VNDF_FN VNDF_REAL vndf_impl_ggx_bounded_pdf(struct vndf_ggx_lobe v, VNDF_REAL3 wi, struct vndf_impl_bound b) {
    VNDF_REAL3 wo = VNDF_MAKE3(v.wo_x, v.wo_y, v.wo_z);
    return vndf_impl_ggx_bounded_half_pdf(v, vndf_impl_half_of(wo, wi, v.alpha_x, v.alpha_y), b);
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
    struct vndf_ggx_lobe lobe = vndf_ggx_lobe_of(wo, alpha);
    return vndf_impl_ggx_bounded_pdf(lobe, wi, vndf_impl_ggx_bound(lobe));
}

// The same for many wi and one wo and alpha.
// Accuracy: 16 eps; double 19.
VNDF_FN VNDF_REAL vndf_ggx_pdf_wi_eto2023_lobe(struct vndf_ggx_lobe lobe, VNDF_REAL3 wi) {
    return vndf_impl_ggx_bounded_pdf(lobe, wi, vndf_impl_ggx_bound(lobe));
}

VNDF_END

#endif
