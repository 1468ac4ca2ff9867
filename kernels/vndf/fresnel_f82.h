// Fresnel reflectance of metals by an edge tint.
#ifndef VNDF_FRESNEL_F82_H
#define VNDF_FRESNEL_F82_H

#include "impl/fresnel.h"

VNDF_BEGIN

// Schlick's reflectance times `tint` at the angle where metals deviate from it most, cos theta = 1/7 (82 degrees).
// Source: Kutz, Hasan & Edmondson, Novel Aspects of the Adobe Standard Material, 2021, Section 2.3: s(c) - b c (1 - c)^6,
//     s Schlick's with f90 = 1, b = (1 - tint) s(1/7) / (1/7 (6/7)^6).
// cos_theta: of the angle between wo and the microfacet normal; clamped to [0, 1].
// f0: reflectance at normal incidence, clamped to [0, 1].
// tint: factor at 82 degrees, clamped to [0, 1]; 1: Schlick's reflectance.
// return: in [0, 1]; 0 where the difference is negative, which it is for a black tint on a dark f0.
// Accuracy: 1 eps (1 + condition number); double 1.
VNDF_FN VNDF_REAL vndf_fresnel_f82(VNDF_REAL cos_theta, VNDF_REAL f0, VNDF_REAL tint) {
    VNDF_REAL cosine = vndf_impl_fresnel_cosine(cos_theta), low = vndf_impl_reflectance(f0);
    VNDF_REAL rise = vndf_impl_fresnel_rise(cosine), high = VNDF_R(1.0) - low;
    // s(1/7) = f0 + (1 - f0) (6/7)^5, over 1/7 (6/7)^6: 7 (7/6)^6 and 7 (7/6).
    VNDF_REAL b = (VNDF_R(1.0) - vndf_impl_reflectance(tint)) *
                  VNDF_FMA(VNDF_R(17.651384602194787380), low, VNDF_R(8.1666666666666666667) * high);
    VNDF_REAL dip = b * (cosine * (VNDF_R(1.0) - cosine));
    return vndf_impl_reflectance(VNDF_FMA(rise, high - dip, low));
}

VNDF_END

#endif
