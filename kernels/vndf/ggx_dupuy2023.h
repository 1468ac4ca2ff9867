// GGX visible normals by spherical caps: the fastest exact map.
//
// Source: Dupuy & Benyoub, Sampling Visible GGX Normals with Spherical Caps, 2023, Listings 1 and 3 (the last
//     warp of Listing 1 applied to the sampled normal). Paper wi = wo here.
#ifndef VNDF_GGX_DUPUY2023_H
#define VNDF_GGX_DUPUY2023_H

#include "ggx.h"
#include "impl/lobe.h"

VNDF_BEGIN

VNDF_FN struct vndf_impl_sample vndf_impl_ggx_dupuy2023(struct vndf_ggx_lobe lobe, VNDF_REAL2 u) {
    return vndf_impl_cap_normal(lobe, vndf_impl_cap_half(lobe, u));
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
