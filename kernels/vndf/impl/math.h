// Elementary functions of the three math policies (see config.h): scalar, branch-free, always inlined.
//
// strict uses only correctly rounded operations and the polynomials of polynomials.h. builtin and native call
// OpenCL's functions (C, C++: the standard library's) where there is one; functions without a counterpart (erfcx, erfinv,
// the Kepler equation ...) keep their polynomials.
//
// Errors are maxima for strict, float / double, in eps = 2^-24 / 2^-53, relative unless stated otherwise. Those in ulps
// are float's over every number of the domain, rounded up (clvndf_tests "[exhaustive]"). math_test.cpp asserts both at
// some thousand numbers. NaN in gives NaN out.
#ifndef VNDF_IMPL_MATH_H
#define VNDF_IMPL_MATH_H

#include "shim.h"
#include "polynomials.h"

VNDF_BEGIN

#define VNDF_IMPL_STRICT (VNDF_POLICY == 0)

#define VNDF_IMPL_FIRST(c) VNDF_REAL p = VNDF_R(c);
#define VNDF_IMPL_NEXT(c) p = VNDF_FMA(p, z, VNDF_R(c));

// The same in float by Estrin's scheme, whose parts do not wait for each other: lowest power first, with z2 and z4. The last
// step is Horner's, which rounds less; z^8 would leave the range of numbers.
#define VNDF_IMPL_P2(a, b) VNDF_FMA(b, z, a)
#define VNDF_IMPL_P4(a, b, c, d) VNDF_FMA(VNDF_IMPL_P2(c, d), z2, VNDF_IMPL_P2(a, b))
#define VNDF_IMPL_P5(a, b, c, d, e) VNDF_FMA(VNDF_FMA(e, z2, VNDF_IMPL_P2(c, d)), z2, VNDF_IMPL_P2(a, b))
#define VNDF_IMPL_P8(a, b, c, d, e, f, g, h) VNDF_FMA(VNDF_IMPL_P4(e, f, g, h), z4, VNDF_IMPL_P4(a, b, c, d))
#define VNDF_IMPL_P9(a, b, c, d, e, f, g, h, i) VNDF_FMA(VNDF_IMPL_P8(b, c, d, e, f, g, h, i), z, a)
#define VNDF_IMPL_P12(a, b, c, d, e, f, g, h, i, j, k, l) \
    VNDF_FMA(VNDF_IMPL_P8(e, f, g, h, i, j, k, l), z4, VNDF_IMPL_P4(a, b, c, d))
#define VNDF_IMPL_P13(a, b, c, d, e, f, g, h, i, j, k, l, m) \
    VNDF_FMA(VNDF_IMPL_P12(b, c, d, e, f, g, h, i, j, k, l, m), z, a)

#if VNDF_DOUBLE
#define VNDF_IMPL_MANTISSA_BITS 52
#define VNDF_IMPL_EXPONENT_BIAS 1023
#define VNDF_IMPL_ROUNDER 6755399441055744.0           // 1.5 * 2^52: x + it - it rounds to an integer
#define VNDF_IMPL_LN2_HIGH 6.93147180369123816490e-01  // 33 bits, so that its multiples up to 2^20 are exact
#define VNDF_IMPL_LN2_LOW 1.90821492927058770002e-10
#define VNDF_IMPL_EXP_MIN -1400.0                    // exp(x / 2) is still normal
#define VNDF_IMPL_LEAST 2.22507385850720138309e-308  // 2^-1022, the least normal number
#define VNDF_IMPL_ROOT_LEAST \
    7.45834073120020674329e-155  // 2^-512: 1 over the root of what is no number any more
#else
#define VNDF_IMPL_MANTISSA_BITS 23
#define VNDF_IMPL_EXPONENT_BIAS 127
#define VNDF_IMPL_ROUNDER 12582912.0f    // 1.5 * 2^23: x + it - it rounds to an integer
#define VNDF_IMPL_LN2_HIGH 0.693359375f  // 9 bits, so that its multiples up to 2^15 are exact
#define VNDF_IMPL_LN2_LOW -2.12194440e-4f
#define VNDF_IMPL_EXP_MIN -174.0f                    // exp(x / 2) is still normal
#define VNDF_IMPL_LEAST 1.17549435082228750797e-38f  // 2^-126, the least normal number
#define VNDF_IMPL_ROOT_LEAST \
    5.42101086242752217004e-20f  // 2^-64: 1 over the root of what is no number any more
