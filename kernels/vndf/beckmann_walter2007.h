// Plain Beckmann normals, visible or not: the baseline.
//
// Source: Walter et al., Microfacet Models for Refraction through Rough Surfaces, 2007, Equations 28 and 29, stretched to
//     two alphas.
#ifndef VNDF_BECKMANN_WALTER2007_H
#define VNDF_BECKMANN_WALTER2007_H

#include "beckmann.h"
#include "impl/beckmann_slopes.h"

VNDF_BEGIN

// tan(theta) = sqrt(-log(1 - u1)) before the stretch; e^(-tan(theta)^2) is 1 - u1.
VNDF_FN struct vndf_impl_sample vndf_impl_beckmann_walter2007(VNDF_REAL2 alpha, VNDF_REAL2 u) {
    VNDF_REAL u1 = vndf_impl_u(u.x), u2 = vndf_impl_u(u.y);
    // log(1 - u1) with the rounding error of the difference.
    VNDF_REAL rest = VNDF_R(1.0) - u1;
    VNDF_REAL logarithm = vndf_impl_log(rest) + VNDF_DIVIDE((VNDF_R(1.0) - rest) - u1, rest);
    VNDF_REAL radius = VNDF_SQRT(-logarithm);
    // y waits for x, which is finite: side by side they would be packed (impl/stretch.h).
    VNDF_REAL x = radius * vndf_impl_circle_cos(u2);
    VNDF_REAL y = (x <= VNDF_REAL_MAX ? radius : VNDF_R(0.0)) * vndf_impl_circle_sin(u2);
    return vndf_impl_beckmann_unstretch(VNDF_R(1.0), VNDF_R(0.0), x, y, vndf_impl_alpha(alpha.x),
                                        vndf_impl_alpha_y(alpha.y), VNDF_1_PI * rest);
}

// A normal with density proportional to D(wm) wm.z, whatever the view direction.
// alpha: in [1e-8, 1e3] each.
// u: u.x the polar angle, u.y the azimuth before the stretch.
// return: unit vector wm, wm.z > 0, with density vndf_beckmann_pdf_wm_walter2007(wm, alpha).
// Accuracy: angle to the exact map, 99th percentile: 1 eps (1 + condition number); double 1.
VNDF_FN VNDF_REAL3 vndf_beckmann_sample_wm_walter2007(VNDF_REAL2 alpha, VNDF_REAL2 u) {
    return vndf_impl_direction(vndf_impl_beckmann_walter2007(alpha, u));
}

// The same; w: its density per steradian of wm, from the sampler's own terms.
VNDF_FN VNDF_REAL4 vndf_beckmann_sample_wm_walter2007_with_pdf(VNDF_REAL2 alpha, VNDF_REAL2 u) {
    return vndf_impl_direction_pdf(vndf_impl_beckmann_walter2007(alpha, u));
}

VNDF_END

#endif
