// What keeps numbers in range: the clamps of the public domain, products and quotients that do not overflow.
#ifndef VNDF_IMPL_RANGE_H
#define VNDF_IMPL_RANGE_H

#include "math.h"

VNDF_BEGIN

// alpha within [1e-8, 1e3]; NaN counts as the least.
VNDF_FN VNDF_REAL vndf_impl_alpha(VNDF_REAL alpha) {
    VNDF_REAL low = alpha > VNDF_ALPHA_MIN ? alpha : VNDF_ALPHA_MIN;
    return low < VNDF_ALPHA_MAX ? low : VNDF_ALPHA_MAX;
}
// The same, the ends in the other order: two of one form would be packed by LLVM.
VNDF_FN VNDF_REAL vndf_impl_alpha_y(VNDF_REAL alpha) {
    VNDF_REAL high = alpha > VNDF_ALPHA_MAX ? VNDF_ALPHA_MAX : alpha;
    return high > VNDF_ALPHA_MIN ? high : VNDF_ALPHA_MIN;
}

// u within (0, 1): u = 1 is a singularity of several maps, u = 0 an infinite slope.
VNDF_FN VNDF_REAL vndf_impl_u(VNDF_REAL u) {
    VNDF_REAL low = u > VNDF_U_MIN ? u : VNDF_U_MIN;
    return low < VNDF_U_MAX ? low : VNDF_U_MAX;
}

// What arguments beyond the domain leave of a positive number and of a share: infinity and NaN count as the largest number
// and as 1. In the domain nothing is left for them to do.
VNDF_FN VNDF_REAL vndf_impl_finite(VNDF_REAL x) {
#if VNDF_IMPL_PRECISE < 2 && defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__
    // By the bits: who is told that there are no infinities may take a comparison with them for true.
    VNDF_INT size = VNDF_AS_INT(VNDF_REAL_MAX) | ((VNDF_INT)1 << VNDF_IMPL_MANTISSA_BITS);
    return (VNDF_AS_INT(x) & size) <= VNDF_AS_INT(VNDF_REAL_MAX) ? x : VNDF_REAL_MAX;
#else
    return x < VNDF_REAL_MAX ? x : VNDF_REAL_MAX;
#endif
}
VNDF_FN VNDF_REAL vndf_impl_share(VNDF_REAL x) {
    return x < VNDF_R(1.0) ? x : VNDF_R(1.0);
}
// 0 if all components are finite, NaN otherwise: added to a result that is kept finite, it lets NaN through.
VNDF_FN VNDF_REAL vndf_impl_zero(VNDF_REAL x, VNDF_REAL y, VNDF_REAL z) {
    return VNDF_FMA(x, VNDF_R(0.0), VNDF_FMA(y, VNDF_R(0.0), z * VNDF_R(0.0)));
}

// Whether a b is more than the largest finite number, for a, b >= 0, a <= b or a <= 2^64 (double: 2^512). It is judged
// before the product is formed, so that nothing overflows, not even under compiler options that know no infinity; and from
// numbers far from subnormal ones, which are slow.
VNDF_FN int vndf_impl_beyond(VNDF_REAL a, VNDF_REAL b) {
    VNDF_REAL root = VNDF_DIVIDE(VNDF_R(1.0), VNDF_IMPL_ROOT_LEAST);
    return vndf_impl_min(a, root) * (b * (VNDF_R(0.25) * VNDF_IMPL_ROOT_LEAST)) >= VNDF_R(0.25) * root;
}
// Their product, and the largest finite number where that is more.
VNDF_FN VNDF_REAL vndf_impl_bounded_product(VNDF_REAL a, VNDF_REAL b) {
    return vndf_impl_beyond(a, b) ? VNDF_REAL_MAX : a * b;
}

// a / b for a, b >= 0 in the same way, also for b = 0.
VNDF_FN VNDF_REAL vndf_impl_bounded_quotient(VNDF_REAL a, VNDF_REAL b) {
    VNDF_REAL down = VNDF_R(2.3283064365386963e-10);  // 2^-32
    int beyond = a * down >= vndf_impl_min(b, VNDF_R(1.0)) *
                                 VNDF_DIVIDE(VNDF_DIVIDE(down, VNDF_IMPL_ROOT_LEAST), VNDF_IMPL_ROOT_LEAST);
    return beyond ? VNDF_REAL_MAX : VNDF_DIVIDE(a, b);
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

// x > 0 as a number in [1, 2) and a power of two.
VNDF_FN struct vndf_impl_power vndf_impl_split(VNDF_REAL x) {
    struct vndf_impl_power s;
    VNDF_REAL scale = vndf_impl_scale(x);
    s.part = x * scale;
    s.exponent = VNDF_IMPL_EXPONENT_BIAS - (VNDF_AS_INT(scale) >> VNDF_IMPL_MANTISSA_BITS);
    return s;
}

VNDF_END

#endif
