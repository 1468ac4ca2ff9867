// The Beckmann distribution (Gaussian slopes) with Smith masking: its terms and its densities.
//
// Conventions of vndf.h; the names of ggx.h. `alpha` is (alpha_x, alpha_y). Densities and terms
// use the vectors literally, without normalising them.
//
// Symbols: l = |(alpha_x w.x, alpha_y w.y)|, a = w.z / l (the cotangent of the stretched polar angle),
// I(x) = e^(x^2) ierfc(x) / 2. What w does not see has the area l e^(-a^2) I(|a|): sigma is w.z plus that above the horizon
// and just that below it, so that nothing cancels. Where e^(-a^2) meets another exponential, the exponents are combined
// first.
//
// Accuracy: relative errors; q is the exponent of the Gaussian.
#ifndef VNDF_BECKMANN_H
#define VNDF_BECKMANN_H

#include "beckmann_lobe.h"
#include "impl/beckmann_slopes.h"
#include "impl/beckmann_terms.h"

VNDF_BEGIN

// The distribution of normals D.
// Source: Walter et al., Microfacet Models for Refraction through Rough Surfaces, 2007, Equation 25 (m = wm), in the
//     anisotropic vector form of Heitz, Understanding the Masking-Shadowing Function, 2014.
// wm: unit normal, local frame.
// alpha: in [1e-8, 1e3] each.
// return: per steradian of wm per unit projected area: its integral with wm.z is 1; 0 for wm.z <= 0.
// Accuracy: 8 eps (1 + 2 q); double 8.
VNDF_FN VNDF_REAL vndf_beckmann_ndf(VNDF_REAL3 wm, VNDF_REAL2 alpha) {
    return vndf_impl_beckmann_d(wm.x, wm.y, wm.z, vndf_impl_alpha(alpha.x), vndf_impl_alpha_y(alpha.y),
                                VNDF_R(1.0));
}

// The distribution of slopes P22.
// Source: Heitz & d'Eon, Importance Sampling Microfacet-Based BSDFs with the Distribution of Visible Normals, 2014,
//     supplement 1, Section 3.1, scaled by alpha.
// slope: (x, y) of the normal (-x, -y, 1), any real numbers.
// return: per unit of slope area, integral 1.
// Accuracy: 6 eps (1 + 2 q); double 6.
VNDF_FN VNDF_REAL vndf_beckmann_p22(VNDF_REAL2 slope, VNDF_REAL2 alpha) {
    return vndf_impl_beckmann_d(slope.x, slope.y, VNDF_R(1.0), vndf_impl_alpha(alpha.x),
                                vndf_impl_alpha_y(alpha.y), VNDF_R(1.0));
}

// Smith's Lambda.
// Source: Heitz 2014, Equation 66, as e^(-a^2) I(a) / a, which does not cancel.
// w: unit vector, local frame.
// return: >= 0 above the horizon. Below it, sigma(w) / w.z - 1 = -1 - Lambda(-w), so that (1 + Lambda) w.z is the
//     projected area everywhere. The largest finite number at the pole w.z = 0.
// Accuracy: 8 eps (1 + 2 q); double 9.
//     q = a^2.
VNDF_FN VNDF_REAL vndf_beckmann_lambda(VNDF_REAL3 w, VNDF_REAL2 alpha) {
    VNDF_REAL upper = vndf_impl_beckmann_upper_lambda(w, alpha);
    return w.z < VNDF_R(0.0) ? -VNDF_R(1.0) - upper : upper;
}

// The projected area of the microsurface seen from w.
// Source: Heitz & d'Eon 2014, supplement 1, Section 3.2: w.z / G1(w), as max(w.z, 0) + l e^(-a^2) I(|a|).
// w: unit vector, local frame, anywhere on the sphere.
// return: >= 0, per unit area of the macrosurface. Integral of D max(w . m, 0).
// Accuracy: 8 eps (1 + 2 q); double 9.
//     q = a^2 below the horizon, 0 above it.
VNDF_FN VNDF_REAL vndf_beckmann_sigma(VNDF_REAL3 w, VNDF_REAL2 alpha) {
    return vndf_impl_beckmann_sigma(vndf_beckmann_lobe_of(w, alpha));
}

