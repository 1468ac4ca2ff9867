// GGX visible normals by spherical caps: the fastest exact map.
//
// Source: Dupuy & Benyoub, Sampling Visible GGX Normals with Spherical Caps, 2023, Listings 1 and 3 (the last
//     warp of Listing 1 applied to the sampled normal). Paper wi = wo here.
#ifndef VNDF_GGX_DUPUY2023_H
#define VNDF_GGX_DUPUY2023_H

#include "ggx.h"
#include "impl/caps.h"

VNDF_BEGIN

// With P = 1 + z, Q = 1 - z of the stretched view direction, the reflection o on the cap has 1 - o.z = u2 P
// and 1 + o.z = (1 - u2) P + Q, and the half vector divided by sqrt(P) is
//     (sqrt(u2 ((1 - u2) P + Q)) e(phi) + sqrt(Q) e_v, (1 - u2) sqrt(P)):
// all components stay of order 1 however small P is behind the surface.
VNDF_FN struct vndf_impl_sample vndf_impl_ggx_dupuy2023(VNDF_REAL3 wo, VNDF_REAL2 alpha, VNDF_REAL2 u) {
    struct vndf_impl_view v = vndf_impl_stretch(wo, alpha);
    struct vndf_impl_cap cap = vndf_impl_cap_of(v);
    VNDF_REAL u1 = vndf_impl_u(u.x), u2 = vndf_impl_u(u.y), rest = VNDF_R(1.0) - u2;
    VNDF_REAL square = u2 * VNDF_FMA(rest, cap.p, cap.q), sin_o = VNDF_SQRT(square);
    struct vndf_impl_cap_half h = vndf_impl_cap_half_of(
        vndf_impl_azimuth_x(v), vndf_impl_azimuth_y(v), cap.sqrt_q, cap.q, sin_o * vndf_impl_circle_cos(u1),
        sin_o * vndf_impl_circle_sin(u1), square,
        rest * vndf_impl_cap_excess(u2, rest, cap.p, cap.q, VNDF_R(2.0) * cap.z), rest * cap.sqrt_p);
    // (m . v) sqrt(P) = |h|^2 / 2 for k = 1; it is weighed against |h|.
    VNDF_REAL h2 = VNDF_FMA(h.x, h.x, VNDF_FMA(h.y, h.y, h.z * h.z)), scale = h.k * cap.sqrt_p;
    VNDF_REAL weight = cap.sqrt_p > VNDF_R(0.0) ? h2 / scale : VNDF_R(0.0);
    return vndf_impl_ggx_unstretch(h.x, h.y, h.z, v.alpha_x, v.alpha_y, weight);
}

// A visible normal by the spherical cap.
// wo: unit vector, local frame, anywhere on the sphere. At wo = -z, where nothing
//     is visible: a unit vector on the horizon with density 0.
// alpha: in [1e-8, 1e3] each.
// u: u.x the azimuth of the cap, u.y its height.
// return: unit vector wm, wm.z >= 0, with density vndf_ggx_pdf_wm(wo, wm, alpha).
// Accuracy: angle to the exact map, 99th percentile: 1 eps (1 + condition number), 1 behind the surface; double 1, 1.
VNDF_FN VNDF_REAL3 vndf_ggx_sample_wm_dupuy2023(VNDF_REAL3 wo, VNDF_REAL2 alpha, VNDF_REAL2 u) {
    return vndf_impl_direction(vndf_impl_ggx_dupuy2023(wo, alpha, u));
}

// The same; w: its density per steradian of wm, from the sampler's own terms.
VNDF_FN VNDF_REAL4 vndf_ggx_sample_wm_dupuy2023_with_pdf(VNDF_REAL3 wo, VNDF_REAL2 alpha, VNDF_REAL2 u) {
    return vndf_impl_direction_pdf(vndf_impl_ggx_dupuy2023(wo, alpha, u));
}

VNDF_END

#endif
