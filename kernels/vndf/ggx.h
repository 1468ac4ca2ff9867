// The GGX distribution (Trowbridge-Reitz) with Smith masking: its terms and its densities.
//
// Conventions of vndf.h. Every function takes vectors, never cosines: a D that sees only wm.z loses all
// digits below alpha = 1e-2. `alpha` is (alpha_x, alpha_y). Densities and terms use the
// vectors literally, without normalising them. Symbols: l = |(alpha_x w.x, alpha_y w.y)|, t = sqrt(l^2 +
// w.z^2).
#ifndef VNDF_GGX_H
#define VNDF_GGX_H

#include "ggx_lobe.h"
#include "impl/exact.h"
#include "impl/mirror.h"
#include "impl/slopes.h"
#include "impl/stretch.h"

VNDF_BEGIN

// The distribution of normals D.
// Source: Walter et al. 2007, Equation 33 (m = wm), in the anisotropic vector form of Heitz, Understanding
//     the Masking-Shadowing Function, 2014.
// wm: unit normal, local frame.
// alpha: in [1e-8, 1e3] each.
// return: per steradian of wm per unit projected area: its integral with wm.z is 1; 0 for wm.z <= 0.
// Accuracy: 8 eps; double 12.
VNDF_FN VNDF_REAL vndf_ggx_ndf(VNDF_REAL3 wm, VNDF_REAL2 alpha) {
    VNDF_REAL alpha_x = vndf_impl_alpha(alpha.x), alpha_y = vndf_impl_alpha_y(alpha.y);
    VNDF_REAL q = vndf_impl_ggx_q(wm.x, wm.y, wm.z, alpha_x, alpha_y);
    VNDF_REAL d = VNDF_DIVIDE(VNDF_1_PI, (q * alpha_x) * (q * alpha_y));
    return wm.z > VNDF_R(0.0) ? vndf_impl_finite(d) : VNDF_R(0.0);
}

// The distribution of slopes P22.
// Source: Heitz & d'Eon, Importance Sampling Microfacet-Based BSDFs with the Distribution of Visible Normals,
//     2014, supplement 1, Section 4.1, scaled by alpha.
// slope: (x, y) of the normal (-x, -y, 1), any real numbers.
// return: per unit of slope area, integral 1.
// Accuracy: 8 eps; double 11.
VNDF_FN VNDF_REAL vndf_ggx_p22(VNDF_REAL2 slope, VNDF_REAL2 alpha) {
    VNDF_REAL alpha_x = vndf_impl_alpha(alpha.x), alpha_y = vndf_impl_alpha_y(alpha.y);
    // Beyond 2^58 alpha (double: 2^506 alpha) nothing of the density is left.
    VNDF_REAL limit = VNDF_DIVIDE(VNDF_R(0.015625), VNDF_IMPL_ROOT_LEAST);
    VNDF_REAL x = vndf_impl_min(vndf_impl_abs(slope.x), alpha_x * limit),
              y = vndf_impl_min(vndf_impl_abs(slope.y), alpha_y * limit);
    VNDF_REAL q = vndf_impl_ggx_q(x, y, VNDF_R(1.0), alpha_x, alpha_y);
    VNDF_REAL qx = q * alpha_x, qy = q * alpha_y;
    int nothing = vndf_impl_beyond(vndf_impl_min(qx, qy), vndf_impl_max(qx, qy));
    return nothing ? VNDF_R(0.0) : VNDF_DIVIDE(VNDF_1_PI, qx * qy);
}

