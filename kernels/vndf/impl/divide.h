// Correctly rounded quotients and square roots of float on devices whose own are not: OpenCL lets `/` err by 2.5 and sqrt by 3
// ulp where -cl-fp32-correctly-rounded-divide-sqrt is not offered. double has them everywhere.
//
// The device's value, of numbers scaled to [1, 4), is brought next to the exact one by a step of Newton's. Of it and of its
// neighbour, towards which the remainder points, the nearer is taken: remainders are exact by fma, and so is on which side of
// the middle they lie (Markstein, IA-64 and Elementary Functions, 2000). For every argument (tests/kernels/divide_test.cpp).
#ifndef VNDF_IMPL_DIVIDE_H
#define VNDF_IMPL_DIVIDE_H

#if !VNDF_SOFTWARE_DIVIDE || VNDF_DOUBLE
#define VNDF_DIVIDE(a, b) ((a) / (b))
#define VNDF_SQRT(x) VNDF_IMPL_SQRT(x)
#else

// The device's own, within 3 ulp for numbers from 1 to 4. Tests put worse ones in their place.
#ifndef VNDF_IMPL_ROUGH_QUOTIENT
#define VNDF_IMPL_ROUGH_QUOTIENT(a, b) ((a) / (b))
#define VNDF_IMPL_ROUGH_ROOT(x) VNDF_IMPL_SQRT(x)
#endif

VNDF_BEGIN

#define VNDF_IMPL_ONE 0x3f800000
#define VNDF_IMPL_INFINITY 0x7f800000
#define VNDF_IMPL_PART 0x007fffff

// 2^n for -126 <= n <= 127.
VNDF_FN float vndf_impl_power_of_two(int n) {
    return VNDF_AS_REAL((n + 127) << 23);
}
// The bits of |x| > 0 times 2^24 if it is subnormal, and what is to be added to the exponent for that.
VNDF_FN int vndf_impl_normal_bits(float x) {
    return (VNDF_AS_INT(x) & 0x7fffffff) < 0x00800000 ? VNDF_AS_INT(x * 16777216.0f) & 0x7fffffff
                                                      : VNDF_AS_INT(x) & 0x7fffffff;
}
VNDF_FN int vndf_impl_normal_shift(float x) {
    return (VNDF_AS_INT(x) & 0x7fffffff) < 0x00800000 ? -24 : 0;
}

VNDF_FN float vndf_impl_divide(float x, float y) {
    int bits_x = vndf_impl_normal_bits(x), bits_y = vndf_impl_normal_bits(y);
    float a = VNDF_AS_REAL((bits_x & VNDF_IMPL_PART) | VNDF_IMPL_ONE);
    float b = VNDF_AS_REAL((bits_y & VNDF_IMPL_PART) | VNDF_IMPL_ONE);
    int exponent = (bits_x >> 23) + vndf_impl_normal_shift(x) - (bits_y >> 23) - vndf_impl_normal_shift(y);
    float rcp = VNDF_IMPL_ROUGH_QUOTIENT(1.0f, b), q = a * rcp;
    q = VNDF_FMA(VNDF_FMA(-q, b, a), rcp, q);
    float rest = VNDF_FMA(-q, b, a), next = VNDF_AS_REAL(VNDF_AS_INT(q) + (rest > 0.0f ? 1 : -1));
    float beyond = VNDF_FMA(0.5f * (q - next), b, rest);
    q = (rest > 0.0f ? beyond > 0.0f : beyond < 0.0f) ? next : q;
    // In two steps, since 2^exponent may be none of a float; beyond these limits nothing changes.
    exponent = exponent < -152 ? -152 : exponent > 130 ? 130 : exponent;
    int first = exponent >> 1, second = exponent - first;
    float result = q * vndf_impl_power_of_two(first) * vndf_impl_power_of_two(second);
    // A subnormal result was rounded a second time: of it and its neighbour the nearer again. Half way between is only what the
    // first time left as it was, and the second has made even.
    float back = result * vndf_impl_power_of_two(-second) * vndf_impl_power_of_two(-first);
    float half_step = vndf_impl_power_of_two(-150 - (exponent < -125 ? exponent : -125));
    rest = VNDF_FMA(-back, b, a);
    float over = VNDF_FMA(-half_step, b, rest > 0.0f ? rest : -rest);
    float other = VNDF_AS_REAL(VNDF_AS_INT(result) + (rest > 0.0f ? 1 : -1));
    result = VNDF_AS_INT(result) <= 0x00800000 && over > 0.0f ? other : result;
    int sign = (VNDF_AS_INT(x) ^ VNDF_AS_INT(y)) & ~0x7fffffff;
    // Nothing is rounded of 0, of infinity and of what is no number.
    int plain_x = VNDF_AS_INT(x) & 0x7fffffff, plain_y = VNDF_AS_INT(y) & 0x7fffffff;
    int special =
        plain_x == 0 || plain_y == 0 || plain_x >= VNDF_IMPL_INFINITY || plain_y >= VNDF_IMPL_INFINITY;
    return special ? x / y : VNDF_AS_REAL(VNDF_AS_INT(result) | sign);
}

VNDF_FN float vndf_impl_root(float x) {
    int bits = vndf_impl_normal_bits(x);
    int exponent = ((bits >> 23) - 127) & ~1;
    float m = VNDF_AS_REAL(bits - exponent * 0x00800000), s = VNDF_IMPL_ROUGH_ROOT(m);
    s = VNDF_FMA(VNDF_FMA(-s, s, m), VNDF_IMPL_ROUGH_QUOTIENT(0.5f, s), s);
    float rest = VNDF_FMA(-s, s, m), next = VNDF_AS_REAL(VNDF_AS_INT(s) + (rest > 0.0f ? 1 : -1));
    // Beyond the middle (s + next) / 2; its square and m are multiples of what is left, so that no root is there.
    float beyond = VNDF_FMA(s - next, s, rest);
    s = (rest > 0.0f ? beyond > 0.0f : beyond <= 0.0f) ? next : s;
    float result = VNDF_AS_REAL(VNDF_AS_INT(s) + (exponent + vndf_impl_normal_shift(x)) * 0x00400000);
    return x > 0.0f && VNDF_AS_INT(x) < VNDF_IMPL_INFINITY ? result : VNDF_IMPL_SQRT(x);
}

VNDF_END

#define VNDF_DIVIDE(a, b) vndf_impl_divide(a, b)
#define VNDF_SQRT(x) vndf_impl_root(x)
#endif

#endif
