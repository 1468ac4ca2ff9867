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
    return l > VNDF_R(0.0) ? vndf_impl_min(vndf_impl_abs(z) / l, limit) : limit;
}

// weight D for a normal (x, y, z), taken literally.
VNDF_FN VNDF_REAL vndf_impl_beckmann_d(VNDF_REAL x, VNDF_REAL y, VNDF_REAL z, VNDF_REAL alpha_x,
                                       VNDF_REAL alpha_y, VNDF_REAL weight) {
    // Where z is below 2^-16, or a slope beyond 2^20 alpha, the exponential is 0.
    VNDF_REAL up = vndf_impl_max(z, VNDF_R(1.52587890625e-05)), limit = VNDF_R(1048576.0);
    VNDF_REAL z2 = up * up, sx = vndf_impl_min(vndf_impl_abs(x), alpha_x * limit) / alpha_x / up,
              sy = vndf_impl_min(vndf_impl_abs(y), alpha_y * limit) / alpha_y / up;
    VNDF_REAL d = vndf_impl_scaled_exp(-VNDF_FMA(sx, sx, sy * sy), VNDF_R(0.0),
                                       VNDF_1_PI * weight / ((z2 * alpha_x) * (z2 * alpha_y)));
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

// What w does not see, l e^(-a^2) I(|a|).
VNDF_FN VNDF_REAL vndf_impl_beckmann_unseen(VNDF_REAL l, VNDF_REAL z) {
    VNDF_REAL a = vndf_impl_beckmann_cot(l, z);
    a = vndf_impl_min(a, VNDF_DOUBLE ? VNDF_R(40.0) : VNDF_R(14.0));
    return vndf_impl_scaled_expx2(a, l * vndf_impl_scaled_erfc_of(a).ierfcx);
}

// The exponent of D / sigma(wo) behind the surface, q - a^2, for a normal that faces away from wo, as a sum of two
// numbers: q is small beside a^2 = (wo.z / l)^2, which is computed in twice the precision.
VNDF_FN struct vndf_impl_pair vndf_impl_hidden_exponent(VNDF_REAL3 wo, VNDF_REAL q, VNDF_REAL alpha_x,
                                                        VNDF_REAL alpha_y) {
    VNDF_REAL up = VNDF_R(134217728.0), ax = alpha_x * up, ay = alpha_y * up, z = wo.z * up;
    VNDF_REAL x = ax * wo.x, y = ay * wo.y, x2 = x * x, y2 = y * y, z2 = z * z;
    // At least 2^-70 (double: 2^-518), against infinity: beyond lies a view that sees nothing.
    VNDF_REAL l2 = vndf_impl_max(x2 + y2, VNDF_R(0.015625) * VNDF_IMPL_ROOT_LEAST), a2 = z2 / l2;
    VNDF_REAL cross = VNDF_FMA(x, VNDF_FMA(ax, wo.x, -x), y * VNDF_FMA(ay, wo.y, -y));
    VNDF_REAL squares = VNDF_FMA(x, x, -x2) + (VNDF_FMA(y, y, -y2) + vndf_impl_sum_error(x2, y2, l2));
    VNDF_REAL l2_low = VNDF_FMA(VNDF_R(2.0), cross, squares);
    VNDF_REAL a2_low = (VNDF_FMA(-a2, l2, z2) + (VNDF_FMA(z, z, -z2) - a2 * l2_low)) / l2;
    struct vndf_impl_pair exponent;
    VNDF_REAL head = q - a2, tail = vndf_impl_sum_error(q, -a2, head) - a2_low, sum = head + tail;
    // Where a is large the tail may be more than a correction of the exponential (math.h).
    int beyond = vndf_impl_abs(tail) > VNDF_R(1e-2);
    exponent.head = beyond ? sum : head;
    exponent.tail =
        beyond ? vndf_impl_min(vndf_impl_max(tail - (sum - head), VNDF_R(-1e-2)), VNDF_R(1e-2)) : tail;
    return exponent;
}

// weight D / sigma(wo), whose exponentials leave e^-exponent: q of D, and behind the surface q - a^2. 1 / height^4 of D is
// `rise`^2; l and z are those of the stretched wo.
VNDF_FN VNDF_REAL vndf_impl_beckmann_share(VNDF_REAL l, VNDF_REAL z, struct vndf_impl_pair exponent,
                                           VNDF_REAL rise, VNDF_REAL weight, VNDF_REAL alpha_x,
                                           VNDF_REAL alpha_y) {
    VNDF_REAL hidden_area = vndf_impl_scaled_erfc_of(vndf_impl_beckmann_cot(l, z)).ierfcx;
    VNDF_REAL hidden_l = l > VNDF_R(0.0) ? l : VNDF_R(1.0);
    int front = z >= VNDF_R(0.0);
    // Powers of two apart: below the horizon l I(a) may be as small as weight.
    // Each is made dependent on the one before, which is positive, so that LLVM's SLP pass does not pack them
    // (impl/stretch.h).
    struct vndf_impl_power area = vndf_impl_split(front ? vndf_impl_beckmann_unseen(l, z) + z : hidden_l),
                           scale;
    struct vndf_impl_power least = vndf_impl_split(area.part > VNDF_R(0.0) ? hidden_area : VNDF_R(1.0));
    struct vndf_impl_power up = vndf_impl_split(least.part > VNDF_R(0.0) ? rise : VNDF_R(1.0));
    VNDF_REAL seen = weight / area.part, share = front ? seen : seen / least.part;
    scale.part = VNDF_1_PI * share * up.part / (alpha_x * alpha_y) * up.part;
    scale.exponent = 2 * up.exponent - area.exponent - (front ? 0 : least.exponent);
    VNDF_REAL result = vndf_impl_finite(vndf_impl_bounded_exp(-exponent.head, -exponent.tail, scale));
    return front || l > VNDF_R(0.0) ? result : VNDF_R(0.0);
}

// weight D / sigma(wo) for a normal (x, y, z), z > 0: 1 / height^4 of D is `rise`^2, and cosine is wo . (x, y, z), exact to
// rounding. Behind the surface the exponents of D and sigma combine: with the slope |a| + tau along wo and y across,
// q - a^2 = tau (2 |a| + tau) + y^2. A normal that faces away (tau < 0) occurs only as the half vector of two rounded
// directions.
VNDF_FN VNDF_REAL vndf_impl_beckmann_visible(VNDF_REAL3 wo, VNDF_REAL x, VNDF_REAL y, VNDF_REAL z,
                                             VNDF_REAL cosine, int rounded, VNDF_REAL rise, VNDF_REAL weight,
                                             VNDF_REAL2 alpha) {
    struct vndf_impl_view v = vndf_impl_stretch(wo, alpha);
    VNDF_REAL a = vndf_impl_beckmann_cot(v.l, wo.z);
    int front = wo.z >= VNDF_R(0.0);
    // Slopes beyond 2^62 (double: 2^510) have the density 0.
    VNDF_REAL limit = VNDF_R(0.25) / VNDF_IMPL_ROOT_LEAST;
    // sy waits for sx, which is finite: side by side they would be packed (impl/stretch.h).
    VNDF_REAL sx = x / v.alpha_x / z, sy = (sx <= VNDF_REAL_MAX ? y : VNDF_R(0.0)) / v.alpha_y / z;
    VNDF_REAL qx = vndf_impl_min(vndf_impl_abs(sx), limit), qy = vndf_impl_min(vndf_impl_abs(sy), limit);
    VNDF_REAL q = VNDF_FMA(qx, qx, qy * qy);
    // tau = cosine / (z l): both times a power of two, since the product may underflow.
    VNDF_REAL l = v.l > VNDF_R(0.0) ? v.l : VNDF_R(1.0),
              tau = cosine / VNDF_IMPL_ROOT_LEAST / (z / VNDF_IMPL_ROOT_LEAST * l);
    VNDF_REAL lean = vndf_impl_min(vndf_impl_max(tau, VNDF_R(0.0)), limit);
    VNDF_REAL across =
        vndf_impl_min(vndf_impl_abs(vndf_impl_difference_of_products(sx, v.y, sy, v.x) * v.rcp_l), limit);
    VNDF_REAL steep = VNDF_FMA(lean, VNDF_FMA(VNDF_R(2.0), a, lean), across * across);
    struct vndf_impl_pair hidden = vndf_impl_hidden_exponent(wo, q, v.alpha_x, v.alpha_y);
    int away = rounded && !front && tau < VNDF_R(0.0);
    struct vndf_impl_pair left;
    left.head = front ? q : (away ? hidden.head : steep);
    left.tail = away ? hidden.tail : VNDF_R(0.0);
    return vndf_impl_beckmann_share(v.l, wo.z, left, rise, weight, v.alpha_x, v.alpha_y);
}

// z > 0 at least 2^-62 (double: 2^-510), below which slopes are too large for any number.
VNDF_FN VNDF_REAL vndf_impl_beckmann_height(VNDF_REAL z) {
    return vndf_impl_max(z, VNDF_R(4.0) * VNDF_IMPL_ROOT_LEAST);
}

VNDF_END

#endif