// Smith's Lambda.
// Source: Heitz 2014, Equation 72, as l^2 / (2 w.z (t + w.z)), which does not cancel for small alpha.
// w: unit vector, local frame.
// return: >= 0 above the horizon. Below it, sigma(w) / w.z - 1 = -1 - Lambda(-w), so that (1 + Lambda) w.z is
//     the projected area everywhere. The largest finite number (largest negative below) at the pole w.z = 0.
// Accuracy: 8 eps; double 12.
VNDF_FN VNDF_REAL vndf_ggx_lambda(VNDF_REAL3 w, VNDF_REAL2 alpha) {
    VNDF_REAL alpha_x = vndf_impl_alpha(alpha.x), alpha_y = vndf_impl_alpha_y(alpha.y);
    struct vndf_impl_view v = vndf_impl_view_of(alpha_x * w.x, alpha_y * w.y, w.z);
    VNDF_REAL z = vndf_impl_abs(w.z);
    VNDF_REAL pole = VNDF_DIVIDE(VNDF_R(0.5) * v.l, v.r + z) * vndf_impl_bounded_quotient(v.l, z);
    VNDF_REAL upper = vndf_impl_finite(z > VNDF_R(0.0) ? pole : VNDF_REAL_MAX);
    return w.z < VNDF_R(0.0) ? -VNDF_R(1.0) - upper : upper;
}

// Infinite only where an argument is out of the domain; NaN stays.
VNDF_FN VNDF_REAL vndf_impl_ggx_sigma(struct vndf_ggx_lobe lobe) {
    VNDF_REAL height = vndf_impl_min(lobe.axis.height, VNDF_REAL_MAX),
              weight = vndf_impl_min(lobe.axis.weight, VNDF_REAL_MAX);
    return VNDF_DIVIDE(height * VNDF_R(3.7252902984619140625e-09), weight);
}

// The projected area of the microsurface seen from w.
// Source: Dupuy & Benyoub, Sampling Visible GGX Normals with Spherical Caps, 2023, Equation 4, stretched.
// w: unit vector, local frame, anywhere on the sphere.
// return: (w.z + t) / 2, in [0, max(1, alpha)]: per unit area of the macrosurface; the
//     integral of D max(w . m, 0).
// Accuracy: 8 eps; double 11.
//     Also below the horizon.
VNDF_FN VNDF_REAL vndf_ggx_sigma(VNDF_REAL3 w, VNDF_REAL2 alpha) {
    return vndf_impl_ggx_sigma(vndf_ggx_lobe_of(w, alpha));
}

// The same of a lobe's wo.
// Accuracy: 8 eps; double 11.
VNDF_FN VNDF_REAL vndf_ggx_sigma_lobe(struct vndf_ggx_lobe lobe) {
    return vndf_impl_ggx_sigma(lobe);
}

// Infinite only where an argument is out of the domain; NaN stays.
VNDF_FN VNDF_REAL vndf_impl_ggx_g1(struct vndf_ggx_lobe lobe) {
    VNDF_REAL z = vndf_impl_min(lobe.axis.z, VNDF_R(0.25) * VNDF_REAL_MAX),
              height = vndf_impl_min(lobe.axis.height, VNDF_REAL_MAX);
    int above = lobe.wo_z > VNDF_R(0.0);
    VNDF_REAL g1 = VNDF_DIVIDE(VNDF_R(2.0) * z, above ? height : VNDF_R(1.0));
    return above ? vndf_impl_min(g1, VNDF_R(1.0)) : VNDF_R(0.0);
}

// Smith masking of one direction, for a normal that faces it.
// Source: Heitz 2014, Equation 43: w.z / sigma = 2 w.z / (w.z + t).
// w: unit vector, local frame.
// return: in [0, 1]; 0 for w.z <= 0.
// Accuracy: 7 eps; double 7.
VNDF_FN VNDF_REAL vndf_ggx_g1(VNDF_REAL3 w, VNDF_REAL2 alpha) {
    return vndf_impl_ggx_g1(vndf_ggx_lobe_of(w, alpha));
}

// The same of a lobe's wo.
// Accuracy: 7 eps; double 7.
VNDF_FN VNDF_REAL vndf_ggx_g1_lobe(struct vndf_ggx_lobe lobe) {
    return vndf_impl_ggx_g1(lobe);
}