#endif

VNDF_FN VNDF_REAL vndf_impl_abs(VNDF_REAL x) {
    return x < VNDF_R(0.0) ? -x : x;
}
VNDF_FN VNDF_REAL vndf_impl_min(VNDF_REAL x, VNDF_REAL limit) {
    return x > limit ? limit : x;
}
VNDF_FN VNDF_REAL vndf_impl_max(VNDF_REAL x, VNDF_REAL limit) {
    return x < limit ? limit : x;
}
VNDF_FN VNDF_REAL vndf_impl_square(VNDF_REAL x) {
    return x * x;
}

// sin(2 pi x) for |x| <= 1/4.
VNDF_FN VNDF_REAL vndf_impl_sin_2pi(VNDF_REAL x) {
#if VNDF_IMPL_STRICT
    VNDF_REAL z = x * x;
    VNDF_IMPL_SIN_2PI(VNDF_IMPL_FIRST, VNDF_IMPL_NEXT)
    return VNDF_FMA(x, VNDF_R(4.0), p * x);
#else
    return VNDF_SIN_2PI(x);
#endif
}

// sin(2 pi u) for u in [0, 1]. Accuracy: absolute 1.43 / 2; relative 1.8 / 3 and 1.43 ulp for u < 1/2.
VNDF_FN VNDF_REAL vndf_impl_circle_sin(VNDF_REAL u) {
    // Folded onto [-1/4, 1/4] by u, 1/2 - u or u - 1, exactly.
    VNDF_REAL fold = vndf_impl_min(u, VNDF_R(0.5) - u);
    return vndf_impl_sin_2pi(vndf_impl_max(fold, u - VNDF_R(1.0)));
}

// cos(2 pi u) for u in [0, 1]. Accuracy: absolute 1.59 / 2.
VNDF_FN VNDF_REAL vndf_impl_circle_cos(VNDF_REAL u) {
    return vndf_impl_sin_2pi(VNDF_R(0.25) - vndf_impl_min(u, VNDF_R(1.0) - u));
}

// log(x) for normal x > 0. Accuracy: 1.4 / 2; 0.85 ulp.
VNDF_FN VNDF_REAL vndf_impl_log(VNDF_REAL x) {
#if VNDF_IMPL_STRICT
    // x = 2^k m with m in [sqrt(1/2), sqrt(2)); log(m) = 2 s + s^3 p(s^2) with s = (m - 1) / (m + 1), arranged so that
    // only small terms are rounded.
    VNDF_INT low = VNDF_AS_INT(VNDF_R(0.70710678118654752440));
    VNDF_INT bits = VNDF_AS_INT(vndf_impl_abs(x)) - low;  // of a number below 0 the difference might overflow
    VNDF_REAL k = (VNDF_REAL)(bits >> VNDF_IMPL_MANTISSA_BITS);
    VNDF_INT mantissa = bits & (((VNDF_INT)1 << VNDF_IMPL_MANTISSA_BITS) - 1);
    VNDF_REAL f = VNDF_AS_REAL(mantissa + low) - VNDF_R(1.0);
    VNDF_REAL s = VNDF_DIVIDE(f, VNDF_R(2.0) + f);
    VNDF_REAL z = s * s;
    VNDF_IMPL_LOG(VNDF_IMPL_FIRST, VNDF_IMPL_NEXT)
    VNDF_REAL half_square = VNDF_R(0.5) * f * f;
    VNDF_REAL tail = VNDF_FMA(s, VNDF_FMA(z, p, half_square), k * VNDF_IMPL_LN2_LOW) - half_square;
    VNDF_REAL result = VNDF_FMA(k, VNDF_IMPL_LN2_HIGH, f + tail);
    return x > VNDF_R(0.0) ? result : x - x + result;  // the bits of NaN are no number
#else
    return VNDF_FAST(log)(x);
#endif
}

