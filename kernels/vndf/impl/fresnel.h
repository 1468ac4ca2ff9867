// What the Fresnel reflectances share.
#ifndef VNDF_IMPL_FRESNEL_H
#define VNDF_IMPL_FRESNEL_H

#include "range.h"

VNDF_BEGIN

// A cosine that counts as one of [0, 1].
VNDF_FN VNDF_REAL vndf_impl_fresnel_cosine(VNDF_REAL cos_theta) {
    return vndf_impl_share(vndf_impl_max(cos_theta, VNDF_R(0.0)));
}

// (1 - c)^5, Schlick's rise towards grazing incidence.
VNDF_FN VNDF_REAL vndf_impl_fresnel_rise(VNDF_REAL cosine) {
    VNDF_REAL rest = VNDF_R(1.0) - cosine, square = rest * rest;
    return square * square * rest;
}

// A reflectance within [0, 1]; NaN counts as 0.
VNDF_FN VNDF_REAL vndf_impl_reflectance(VNDF_REAL f) {
    return vndf_impl_share(f > VNDF_R(0.0) ? f : VNDF_R(0.0));
}

VNDF_END

#endif