// The length t of wi after the stretch, times 2^27.
VNDF_FN VNDF_REAL vndf_impl_ggx_stretched(struct vndf_ggx_lobe lobe, VNDF_REAL3 wi) {
    VNDF_REAL kx = lobe.alpha_x * wi.x * VNDF_R(134217728.0), ky = lobe.alpha_y * wi.y * VNDF_R(134217728.0);
    // Made dependent on wo's root, so that LLVM's SLP pass does not pack the two; the other choice is never taken.
    VNDF_REAL kz = wi.z * (lobe.axis.t < VNDF_R(0.0) ? VNDF_R(1.0) : VNDF_R(134217728.0));
    return VNDF_SQRT(VNDF_FMA(kz, kz, VNDF_FMA(kx, kx, ky * ky)));
}

// t_o i + t_i o times 2^27, with the same bits for wo and wi exchanged: a sum of two products, of which the second is written
// as a fma, so that LLVM's SLP pass does not pack them.
VNDF_FN VNDF_REAL vndf_impl_ggx_both(struct vndf_ggx_lobe lobe, VNDF_REAL3 wi) {
    VNDF_REAL t_i = vndf_impl_ggx_stretched(lobe, wi);
    return lobe.axis.t * wi.z + VNDF_FMA(t_i, lobe.wo_z, VNDF_R(0.0));
}

VNDF_FN VNDF_REAL vndf_impl_ggx_g2(struct vndf_ggx_lobe lobe, VNDF_REAL3 wi) {
    VNDF_REAL both = vndf_impl_ggx_both(lobe, wi);
    int above = lobe.wo_z > VNDF_R(0.0) && wi.z > VNDF_R(0.0), swap = lobe.wo_z > wi.z;
    VNDF_REAL low = swap ? wi.z : lobe.wo_z, high = swap ? lobe.wo_z : wi.z;
    VNDF_REAL g2 = high * VNDF_DIVIDE(low * VNDF_R(268435456.0), above ? both : VNDF_R(1.0));
    return above ? vndf_impl_share(g2) : VNDF_R(0.0);
}

// Height-correlated masking and shadowing of a reflection.
// Source: Heitz 2014, Equation 99: 1 / (1 + Lambda(wo) + Lambda(wi)) = 2 o i / (t_o i + t_i o), o = wo.z,
//     i = wi.z, the smaller cosine divided first so that nothing underflows.
// wo, wi: unit vectors, local frame.
// return: in [0, 1]; 0 unless both are above the horizon.
// Accuracy: 7 eps; double 7.
VNDF_FN VNDF_REAL vndf_ggx_g2(VNDF_REAL3 wo, VNDF_REAL3 wi, VNDF_REAL2 alpha) {
    return vndf_impl_ggx_g2(vndf_ggx_lobe_of(wo, alpha), wi);
}

// The same for many wi and one wo and alpha.
// Accuracy: 7 eps; double 7.
VNDF_FN VNDF_REAL vndf_ggx_g2_lobe(struct vndf_ggx_lobe lobe, VNDF_REAL3 wi) {
    return vndf_impl_ggx_g2(lobe, wi);
}

// Separable masking and shadowing: G1(wo) G1(wi).
// Source: Heitz 2014, Equation 98.
// wo, wi: unit vectors, local frame.
// return: in [0, 1]; 0 unless both are above the horizon.
// Accuracy: 8 eps; double 9.
VNDF_FN VNDF_REAL vndf_ggx_g2_separable(VNDF_REAL3 wo, VNDF_REAL3 wi, VNDF_REAL2 alpha) {
    // wi's factor is made dependent on wo's, so that LLVM's SLP pass does not pack the two (impl/stretch.h).
    VNDF_REAL g1 = vndf_ggx_g1(wo, alpha);
    VNDF_REAL2 alpha_i =
        VNDF_MAKE2(g1 > VNDF_R(0.0) ? alpha.x : VNDF_R(1.0), g1 > VNDF_R(0.0) ? alpha.y : VNDF_R(1.0));
    return g1 * vndf_ggx_g1(wi, alpha_i);
}

