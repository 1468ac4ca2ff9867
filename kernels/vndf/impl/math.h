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

#if VNDF_DOUBLE
#define VNDF_IMPL_MANTISSA_BITS 52
#define VNDF_IMPL_EXPONENT_BIAS 1023
#define VNDF_IMPL_ROUNDER 6755399441055744.0           // 1.5 * 2^52: x + it - it rounds to an integer
#define VNDF_IMPL_LN2_HIGH 6.93147180369123816490e-01  // 33 bits, so that its multiples up to 2^20 are exact
#define VNDF_IMPL_LN2_LOW 1.90821492927058770002e-10
#define VNDF_IMPL_EXP_MIN -1400.0  // exp(x / 2) is still normal
#define VNDF_IMPL_MAX 1.7976931348623157e308
#else
#define VNDF_IMPL_MANTISSA_BITS 23
#define VNDF_IMPL_EXPONENT_BIAS 127
#define VNDF_IMPL_ROUNDER 12582912.0f    // 1.5 * 2^23: x + it - it rounds to an integer
#define VNDF_IMPL_LN2_HIGH 0.693359375f  // 9 bits, so that its multiples up to 2^15 are exact
#define VNDF_IMPL_LN2_LOW -2.12194440e-4f
#define VNDF_IMPL_EXP_MIN -174.0f  // exp(x / 2) is still normal
#define VNDF_IMPL_MAX 3.402823466e38f
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

// 2^k for exponents of normal numbers.
VNDF_FN VNDF_REAL vndf_impl_exp2i(VNDF_INT k) {
    return VNDF_AS_REAL((k + VNDF_IMPL_EXPONENT_BIAS) << VNDF_IMPL_MANTISSA_BITS);
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
    VNDF_REAL b = u > VNDF_R(0.5) ? u - VNDF_R(1.0) : u;  // exact
    VNDF_REAL c = vndf_impl_abs(b);
    VNDF_REAL m = vndf_impl_min(c, VNDF_R(0.5) - c);  // exact where chosen
    return vndf_impl_sin_2pi(b < VNDF_R(0.0) ? -m : m);
}

