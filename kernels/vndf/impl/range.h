// What keeps numbers in range: the clamps of the public domain, products and quotients that do not overflow.
#ifndef VNDF_IMPL_RANGE_H
#define VNDF_IMPL_RANGE_H

#include "math.h"

#if VNDF_DOUBLE
#define VNDF_IMPL_ROOT_LEAST \
    7.45834073120020674329e-155  // 2^-512: 1 over the root of what is no number any more
#else
#define VNDF_IMPL_ROOT_LEAST \
    5.42101086242752217004e-20f  // 2^-64: 1 over the root of what is no number any more
#endif

// alpha within [VNDF_ALPHA_MIN, VNDF_ALPHA_MAX]: below, a float direction cannot tell the lobe from a mirror; above, squares
// would leave the range of numbers. NaN counts as the least.
VNDF_FN VNDF_REAL vndf_impl_alpha(VNDF_REAL alpha) {
    VNDF_REAL low = alpha > VNDF_ALPHA_MIN ? alpha : VNDF_ALPHA_MIN;
    return low < VNDF_ALPHA_MAX ? low : VNDF_ALPHA_MAX;
}
// The same, the ends in the other order: alpha_x and alpha_y by one form would be packed (see vndf_impl_view_of).
VNDF_FN VNDF_REAL vndf_impl_alpha_y(VNDF_REAL alpha) {
    VNDF_REAL high = alpha > VNDF_ALPHA_MAX ? VNDF_ALPHA_MAX : alpha;
    return high > VNDF_ALPHA_MIN ? high : VNDF_ALPHA_MIN;
}

// u within [VNDF_U_MIN, VNDF_U_MAX]: u = 1 is a true singularity of several maps, u = 0 an infinite slope.
VNDF_FN VNDF_REAL vndf_impl_u(VNDF_REAL u) {
    VNDF_REAL low = u > VNDF_U_MIN ? u : VNDF_U_MIN;
    return low < VNDF_U_MAX ? low : VNDF_U_MAX;
}

// What arguments beyond the domain leave of a positive number and of a share: infinity and NaN count as the largest number
// and as 1. In the domain nothing is left for them to do.
VNDF_FN VNDF_REAL vndf_impl_finite(VNDF_REAL x) {
    return x < VNDF_REAL_MAX ? x : VNDF_REAL_MAX;
}
VNDF_FN VNDF_REAL vndf_impl_share(VNDF_REAL x) {
    return x < VNDF_R(1.0) ? x : VNDF_R(1.0);
}
// 0 times each component, summed: 0 if all are finite, else NaN.
VNDF_FN VNDF_REAL vndf_impl_nothing(VNDF_REAL x, VNDF_REAL y, VNDF_REAL z) {
    return VNDF_FMA(x, VNDF_R(0.0), VNDF_FMA(y, VNDF_R(0.0), z * VNDF_R(0.0)));
}
VNDF_FN int vndf_impl_is_finite(VNDF_REAL x, VNDF_REAL y, VNDF_REAL z) {
    return vndf_impl_nothing(x, y, z) == VNDF_R(0.0);
}

// Whether a b, for a, b >= 0, is more than the largest finite number. It is judged before the product is formed, so that
// nothing overflows, not even under compiler options that know no infinity.
VNDF_FN int vndf_impl_beyond(VNDF_REAL a, VNDF_REAL b) {
    return (a * VNDF_IMPL_ROOT_LEAST) * (b * VNDF_IMPL_ROOT_LEAST) >= VNDF_R(1.0);
}
// a b for a, b >= 0, and the largest finite number where that is more.
VNDF_FN VNDF_REAL vndf_impl_bounded_product(VNDF_REAL a, VNDF_REAL b) {
    return vndf_impl_beyond(a, b) ? VNDF_REAL_MAX : a * b;
}

// a / b for a, b >= 0 in the same way, also for b = 0.
VNDF_FN VNDF_REAL vndf_impl_bounded_quotient(VNDF_REAL a, VNDF_REAL b) {
    int beyond = a * VNDF_IMPL_ROOT_LEAST >= vndf_impl_min(b, VNDF_R(1.0)) / VNDF_IMPL_ROOT_LEAST;
    return beyond ? VNDF_REAL_MAX : a / b;
}

// The power of two that brings |x| in (0, 4] near 1, exactly: no square below under- or overflows.
VNDF_FN VNDF_REAL vndf_impl_scale(VNDF_REAL x) {
#if VNDF_DOUBLE
    VNDF_INT exponent = VNDF_AS_INT(x) & 0x7ff0000000000000;
    return VNDF_AS_REAL(0x7fe0000000000000 - exponent);
#else
    VNDF_INT exponent = VNDF_AS_INT(x) & 0x7f800000;
    return VNDF_AS_REAL(0x7f000000 - exponent);
#endif
}

// What x > 0 divides by: 1 / x = scale / part, part in [1, 2) and scale a power of two. The quotient by part does not
// overflow, and its product with scale can be bounded. x = 0 counts as 1.
struct vndf_impl_divisor {
    VNDF_REAL part, scale;
};
VNDF_FN struct vndf_impl_divisor vndf_impl_divisor_of(VNDF_REAL x) {
    struct vndf_impl_divisor d;
    VNDF_REAL positive = x > VNDF_R(0.0) ? x : VNDF_R(1.0);
    d.scale = vndf_impl_scale(positive);
    d.part = positive * d.scale;
    return d;
}

// x > 0 as a number in [1, 2) and a power of two.
VNDF_FN struct vndf_impl_power vndf_impl_split(VNDF_REAL x) {
    struct vndf_impl_power s;
    VNDF_REAL scale = vndf_impl_scale(x);
    s.part = x * scale;
    s.exponent = VNDF_IMPL_EXPONENT_BIAS - (VNDF_AS_INT(scale) >> VNDF_IMPL_MANTISSA_BITS);
    return s;
}

// part 2^exponent for a part >= 0 of moderate size, at most the largest finite number.
VNDF_FN VNDF_REAL vndf_impl_bounded_power(struct vndf_impl_power x) {
    VNDF_INT most = 2 * VNDF_IMPL_EXPONENT_BIAS - 2, all = x.exponent > most ? most : x.exponent;
    all = all < -most ? -most : all;
    VNDF_INT first = all >> 1;
    return vndf_impl_bounded_product(vndf_impl_bounded_product(x.part, vndf_impl_exp2i(first)),
                                     vndf_impl_exp2i(all - first));
}

#endif