// log(x) for x in [2^-66, 1] (double: as vndf_impl_log). Accuracy: 2 / 2.
VNDF_FN VNDF_REAL vndf_impl_log_of_share(VNDF_REAL x) {
#if VNDF_IMPL_STRICT && !VNDF_DOUBLE
    // As above, without a division: log(1 + f) = f + f^2 p(f).
    // Without its sign, so that the difference does not overflow.
    VNDF_INT low = VNDF_AS_INT(0.70710678118654752440f), bits = (VNDF_AS_INT(x) & 0x7fffffff) - low;
    VNDF_REAL k = (VNDF_REAL)(bits >> VNDF_IMPL_MANTISSA_BITS);
    VNDF_REAL z = VNDF_AS_REAL((bits & 0x7fffff) + low) - 1.0f;
    VNDF_REAL z2 = z * z, z4 = z2 * z2, p = VNDF_IMPL_LOG1P(VNDF_IMPL_P9, VNDF_R);
    return VNDF_FMA(k, 0.69314718055994530942f, VNDF_FMA(z2, p, z)) +
           (x - x);  // the bits of NaN are no number
#else
    return vndf_impl_log(x);
#endif
}
// -log(x) to 4e-4 of its size, with every policy, for normal x > 0.
VNDF_FN VNDF_REAL vndf_impl_rough_minus_log(VNDF_REAL x) {
    VNDF_INT low = VNDF_AS_INT(VNDF_R(0.70710678118654752440)), bits = VNDF_AS_INT(x) - low;
    VNDF_REAL k = (VNDF_REAL)(bits >> VNDF_IMPL_MANTISSA_BITS);
    VNDF_INT mantissa = bits & (((VNDF_INT)1 << VNDF_IMPL_MANTISSA_BITS) - 1);
    VNDF_REAL z = VNDF_AS_REAL(mantissa + low) - VNDF_R(1.0);
#if VNDF_DOUBLE
    VNDF_IMPL_LOG1P_ROUGH(VNDF_IMPL_FIRST, VNDF_IMPL_NEXT)
#else
    VNDF_REAL z2 = z * z, p = VNDF_IMPL_LOG1P_ROUGH(VNDF_IMPL_P4, VNDF_R);
#endif
    return VNDF_FMA(k, VNDF_R(-0.69314718055994530942), -z * p);
}

// x 2^exponent for x >= 0: 0 where that is no normal number, and at most the largest finite one.
VNDF_FN VNDF_REAL vndf_impl_times_power(VNDF_REAL x, VNDF_INT exponent) {
    VNDF_INT bits = VNDF_AS_INT(x), biased = (bits >> VNDF_IMPL_MANTISSA_BITS) + exponent;
    int below = x < VNDF_IMPL_LEAST || biased < 1;
    int beyond = biased > 2 * VNDF_IMPL_EXPONENT_BIAS;
    VNDF_INT kept = below || beyond ? 0 : exponent;
    VNDF_REAL result = VNDF_AS_REAL(bits + kept * ((VNDF_INT)1 << VNDF_IMPL_MANTISSA_BITS));
    result = beyond ? VNDF_REAL_MAX : result;
    return x == x ? (below ? VNDF_R(0.0) : result) : x;
}

// exp(z) for |z| <= log(2) / 2 + 1e-2, strict.
VNDF_FN VNDF_REAL vndf_impl_exp_near_0(VNDF_REAL z) {
    VNDF_REAL z2 = z * z;
#if VNDF_DOUBLE
    VNDF_IMPL_EXP(VNDF_IMPL_FIRST, VNDF_IMPL_NEXT)
#else
    VNDF_REAL p = VNDF_IMPL_EXP(VNDF_IMPL_P5, VNDF_R);
#endif
    return VNDF_FMA(z2, p, z) + VNDF_R(1.0);
}

