// The terms and densities of the isotropic Beckmann distribution about a normal n, in the frame that all vectors are given in.
//
// Conventions and names of beckmann.h, with n behind the first direction and one alpha; angles as in ggx_world.h.
// n: unit macroscopic normal, any.
//
// Accuracy: relative errors; q is the exponent of the Gaussian.
#ifndef VNDF_BECKMANN_WORLD_H
#define VNDF_BECKMANN_WORLD_H

#include "beckmann.h"
#include "impl/world.h"

VNDF_BEGIN

// The distribution of normals D about n.
// Source: Walter et al. 2007, Equation 25 (m = wm).
// wm, n: unit vectors.
// alpha: in [1e-8, 1e3].
// return: per steradian of wm per unit projected area: its integral with wm . n is 1; 0 for wm . n <= 0.
// Accuracy: 12 eps (1 + 2 q); double 16.
VNDF_FN VNDF_REAL vndf_beckmann_ndf_world(VNDF_REAL3 wm, VNDF_REAL3 n, VNDF_REAL alpha) {
    return vndf_beckmann_ndf(vndf_impl_about(n, wm), VNDF_MAKE2(alpha, alpha));
}

// Smith's Lambda about n.
// Source: Heitz 2014, Equation 66.
// w, n: unit vectors.
// return: as vndf_beckmann_lambda: >= 0 above the horizon, -1 - Lambda(-w) below it, the largest finite number at w . n = 0.
// Accuracy: 10 eps (1 + 2 q); double 10.
VNDF_FN VNDF_REAL vndf_beckmann_lambda_world(VNDF_REAL3 w, VNDF_REAL3 n, VNDF_REAL alpha) {
    return vndf_beckmann_lambda(vndf_impl_about(n, w), VNDF_MAKE2(alpha, alpha));
}

// The projected area of the microsurface seen from w.
// Source: Heitz & d'Eon 2014, supplement 1, Section 3.2.
// w, n: unit vectors, any.
// return: >= 0, per unit area of the macrosurface.
// Accuracy: 9 eps (1 + 2 q); double 9.
VNDF_FN VNDF_REAL vndf_beckmann_sigma_world(VNDF_REAL3 w, VNDF_REAL3 n, VNDF_REAL alpha) {
    return vndf_beckmann_sigma(vndf_impl_about(n, w), VNDF_MAKE2(alpha, alpha));
}

// Smith masking of one direction, for a normal that faces it.
// Source: Heitz 2014, Equation 43.
// w, n: unit vectors.
// return: in [0, 1]; 0 for w . n <= 0.
// Accuracy: 8 eps; double 8.
VNDF_FN VNDF_REAL vndf_beckmann_g1_world(VNDF_REAL3 w, VNDF_REAL3 n, VNDF_REAL alpha) {
    return vndf_beckmann_g1(vndf_impl_about(n, w), VNDF_MAKE2(alpha, alpha));
}

// Height-correlated masking and shadowing of a reflection.
// Source: Heitz 2014, Equation 99.
// wo, n, wi: unit vectors.
// return: in [0, 1]; 0 unless both are above the horizon.
// Accuracy: 8 eps; double 9.
VNDF_FN VNDF_REAL vndf_beckmann_g2_world(VNDF_REAL3 wo, VNDF_REAL3 n, VNDF_REAL3 wi, VNDF_REAL alpha) {
    VNDF_REAL3 o = vndf_impl_about(n, wo);
    return vndf_beckmann_g2(o, vndf_impl_about(vndf_impl_next(n, o), wi), VNDF_MAKE2(alpha, alpha));
}

// The weight of a visible normal's reflection, brdf cos(theta_i) / vndf_beckmann_pdf_wi_world of a perfect conductor.
// Source: Heitz 2014, Equations 43 and 99: G2 / G1(wo).
// wo, n, wi: unit vectors.
// return: in [0, 1]; 0 unless both are above the horizon.
// Accuracy: 9.5 eps; double 9.5.
VNDF_FN VNDF_REAL vndf_beckmann_weight_world(VNDF_REAL3 wo, VNDF_REAL3 n, VNDF_REAL3 wi, VNDF_REAL alpha) {
    VNDF_REAL3 o = vndf_impl_about(n, wo);
    return vndf_beckmann_weight(o, vndf_impl_about(vndf_impl_next(n, o), wi), VNDF_MAKE2(alpha, alpha));
}

