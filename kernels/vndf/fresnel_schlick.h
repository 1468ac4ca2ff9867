// Fresnel reflectance by Schlick's approximation.
#ifndef VNDF_FRESNEL_SCHLICK_H
#define VNDF_FRESNEL_SCHLICK_H

#include "impl/range.h"

VNDF_BEGIN

// (1 - cos theta)^5, for a cosine that counts as one of [0, 1].
VNDF_FN VNDF_REAL vndf_impl_schlick_rise(VNDF_REAL cos_theta) {
    VNDF_REAL rest = VNDF_R(1.0) - vndf_impl_share(vndf_impl_max(cos_theta, VNDF_R(0.0))), square = rest * rest;
    return square * square * rest;
}

// A reflectance within [0, 1]; NaN counts as 0.
VNDF_FN VNDF_REAL vndf_impl_reflectance(VNDF_REAL f) {
    return vndf_impl_share(f > VNDF_R(0.0) ? f : VNDF_R(0.0));
}

// The reflectance between normal and grazing incidence.
// Source: Schlick, An Inexpensive BRDF Model for Physically-based Rendering, 1994, Equation 15: f0 + (f90 - f0)
//     (1 - cos theta)^5, with the reflectance f90 at grazing incidence for his 1.
// cos_theta: of the angle between wo and the microfacet normal; clamped to [0, 1].
// f0, f90: reflectances at normal and at grazing incidence, clamped to [0, 1].
// return: in [0, 1].
// Accuracy: 1 eps (1 + condition number); double 1.
VNDF_FN VNDF_REAL vndf_fresnel_schlick(VNDF_REAL cos_theta, VNDF_REAL f0, VNDF_REAL f90) {
    VNDF_REAL low = vndf_impl_reflectance(f0), high = vndf_impl_reflectance(f90);
    return VNDF_FMA(vndf_impl_schlick_rise(cos_theta), high - low, low);
}

VNDF_END

#endif