// scale * exp(x + low), |low| <= 1e-2, for every scale >= 0 and x: exp(x) itself may leave the range of numbers. 0 below
// x = -174 / -1400 and where the result is no normal number; as for x = 174 / 1400 above. Accuracy: 2.5 / 2.5.
VNDF_FN VNDF_REAL vndf_impl_scaled_exp(VNDF_REAL x, VNDF_REAL low, VNDF_REAL scale) {
    VNDF_REAL bounded = vndf_impl_min(vndf_impl_max(x, VNDF_IMPL_EXP_MIN), -VNDF_IMPL_EXP_MIN);
#if VNDF_IMPL_STRICT
    // x = k log(2) + z.
    VNDF_REAL shifted = VNDF_FMA(bounded, VNDF_R(1.44269504088896340736), VNDF_IMPL_ROUNDER);
    VNDF_REAL k = shifted - VNDF_IMPL_ROUNDER;
    VNDF_REAL z = VNDF_FMA(k, -VNDF_IMPL_LN2_LOW, VNDF_FMA(k, -VNDF_IMPL_LN2_HIGH, bounded)) + low;
    VNDF_REAL power = vndf_impl_exp_near_0(z);
    VNDF_REAL result =
        vndf_impl_times_power(scale * power, VNDF_AS_INT(shifted) - VNDF_AS_INT(VNDF_IMPL_ROUNDER));
#else
    VNDF_REAL root = VNDF_FAST(exp)(VNDF_R(0.5) * bounded);
    VNDF_REAL result = scale * root * VNDF_FMA(root, low, root);
#endif
    return x < VNDF_IMPL_EXP_MIN ? VNDF_R(0.0) : result;
}

// exp(x) for |x| <= 80 / 600: neither ends nor scale are to be minded. Accuracy: 1.5 / 2.
VNDF_FN VNDF_REAL vndf_impl_moderate_exp(VNDF_REAL x) {
#if VNDF_IMPL_STRICT
    VNDF_REAL shifted = VNDF_FMA(x, VNDF_R(1.44269504088896340736), VNDF_IMPL_ROUNDER);
    VNDF_REAL k = shifted - VNDF_IMPL_ROUNDER;
    VNDF_REAL z = VNDF_FMA(k, -VNDF_IMPL_LN2_LOW, VNDF_FMA(k, -VNDF_IMPL_LN2_HIGH, x));
    VNDF_REAL power = vndf_impl_exp_near_0(z);
    // k is in the last bits of `shifted`; the others leave by the shift.
    return VNDF_AS_REAL(VNDF_AS_INT(power) + (VNDF_AS_INT(shifted) << VNDF_IMPL_MANTISSA_BITS));
#else
    return VNDF_FAST(exp)(x);
#endif
}

// A number as part 2^exponent.
struct vndf_impl_power {
    VNDF_REAL part;
    VNDF_INT exponent;
};

// scale e^(x + low), |low| <= 1e-2, for a scale of any size; 0 below x = -174 / -1400, as for x = 174 / 1400 above.
VNDF_FN struct vndf_impl_power vndf_impl_exp_power(VNDF_REAL x, VNDF_REAL low, struct vndf_impl_power scale) {
    VNDF_REAL bounded = vndf_impl_min(vndf_impl_max(x, VNDF_IMPL_EXP_MIN), -VNDF_IMPL_EXP_MIN);
    VNDF_REAL shifted = VNDF_FMA(bounded, VNDF_R(1.44269504088896340736), VNDF_IMPL_ROUNDER);
    VNDF_REAL k = shifted - VNDF_IMPL_ROUNDER;
    VNDF_REAL z = VNDF_FMA(k, -VNDF_IMPL_LN2_LOW, VNDF_FMA(k, -VNDF_IMPL_LN2_HIGH, bounded)) + low;
#if VNDF_IMPL_STRICT
    VNDF_REAL power = vndf_impl_exp_near_0(z);
#else
    VNDF_REAL power = VNDF_FAST(exp)(z);
#endif
    scale.exponent += VNDF_AS_INT(shifted) - VNDF_AS_INT(VNDF_IMPL_ROUNDER);
    scale.part = x < VNDF_IMPL_EXP_MIN ? VNDF_R(0.0) : scale.part * power;
    return scale;
}

