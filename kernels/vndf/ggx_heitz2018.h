// GGX visible normals by the cross section of the hemisphere.
//
// Source: Heitz, Sampling the GGX Distribution of Visible Normals, 2018, as restated in Dupuy & Benyoub,
//     Sampling Visible GGX Normals with Spherical Caps, 2023, Listing 2. Paper wi = wo here; s = P / 2.
#ifndef VNDF_GGX_HEITZ2018_H
#define VNDF_GGX_HEITZ2018_H

#include "ggx.h"
#include "impl/lobe.h"

VNDF_BEGIN

// The point (t1, b) of the unit disc becomes (t1, t) of the cross section, t = (Q R + P b) / 2 with
// R = sqrt(1 - t1^2), and the normal t1 w1 + t w2 + t_i v. Where the listing subtracts: R - |b| is
// (1 - u2) / (R + |b|); t for b near -R is P (R + b) / 2 - z R; t_i^2 factors into P (R - b) (P (R + b) + 2 Q
// R) / 4; and the height t S + t_i z is, for t and z of opposite signs, its product with the conjugate t S -
// t_i z, which factors too, over that conjugate.
VNDF_FN struct vndf_impl_sample vndf_impl_ggx_heitz2018(struct vndf_ggx_lobe v, VNDF_REAL2 u) {
    struct vndf_impl_polar cap = vndf_impl_polar_of(v);
    VNDF_REAL u1 = vndf_impl_u(u.x), u2 = vndf_impl_u(u.y);
    VNDF_REAL radius = VNDF_SQRT(u2), t1 = radius * vndf_impl_circle_cos(u1);
    VNDF_REAL b = radius * vndf_impl_circle_sin(u1), abs_b = vndf_impl_abs(b);
    VNDF_REAL big_r = VNDF_SQRT(VNDF_FMA(b, b, VNDF_R(1.0) - u2));
    VNDF_REAL sum = big_r + abs_b, difference = VNDF_DIVIDE(VNDF_R(1.0) - u2, sum);
    int lower = b < VNDF_R(0.0);
    VNDF_REAL plus = lower ? difference : sum, minus = lower ? sum : difference;  // R + b, R - b
    VNDF_REAL z = cap.z, sine = cap.sine;
    VNDF_REAL half_p_plus = VNDF_R(0.5) * cap.p * plus, q_r = cap.q * big_r;
    VNDF_REAL t =
        b < VNDF_R(-0.5) * big_r ? VNDF_FMA(-z, big_r, half_p_plus) : VNDF_R(0.5) * VNDF_FMA(cap.p, b, q_r);
    // t_i / sqrt(P), so that it stays of order 1 behind the surface.
    VNDF_REAL root = VNDF_SQRT(minus * VNDF_R(0.5) * (half_p_plus + q_r));
    VNDF_REAL t_i = cap.sqrt_p * root;
    // The denominator is 0 where nothing is visible: a normal on the horizon.
    VNDF_REAL other = VNDF_FMA(t, sine, -t_i * z);
    // Towards the horizon Q and P differ by little, and their terms cancel: there t - z R, of two equal signs.
    int level = vndf_impl_abs(z) < VNDF_R(0.0625);
    VNDF_REAL factor = level ? VNDF_FMA(-z, big_r, t) : VNDF_FMA(VNDF_R(-0.5) * cap.p, minus, q_r);
    VNDF_REAL conjugate = VNDF_DIVIDE(half_p_plus * factor, other == VNDF_R(0.0) ? VNDF_R(1.0) : other);
    int opposite = (t < VNDF_R(0.0)) != (z < VNDF_R(0.0));
    VNDF_REAL hz = opposite ? conjugate : VNDF_FMA(t, sine, t_i * z);
    VNDF_REAL along = VNDF_FMA(t_i, sine, -t * z);
    // w1 = (1, 0, 0) where the stretched view direction has no azimuth.
    int vertical = v.wo_x == VNDF_R(0.0) && v.wo_y == VNDF_R(0.0);
    VNDF_REAL ex = vertical ? VNDF_R(0.0) : cap.x, ey = vertical ? VNDF_R(-1.0) : cap.y;
    return vndf_impl_ggx_unstretch(
        VNDF_FMA(along, ex, -t1 * ey), VNDF_FMA(along, ey, t1 * ex), hz, v.alpha_x, v.alpha_y,
        cap.sqrt_p > VNDF_R(0.0) ? VNDF_DIVIDE(VNDF_R(2.0) * root, cap.sqrt_p) : VNDF_R(0.0));
}

// A visible normal by the cross section.
// wo: unit vector, local frame, anywhere on the sphere. At wo = -z, where nothing
//     is visible: a unit vector on the horizon with density 0.
// alpha: in [1e-8, 1e3] each.
// u: u.x the azimuth of the disc, u.y its squared radius.
// return: unit vector wm, wm.z >= 0, with density vndf_ggx_pdf_wm(wo, wm, alpha).
// Accuracy: angle to the exact map, 99th percentile: 1.25 eps (1 + condition number), 1.5 behind the surface; double 1.25, 1.5.
VNDF_FN VNDF_REAL3 vndf_ggx_sample_wm_heitz2018(VNDF_REAL3 wo, VNDF_REAL2 alpha, VNDF_REAL2 u) {
    return vndf_impl_direction(vndf_impl_ggx_heitz2018(vndf_ggx_lobe_of(wo, alpha), u));
}

// The same; w: its density per steradian of wm, from the sampler's own terms.
VNDF_FN VNDF_REAL4 vndf_ggx_sample_wm_heitz2018_with_pdf(VNDF_REAL3 wo, VNDF_REAL2 alpha, VNDF_REAL2 u) {
    return vndf_impl_direction_pdf(vndf_impl_ggx_heitz2018(vndf_ggx_lobe_of(wo, alpha), u));
}

// The same for many u and one wo and alpha.
// Accuracy: angle to the exact map, 99th percentile: 1.25 eps (1 + condition number), 1.5 behind the surface; double 1.25, 1.5.
VNDF_FN VNDF_REAL3 vndf_ggx_sample_wm_heitz2018_lobe(struct vndf_ggx_lobe lobe, VNDF_REAL2 u) {
    return vndf_impl_direction(vndf_impl_ggx_heitz2018(lobe, u));
}

// The same; w: its density, from the sampler's own terms.
VNDF_FN VNDF_REAL4 vndf_ggx_sample_wm_heitz2018_lobe_with_pdf(struct vndf_ggx_lobe lobe, VNDF_REAL2 u) {
    return vndf_impl_direction_pdf(vndf_impl_ggx_heitz2018(lobe, u));
}

VNDF_END

#endif
