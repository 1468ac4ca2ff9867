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
    VNDF_REAL unseen = vndf_impl_beckmann_unseen(vndf_impl_beckmann_l(w, alpha), w.z);
    return vndf_impl_finite(unseen + vndf_impl_max(w.z, VNDF_R(0.0))) + vndf_impl_zero(w.x, w.y, w.z);
}

// Smith masking of one direction, for a normal that faces it.
// Source: Heitz 2014, Equation 43: 1 / (1 + Lambda) = w.z / sigma(w).
// w: unit vector, local frame.
// return: in [0, 1]; 0 for w.z <= 0.
// Accuracy: 8 eps; double 9.
VNDF_FN VNDF_REAL vndf_beckmann_g1(VNDF_REAL3 w, VNDF_REAL2 alpha) {
    return w.z > VNDF_R(0.0) ? vndf_impl_min(w.z / vndf_beckmann_sigma(w, alpha), VNDF_R(1.0)) : VNDF_R(0.0);
}

// A quarter of 1 + Lambda(wo) and of 1 + Lambda(wo) + Lambda(wi), so that the sum of two poles is a number.
struct vndf_impl_lambdas {
    VNDF_REAL visible, sum;
};
VNDF_FN struct vndf_impl_lambdas vndf_impl_beckmann_lambdas(VNDF_REAL3 wo, VNDF_REAL3 wi, VNDF_REAL2 alpha) {
    struct vndf_impl_lambdas lambdas;
    // wi's terms are made dependent on wo's, so that LLVM's SLP pass does not pack the two (impl/stretch.h).
    // Next to nothing counts as little: it is slow where it is no normal number.
    VNDF_REAL little = VNDF_EPSILON * VNDF_EPSILON;
    VNDF_REAL lambda_o = vndf_impl_max(vndf_impl_beckmann_upper_lambda(wo, alpha), little);
    VNDF_REAL2 alpha_i = VNDF_MAKE2(lambda_o >= VNDF_R(0.0) ? alpha.x : VNDF_R(1.0),
                                    lambda_o >= VNDF_R(0.0) ? alpha.y : VNDF_R(1.0));
    VNDF_REAL lambda_i = vndf_impl_max(vndf_impl_beckmann_upper_lambda(wi, alpha_i), little),
              quarter = VNDF_R(0.25);
    lambdas.visible = VNDF_FMA(quarter, lambda_o, quarter);
    // A sum of equals: the same bits for wo and wi exchanged.
    lambdas.sum = VNDF_FMA(quarter, lambda_i, quarter * lambda_o) + quarter;
    return lambdas;
}

// Height-correlated masking and shadowing of a reflection.
// Source: Heitz 2014, Equation 99: 1 / (1 + Lambda(wo) + Lambda(wi)).
// wo, wi: unit vectors, local frame.
// return: in [0, 1]; 0 unless both are above the horizon.
// Accuracy: 8 eps; double 9.
VNDF_FN VNDF_REAL vndf_beckmann_g2(VNDF_REAL3 wo, VNDF_REAL3 wi, VNDF_REAL2 alpha) {
    VNDF_REAL sum = vndf_impl_beckmann_lambdas(wo, wi, alpha).sum;
    return vndf_impl_min(wo.z, wi.z) > VNDF_R(0.0) ? vndf_impl_min(VNDF_R(0.25) / sum, VNDF_R(1.0))
                                                   : VNDF_R(0.0);
}

// Separable masking and shadowing: G1(wo) G1(wi).
// Source: Heitz 2014, Equation 98.
// wo, wi: unit vectors, local frame.
// return: in [0, 1]; 0 unless both are above the horizon.
// Accuracy: 8 eps; double 12.
VNDF_FN VNDF_REAL vndf_beckmann_g2_separable(VNDF_REAL3 wo, VNDF_REAL3 wi, VNDF_REAL2 alpha) {
    return vndf_beckmann_g1(wo, alpha) * vndf_beckmann_g1(wi, alpha);
}

