// Fresnel reflectance of metals by an edge tint.
#ifndef VNDF_FRESNEL_F82_H
#define VNDF_FRESNEL_F82_H

#include "impl/fresnel.h"

VNDF_BEGIN

// Schlick's reflectance times `tint` at the angle where metals deviate from it most, cos theta = 1/7 (82 degrees).
// Source: Kutz, Hasan & Edmondson, Novel Aspects of the Adobe Standard Material, 2021, Section 2.3: s(c) - b c d^6, d = 1 - c,
//     s Schlick's with f90 = 1, b = (1 - tint) s(1/7) / (1/7 (6/7)^6). Here with factors of the differences that vanish at 1/7:
//     with e = 1 - 7 c, f0 (e^2 r(d) + tint (7^7/6^6) c d^6) + (1 - f0) d^5 (e (1 - 7/6 c) + tint (49/6) c d),
//     r the polynomial (1 - (7^7/6^6) c d^6) / e^2, whose coefficients in d are all positive.
// cos_theta: of the angle between wo and the microfacet normal; clamped to [0, 1].
// f0: reflectance at normal incidence, clamped to [0, 1].
// tint: factor at 82 degrees, clamped to [0, 1]; 1: Schlick's reflectance.
// return: in [0, 1]; 0 where the formula is negative, which it is for a black tint on a dark f0.
// Accuracy: 10 eps (1 + condition number); double 10.
VNDF_FN VNDF_REAL vndf_fresnel_f82(VNDF_REAL cos_theta, VNDF_REAL f0, VNDF_REAL tint) {
    VNDF_REAL c = vndf_impl_fresnel_cosine(cos_theta), d = VNDF_R(1.0) - c, rise = vndf_impl_fresnel_rise(c);
    VNDF_REAL e = VNDF_FMA(VNDF_R(-7.0), c, VNDF_R(1.0)), cd = c * d;
    VNDF_REAL r = VNDF_FMA(d, VNDF_R(0.36023233882030178326), VNDF_R(0.25730881344307270233));
    r = VNDF_FMA(d, r, VNDF_R(0.17644032921810699588));
    r = VNDF_FMA(d, r, VNDF_R(0.11342592592592592593));
    r = VNDF_FMA(d, r, VNDF_R(0.064814814814814814815));
    r = VNDF_FMA(d, r, VNDF_R(0.027777777777777777778));
    // What is left of f0 and of 1 - f0, and what the tint gives back.
    VNDF_REAL low = vndf_impl_reflectance(f0), high = VNDF_R(1.0) - low, given = vndf_impl_reflectance(tint);
    VNDF_REAL left_low = e * e * r,
              left_high = e * VNDF_FMA(VNDF_R(-7.0), c, VNDF_R(6.0)) * VNDF_R(0.16666666666666666667);
    VNDF_REAL part_low = VNDF_FMA(given * rise, VNDF_R(17.651384602194787380) * cd, left_low);
    VNDF_REAL part_high = rise * VNDF_FMA(given, VNDF_R(8.1666666666666666667) * cd, left_high);
    return vndf_impl_reflectance(VNDF_FMA(low, part_low, high * part_high));
}

VNDF_END

#endif