VNDF_FN VNDF_REAL vndf_impl_ggx_weight(struct vndf_ggx_lobe lobe, VNDF_REAL3 wi) {
    VNDF_REAL both = VNDF_FMA(lobe.axis.t, wi.z, vndf_impl_ggx_stretched(lobe, wi) * lobe.wo_z);
    int above = lobe.wo_z > VNDF_R(0.0) && wi.z > VNDF_R(0.0);
    VNDF_REAL weight = VNDF_DIVIDE(wi.z * lobe.axis.height, above ? both : VNDF_R(1.0));
    return above ? vndf_impl_share(weight) : VNDF_R(0.0);
}

// The weight of a visible normal's reflection: brdf cos(theta_i) / vndf_ggx_pdf_wi of a perfectly conducting mirror.
// Source: Heitz 2014, Equations 43 and 99: G2 / G1(wo) = i (o + t_o) / (t_o i + t_i o), o = wo.z, i = wi.z.
//     G2 is height-correlated; of the separable one the weight is vndf_ggx_g1(wi, alpha).
// wo, wi: unit vectors, local frame.
// return: in [0, 1]; 0 unless both are above the horizon.
// Accuracy: 8 eps; double 8.
VNDF_FN VNDF_REAL vndf_ggx_weight(VNDF_REAL3 wo, VNDF_REAL3 wi, VNDF_REAL2 alpha) {
    return vndf_impl_ggx_weight(vndf_ggx_lobe_of(wo, alpha), wi);
}

// The same for many wi and one wo and alpha.
// Accuracy: 8 eps; double 8.
VNDF_FN VNDF_REAL vndf_ggx_weight_lobe(struct vndf_ggx_lobe lobe, VNDF_REAL3 wi) {
    return vndf_impl_ggx_weight(lobe, wi);
}

// cos_om: wo . wm.
VNDF_FN VNDF_REAL vndf_impl_ggx_visible(struct vndf_ggx_lobe lobe, VNDF_REAL3 wm, VNDF_REAL cos_om) {
    VNDF_REAL q = vndf_impl_ggx_q(wm.x, wm.y, wm.z, lobe.alpha_x, lobe.alpha_y);
    VNDF_REAL twice_sigma = vndf_impl_lobe_twice_sigma(lobe);
    VNDF_REAL area =
        VNDF_DIVIDE(VNDF_2_PI, (q * lobe.alpha_x) * (q * lobe.alpha_y)) * vndf_impl_max(cos_om, VNDF_R(0.0));
    VNDF_REAL pdf = vndf_impl_bounded_quotient(area, twice_sigma);
    int visible = wm.z > VNDF_R(0.0) && cos_om > VNDF_R(0.0) && twice_sigma > VNDF_R(0.0);
    return visible ? vndf_impl_finite(pdf) : VNDF_R(0.0);
}
VNDF_FN VNDF_REAL vndf_impl_ggx_pdf_wm(struct vndf_ggx_lobe lobe, VNDF_REAL3 wm) {
    VNDF_REAL cos_om = vndf_impl_dot(lobe.wo_x, lobe.wo_y, lobe.wo_z, wm.x, wm.y, wm.z);
    return vndf_impl_ggx_visible(lobe, wm, cos_om);
}

// The distribution of visible normals: the density of every vndf_ggx_sample_wm_* but walter2007.
// Source: Dupuy & Benyoub 2023, Equation 1, as max(wo . wm, 0) D(wm) / sigma(wo).
// wo: unit vector, local frame, anywhere on the sphere (at -z nothing is visible: 0).
// wm: unit normal, local frame.
// return: per steradian of wm; 0 for wm.z <= 0 or wo . wm <= 0.
// Accuracy: 14 eps; double 13.
//     Also where wo . wm or 1 + wo.z nearly vanish.
VNDF_FN VNDF_REAL vndf_ggx_pdf_wm(VNDF_REAL3 wo, VNDF_REAL3 wm, VNDF_REAL2 alpha) {
    return vndf_impl_ggx_pdf_wm(vndf_ggx_lobe_of(wo, alpha), wm);
}

