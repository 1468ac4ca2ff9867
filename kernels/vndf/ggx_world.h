// The terms and densities of isotropic GGX about a normal n, in the frame that all vectors are given in: no tangent is needed.
//
// Conventions and names of ggx.h, with n behind the first direction and one alpha. The angle to n is taken from |n x w|: small
// angles keep their digits, as they do in a local frame; renderers' 1 - (n . w)^2 loses them (ggx_cosines.h).
// n: unit macroscopic normal, any.
#ifndef VNDF_GGX_WORLD_H
#define VNDF_GGX_WORLD_H

#include "ggx.h"
#include "impl/world.h"

VNDF_BEGIN

// The distribution of normals D about n.
// Source: Walter et al. 2007, Equation 33 (m = wm).
// wm, n: unit vectors.
// alpha: in [1e-8, 1e3].
// return: per steradian of wm per unit projected area: its integral with wm . n is 1; 0 for wm . n <= 0.
// Accuracy: 20 eps; double 22.
VNDF_FN VNDF_REAL vndf_ggx_ndf_world(VNDF_REAL3 wm, VNDF_REAL3 n, VNDF_REAL alpha) {
    return vndf_ggx_ndf(vndf_impl_about(n, wm), VNDF_MAKE2(alpha, alpha));
}

// Smith's Lambda about n.
// Source: Heitz 2014, Equation 72.
// w, n: unit vectors.
// return: as vndf_ggx_lambda: >= 0 above the horizon, -1 - Lambda(-w) below it, the largest finite number at w . n = 0.
// Accuracy: 13.5 eps; double 13.5.
VNDF_FN VNDF_REAL vndf_ggx_lambda_world(VNDF_REAL3 w, VNDF_REAL3 n, VNDF_REAL alpha) {
    return vndf_ggx_lambda(vndf_impl_about(n, w), VNDF_MAKE2(alpha, alpha));
}

// The projected area of the microsurface seen from w.
// Source: Dupuy & Benyoub 2023, Equation 4, stretched.
// w, n: unit vectors, any.
// return: in [0, max(1, alpha)], per unit area of the macrosurface.
// Accuracy: 13 eps; double 13.
VNDF_FN VNDF_REAL vndf_ggx_sigma_world(VNDF_REAL3 w, VNDF_REAL3 n, VNDF_REAL alpha) {
    return vndf_ggx_sigma(vndf_impl_about(n, w), VNDF_MAKE2(alpha, alpha));
}

// Smith masking of one direction, for a normal that faces it.
// Source: Heitz 2014, Equation 43.
// w, n: unit vectors.
// return: in [0, 1]; 0 for w . n <= 0.
// Accuracy: 7.5 eps; double 7.5.
VNDF_FN VNDF_REAL vndf_ggx_g1_world(VNDF_REAL3 w, VNDF_REAL3 n, VNDF_REAL alpha) {
    return vndf_ggx_g1(vndf_impl_about(n, w), VNDF_MAKE2(alpha, alpha));
}

// Height-correlated masking and shadowing of a reflection.
// Source: Heitz 2014, Equation 99.
// wo, n, wi: unit vectors.
// return: in [0, 1]; 0 unless both are above the horizon.
// Accuracy: 7 eps; double 7.
VNDF_FN VNDF_REAL vndf_ggx_g2_world(VNDF_REAL3 wo, VNDF_REAL3 n, VNDF_REAL3 wi, VNDF_REAL alpha) {
    VNDF_REAL3 o = vndf_impl_about(n, wo);
    return vndf_ggx_g2(o, vndf_impl_about(vndf_impl_next(n, o), wi), VNDF_MAKE2(alpha, alpha));
}

// The weight of a visible normal's reflection, brdf cos(theta_i) / vndf_ggx_pdf_wi_world of a perfect conductor.
// Source: Heitz 2014, Equations 43 and 99: G2 / G1(wo).
// wo, n, wi: unit vectors.
// return: in [0, 1]; 0 unless both are above the horizon.
// Accuracy: 8 eps; double 8.
VNDF_FN VNDF_REAL vndf_ggx_weight_world(VNDF_REAL3 wo, VNDF_REAL3 n, VNDF_REAL3 wi, VNDF_REAL alpha) {
    VNDF_REAL3 o = vndf_impl_about(n, wo);
    return vndf_ggx_weight(o, vndf_impl_about(vndf_impl_next(n, o), wi), VNDF_MAKE2(alpha, alpha));
}

