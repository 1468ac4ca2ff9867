// What the terms and densities of the Beckmann distribution share. Symbols: those of beckmann.h.
#ifndef VNDF_IMPL_BECKMANN_TERMS_H
#define VNDF_IMPL_BECKMANN_TERMS_H

#include "exact.h"
#include "stretch.h"

VNDF_BEGIN

// |cot theta| of a stretched direction, at most 2^60 (double: 2^120): beyond, a Gaussian is cut nowhere, or seen at a cosine
// that rounds to 0; l = 0 is normal incidence.
VNDF_FN VNDF_REAL vndf_impl_beckmann_cot(VNDF_REAL l, VNDF_REAL z) {
    VNDF_REAL limit = VNDF_DOUBLE ? VNDF_R(1.329227995784916e36) : VNDF_R(1152921504606846976.0);
    return l > VNDF_R(0.0) ? vndf_impl_min(VNDF_DIVIDE(vndf_impl_abs(z), l), limit) : limit;
}

// weight D for a normal (x, y, z), taken literally.
VNDF_FN VNDF_REAL vndf_impl_beckmann_d(VNDF_REAL x, VNDF_REAL y, VNDF_REAL z, VNDF_REAL alpha_x,
                                       VNDF_REAL alpha_y, VNDF_REAL weight) {
    // Where z is below 2^-16, or a slope beyond 2^20 alpha, the exponential is 0.
    VNDF_REAL up = vndf_impl_max(z, VNDF_R(1.52587890625e-05)), limit = VNDF_R(1048576.0);
    VNDF_REAL z2 = up * up,
              sx = VNDF_DIVIDE(VNDF_DIVIDE(vndf_impl_min(vndf_impl_abs(x), alpha_x * limit), alpha_x), up),
              sy = VNDF_DIVIDE(VNDF_DIVIDE(vndf_impl_min(vndf_impl_abs(y), alpha_y * limit), alpha_y), up);
    VNDF_REAL d = vndf_impl_scaled_exp(-VNDF_FMA(sx, sx, sy * sy), VNDF_R(0.0),
                                       VNDF_DIVIDE(VNDF_1_PI * weight, (z2 * alpha_x) * (z2 * alpha_y)));
    return z > VNDF_R(0.0) ? vndf_impl_finite(d) : VNDF_R(0.0);
}

// l = |(alpha_x w.x, alpha_y w.y)|: the products carry their rounding errors along, since a product of two G1 has no
// units to spare. They are taken 2^27 times larger, against underflow.
VNDF_FN VNDF_REAL vndf_impl_beckmann_l(VNDF_REAL3 w, VNDF_REAL2 alpha) {
    VNDF_REAL ax = vndf_impl_alpha(alpha.x) * VNDF_R(134217728.0),
              ay = vndf_impl_alpha_y(alpha.y) * VNDF_R(134217728.0);
    VNDF_REAL x = ax * w.x, y = ay * w.y, low = VNDF_FMA(x, VNDF_FMA(ax, w.x, -x), y * VNDF_FMA(ay, w.y, -y));
    return VNDF_SQRT(VNDF_FMA(x, x, VNDF_FMA(y, y, low + low))) * VNDF_R(7.450580596923828125e-09);
}

// Lambda of w or -w, whichever is above the horizon: e^(-a^2) I(a) / a, 0 from a = 14 (double: 40) on.
VNDF_FN VNDF_REAL vndf_impl_beckmann_upper_lambda(VNDF_REAL3 w, VNDF_REAL2 alpha) {
    VNDF_REAL a = vndf_impl_beckmann_cot(vndf_impl_beckmann_l(w, alpha), w.z);
    a = vndf_impl_min(a, VNDF_DOUBLE ? VNDF_R(40.0) : VNDF_R(14.0));
    return vndf_impl_scaled_expx2(a, vndf_impl_bounded_quotient(vndf_impl_scaled_erfc_of(a).ierfcx, a));
}

VNDF_END

#endif