// The same of a lobe's wo.
// Accuracy: 8 eps (1 + 2 q); double 9.
VNDF_FN VNDF_REAL vndf_beckmann_sigma_lobe(struct vndf_beckmann_lobe lobe) {
    return vndf_impl_beckmann_sigma(lobe);
}

VNDF_FN VNDF_REAL vndf_impl_beckmann_g1(struct vndf_beckmann_lobe lobe) {
    int above = lobe.wo_z > VNDF_R(0.0);
    VNDF_REAL sigma = vndf_impl_finite(above ? vndf_impl_beckmann_front_sigma(lobe) : VNDF_R(1.0)) +
                      vndf_impl_zero(lobe.wo_x, lobe.wo_y, lobe.wo_z);
    return above ? vndf_impl_min(VNDF_DIVIDE(lobe.wo_z, sigma), VNDF_R(1.0)) : VNDF_R(0.0);
}

// Smith masking of one direction, for a normal that faces it.
// Source: Heitz 2014, Equation 43: 1 / (1 + Lambda) = w.z / sigma(w).
// w: unit vector, local frame.
// return: in [0, 1]; 0 for w.z <= 0.
// Accuracy: 8 eps; double 9.
VNDF_FN VNDF_REAL vndf_beckmann_g1(VNDF_REAL3 w, VNDF_REAL2 alpha) {
    return vndf_impl_beckmann_g1(vndf_beckmann_lobe_of(w, alpha));
}

// The same of a lobe's wo.
// Accuracy: 8 eps; double 9.
VNDF_FN VNDF_REAL vndf_beckmann_g1_lobe(struct vndf_beckmann_lobe lobe) {
    return vndf_impl_beckmann_g1(lobe);
}

VNDF_FN VNDF_REAL vndf_impl_beckmann_g2(struct vndf_beckmann_lobe lobe, VNDF_REAL3 wi) {
    int above = lobe.wo_z > VNDF_R(0.0) && wi.z > VNDF_R(0.0), swap = lobe.wo_z > wi.z;
    VNDF_REAL both = vndf_impl_beckmann_both(lobe, vndf_impl_beckmann_other(lobe, wi));
    VNDF_REAL low = swap ? wi.z : lobe.wo_z, high = swap ? lobe.wo_z : wi.z;
    // The smaller cosine is divided first, so that nothing underflows.
    VNDF_REAL g2 = high * VNDF_DIVIDE(low * VNDF_R(1099511627776.0), above ? both : VNDF_R(1.0));
    return above ? vndf_impl_share(g2) : VNDF_R(0.0);
}

// Height-correlated masking and shadowing of a reflection.
// Source: Heitz 2014, Equation 99: 1 / (1 + Lambda(wo) + Lambda(wi)), over and under times both cosines.
// wo, wi: unit vectors, local frame.
// return: in [0, 1]; 0 unless both are above the horizon.
// Accuracy: 8 eps; double 9.
VNDF_FN VNDF_REAL vndf_beckmann_g2(VNDF_REAL3 wo, VNDF_REAL3 wi, VNDF_REAL2 alpha) {
    return vndf_impl_beckmann_g2(vndf_beckmann_lobe_of(wo, alpha), wi);
}

// The same for many wi and one wo and alpha.
// Accuracy: 8 eps; double 9.
VNDF_FN VNDF_REAL vndf_beckmann_g2_lobe(struct vndf_beckmann_lobe lobe, VNDF_REAL3 wi) {
    return vndf_impl_beckmann_g2(lobe, wi);
}