// The same for many wm and one wo and alpha.
// Accuracy: 14 eps; double 13.
VNDF_FN VNDF_REAL vndf_ggx_pdf_wm_lobe(struct vndf_ggx_lobe lobe, VNDF_REAL3 wm) {
    return vndf_impl_ggx_pdf_wm(lobe, wm);
}

VNDF_FN VNDF_REAL vndf_impl_ggx_pdf_wi(struct vndf_ggx_lobe lobe, VNDF_REAL3 wi) {
    struct vndf_impl_half h =
        vndf_impl_half_of(VNDF_MAKE3(lobe.wo_x, lobe.wo_y, lobe.wo_z), wi, lobe.alpha_x, lobe.alpha_y);
    return vndf_impl_ggx_reflection_pdf(h, vndf_impl_lobe_twice_sigma(lobe), lobe.alpha_x, lobe.alpha_y);
}

// The density of the reflection of wo about a visible normal.
// Source: Dupuy & Benyoub 2023, Equation 20, with 1 / sigma for G1 / cos: D(h) / (4 sigma(wo)), h = wo + wi.
// wo: unit vector, local frame, anywhere on the sphere.
// wi: unit vector, local frame, anywhere on the sphere: a reflection may fall below the horizon.
// return: per steradian of wi; 0 where the half vector points to or below the horizon.
// Accuracy: 16 eps; double 20.
//     Below alpha = 1e-2 the rounding of wi moves the density by more than that: use a sampler's _with_pdf form
//     there.
VNDF_FN VNDF_REAL vndf_ggx_pdf_wi(VNDF_REAL3 wo, VNDF_REAL3 wi, VNDF_REAL2 alpha) {
    return vndf_impl_ggx_pdf_wi(vndf_ggx_lobe_of(wo, alpha), wi);
}

// The same for many wi and one wo and alpha.
// Accuracy: 16 eps; double 20.
VNDF_FN VNDF_REAL vndf_ggx_pdf_wi_lobe(struct vndf_ggx_lobe lobe, VNDF_REAL3 wi) {
    return vndf_impl_ggx_pdf_wi(lobe, wi);
}

// D of the half vector of wo and wi by one quotient: s (a s) / pi with a = alpha_x alpha_y and
// s = a |h|^2 / ((alpha_y h.x)^2 + (alpha_x h.y)^2 + (a h.z)^2). D takes s squared, so the products carry their rounding
// errors along. 0 where h points to or below the horizon.
VNDF_FN VNDF_REAL vndf_impl_ggx_half_ndf(struct vndf_ggx_lobe lobe, VNDF_REAL3 wi) {
    VNDF_REAL x = lobe.wo_x + wi.x, y = lobe.wo_y + wi.y, z = lobe.wo_z + wi.z;
    VNDF_REAL largest = vndf_impl_max(vndf_impl_max(vndf_impl_abs(x), vndf_impl_abs(y)), vndf_impl_abs(z));
    VNDF_REAL scale = vndf_impl_scale(largest), a = lobe.alpha_x * lobe.alpha_y;
    x *= scale;
    y *= scale;
    z *= scale;
    // The products 2^13 times larger, so that their errors are not lost as subnormal numbers.
    VNDF_REAL up = VNDF_R(8192.0), kx = up * lobe.alpha_x, ky = up * lobe.alpha_y;
    VNDF_REAL px = ky * x, py = kx * y, pz = up * a * z;
    VNDF_REAL low = VNDF_FMA(px, VNDF_FMA(ky, x, -px), py * VNDF_FMA(kx, y, -py));
    VNDF_REAL q = VNDF_FMA(px, px, VNDF_FMA(py, py, VNDF_FMA(pz, pz, low + low)));
    int above = z > VNDF_R(0.0) && q > VNDF_R(0.0);
    VNDF_REAL s = VNDF_DIVIDE(up * up * a * VNDF_FMA(x, x, VNDF_FMA(y, y, z * z)), above ? q : VNDF_R(1.0));
    return above ? VNDF_1_PI * s * (a * s) : VNDF_R(0.0);
}

