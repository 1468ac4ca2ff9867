// Visible slopes of GGX at alpha = 1, in the plane of incidence.
#ifndef VNDF_IMPL_SLOPES_H
#define VNDF_IMPL_SLOPES_H

#include "exact.h"

VNDF_BEGIN

// sin and cos of the angle psi whose slope x = tan psi has the visible cumulative probability u1.
// Source: Heitz & d'Eon 2014, supplement 1, Section 4.2. The distribution is affine in s = sin(theta + psi):
//     s = u1 (1 + c) - c with c = cos theta, and cos(theta + psi) = sqrt((1 - s)(1 + s)) with both factors
//     formed without a difference; no root has to be chosen, and every theta is valid.
struct vndf_impl_slope {
    VNDF_REAL sin_psi, cos_psi;
    VNDF_REAL visible;  // cos(theta + psi) / sqrt(1 + c)
};
VNDF_FN struct vndf_impl_slope vndf_impl_ggx_slope(VNDF_REAL c, VNDF_REAL sine, VNDF_REAL p, VNDF_REAL q,
                                                   VNDF_REAL sqrt_p, VNDF_REAL u1) {
    struct vndf_impl_slope slope;
    VNDF_REAL up = u1 * p, s = up - c;
    slope.visible = VNDF_SQRT((VNDF_R(1.0) - u1) * (up + q));
    VNDF_REAL cosine = sqrt_p * slope.visible;
    slope.sin_psi = VNDF_FMA(s, c, -cosine * sine);
    // cos psi = cosine c + s sine; its product with the conjugate is (c - s)(c + s), for opposite signs.
    VNDF_REAL direct = VNDF_FMA(cosine, c, s * sine);
    // The denominator is 0 where nothing is visible: a normal on the horizon.
    VNDF_REAL other = VNDF_FMA(cosine, c, -s * sine);
    VNDF_REAL conjugate =
        VNDF_DIVIDE(up * (VNDF_R(2.0) * c - up), other == VNDF_R(0.0) ? VNDF_R(1.0) : other);
    int opposite = (s < VNDF_R(0.0)) != (c < VNDF_R(0.0));
    slope.cos_psi = opposite ? conjugate : direct;
    return slope;
}

VNDF_END

#endif