// Separable masking and shadowing: G1(wo) G1(wi).
// Source: Heitz 2014, Equation 98.
// wo, wi: unit vectors, local frame.
// return: in [0, 1]; 0 unless both are above the horizon.
// Accuracy: 8 eps; double 12.
VNDF_FN VNDF_REAL vndf_beckmann_g2_separable(VNDF_REAL3 wo, VNDF_REAL3 wi, VNDF_REAL2 alpha) {
    struct vndf_beckmann_lobe lobe = vndf_beckmann_lobe_of(wo, alpha);
    VNDF_REAL masked = vndf_impl_beckmann_g1(lobe);
    // Made dependent on the other one, so that LLVM's SLP pass does not pack the two (impl/stretch.h); the other choice is never
    // taken.
    VNDF_REAL3 after = VNDF_MAKE3(wi.x, wi.y, masked >= VNDF_R(0.0) ? wi.z : VNDF_R(1.0));
    return masked * vndf_impl_beckmann_g1(vndf_impl_beckmann_other(lobe, after));
}

// G2 / G1(wo) is i sigma(wo) over the sum of vndf_impl_beckmann_both.
VNDF_FN VNDF_REAL vndf_impl_beckmann_weight(struct vndf_beckmann_lobe lobe, VNDF_REAL3 wi) {
    int above = lobe.wo_z > VNDF_R(0.0) && wi.z > VNDF_R(0.0);
    VNDF_REAL both = vndf_impl_beckmann_both(lobe, vndf_impl_beckmann_other(lobe, wi));
    VNDF_REAL seen = wi.z * VNDF_R(1099511627776.0) * vndf_impl_beckmann_front_sigma(lobe);
    VNDF_REAL weight = VNDF_DIVIDE(seen, above ? both : VNDF_R(1.0));
    return above ? vndf_impl_share(weight) : VNDF_R(0.0);
}

// The weight of a visible normal's reflection: brdf cos(theta_i) / vndf_beckmann_pdf_wi of a perfectly conducting mirror.
// Source: Heitz 2014, Equations 43 and 99: G2 / G1(wo) = (1 + Lambda(wo)) / (1 + Lambda(wo) + Lambda(wi)).
// wo, wi: unit vectors, local frame.
// return: in [0, 1]; 0 unless both are above the horizon.
// Accuracy: 8 eps; double 9.
VNDF_FN VNDF_REAL vndf_beckmann_weight(VNDF_REAL3 wo, VNDF_REAL3 wi, VNDF_REAL2 alpha) {
    return vndf_impl_beckmann_weight(vndf_beckmann_lobe_of(wo, alpha), wi);
}

// The same for many wi and one wo and alpha.
// Accuracy: 8 eps; double 9.
VNDF_FN VNDF_REAL vndf_beckmann_weight_lobe(struct vndf_beckmann_lobe lobe, VNDF_REAL3 wi) {
    return vndf_impl_beckmann_weight(lobe, wi);
}

// cosine: wo . wm.
VNDF_FN VNDF_REAL vndf_impl_beckmann_facing(struct vndf_beckmann_lobe lobe, VNDF_REAL3 wm, VNDF_REAL cosine) {
    VNDF_REAL z = vndf_impl_beckmann_height(wm.z), rise = VNDF_DIVIDE(VNDF_R(1.0), z * z), rcp = z * rise;
    int faces = wm.z > VNDF_R(0.0) && cosine > VNDF_R(0.0);
    struct vndf_impl_power pdf = vndf_impl_beckmann_visible(lobe, wm.x * rcp, wm.y * rcp, z, cosine, 0, rise,
                                                            faces ? cosine : VNDF_R(0.0));
    return faces ? vndf_impl_finite(vndf_impl_times_power(pdf.part, pdf.exponent)) : VNDF_R(0.0);
}
VNDF_FN VNDF_REAL vndf_impl_beckmann_pdf_wm(struct vndf_beckmann_lobe lobe, VNDF_REAL3 wm) {
    return vndf_impl_beckmann_facing(lobe, wm,
                                     vndf_impl_dot(lobe.wo_x, lobe.wo_y, lobe.wo_z, wm.x, wm.y, wm.z));
}

