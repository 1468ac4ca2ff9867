// The terms and densities of the isotropic Beckmann distribution from cosines alone.
//
// Names of beckmann.h; ggx_cosines.h says what cosines are worth: half a unit moves D and the densities 2 / alpha^2 times as
// much, anywhere in the lobe.
// cosines: in [-1, 1]; beyond, as rounding makes them, the sine is 0. Of the angles to the macroscopic normal if not said
//     otherwise.
//
// Accuracy: relative errors for the cosines as given; q is the exponent of the Gaussian.
#ifndef VNDF_BECKMANN_COSINES_H
#define VNDF_BECKMANN_COSINES_H

#include "beckmann.h"
#include "impl/world.h"

VNDF_BEGIN

// The distribution of normals D.
// Source: Walter et al. 2007, Equation 25 (m = wm).
// cos_theta_m: n . wm.
// alpha: in [1e-8, 1e3].
// return: per steradian of wm per unit projected area; 0 for cos_theta_m <= 0.
// Accuracy: 8 eps (1 + 2 q); double 8.
VNDF_FN VNDF_REAL vndf_beckmann_ndf_cosines(VNDF_REAL cos_theta_m, VNDF_REAL alpha) {
    return vndf_beckmann_ndf(vndf_impl_of_cosine(cos_theta_m), VNDF_MAKE2(alpha, alpha));
}

// Smith's Lambda.
// Source: Heitz 2014, Equation 66.
// cos_theta: n . w.
// return: as vndf_beckmann_lambda: >= 0 above the horizon, -1 - Lambda(-w) below it, the largest finite number at 0.
// Accuracy: 9 eps (1 + 2 q); double 9.
VNDF_FN VNDF_REAL vndf_beckmann_lambda_cosines(VNDF_REAL cos_theta, VNDF_REAL alpha) {
    return vndf_beckmann_lambda(vndf_impl_of_cosine(cos_theta), VNDF_MAKE2(alpha, alpha));
}

// The projected area of the microsurface.
// Source: Heitz & d'Eon 2014, supplement 1, Section 3.2.
// cos_theta: n . w.
// return: >= 0, per unit area of the macrosurface.
// Accuracy: 8 eps (1 + 2 q); double 8.
VNDF_FN VNDF_REAL vndf_beckmann_sigma_cosines(VNDF_REAL cos_theta, VNDF_REAL alpha) {
    return vndf_beckmann_sigma(vndf_impl_of_cosine(cos_theta), VNDF_MAKE2(alpha, alpha));
}

// Smith masking of one direction, for a normal that faces it.
// Source: Heitz 2014, Equation 43.
// cos_theta: n . w.
// return: in [0, 1]; 0 for cos_theta <= 0.
// Accuracy: 8 eps; double 8.
VNDF_FN VNDF_REAL vndf_beckmann_g1_cosines(VNDF_REAL cos_theta, VNDF_REAL alpha) {
    return vndf_beckmann_g1(vndf_impl_of_cosine(cos_theta), VNDF_MAKE2(alpha, alpha));
}

// Height-correlated masking and shadowing of a reflection.
// Source: Heitz 2014, Equation 99.
// cos_theta_o, cos_theta_i: n . wo, n . wi.
// return: in [0, 1]; 0 unless both are positive.
// Accuracy: 8 eps; double 8.
VNDF_FN VNDF_REAL vndf_beckmann_g2_cosines(VNDF_REAL cos_theta_o, VNDF_REAL cos_theta_i, VNDF_REAL alpha) {
    VNDF_REAL3 o = vndf_impl_of_cosine(cos_theta_o);
    return vndf_beckmann_g2(o, vndf_impl_of_next_cosine(cos_theta_i, o), VNDF_MAKE2(alpha, alpha));
}

// The weight of a visible normal's reflection, brdf cos(theta_i) / vndf_beckmann_pdf_wi_cosines of a perfect conductor.
// Source: Heitz 2014, Equations 43 and 99: G2 / G1(wo).
// cos_theta_o, cos_theta_i: n . wo, n . wi.
// return: in [0, 1]; 0 unless both are positive.
// Accuracy: 8 eps; double 8.
VNDF_FN VNDF_REAL vndf_beckmann_weight_cosines(VNDF_REAL cos_theta_o, VNDF_REAL cos_theta_i,
                                               VNDF_REAL alpha) {
    VNDF_REAL3 o = vndf_impl_of_cosine(cos_theta_o);
    return vndf_beckmann_weight(o, vndf_impl_of_next_cosine(cos_theta_i, o), VNDF_MAKE2(alpha, alpha));
}