// exp(x) for x <= 88 / 700; 0 where that is no normal number. Accuracy: 1.5 / 2; 1.02 ulp where the result is normal.
VNDF_FN VNDF_REAL vndf_impl_exp(VNDF_REAL x) {
    return vndf_impl_scaled_exp(x, VNDF_R(0.0), VNDF_R(1.0));
}

// scale * exp(-x^2), where the rounding error of x^2 is compensated. Accuracy: 2.5 / 2.5, every x.
VNDF_FN VNDF_REAL vndf_impl_scaled_expx2(VNDF_REAL x, VNDF_REAL scale) {
    VNDF_REAL limit =
        VNDF_DOUBLE ? VNDF_R(40.0) : VNDF_R(14.0);  // beyond it the exponential is 0, and x^2 may overflow
    VNDF_REAL y = vndf_impl_min(vndf_impl_abs(x), limit);
    VNDF_REAL square = y * y;
    return vndf_impl_scaled_exp(-square, -VNDF_FMA(y, y, -square), scale);
}

// exp(-x^2). Accuracy: 1.7 / 2.5; 1.16 ulp where the result is normal, every x.
VNDF_FN VNDF_REAL vndf_impl_expx2(VNDF_REAL x) {
    return vndf_impl_scaled_expx2(x, VNDF_R(1.0));
}

// erfcx(x) = exp(x^2) erfc(x) and ierfcx(x) = exp(x^2) ierfc(x) / 2 for 0 <= x <= 1e18 / 1e150, from one polynomial r in
// v = 2 / (2 + x):
//     erfcx = v ((1 + v) / (2 sqrt(pi)) + v^2 (7 / (16 sqrt(pi)) + v r)),
//     ierfcx = v^2 (1 / (16 sqrt(pi)) + v (7 / (16 sqrt(pi)) - (1 - v) r)), or (1 / sqrt(pi) - x erfcx) / 2 for small x.
#define VNDF_IMPL_ERFCX_THIRD VNDF_R(0.24683294280214337554)    // 7 / (16 sqrt(pi))
#define VNDF_IMPL_IERFCX_SECOND VNDF_R(0.03526184897173476793)  // 1 / (16 sqrt(pi))
VNDF_FN VNDF_REAL vndf_impl_scaled_erfc_rest(VNDF_REAL v) {
#if VNDF_DOUBLE
    VNDF_REAL z = v - 0.5;
    VNDF_IMPL_SCALED_ERFC(VNDF_IMPL_FIRST, VNDF_IMPL_NEXT)
#else
    // Of a smaller v it does not matter, but its powers would be no normal numbers.
    VNDF_REAL z = vndf_impl_max(v, 5.9604644775390625e-08f), z2 = z * z, z4 = z2 * z2;
    VNDF_REAL p = VNDF_IMPL_SCALED_ERFC(VNDF_IMPL_P12, VNDF_R);
#endif
    return p;
}
struct vndf_impl_scaled_erfc {
    VNDF_REAL erfcx, ierfcx;
};
VNDF_FN struct vndf_impl_scaled_erfc vndf_impl_scaled_erfc_at(VNDF_REAL x, VNDF_REAL v) {
    struct vndf_impl_scaled_erfc f;
    VNDF_REAL v2 = v * v, r = vndf_impl_scaled_erfc_rest(v);
    VNDF_REAL first = VNDF_R(0.5) * VNDF_1_SQRT_PI, third = VNDF_IMPL_ERFCX_THIRD;
    f.erfcx = v * VNDF_FMA(v2, VNDF_FMA(v, r, third), VNDF_FMA(v, first, first));
    VNDF_REAL tail = v2 * VNDF_FMA(v, VNDF_FMA(v - VNDF_R(1.0), r, third), VNDF_IMPL_IERFCX_SECOND);
    f.ierfcx = x < VNDF_R(0.4) ? VNDF_FMA(VNDF_R(-0.5) * x, f.erfcx, first) : tail;
    return f;
}
// The same where the last digits count: v with the rounding errors of 2 + x and of the quotient.
VNDF_FN struct vndf_impl_scaled_erfc vndf_impl_scaled_erfc_of(VNDF_REAL x) {
    VNDF_REAL sum = VNDF_R(2.0) + x, low = x - (sum - VNDF_R(2.0)), v = VNDF_DIVIDE(VNDF_R(2.0), sum);
    VNDF_REAL rest = VNDF_FMA(-v, low, VNDF_FMA(-v, sum, VNDF_R(2.0)));
    return vndf_impl_scaled_erfc_at(x, VNDF_FMA(VNDF_R(0.5) * v, rest, v));
}