// The distribution of visible normals: the density of every vndf_beckmann_sample_wm_* but walter2007.
// Source: Heitz & d'Eon, Importance Sampling Microfacet-Based BSDFs with the Distribution of Visible Normals, 2014:
//     max(wo . wm, 0) D(wm) / sigma(wo).
// wo: unit vector, local frame, anywhere on the sphere (at -z nothing is visible: 0).
// wm: unit normal, local frame.
// return: per steradian of wm; 0 for wm.z <= 0 or wo . wm <= 0.
// Accuracy: 12 eps (1 + 2 q); double 13.
VNDF_FN VNDF_REAL vndf_beckmann_pdf_wm(VNDF_REAL3 wo, VNDF_REAL3 wm, VNDF_REAL2 alpha) {
    return vndf_impl_beckmann_pdf_wm(vndf_beckmann_lobe_of(wo, alpha), wm);
}

// The same for many wm and one wo and alpha.
// Accuracy: 12 eps (1 + 2 q); double 13.
VNDF_FN VNDF_REAL vndf_beckmann_pdf_wm_lobe(struct vndf_beckmann_lobe lobe, VNDF_REAL3 wm) {
    return vndf_impl_beckmann_pdf_wm(lobe, wm);
}

VNDF_FN VNDF_REAL vndf_impl_beckmann_pdf_wi(struct vndf_beckmann_lobe lobe, VNDF_REAL3 wi) {
    struct vndf_impl_power pdf = vndf_impl_beckmann_half(lobe, wi, VNDF_R(0.25));
    VNDF_REAL result = vndf_impl_finite(vndf_impl_times_power(pdf.part, pdf.exponent));
    return lobe.wo_z + wi.z > VNDF_R(0.0) ? result : VNDF_R(0.0);
}

// The density of the reflection of wo about a visible normal.
// Source: Heitz & d'Eon 2014, with the reflection Jacobian: D(h) / (4 sigma(wo)), h = wo + wi.
// wo: unit vector, local frame, anywhere on the sphere.
// wi: unit vector, local frame, anywhere on the sphere: a reflection may fall below the horizon.
// return: per steradian of wi; 0 where the half vector points to or below the horizon.
// Accuracy: 15 eps (1 + 2 q); double 14.
//     Below alpha = 1e-2 the rounding of wi moves the density by more than that: use a sampler's _with_pdf form
//     there.
VNDF_FN VNDF_REAL vndf_beckmann_pdf_wi(VNDF_REAL3 wo, VNDF_REAL3 wi, VNDF_REAL2 alpha) {
    return vndf_impl_beckmann_pdf_wi(vndf_beckmann_lobe_of(wo, alpha), wi);
}

// The same for many wi and one wo and alpha.
// Accuracy: 15 eps (1 + 2 q); double 14.
VNDF_FN VNDF_REAL vndf_beckmann_pdf_wi_lobe(struct vndf_beckmann_lobe lobe, VNDF_REAL3 wi) {
    return vndf_impl_beckmann_pdf_wi(lobe, wi);
}

// The density the other way is that of wi's lobe.
VNDF_FN VNDF_REAL2 vndf_impl_beckmann_pdf_wi_both(struct vndf_beckmann_lobe lobe, VNDF_REAL3 wi) {
    VNDF_REAL3 wo = VNDF_MAKE3(lobe.wo_x, lobe.wo_y, lobe.wo_z);
    VNDF_REAL pdf = vndf_impl_beckmann_pdf_wi(lobe, wi);
    VNDF_REAL back = vndf_impl_beckmann_pdf_wi(vndf_impl_beckmann_other(lobe, wi), wo);
    return VNDF_MAKE2(pdf, back);
}

