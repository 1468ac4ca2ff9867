// The terms and densities of isotropic GGX from cosines alone, as shaders that hold dot products and no vectors have them.
//
// Names of ggx.h. A cosine is taken for an exact number, and 1 - c^2 rounded once: each function is as accurate as in a local
// frame, for the cosine as given. What is lost is lost before, where the cosine is rounded: half a unit, 2^-25 (double: 2^-54),
// moves
//     D and the densities by up to 4 / alpha^2 times as much: 12 % at alpha = 1e-3, 0.12 % at 1e-2, 1e-5 at 0.1. Below alpha =
//         3.4e-4 (double: 1.4e-8) the lobe is narrower than the step from 1 to the next cosine;
//     G1, G2 and the weight by no more than as much, for alpha up to 1.
// frames_test.cpp asserts both. A dot product of rounded vectors is off by more than half a unit. With vectors at hand take
// ggx_world.h.
// cosines: in [-1, 1]; beyond, as rounding makes them, the sine is 0. Of the angles to the macroscopic normal if not said
//     otherwise.
#ifndef VNDF_GGX_COSINES_H
#define VNDF_GGX_COSINES_H

#include "ggx.h"
#include "impl/world.h"

VNDF_BEGIN

// The distribution of normals D.
// Source: Walter et al. 2007, Equation 33 (m = wm).
// cos_theta_m: n . wm.
// alpha: in [1e-8, 1e3].
// return: per steradian of wm per unit projected area; 0 for cos_theta_m <= 0.
// Accuracy: 14 eps; double 14.
VNDF_FN VNDF_REAL vndf_ggx_ndf_cosines(VNDF_REAL cos_theta_m, VNDF_REAL alpha) {
    return vndf_ggx_ndf(vndf_impl_of_cosine(cos_theta_m), VNDF_MAKE2(alpha, alpha));
}

// Smith's Lambda.
// Source: Heitz 2014, Equation 72.
// cos_theta: n . w.
// return: as vndf_ggx_lambda: >= 0 above the horizon, -1 - Lambda(-w) below it, the largest finite number at 0.
// Accuracy: 9.5 eps; double 10.5.
VNDF_FN VNDF_REAL vndf_ggx_lambda_cosines(VNDF_REAL cos_theta, VNDF_REAL alpha) {
    return vndf_ggx_lambda(vndf_impl_of_cosine(cos_theta), VNDF_MAKE2(alpha, alpha));
}

// The projected area of the microsurface.
// Source: Dupuy & Benyoub 2023, Equation 4, stretched.
// cos_theta: n . w.
// return: in [0, max(1, alpha)], per unit area of the macrosurface.
// Accuracy: 9 eps; double 9.
VNDF_FN VNDF_REAL vndf_ggx_sigma_cosines(VNDF_REAL cos_theta, VNDF_REAL alpha) {
    return vndf_ggx_sigma(vndf_impl_of_cosine(cos_theta), VNDF_MAKE2(alpha, alpha));
}

// Smith masking of one direction, for a normal that faces it.
// Source: Heitz 2014, Equation 43.
// cos_theta: n . w.
// return: in [0, 1]; 0 for cos_theta <= 0.
// Accuracy: 6 eps; double 6.
VNDF_FN VNDF_REAL vndf_ggx_g1_cosines(VNDF_REAL cos_theta, VNDF_REAL alpha) {
    return vndf_ggx_g1(vndf_impl_of_cosine(cos_theta), VNDF_MAKE2(alpha, alpha));
}

// Height-correlated masking and shadowing of a reflection.
// Source: Heitz 2014, Equation 99.
// cos_theta_o, cos_theta_i: n . wo, n . wi.
// return: in [0, 1]; 0 unless both are positive.
// Accuracy: 6 eps; double 6.
VNDF_FN VNDF_REAL vndf_ggx_g2_cosines(VNDF_REAL cos_theta_o, VNDF_REAL cos_theta_i, VNDF_REAL alpha) {
    VNDF_REAL3 o = vndf_impl_of_cosine(cos_theta_o);
    return vndf_ggx_g2(o, vndf_impl_of_next_cosine(cos_theta_i, o), VNDF_MAKE2(alpha, alpha));
}

// The weight of a visible normal's reflection, brdf cos(theta_i) / vndf_ggx_pdf_wi_cosines of a perfect conductor.
// Source: Heitz 2014, Equations 43 and 99: G2 / G1(wo).
// cos_theta_o, cos_theta_i: n . wo, n . wi.
// return: in [0, 1]; 0 unless both are positive.
// Accuracy: 7 eps; double 7.
VNDF_FN VNDF_REAL vndf_ggx_weight_cosines(VNDF_REAL cos_theta_o, VNDF_REAL cos_theta_i, VNDF_REAL alpha) {
    VNDF_REAL3 o = vndf_impl_of_cosine(cos_theta_o);
    return vndf_ggx_weight(o, vndf_impl_of_next_cosine(cos_theta_i, o), VNDF_MAKE2(alpha, alpha));
}

// The distribution of visible normals.
// Source: Dupuy & Benyoub 2023, Equation 1, as max(wo . wm, 0) D(wm) / sigma(wo).
// cos_theta_o, cos_theta_m: n . wo, n . wm.
// wo_dot_wm: wo . wm.
// return: per steradian of wm; 0 for cos_theta_m <= 0 or wo_dot_wm <= 0.
// Accuracy: 14 eps; double 15.
VNDF_FN VNDF_REAL vndf_ggx_pdf_wm_cosines(VNDF_REAL cos_theta_o, VNDF_REAL cos_theta_m, VNDF_REAL wo_dot_wm,
                                          VNDF_REAL alpha) {
    VNDF_REAL3 o = vndf_impl_of_cosine(cos_theta_o);
    return vndf_impl_ggx_visible(vndf_ggx_lobe_of(o, VNDF_MAKE2(alpha, alpha)),
                                 vndf_impl_of_next_cosine(cos_theta_m, o), wo_dot_wm);
}

// The density of the reflection of wo about a visible normal.
// Source: Dupuy & Benyoub 2023, Equation 20, with 1 / sigma for G1 / cos: D(wm) / (4 sigma(wo)).
// cos_theta_o: n . wo.
// cos_theta_m: n . wm, wm the half vector of wo and wi.
// return: per steradian of wi; 0 for cos_theta_m <= 0.
// Accuracy: 18 eps; double 18.
VNDF_FN VNDF_REAL vndf_ggx_pdf_wi_cosines(VNDF_REAL cos_theta_o, VNDF_REAL cos_theta_m, VNDF_REAL alpha) {
    VNDF_REAL a = vndf_impl_alpha(alpha);
    VNDF_REAL3 o = vndf_impl_of_cosine(cos_theta_o), m = vndf_impl_of_next_cosine(cos_theta_m, o);
    return vndf_impl_ggx_reflection_pdf(vndf_impl_half_along(m.x, VNDF_R(0.0), m.z, a, a),
                                        vndf_impl_ggx_twice_sigma(o.x, VNDF_R(0.0), o.z, a, a), a, a);
}

VNDF_END

#endif