#if VNDF_DOUBLE
#define VNDF_IMPL_SELECT(a, b, c) (centre ? VNDF_R(a) : (middle ? VNDF_R(b) : VNDF_R(c)))
#define VNDF_IMPL_FIRST_OF(a, b, c) VNDF_REAL p = VNDF_IMPL_SELECT(a, b, c);
#define VNDF_IMPL_NEXT_OF(a, b, c) p = VNDF_FMA(p, z, VNDF_IMPL_SELECT(a, b, c));
#else
#define VNDF_IMPL_SELECT(a, b) (centre ? VNDF_R(a) : VNDF_R(b))
#endif

// erfinv(p) / p as a function of w = -log(1 - p^2), 0 <= w <= 42 / 744, and of its root.
VNDF_FN VNDF_REAL vndf_impl_erfinv_ratio_of_log(VNDF_REAL w, VNDF_REAL root) {
    int centre =
        w <= VNDF_R(7.0);  // one polynomial, whose coefficients are selected: two would not vectorise
#if VNDF_DOUBLE
    VNDF_REAL inverse = VNDF_DIVIDE(1.0, centre ? 1.0 : root);
    int middle = w <= 40.0;
    VNDF_REAL z = centre ? w - 3.5 : inverse - (middle ? 0.25 : 0.1);
    VNDF_IMPL_ERFINV(VNDF_IMPL_FIRST_OF, VNDF_IMPL_NEXT_OF)
    return centre ? p : p * root;
#else
    VNDF_REAL z = centre ? w - 3.5f : root - 4.5f, z2 = z * z, z4 = z2 * z2;
    return VNDF_IMPL_ERFINV(VNDF_IMPL_P13, VNDF_IMPL_SELECT);
#endif
}

// erfinv(p) / p as a function of r = 1 - p^2 = q (2 - q), q = 1 - p, for r in (0, 1]; a caller that has both p and q
// without cancellation gets erfinv(p) = erfcinv(q) accurate at both ends. Accuracy: 3.5 / 8; 3.04 ulp.
VNDF_FN VNDF_REAL vndf_impl_erfinv_ratio(VNDF_REAL r) {
    VNDF_REAL w = vndf_impl_max(-vndf_impl_log_of_share(r), VNDF_R(0.0));
    return vndf_impl_erfinv_ratio_of_log(w, VNDF_SQRT(w));
}

// erfcinv(q) for q in (0, 2). Accuracy: 4.1 / 10; 3.27 ulp.
VNDF_FN VNDF_REAL vndf_impl_erfcinv(VNDF_REAL q) {
    return (VNDF_R(1.0) - q) * vndf_impl_erfinv_ratio(q * (VNDF_R(2.0) - q));
}