// The densities of a reflection both ways, as bidirectional methods need them: that of wi seen from wo, and that of wo
// seen from wi.
// Source: Heitz & d'Eon 2014, with the reflection Jacobian: D(h) / (4 sigma(wo)) and D(h) / (4 sigma(wi)), h = wo + wi.
// wo, wi: unit vectors, local frame, anywhere on the sphere.
// return: (vndf_beckmann_pdf_wi(wo, wi), vndf_beckmann_pdf_wi(wi, wo)), bit for bit, per steradian of wi and of wo.
// Accuracy: 15 eps (1 + 2 q); double 14.
//     Below alpha = 1e-2 the rounding of wi moves both by more than that.
VNDF_FN VNDF_REAL2 vndf_beckmann_pdf_wi_both(VNDF_REAL3 wo, VNDF_REAL3 wi, VNDF_REAL2 alpha) {
    return vndf_impl_beckmann_pdf_wi_both(vndf_beckmann_lobe_of(wo, alpha), wi);
}

// The same for many wi and one wo and alpha.
// Accuracy: 15 eps (1 + 2 q); double 14.
VNDF_FN VNDF_REAL2 vndf_beckmann_pdf_wi_both_lobe(struct vndf_beckmann_lobe lobe, VNDF_REAL3 wi) {
    return vndf_impl_beckmann_pdf_wi_both(lobe, wi);
}

// The value is the density times sigma(wo) / (o i / G2): powers of two apart, since the density may leave the range of
// numbers where the value does not.
VNDF_FN VNDF_REAL2 vndf_impl_beckmann_eval_pdf(struct vndf_beckmann_lobe lobe, VNDF_REAL3 wi) {
    struct vndf_impl_power pdf = vndf_impl_beckmann_half(lobe, wi, VNDF_R(0.25));
    VNDF_REAL density = vndf_impl_finite(vndf_impl_times_power(pdf.part, pdf.exponent));
    int above = lobe.wo_z > VNDF_R(0.0) && wi.z > VNDF_R(0.0);
    VNDF_REAL both = vndf_impl_beckmann_both(lobe, vndf_impl_beckmann_other(lobe, wi));
    VNDF_REAL seen = VNDF_R(1099511627776.0) * vndf_impl_beckmann_front_sigma(lobe);
    struct vndf_impl_power ratio = vndf_impl_split(above ? VNDF_DIVIDE(seen, both) : VNDF_R(1.0));
    VNDF_REAL value =
        vndf_impl_finite(vndf_impl_times_power(pdf.part * ratio.part, pdf.exponent + ratio.exponent));
    return VNDF_MAKE2(above ? value : VNDF_R(0.0), lobe.wo_z + wi.z > VNDF_R(0.0) ? density : VNDF_R(0.0));
}

// A reflection's value and density from common terms.
// Source: Heitz 2014: the value is D(h) G2 / (4 o i), o = wo.z, i = wi.z, h = wo + wi; the density is that of
//     vndf_beckmann_pdf_wi, D(h) / (4 sigma(wo)).
// wo, wi: unit vectors, local frame, anywhere on the sphere.
// return: (value, density). The value is that of the BRDF, without the cosine of wi and without a Fresnel factor, per
//     steradian; 0 unless both are above the horizon. The density is per steradian of wi. value * wi.z / density is
//     vndf_beckmann_weight.
// Accuracy: 18 eps (1 + 2 q); double 16.
//     Below alpha = 1e-2 the rounding of wi moves both by more than that.
VNDF_FN VNDF_REAL2 vndf_beckmann_eval_pdf(VNDF_REAL3 wo, VNDF_REAL3 wi, VNDF_REAL2 alpha) {
    return vndf_impl_beckmann_eval_pdf(vndf_beckmann_lobe_of(wo, alpha), wi);
}

// The same for many wi and one wo and alpha.
// Accuracy: 18 eps (1 + 2 q); double 16.
VNDF_FN VNDF_REAL2 vndf_beckmann_eval_pdf_lobe(struct vndf_beckmann_lobe lobe, VNDF_REAL3 wi) {
    return vndf_impl_beckmann_eval_pdf(lobe, wi);
}

// The density of the plain NDF sampler: D(wm) wm.z.
// Source: Walter et al. 2007, Equation 24.
// wm: unit normal, local frame.
// return: per steradian of wm; 0 for wm.z <= 0.
// Accuracy: 8 eps (1 + 2 q); double 8.
VNDF_FN VNDF_REAL vndf_beckmann_pdf_wm_walter2007(VNDF_REAL3 wm, VNDF_REAL2 alpha) {
    return vndf_impl_beckmann_d(wm.x, wm.y, wm.z, vndf_impl_alpha(alpha.x), vndf_impl_alpha_y(alpha.y),
                                vndf_impl_max(wm.z, VNDF_R(0.0)));
}

