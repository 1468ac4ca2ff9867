// Fresnel reflectance by Schlick's approximation.
#ifndef VNDF_FRESNEL_SCHLICK_H
#define VNDF_FRESNEL_SCHLICK_H

#include "impl/fresnel.h"

VNDF_BEGIN

// The reflectance between normal and grazing incidence.
// Source: Schlick, An Inexpensive BRDF Model for Physically-based Rendering, 1994, Equation 15: f0 + (f90 - f0)
//     (1 - cos theta)^5, with the reflectance f90 at grazing incidence for his 1.
// cos_theta: of the angle between wo and the microfacet normal; clamped to [0, 1].
// f0, f90: reflectances at normal and at grazing incidence, clamped to [0, 1].
// return: in [0, 1].
// Accuracy: 1 eps (1 + condition number); double 1.
VNDF_FN VNDF_REAL vndf_fresnel_schlick(VNDF_REAL cos_theta, VNDF_REAL f0, VNDF_REAL f90) {
    VNDF_REAL low = vndf_impl_reflectance(f0), high = vndf_impl_reflectance(f90);
    return VNDF_FMA(vndf_impl_fresnel_rise(vndf_impl_fresnel_cosine(cos_theta)), high - low, low);
}

VNDF_END

#endif