// cos(2 pi u) for u in [0, 1]. Accuracy: absolute 1.59 / 2.
VNDF_FN VNDF_REAL vndf_impl_circle_cos(VNDF_REAL u) {
    VNDF_REAL b = u > VNDF_R(0.5) ? VNDF_R(1.0) - u : u;
    return vndf_impl_sin_2pi(VNDF_R(0.25) - b);
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
    VNDF_REAL s = f / (VNDF_R(2.0) + f);
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

// scale * exp(x + low), |low| <= 1e-2, for every scale and x: exp(x) itself may leave the range of numbers. 0 below
// x = -174 / -1400; as for x = 174 / 1400 above. Accuracy: 2.5 / 2.5 where the result is normal.
VNDF_FN VNDF_REAL vndf_impl_scaled_exp(VNDF_REAL x, VNDF_REAL low, VNDF_REAL scale) {
    VNDF_REAL bounded = vndf_impl_min(vndf_impl_max(x, VNDF_IMPL_EXP_MIN), -VNDF_IMPL_EXP_MIN);
#if VNDF_IMPL_STRICT
    // x = k log(2) + z; the scale 2^k in two steps, so that neither leaves the normal range.
    VNDF_REAL shifted = VNDF_FMA(bounded, VNDF_R(1.44269504088896340736), VNDF_IMPL_ROUNDER);
    VNDF_REAL k = shifted - VNDF_IMPL_ROUNDER;
    VNDF_REAL z = VNDF_FMA(k, -VNDF_IMPL_LN2_LOW, VNDF_FMA(k, -VNDF_IMPL_LN2_HIGH, bounded)) + low;
    VNDF_IMPL_EXP(VNDF_IMPL_FIRST, VNDF_IMPL_NEXT)
    VNDF_REAL power = VNDF_FMA(z * z, p, z) + VNDF_R(1.0);
    VNDF_INT exponent = VNDF_AS_INT(shifted) - VNDF_AS_INT(VNDF_IMPL_ROUNDER);
    VNDF_INT first = exponent >> 1;
    VNDF_REAL result = scale * vndf_impl_exp2i(first) * power * vndf_impl_exp2i(exponent - first);
#else
    VNDF_REAL root = VNDF_FAST(exp)(VNDF_R(0.5) * bounded);
    VNDF_REAL result = scale * root * VNDF_FMA(root, low, root);
#endif
    return x < VNDF_IMPL_EXP_MIN ? VNDF_R(0.0) : result;
}

// A number as part 2^exponent.
struct vndf_impl_power {
    VNDF_REAL part;
    VNDF_INT exponent;
};

VNDF_FN VNDF_INT vndf_impl_within(VNDF_INT x, VNDF_INT most) {
    VNDF_INT low = x < -most ? -most : x;
    return low > most ? most : low;
}
// Whether part 2^exponent, for part < 2^126 and exponents up to 252 (double: 2044), is more than the largest finite number.
VNDF_FN int vndf_impl_power_beyond(VNDF_REAL part, VNDF_INT exponent) {
    VNDF_INT room = VNDF_IMPL_EXPONENT_BIAS + 1 - exponent;
    return part >= vndf_impl_exp2i(room > 126 ? 126 : room);
}

// scale e^(x + low), |low| <= 1e-2, scale.part in [0, 2^60]: as vndf_impl_scaled_exp, but for a scale of any size, and never
// more than the largest finite number.
VNDF_FN VNDF_REAL vndf_impl_bounded_exp(VNDF_REAL x, VNDF_REAL low, struct vndf_impl_power scale) {
    VNDF_REAL bounded = vndf_impl_min(vndf_impl_max(x, VNDF_IMPL_EXP_MIN), -VNDF_IMPL_EXP_MIN);
    VNDF_REAL shifted = VNDF_FMA(bounded, VNDF_R(1.44269504088896340736), VNDF_IMPL_ROUNDER);
    VNDF_REAL k = shifted - VNDF_IMPL_ROUNDER;
    VNDF_REAL z = VNDF_FMA(k, -VNDF_IMPL_LN2_LOW, VNDF_FMA(k, -VNDF_IMPL_LN2_HIGH, bounded)) + low;
#if VNDF_IMPL_STRICT
    VNDF_IMPL_EXP(VNDF_IMPL_FIRST, VNDF_IMPL_NEXT)
    VNDF_REAL power = VNDF_FMA(z * z, p, z) + VNDF_R(1.0);
#else
    VNDF_REAL power = VNDF_FAST(exp)(z);
#endif
    VNDF_INT exponent = VNDF_AS_INT(shifted) - VNDF_AS_INT(VNDF_IMPL_ROUNDER) + scale.exponent;
    VNDF_INT all = vndf_impl_within(exponent, 2 * VNDF_IMPL_EXPONENT_BIAS - 2), first = all >> 1;
    int beyond = vndf_impl_power_beyond(scale.part * power, all);
    VNDF_REAL result =
        beyond ? VNDF_IMPL_MAX : scale.part * vndf_impl_exp2i(first) * power * vndf_impl_exp2i(all - first);
    return x < VNDF_IMPL_EXP_MIN ? VNDF_R(0.0) : result;
}

// exp(x) for x <= 88 / 700; subnormal, then 0 below. Accuracy: 1.5 / 2; 1.02 ulp where the result is normal.
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

// erfcx(x) = exp(x^2) erfc(x) and ierfcx(x) = exp(x^2) ierfc(x) / 2 over their common shape 1 / (1 + sqrt(pi) x + 2 x^2),
// for 0 <= x <= 1e18 / 1e150: a caller that needs both divides once.
VNDF_FN VNDF_REAL vndf_impl_erfcx_denominator(VNDF_REAL x) {
    return VNDF_FMA(x, VNDF_FMA(VNDF_R(2.0), x, VNDF_SQRT_PI), VNDF_R(1.0));
}
VNDF_FN VNDF_REAL vndf_impl_erfcx_numerator(VNDF_REAL x) {
    VNDF_REAL z = (x - VNDF_R(2.0)) / (x + VNDF_R(2.0));
    VNDF_IMPL_ERFCX(VNDF_IMPL_FIRST, VNDF_IMPL_NEXT)
    return p * VNDF_FMA(x, VNDF_R(2.0) * VNDF_1_SQRT_PI, VNDF_R(1.0));
}
VNDF_FN VNDF_REAL vndf_impl_ierfcx_numerator(VNDF_REAL x) {
    VNDF_REAL z = (x - VNDF_R(2.0)) / (x + VNDF_R(2.0));
    VNDF_IMPL_IERFCX(VNDF_IMPL_FIRST, VNDF_IMPL_NEXT)
    return p;
}

// exp(x^2) erfc(x), as above. Accuracy: 5.2 / 5.2; 4.72 ulp.
VNDF_FN VNDF_REAL vndf_impl_erfcx(VNDF_REAL x) {
    return vndf_impl_erfcx_numerator(x) / vndf_impl_erfcx_denominator(x);
}

// exp(x^2) ierfc(x) / 2 = (1 - sqrt(pi) x erfcx(x)) / (2 sqrt(pi)), as above. Accuracy: 4.3 / 4.5; 3.60 ulp.
VNDF_FN VNDF_REAL vndf_impl_ierfcx(VNDF_REAL x) {
    return vndf_impl_ierfcx_numerator(x) / vndf_impl_erfcx_denominator(x);
}

// erfc(x), every x. Accuracy: 6.2 / 6.2; 5.31 ulp where the result is normal.
VNDF_FN VNDF_REAL vndf_impl_erfc(VNDF_REAL x) {
#if VNDF_IMPL_STRICT
    VNDF_REAL y = vndf_impl_min(vndf_impl_abs(x), VNDF_DOUBLE ? VNDF_R(30.0) : VNDF_R(14.0));  // 0 beyond it
    VNDF_REAL e = vndf_impl_scaled_expx2(y, vndf_impl_erfcx(y));
    return x < VNDF_R(0.0) ? VNDF_R(2.0) - e : e;
#else
    return VNDF_STD(erfc)(x);
#endif
}

// erf(x) for x >= 0, whose erfc(x) is at hand. Accuracy: 5.4 / 5.4; 2.79 ulp.
VNDF_FN VNDF_REAL vndf_impl_erf_of(VNDF_REAL x, VNDF_REAL erfc_x) {
    VNDF_REAL z = vndf_impl_square(vndf_impl_min(x, VNDF_R(1.0)));  // beyond 1/2 it is not used
    VNDF_IMPL_ERF(VNDF_IMPL_FIRST, VNDF_IMPL_NEXT)
    return x <= VNDF_R(0.5) ? VNDF_FMA(x, VNDF_R(1.125), p * x) : VNDF_R(1.0) - erfc_x;
}

// erf(x), every x. Accuracy: 5.4 / 5.4; 2.79 ulp.
VNDF_FN VNDF_REAL vndf_impl_erf(VNDF_REAL x) {
#if VNDF_IMPL_STRICT
    VNDF_REAL y = vndf_impl_abs(x), e = vndf_impl_erf_of(y, vndf_impl_erfc(y));
    return x < VNDF_R(0.0) ? -e : e;
#else
    return VNDF_STD(erf)(x);
#endif
}

#if VNDF_DOUBLE
#define VNDF_IMPL_SELECT(a, b, c) (centre ? VNDF_R(a) : (middle ? VNDF_R(b) : VNDF_R(c)))
#else
#define VNDF_IMPL_SELECT(a, b) (centre ? VNDF_R(a) : VNDF_R(b))
#endif
#if VNDF_DOUBLE
#define VNDF_IMPL_FIRST_OF(a, b, c) VNDF_REAL p = VNDF_IMPL_SELECT(a, b, c);
#define VNDF_IMPL_NEXT_OF(a, b, c) p = VNDF_FMA(p, z, VNDF_IMPL_SELECT(a, b, c));
#else
#define VNDF_IMPL_FIRST_OF(a, b) VNDF_REAL p = VNDF_IMPL_SELECT(a, b);
#define VNDF_IMPL_NEXT_OF(a, b) p = VNDF_FMA(p, z, VNDF_IMPL_SELECT(a, b));
#endif

// erfinv(p) / p as a function of w = -log(1 - p^2), 0 <= w <= 88 / 744.
VNDF_FN VNDF_REAL vndf_impl_erfinv_ratio_of_log(VNDF_REAL w) {
    VNDF_REAL root = VNDF_SQRT(vndf_impl_max(w, VNDF_R(1.0)));
    VNDF_REAL inverse = VNDF_R(1.0) / root;
    int centre =
        w <= VNDF_R(7.0);  // one polynomial, whose coefficients are selected: two would not vectorise
#if VNDF_DOUBLE
    int middle = w <= 40.0;
    VNDF_REAL z = centre ? w - 3.5 : inverse - (middle ? 0.25 : 0.1);
#else
    VNDF_REAL z = centre ? w - 3.5f : inverse - 0.25f;
#endif
    VNDF_IMPL_ERFINV(VNDF_IMPL_FIRST_OF, VNDF_IMPL_NEXT_OF)
    return centre ? p : p * root;
}

// erfinv(p) / p as a function of r = 1 - p^2 = q (2 - q), q = 1 - p, for r in (0, 1]; a caller that has both p and q
// without cancellation gets erfinv(p) = erfcinv(q) accurate at both ends. Accuracy: 3.5 / 8; 3.04 ulp.
VNDF_FN VNDF_REAL vndf_impl_erfinv_ratio(VNDF_REAL r) {
    return vndf_impl_erfinv_ratio_of_log(-vndf_impl_log(r));
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
    VNDF_REAL t = larger > VNDF_R(0.0) ? smaller / larger : x - x;
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
#undef VNDF_IMPL_SELECT
#undef VNDF_IMPL_FIRST_OF
#undef VNDF_IMPL_NEXT_OF

VNDF_END

#endif