// wo about n, and the unit vector along n x wo, x where wo has no azimuth.
struct vndf_impl_view_about {
    VNDF_REAL3 o;
    struct vndf_impl_vector axis;
};
VNDF_FN struct vndf_impl_view_about vndf_impl_view_about_of(VNDF_REAL3 n, VNDF_REAL3 wo) {
    struct vndf_impl_vector c = vndf_impl_cross(n, wo);
    VNDF_REAL sine = vndf_impl_length(c),
              rcp = VNDF_DIVIDE(VNDF_R(1.0), sine > VNDF_R(0.0) ? sine : VNDF_R(1.0));
    struct vndf_impl_view_about v = {
        vndf_impl_upright(sine, vndf_impl_dot(n.x, n.y, n.z, wo.x, wo.y, wo.z), n, wo),
        {sine > VNDF_R(0.0) ? c.x * rcp : VNDF_R(1.0), c.y * rcp, c.z * rcp}};
    return v;
}

// A normal in the local frame whose x axis is wo's part across n, by its cross product m with n and its z.
VNDF_FN VNDF_REAL3 vndf_impl_normal_of(struct vndf_impl_view_about v, struct vndf_impl_vector m,
                                       VNDF_REAL z) {
    struct vndf_impl_vector e = v.axis, across;
    VNDF_REAL x = VNDF_FMA(e.x, m.x, VNDF_FMA(e.y, m.y, e.z * m.z));
    across.x = VNDF_FMA(e.y, m.z, -e.z * m.y);
    across.y = VNDF_FMA(e.z, m.x, -e.x * m.z);
    across.z = VNDF_FMA(e.x, m.y, -e.y * m.x);
    return VNDF_MAKE3(x, vndf_impl_length(across), z);
}

// The distribution of visible normals about n.
// Source: Heitz & d'Eon 2014: max(wo . wm, 0) D(wm) / sigma(wo).
// wo, n: unit vectors, any (at wo = -n nothing is visible: 0).
// wm: unit normal.
// return: per steradian of wm; 0 for wm . n <= 0 or wo . wm <= 0.
// Accuracy: 14 eps (1 + 2 q); double 18.
VNDF_FN VNDF_REAL vndf_beckmann_pdf_wm_world(VNDF_REAL3 wo, VNDF_REAL3 n, VNDF_REAL3 wm, VNDF_REAL alpha) {
    struct vndf_impl_view_about v = vndf_impl_view_about_of(n, wo);
    VNDF_REAL3 next = vndf_impl_next(n, v.o);
    VNDF_REAL3 m = vndf_impl_normal_of(v, vndf_impl_cross(next, wm),
                                       vndf_impl_dot(next.x, next.y, next.z, wm.x, wm.y, wm.z));
    VNDF_REAL3 last = vndf_impl_next(wo, m);
    VNDF_REAL cosine = vndf_impl_dot(last.x, last.y, last.z, wm.x, wm.y, wm.z);
    return vndf_impl_beckmann_facing(vndf_beckmann_lobe_of(v.o, VNDF_MAKE2(alpha, alpha)), m, cosine);
}

// The density of the reflection of wo about a visible normal.
// Source: Heitz & d'Eon 2014, with the reflection Jacobian: D(h) / (4 sigma(wo)), h = wo + wi.
// wo, n, wi: unit vectors, any: a reflection may fall below the horizon.
// return: per steradian of wi; 0 where the half vector points to or below the horizon. A half vector that faces away from
//     wo, as rounding alone makes it, counts as one across wo.
// Accuracy: 20 eps (1 + 2 q); double 20.
//     Below alpha = 1e-2 the rounding of wi moves the density by more than that.
VNDF_FN VNDF_REAL vndf_beckmann_pdf_wi_world(VNDF_REAL3 wo, VNDF_REAL3 n, VNDF_REAL3 wi, VNDF_REAL alpha) {
    struct vndf_impl_view_about v = vndf_impl_view_about_of(n, wo);
    struct vndf_impl_half_sum sum = vndf_impl_half_sum_of(wo, wi);
    VNDF_REAL3 next = vndf_impl_next(n, v.o);
    VNDF_REAL3 h = vndf_impl_normal_of(v, vndf_impl_half_cross(next, sum), vndf_impl_half_dot(next, sum));
    struct vndf_impl_power pdf =
        vndf_impl_beckmann_along(vndf_beckmann_lobe_of(v.o, VNDF_MAKE2(alpha, alpha)), h.x, h.y, h.z,
                                 vndf_impl_half_dot(wo, sum), 0, VNDF_R(0.25));
    VNDF_REAL result = vndf_impl_finite(vndf_impl_times_power(pdf.part, pdf.exponent));
    return h.z > VNDF_R(0.0) ? result : VNDF_R(0.0);
}

VNDF_END

#endif