// The distribution of visible normals about n: the density of vndf_ggx_sample_wm_benyoub2024.
// Source: Dupuy & Benyoub 2023, Equation 1, for alpha_x = alpha_y in the frame of n, whose z components are
//     dot products with n and whose tangential lengths are those of cross products with n.
// wo, n: unit vectors, any (at wo = -n nothing is visible: 0).
// wm: unit normal.
// return: per steradian of wm; 0 for wm . n <= 0 or wo . wm <= 0.
// Accuracy: 21 eps; double 27.
VNDF_FN VNDF_REAL vndf_ggx_pdf_wm_world(VNDF_REAL3 wo, VNDF_REAL3 n, VNDF_REAL3 wm, VNDF_REAL alpha) {
    VNDF_REAL cos_om = vndf_impl_dot(wo.x, wo.y, wo.z, wm.x, wm.y, wm.z);
    // In another order than wo . n: two products of one shape would be packed (impl/stretch.h).
    VNDF_REAL wm_z = vndf_impl_dot(n.z, n.x, n.y, wm.z, wm.x, wm.y);
    VNDF_REAL wo_z = vndf_impl_dot(wo.x, wo.y, wo.z, n.x, n.y, n.z);
    VNDF_REAL a = vndf_impl_alpha(alpha);
    VNDF_REAL twice_sigma =
        vndf_impl_ggx_twice_sigma(vndf_impl_length(vndf_impl_cross(n, wo)), VNDF_R(0.0), wo_z, a, a);
    VNDF_REAL q = vndf_impl_ggx_q(vndf_impl_length(vndf_impl_cross(wm, n)), VNDF_R(0.0), wm_z, a, a);
    VNDF_REAL area = VNDF_DIVIDE(VNDF_2_PI, (q * a) * (q * a)) * cos_om;
    VNDF_REAL pdf = vndf_impl_bounded_quotient(vndf_impl_max(area, VNDF_R(0.0)), twice_sigma);
    // pdf is positive where wo . wm is.
    int visible = vndf_impl_min(pdf, wm_z) > VNDF_R(0.0) && twice_sigma > VNDF_R(0.0);
    return visible ? vndf_impl_finite(pdf) : VNDF_R(0.0);
}

// The density of the reflection of wo about a visible normal.
// Source: Dupuy & Benyoub 2023, Equation 20, with 1 / sigma for G1 / cos: D(h) / (4 sigma(wo)), h = wo + wi.
// wo, n, wi: unit vectors, any: a reflection may fall below the horizon.
// return: per steradian of wi; 0 where the half vector points to or below the horizon.
// Accuracy: 27 eps; double 27.
//     Below alpha = 1e-2 the rounding of wi moves the density by more than that: use the sampler's _with_pdf form there.
VNDF_FN VNDF_REAL vndf_ggx_pdf_wi_world(VNDF_REAL3 wo, VNDF_REAL3 n, VNDF_REAL3 wi, VNDF_REAL alpha) {
    VNDF_REAL a = vndf_impl_alpha(alpha);
    VNDF_REAL3 o = vndf_impl_about(n, wo), next = vndf_impl_next(n, o);
    struct vndf_impl_half_sum sum = vndf_impl_half_sum_of(wo, wi);
    VNDF_REAL3 m = vndf_impl_upright(vndf_impl_length(vndf_impl_half_cross(next, sum)),
                                     vndf_impl_half_dot(next, sum), n, wi);
    return vndf_impl_ggx_reflection_pdf(vndf_impl_half_along(m.x, VNDF_R(0.0), m.z, a, a),
                                        vndf_impl_ggx_twice_sigma(o.x, VNDF_R(0.0), o.z, a, a), a, a);
}

VNDF_END

#endif