// --- Visible slopes at alpha = 1, in the plane of incidence ---

// The marginal density of visible slopes in the plane of incidence, alpha = 1.
// Source: Heitz & d'Eon 2014, supplement 1, Section 3.2.
// cos_theta: of the view direction, in [-1, 1] (at -1 nothing is visible: 0).
// slope: x of the normal (-x, ., 1), positive away from the view direction.
// return: per unit of slope, integral 1 over x < cot(theta); 0 beyond.
// Accuracy: 9 eps (1 + condition number); double 8.
VNDF_FN VNDF_REAL vndf_beckmann_slope_pdf(VNDF_REAL cos_theta, VNDF_REAL slope) {
    struct vndf_impl_seen_slope s = vndf_impl_beckmann_seen_slope(cos_theta, slope);
    VNDF_REAL pdf = vndf_impl_slope_gaussian(s, VNDF_DIVIDE(VNDF_1_SQRT_PI * s.y, s.slopes.area));
    return s.visible > VNDF_R(0.0) ? vndf_impl_finite(pdf) : VNDF_R(0.0);
}

// Its cumulative distribution.
// Source: Heitz & d'Eon 2014, supplement 1, Section 3.2.
// cos_theta, slope: as for vndf_beckmann_slope_pdf.
// return: in [0, 1]; 1 for slope >= cot(theta), and for cos_theta = -1, where nothing is visible.
// Accuracy: 10 eps (1 + condition number); double 10.
VNDF_FN VNDF_REAL vndf_beckmann_slope_cdf(VNDF_REAL cos_theta, VNDF_REAL slope) {
    struct vndf_impl_seen_slope s = vndf_impl_beckmann_seen_slope(cos_theta, slope);
    struct vndf_impl_incidence_slopes i = s.slopes;
    struct vndf_impl_scaled_erfc f = vndf_impl_scaled_erfc_of(vndf_impl_abs(s.x));
    VNDF_REAL rcp = VNDF_DIVIDE(VNDF_R(1.0), i.area), half_y = VNDF_R(0.5) * s.y;
    // For x > 0 what is above; the factor may have either sign there.
    int right = i.front && s.x > VNDF_R(0.0);
    VNDF_REAL body = VNDF_FMA(half_y, f.erfcx, right ? -f.ierfcx : f.ierfcx) * rcp;
    VNDF_REAL e = vndf_impl_slope_gaussian(s, right ? VNDF_R(1.0) : body);
    VNDF_REAL cdf = right ? VNDF_R(1.0) - VNDF_FMA(i.hidden, rcp, body * e) : e;
    return s.visible > VNDF_R(0.0) && cdf < VNDF_R(1.0) ? vndf_impl_max(cdf, VNDF_R(0.0)) : VNDF_R(1.0);
}

// The inverse of vndf_beckmann_slope_cdf.
// Source: Jakob, An Improved Visible Normal Sampling Routine for the Beckmann Distribution, 2014, whose equation in erf x
//     is solved here in x, in forms that do not cancel.
// cos_theta: in [-1, 1].
// u1: probability.
// return: the slope x < cot(theta); minus the largest finite number at cos_theta = -1.
// Accuracy: 7 eps (1 + condition number); double 7.
VNDF_FN VNDF_REAL vndf_beckmann_slope_cdf_inverse(VNDF_REAL cos_theta, VNDF_REAL u1) {
    struct vndf_impl_visible_slope r =
        vndf_impl_slope_of_mass(vndf_impl_beckmann_angle(cos_theta), vndf_impl_u(u1));
    return cos_theta > VNDF_R(-1.0) ? vndf_impl_finite(r.x) : -VNDF_REAL_MAX;
}

VNDF_END

#endif