// The weight of a visible normal's reflection: brdf cos(theta_i) / vndf_beckmann_pdf_wi of a perfectly conducting mirror.
// Source: Heitz 2014, Equations 43 and 99: G2 / G1(wo) = (1 + Lambda(wo)) / (1 + Lambda(wo) + Lambda(wi)).
// wo, wi: unit vectors, local frame.
// return: in [0, 1]; 0 unless both are above the horizon.
// Accuracy: 8 eps; double 9.
VNDF_FN VNDF_REAL vndf_beckmann_weight(VNDF_REAL3 wo, VNDF_REAL3 wi, VNDF_REAL2 alpha) {
    struct vndf_impl_lambdas lambdas = vndf_impl_beckmann_lambdas(wo, wi, alpha);
    VNDF_REAL weight = lambdas.visible / lambdas.sum;
    return vndf_impl_min(wo.z, wi.z) > VNDF_R(0.0) ? vndf_impl_min(weight, VNDF_R(1.0)) : VNDF_R(0.0);
}

// The distribution of visible normals: the density of every vndf_beckmann_sample_wm_* but walter2007.
// Source: Heitz & d'Eon, Importance Sampling Microfacet-Based BSDFs with the Distribution of Visible Normals, 2014:
//     max(wo . wm, 0) D(wm) / sigma(wo).
// wo: unit vector, local frame, anywhere on the sphere (at -z nothing is visible: 0).
// wm: unit normal, local frame.
// return: per steradian of wm; 0 for wm.z <= 0 or wo . wm <= 0.
// Accuracy: 12 eps (1 + 2 q); double 13.
VNDF_FN VNDF_REAL vndf_beckmann_pdf_wm(VNDF_REAL3 wo, VNDF_REAL3 wm, VNDF_REAL2 alpha) {
    VNDF_REAL cosine = vndf_impl_dot(wo.x, wo.y, wo.z, wm.x, wm.y, wm.z);
    VNDF_REAL z = vndf_impl_beckmann_height(wm.z), rise = VNDF_R(1.0) / (z * z);
    VNDF_REAL pdf = vndf_impl_beckmann_visible(wo, wm.x, wm.y, z, cosine, 0, rise,
                                               vndf_impl_max(cosine, VNDF_R(0.0)), alpha);
    return wm.z > VNDF_R(0.0) && cosine > VNDF_R(0.0) ? pdf : VNDF_R(0.0);
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
    VNDF_REAL x = wo.x + wi.x, y = wo.y + wi.y, z = wo.z + wi.z;
    // wo . h with the rounding errors of h: near wi = -wo it is the square of a small h.
    struct vndf_impl_pair dot = vndf_impl_dot_pair(wo.x, wo.y, wo.z, x, y, z);
    VNDF_REAL low = VNDF_FMA(
        wo.x, vndf_impl_sum_error(wo.x, wi.x, x),
        VNDF_FMA(wo.y, vndf_impl_sum_error(wo.y, wi.y, y), wo.z * vndf_impl_sum_error(wo.z, wi.z, z)));
    VNDF_REAL cosine = dot.head + (dot.tail + low);
    VNDF_REAL height = vndf_impl_beckmann_height(z), tx = x / height, ty = y / height;
    VNDF_REAL rise = VNDF_FMA(tx, tx, VNDF_FMA(ty, ty, VNDF_R(1.0)));
    VNDF_REAL pdf = vndf_impl_beckmann_visible(wo, x, y, height, z > VNDF_R(0.0) ? cosine : VNDF_R(0.0), 1,
                                               rise, VNDF_R(0.25), alpha);
    return z > VNDF_R(0.0) ? pdf : VNDF_R(0.0);
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
    VNDF_REAL pdf = vndf_impl_slope_gaussian(s, VNDF_1_SQRT_PI * s.y / s.slopes.area);
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
    VNDF_REAL rcp = VNDF_R(1.0) / i.area, half_y = VNDF_R(0.5) * s.y;
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