// d / (2 n) for a direction of the length t, the height z and the squared tangential part l2 after the stretch, all times a
// power of 2^27; n is twice the projected area, t + z or l^2 / (t + |z|). 0 where nothing is visible.
VNDF_FN VNDF_REAL vndf_impl_ggx_area_pdf(VNDF_REAL t, VNDF_REAL z, VNDF_REAL l2, VNDF_REAL d) {
    VNDF_REAL sum = t + vndf_impl_abs(z), share = VNDF_R(67108864.0) * d;
    int front = z >= VNDF_R(0.0);
    VNDF_REAL area = front ? sum : l2;
    VNDF_REAL pdf = vndf_impl_bounded_quotient(front ? share : share * sum, area);
    return vndf_impl_min(d, area) > VNDF_R(0.0) ? vndf_impl_finite(pdf) : VNDF_R(0.0);
}
VNDF_FN VNDF_REAL vndf_impl_ggx_lobe_pdf(struct vndf_ggx_lobe lobe, VNDF_REAL d) {
    return vndf_impl_ggx_area_pdf(lobe.axis.t, lobe.wo_z * VNDF_R(134217728.0), lobe.axis.l2, d);
}

VNDF_FN VNDF_REAL2 vndf_impl_ggx_pdf_wi_both(struct vndf_ggx_lobe lobe, VNDF_REAL3 wi) {
    VNDF_REAL d = vndf_impl_ggx_half_ndf(lobe, wi), pdf = vndf_impl_ggx_lobe_pdf(lobe, d);
    VNDF_REAL kx = lobe.alpha_x * wi.x * VNDF_R(134217728.0), ky = lobe.alpha_y * wi.y * VNDF_R(134217728.0);
    // Made dependent on wo's density, which is never negative, so that LLVM's SLP pass does not pack the two.
    VNDF_REAL kz = wi.z * (pdf >= VNDF_R(0.0) ? VNDF_R(134217728.0) : VNDF_R(1.0));
    VNDF_REAL l2 = VNDF_FMA(kx, kx, ky * ky);
    return VNDF_MAKE2(pdf, vndf_impl_ggx_area_pdf(VNDF_SQRT(VNDF_FMA(kz, kz, l2)), kz, l2, d));
}

// The densities of a reflection both ways, as bidirectional methods need them: that of wi seen from wo, and that of wo
// seen from wi.
// Source: Dupuy & Benyoub 2023, Equation 20, with 1 / sigma for G1 / cos: D(h) / (4 sigma(wo)) and
//     D(h) / (4 sigma(wi)), h = wo + wi.
// wo, wi: unit vectors, local frame, anywhere on the sphere.
// return: (vndf_ggx_pdf_wi(wo, wi), vndf_ggx_pdf_wi(wi, wo)) to rounding, per steradian of wi and of wo; with wo and wi
//     exchanged the same two numbers exchanged, bit for bit.
// Accuracy: 25 eps; double 21.
VNDF_FN VNDF_REAL2 vndf_ggx_pdf_wi_both(VNDF_REAL3 wo, VNDF_REAL3 wi, VNDF_REAL2 alpha) {
    return vndf_impl_ggx_pdf_wi_both(vndf_ggx_lobe_of(wo, alpha), wi);
}

