// The diffuse reflection of Lambert: its density, and directions drawn from it.
#ifndef VNDF_BSDF_LAMBERT_H
#define VNDF_BSDF_LAMBERT_H

#include "impl/stretch.h"

VNDF_BEGIN

// The density of vndf_lambert_sample_wi, and the BSDF of a white surface times cos(theta_i).
// Source: Lambert's cosine law: wi.z / pi.
// wi: unit vector, local frame.
// return: per steradian of wi; 0 for wi.z <= 0.
// Accuracy: 1 eps; double 1.5.
VNDF_FN VNDF_REAL vndf_lambert_pdf_wi(VNDF_REAL3 wi) {
    return VNDF_1_PI * vndf_impl_max(wi.z, VNDF_R(0.0));
}

VNDF_FN struct vndf_impl_sample vndf_impl_lambert(VNDF_REAL2 u) {
    struct vndf_impl_sample o;
    VNDF_REAL u1 = vndf_impl_u(u.x), u2 = vndf_impl_u(u.y), radius = VNDF_SQRT(u2);
    o.x = radius * vndf_impl_circle_cos(u1);
    o.y = radius * vndf_impl_circle_sin(u1);
    // Made dependent on the other root, so that LLVM's SLP pass does not pack the two; the other choice is never taken.
    o.z = VNDF_SQRT(radius >= VNDF_R(0.0) ? VNDF_R(1.0) - u2 : VNDF_R(1.0));
    o.pdf = VNDF_1_PI * o.z;
    return o;
}

// A direction by the cosine law: a uniform point of the unit disk, raised to the hemisphere.
// Source: Malley's method; Pharr, Jakob & Humphreys, Physically Based Rendering, Appendix A.5.3.
// u: u.x the azimuth, u.y the squared radius.
// return: unit vector wi, wi.z > 0, with density vndf_lambert_pdf_wi(wi).
// Accuracy: 1.5 eps (1 + condition number); double 2.
VNDF_FN VNDF_REAL3 vndf_lambert_sample_wi(VNDF_REAL2 u) {
    return vndf_impl_direction(vndf_impl_lambert(u));
}

VNDF_END

#endif