// weight D / sigma(wo). Behind the surface the exponents of both combine to
//     q - a^2 = (1 - o^2 - m^2) / (alpha m sin(theta_o))^2, o and m the cosines:
// begun with the smaller of the two squares of sines, it has the rounding of q. It is negative for no visible normal.
VNDF_FN VNDF_REAL vndf_impl_beckmann_visible_cosines(VNDF_REAL3 o, VNDF_REAL cos_theta_m, VNDF_REAL weight,
                                                     VNDF_REAL alpha) {
    struct vndf_beckmann_lobe lobe = vndf_beckmann_lobe_of(o, VNDF_MAKE2(alpha, alpha));
    VNDF_REAL z = vndf_impl_beckmann_height(cos_theta_m);
    VNDF_REAL m2 = VNDF_FMA(-cos_theta_m, cos_theta_m, VNDF_R(1.0)), o2 = VNDF_FMA(-o.z, o.z, VNDF_R(1.0));
    VNDF_REAL gap = o2 < m2 ? VNDF_FMA(-cos_theta_m, cos_theta_m, o2) : VNDF_FMA(-o.z, o.z, m2);
    // Slopes beyond 2^31 (double: 2^255) have the density 0.
    VNDF_REAL square =
        o.z < VNDF_R(0.0) ? VNDF_DIVIDE(gap, vndf_impl_max(o2, VNDF_EPSILON * VNDF_EPSILON)) : m2;
    VNDF_REAL slope =
        VNDF_DIVIDE(VNDF_DIVIDE(VNDF_SQRT(vndf_impl_max(square, VNDF_R(0.0))), z), lobe.alpha_x);
    VNDF_REAL bounded = vndf_impl_min(slope, VNDF_DIVIDE(VNDF_R(0.25), VNDF_IMPL_ROOT_LEAST));
    struct vndf_impl_pair exponent = {bounded * bounded, VNDF_R(0.0)};
    struct vndf_impl_power pdf =
        vndf_impl_beckmann_share(lobe, exponent, VNDF_DIVIDE(VNDF_R(1.0), z * z), weight);
    return vndf_impl_finite(vndf_impl_times_power(pdf.part, pdf.exponent));
}

// The distribution of visible normals.
// Source: Heitz & d'Eon 2014: max(wo . wm, 0) D(wm) / sigma(wo).
// cos_theta_o, cos_theta_m: n . wo, n . wm.
// wo_dot_wm: wo . wm.
// return: per steradian of wm; 0 for cos_theta_m <= 0 or wo_dot_wm <= 0.
// Accuracy: 12 eps (1 + 2 q); double 12.
VNDF_FN VNDF_REAL vndf_beckmann_pdf_wm_cosines(VNDF_REAL cos_theta_o, VNDF_REAL cos_theta_m,
                                               VNDF_REAL wo_dot_wm, VNDF_REAL alpha) {
    VNDF_REAL pdf = vndf_impl_beckmann_visible_cosines(vndf_impl_of_cosine(cos_theta_o), cos_theta_m,
                                                       vndf_impl_max(wo_dot_wm, VNDF_R(0.0)), alpha);
    return cos_theta_m > VNDF_R(0.0) && wo_dot_wm > VNDF_R(0.0) ? pdf : VNDF_R(0.0);
}

// The density of the reflection of wo about a visible normal.
// Source: Heitz & d'Eon 2014, with the reflection Jacobian: D(wm) / (4 sigma(wo)).
// cos_theta_o: n . wo.
// cos_theta_m: n . wm, wm the half vector of wo and wi.
// return: per steradian of wi; 0 for cos_theta_m <= 0.
// Accuracy: 14 eps (1 + 2 q); double 14.
VNDF_FN VNDF_REAL vndf_beckmann_pdf_wi_cosines(VNDF_REAL cos_theta_o, VNDF_REAL cos_theta_m,
                                               VNDF_REAL alpha) {
    VNDF_REAL pdf = vndf_impl_beckmann_visible_cosines(vndf_impl_of_cosine(cos_theta_o), cos_theta_m,
                                                       VNDF_R(0.25), alpha);
    return cos_theta_m > VNDF_R(0.0) ? pdf : VNDF_R(0.0);
}

VNDF_END

#endif