// The same for many wi and one wo and alpha.
// Accuracy: 25 eps; double 21.
VNDF_FN VNDF_REAL2 vndf_ggx_pdf_wi_both_lobe(struct vndf_ggx_lobe lobe, VNDF_REAL3 wi) {
    return vndf_impl_ggx_pdf_wi_both(lobe, wi);
}

VNDF_FN VNDF_REAL2 vndf_impl_ggx_eval_pdf(struct vndf_ggx_lobe lobe, VNDF_REAL3 wi) {
    VNDF_REAL d = vndf_impl_ggx_half_ndf(lobe, wi), both = vndf_impl_ggx_both(lobe, wi);
    int above = lobe.wo_z > VNDF_R(0.0) && wi.z > VNDF_R(0.0);
    VNDF_REAL value = vndf_impl_bounded_quotient(VNDF_R(67108864.0) * d, above ? both : VNDF_R(1.0));
    value = above ? vndf_impl_finite(value) : VNDF_R(0.0);
    // Made dependent on the value, which is never negative, so that LLVM's SLP pass does not pack the two.
    return VNDF_MAKE2(value, vndf_impl_ggx_lobe_pdf(lobe, value >= VNDF_R(0.0) ? d : VNDF_R(0.0)));
}

// A reflection's value and density from common terms.
// Source: Heitz 2014: the value is D(h) G2 / (4 o i) = D(h) / (2 (t_o i + t_i o)), o = wo.z, i = wi.z, h = wo + wi; the
//     density is that of vndf_ggx_pdf_wi, D(h) / (4 sigma(wo)).
// wo, wi: unit vectors, local frame, anywhere on the sphere.
// return: (value, density). The value is that of the BRDF, without the cosine of wi and without a Fresnel factor, per
//     steradian; 0 unless both are above the horizon; the same bits for wo and wi exchanged. The density is per steradian
//     of wi. value * wi.z / density is vndf_ggx_weight.
// Accuracy: 25 eps; double 21.
//     Below alpha = 1e-2 the rounding of wi moves both by more than that.
VNDF_FN VNDF_REAL2 vndf_ggx_eval_pdf(VNDF_REAL3 wo, VNDF_REAL3 wi, VNDF_REAL2 alpha) {
    return vndf_impl_ggx_eval_pdf(vndf_ggx_lobe_of(wo, alpha), wi);
}

// The same for many wi and one wo and alpha.
// Accuracy: 25 eps; double 21.
VNDF_FN VNDF_REAL2 vndf_ggx_eval_pdf_lobe(struct vndf_ggx_lobe lobe, VNDF_REAL3 wi) {
    return vndf_impl_ggx_eval_pdf(lobe, wi);
}

// The density of the plain NDF sampler: D(wm) wm.z.
// Source: Walter et al. 2007, Equation 24.
// wm: unit normal, local frame.
// return: per steradian of wm; 0 for wm.z <= 0.
// Accuracy: 11 eps; double 12.
VNDF_FN VNDF_REAL vndf_ggx_pdf_wm_walter2007(VNDF_REAL3 wm, VNDF_REAL2 alpha) {
    return vndf_impl_finite(vndf_ggx_ndf(wm, alpha) * wm.z);
}

// --- Visible slopes at alpha = 1, in the plane of incidence ---

