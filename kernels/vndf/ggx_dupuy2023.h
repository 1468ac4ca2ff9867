// GGX visible normals by spherical caps: the fastest exact map.
//
// Source: Dupuy & Benyoub, Sampling Visible GGX Normals with Spherical Caps, 2023, Listings 1 and 3 (the last
//     warp of Listing 1 applied to the sampled normal). Paper wi = wo here.
#ifndef VNDF_GGX_DUPUY2023_H
#define VNDF_GGX_DUPUY2023_H

#include "ggx.h"
#include "impl/lobe.h"

VNDF_BEGIN

// The normal g of a half vector h, and its density by the length that h has.
VNDF_FN struct vndf_impl_sample vndf_impl_ggx_dupuy2023(struct vndf_ggx_lobe v, VNDF_REAL2 u) {
    struct vndf_impl_sample m;
    struct vndf_impl_vector h = vndf_impl_cap_half(v, u);
    VNDF_REAL gx = v.alpha_x * h.x, gy = v.alpha_y * h.y;
    VNDF_REAL length2 = VNDF_FMA(gx, gx, VNDF_FMA(gy, gy, h.z * h.z));
    VNDF_REAL length = VNDF_SQRT(length2), rcp = VNDF_DIVIDE(VNDF_R(1.0), length);
    // Only a huge wo has none.
    int defined = length2 > VNDF_R(0.0) && length2 <= VNDF_REAL_MAX;
    m.x = defined ? gx * rcp : VNDF_R(0.0);
    m.y = defined ? gy * rcp : VNDF_R(0.0);
    m.z = defined ? h.z * rcp : VNDF_R(1.0);
    VNDF_REAL ratio = VNDF_DIVIDE(length2, VNDF_FMA(h.x, h.x, VNDF_FMA(h.y, h.y, h.z * h.z)));
    VNDF_REAL pdf = VNDF_DIVIDE(VNDF_1_PI * (ratio * length), v.axis.height * (v.alpha_x * v.alpha_y));
    // At wo = -z, where nothing is visible, the height is 0, and the normal on the horizon.
    m.pdf = defined && v.axis.height > VNDF_R(0.0) ? vndf_impl_finite(pdf) : VNDF_R(0.0);
    return m;
}

// A visible normal by the spherical cap.
// wo: unit vector, local frame, anywhere on the sphere. At wo = -z, where nothing
//     is visible: a unit vector on the horizon with density 0.
// alpha: in [1e-8, 1e3] each.
// u: u.x the azimuth of the cap, u.y its height.
// return: unit vector wm, wm.z >= 0, with density vndf_ggx_pdf_wm(wo, wm, alpha).
// Accuracy: angle to the exact map, 99th percentile: 0.75 eps (1 + condition number), 0.75 behind the surface; double 0.75, 0.75.
VNDF_FN VNDF_REAL3 vndf_ggx_sample_wm_dupuy2023(VNDF_REAL3 wo, VNDF_REAL2 alpha, VNDF_REAL2 u) {
    return vndf_impl_direction(vndf_impl_ggx_dupuy2023(vndf_ggx_lobe_of(wo, alpha), u));
}

// The same; w: its density per steradian of wm, from the sampler's own terms.
VNDF_FN VNDF_REAL4 vndf_ggx_sample_wm_dupuy2023_with_pdf(VNDF_REAL3 wo, VNDF_REAL2 alpha, VNDF_REAL2 u) {
    return vndf_impl_direction_pdf(vndf_impl_ggx_dupuy2023(vndf_ggx_lobe_of(wo, alpha), u));
}

// The same for many u and one wo and alpha.
// Accuracy: angle to the exact map, 99th percentile: 0.75 eps (1 + condition number), 0.75 behind the surface; double 0.75, 0.75.
VNDF_FN VNDF_REAL3 vndf_ggx_sample_wm_dupuy2023_lobe(struct vndf_ggx_lobe lobe, VNDF_REAL2 u) {
    return vndf_impl_direction(vndf_impl_ggx_dupuy2023(lobe, u));
}

// The same; w: its density, from the sampler's own terms.
VNDF_FN VNDF_REAL4 vndf_ggx_sample_wm_dupuy2023_lobe_with_pdf(struct vndf_ggx_lobe lobe, VNDF_REAL2 u) {
    return vndf_impl_direction_pdf(vndf_impl_ggx_dupuy2023(lobe, u));
}

VNDF_END

#endif