// cbrt(x) for normal x > 0. Accuracy: 1.5 / 2; 0.82 ulp.
VNDF_FN VNDF_REAL vndf_impl_cbrt(VNDF_REAL x) {
#if VNDF_IMPL_STRICT
    // Start within 4 % of r = 1 / cbrt(x): a third of the exponent bits, negated; each step cubes the error.
#if VNDF_DOUBLE
    VNDF_REAL r = VNDF_AS_REAL(0x553ef0ff289dd796L - VNDF_AS_INT(x) / 3);
#else
    VNDF_REAL r = VNDF_AS_REAL(0x54a2fa8e - VNDF_AS_INT(x) / 3);
#endif
    VNDF_REAL e = VNDF_FMA(-r * r, r * x, VNDF_R(1.0));
    r = VNDF_FMA(r * e, VNDF_FMA(e, VNDF_R(0.22222222222222222222), VNDF_R(0.33333333333333333333)), r);
    e = VNDF_FMA(-r * r, r * x, VNDF_R(1.0));
    r = VNDF_FMA(r * e, VNDF_FMA(e, VNDF_R(0.22222222222222222222), VNDF_R(0.33333333333333333333)), r);
#if VNDF_DOUBLE
    e = VNDF_FMA(-r * r, r * x, 1.0);
    r = VNDF_FMA(r * e, VNDF_FMA(e, 0.22222222222222222222, 0.33333333333333333333), r);
#endif
    VNDF_REAL y = x * r * r;
    return VNDF_FMA(VNDF_FMA(-y * y, y, x), r * r * VNDF_R(0.33333333333333333333), y);
#else
    return VNDF_STD(cbrt)(x);
#endif
}

// Kepler's equation at eccentricity 1, eta - sin(eta) = 2 pi p for p in (0, 1/2], by k = vndf_impl_kepler_k(p).
VNDF_FN VNDF_REAL vndf_impl_kepler_k(VNDF_REAL p) {
    return vndf_impl_cbrt(VNDF_R(12.0) * VNDF_PI * p);
}

// sin(eta / 2) of eta - sin(eta) = k^3 / 6, 0 <= k <= cbrt(6 pi). Accuracy: 2 / 5; 1.97 ulp.
VNDF_FN VNDF_REAL vndf_impl_kepler_sin_half(VNDF_REAL k) {
    VNDF_REAL z = k * k;
    VNDF_IMPL_KEPLER_SIN(VNDF_IMPL_FIRST, VNDF_IMPL_NEXT)
    return p * k;
}

// cos(eta / 2), as above. Accuracy: absolute 1.81 / 3.
VNDF_FN VNDF_REAL vndf_impl_kepler_cos_half(VNDF_REAL k) {
    VNDF_REAL z = k * k;
    VNDF_IMPL_KEPLER_COS(VNDF_IMPL_FIRST, VNDF_IMPL_NEXT)
    return p;
}

// The u in [0, 1] with (cos(2 pi u), sin(2 pi u)) along (x, y); 0 at the origin. Accuracy: absolute 2 / 2; relative 4 / 4
// for y > 0.
VNDF_FN VNDF_REAL vndf_impl_turn(VNDF_REAL x, VNDF_REAL y) {
    VNDF_REAL ax = vndf_impl_abs(x), ay = vndf_impl_abs(y);
#if VNDF_IMPL_STRICT
    VNDF_REAL larger = ax < ay ? ay : ax, smaller = ax < ay ? ax : ay;
    VNDF_REAL t = larger > VNDF_R(0.0) ? VNDF_DIVIDE(smaller, larger) : x - x;
    VNDF_REAL z = t * t;
    VNDF_IMPL_ARC(VNDF_IMPL_FIRST, VNDF_IMPL_NEXT)
    VNDF_REAL a = t * p;
    a = ax < ay ? VNDF_R(0.25) - a : a;
#else
    VNDF_REAL a = VNDF_R(0.5) * VNDF_1_PI * VNDF_STD(atan2)(ay, ax);
#endif
    a = x < VNDF_R(0.0) ? VNDF_R(0.5) - a : a;
    return y < VNDF_R(0.0) ? VNDF_R(1.0) - a : a;
}

#undef VNDF_IMPL_FIRST
#undef VNDF_IMPL_NEXT
#undef VNDF_IMPL_P2
#undef VNDF_IMPL_P4
#undef VNDF_IMPL_P5
#undef VNDF_IMPL_P8
#undef VNDF_IMPL_P9
#undef VNDF_IMPL_P12
#undef VNDF_IMPL_P13
#undef VNDF_IMPL_SELECT
#if VNDF_DOUBLE
#undef VNDF_IMPL_FIRST_OF
#undef VNDF_IMPL_NEXT_OF
#endif

VNDF_END

#endif