// The marginal density of visible slopes in the plane of incidence, alpha = 1.
// Source: Heitz & d'Eon 2014, supplement 1, Section 4.2.
// cos_theta: of the view direction, in [-1, 1] (at -1 nothing is visible: 0).
// x: slope of the normal (-x, ., 1), positive away from the view direction.
// return: per unit of slope, integral 1 over x < cot(theta); 0 beyond.
// Accuracy: 7 eps (1 + condition number); double 7.
VNDF_FN VNDF_REAL vndf_ggx_slope_pdf(VNDF_REAL cos_theta, VNDF_REAL x) {
    // Nothing is left where the square of x would overflow.
    int beyond = vndf_impl_beyond(vndf_impl_abs(x), vndf_impl_abs(x));
    VNDF_REAL slope = beyond ? VNDF_R(0.0) : x, square = VNDF_FMA(slope, slope, VNDF_R(1.0));
    VNDF_REAL p = VNDF_R(1.0) + cos_theta, visible = vndf_impl_visible_cosine(cos_theta, slope);
    VNDF_REAL pdf = VNDF_DIVIDE(VNDF_DIVIDE(VNDF_DIVIDE(visible, VNDF_SQRT(square)), square),
                                p > VNDF_R(0.0) ? p : VNDF_R(1.0));
    return visible > VNDF_R(0.0) && p > VNDF_R(0.0) && !beyond ? vndf_impl_finite(pdf) : VNDF_R(0.0);
}

// Its cumulative distribution.
// Source: Heitz & d'Eon 2014, supplement 1, Section 4.2: (sin(theta + psi) + cos theta) / (1 + cos theta),
//     x = tan psi, written so that the tail x -> -infinity keeps its digits.
// cos_theta, x: as for vndf_ggx_slope_pdf.
// return: in [0, 1]; 1 for x >= cot(theta), and for cos_theta = -1, where nothing is visible.
// Accuracy: 7 eps (1 + condition number); double 7.
VNDF_FN VNDF_REAL vndf_ggx_slope_cdf(VNDF_REAL cos_theta, VNDF_REAL x) {
    VNDF_REAL sine = vndf_impl_sin_from_cos(cos_theta), p = VNDF_R(1.0) + cos_theta;
    // Where the square of x would overflow, its root is |x|.
    VNDF_REAL size = vndf_impl_min(vndf_impl_abs(x), VNDF_R(0.25) * VNDF_REAL_MAX);
    VNDF_REAL root = vndf_impl_beyond(size, size) ? size : VNDF_SQRT(VNDF_FMA(size, size, VNDF_R(1.0)));
    VNDF_REAL sum = root + size, weight = x < VNDF_R(0.0) ? VNDF_DIVIDE(VNDF_R(1.0), sum) : sum;
    VNDF_REAL cdf =
        VNDF_DIVIDE(VNDF_DIVIDE(VNDF_FMA(cos_theta, weight, sine), root), p > VNDF_R(0.0) ? p : VNDF_R(1.0));
    int inside = vndf_impl_visible_cosine(cos_theta, x) > VNDF_R(0.0) && cdf < VNDF_R(1.0);
    return inside ? vndf_impl_max(cdf, VNDF_R(0.0)) : VNDF_R(1.0);
}

// The inverse of vndf_ggx_slope_cdf.
// Source: Heitz & d'Eon 2014, supplement 1, Section 4.2.
// cos_theta: in [-1, 1].
// u1: probability.
// return: the slope x < cot(theta); minus the largest finite number at cos_theta = -1.
// Accuracy: 5 eps (1 + condition number); double 5.
VNDF_FN VNDF_REAL vndf_ggx_slope_cdf_inverse(VNDF_REAL cos_theta, VNDF_REAL u1) {
    VNDF_REAL sine = vndf_impl_sin_from_cos(cos_theta);
    VNDF_REAL p = VNDF_R(1.0) + cos_theta, q = VNDF_R(1.0) - cos_theta;
    struct vndf_impl_slope slope = vndf_impl_ggx_slope(
        cos_theta, sine, p, q, VNDF_SQRT(p > VNDF_R(0.0) ? p : VNDF_R(0.0)), vndf_impl_u(u1));
    VNDF_REAL x = VNDF_DIVIDE(slope.sin_psi, slope.cos_psi > VNDF_R(0.0) ? slope.cos_psi : VNDF_R(1.0));
    return p > VNDF_R(0.0) && x > -VNDF_REAL_MAX ? vndf_impl_finite(x) : -VNDF_REAL_MAX;
}

VNDF_END

#endif
