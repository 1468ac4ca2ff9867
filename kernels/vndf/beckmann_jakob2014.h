// Beckmann visible normals by inversion of the distribution of visible slopes, for every view direction.
//
// Source: Jakob, An Improved Visible Normal Sampling Routine for the Beckmann Distribution, 2014: one monotone map of u1,
//     where the 2014 supplement folds its range twice. His equation in b = erf x loses the slopes of u1 < 3e-8; here it is
//     solved in the slope itself.
#ifndef VNDF_BECKMANN_JAKOB2014_H
#define VNDF_BECKMANN_JAKOB2014_H

#include "beckmann.h"
#include "impl/beckmann_lobe.h"

VNDF_BEGIN

VNDF_FN struct vndf_impl_sample vndf_impl_beckmann_jakob2014(struct vndf_beckmann_lobe lobe, VNDF_REAL2 u) {
    // The slope across is erfinv(2 u2 - 1); the normal leans against it. First, since nothing waits for it: the rest is one chain.
    VNDF_REAL across = vndf_impl_erfcinv(VNDF_R(2.0) * vndf_impl_u(u.y));
    return vndf_impl_beckmann_normal(lobe, vndf_impl_slope_of_mass(lobe.slopes, vndf_impl_u(u.x)), across);
}

// A visible normal by inversion of the visible slope distribution.
// wo: unit vector, local frame, anywhere on the sphere. At wo = -z, where nothing is
//     visible: a unit vector on the horizon with density 0.
// alpha: in [1e-8, 1e3] each.
// u: u.x the slope in the plane of incidence, from the side of wo (u.x = 0) to the edge of the visible; u.y the slope
//     across.
// return: unit vector wm, wm.z >= 0, with density vndf_beckmann_pdf_wm(wo, wm, alpha).
// Accuracy: angle to the exact map, 99th percentile: 1 eps (1 + condition number), 1.2 behind the surface; double 1, 1.2.
VNDF_FN VNDF_REAL3 vndf_beckmann_sample_wm_jakob2014(VNDF_REAL3 wo, VNDF_REAL2 alpha, VNDF_REAL2 u) {
    return vndf_impl_direction(vndf_impl_beckmann_jakob2014(vndf_beckmann_lobe_of(wo, alpha), u));
}

// The same; w: its density per steradian of wm, from the sampler's own terms.
VNDF_FN VNDF_REAL4 vndf_beckmann_sample_wm_jakob2014_with_pdf(VNDF_REAL3 wo, VNDF_REAL2 alpha, VNDF_REAL2 u) {
    return vndf_impl_direction_pdf(vndf_impl_beckmann_jakob2014(vndf_beckmann_lobe_of(wo, alpha), u));
}

// The same for many u and one wo and alpha.
// Accuracy: angle to the exact map, 99th percentile: 1 eps (1 + condition number), 1.2 behind the surface; double 1, 1.2.
VNDF_FN VNDF_REAL3 vndf_beckmann_sample_wm_jakob2014_lobe(struct vndf_beckmann_lobe lobe, VNDF_REAL2 u) {
    return vndf_impl_direction(vndf_impl_beckmann_jakob2014(lobe, u));
}

// The same; w: its density, from the sampler's own terms.
VNDF_FN VNDF_REAL4 vndf_beckmann_sample_wm_jakob2014_lobe_with_pdf(struct vndf_beckmann_lobe lobe,
                                                                   VNDF_REAL2 u) {
    return vndf_impl_direction_pdf(vndf_impl_beckmann_jakob2014(lobe, u));
}

VNDF_END

#endif
