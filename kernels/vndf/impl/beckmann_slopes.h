// The visible slopes of the Beckmann distribution in the plane of incidence, at alpha = 1, and what the samplers share.
//
// a is the cotangent of the view direction's polar angle, negative behind the surface. A normal (-x, ., 1) leans by t = -x
// towards the view direction, and is y = a - x > 0 from the edge of the visible. With E = erfcx, I = ierfcx (math.h) and
// the area A = sigma / sin(theta), the density of x is y e^(-x^2) / (sqrt(pi) A), and its distribution function C
//     A C = (y E(-x) / 2 + I(-x)) e^(-x^2)                    for x < 0,
//     A C = A - h + (I(x) - y E(x) / 2) e^(-x^2)              for x > 0, h = I(a) e^(-a^2), A = a + h.
// Behind the surface A is I(|a|) e^(-a^2), and e^(-a^2) is left out of all terms: exponents are relative to it.
#ifndef VNDF_IMPL_BECKMANN_SLOPES_H
#define VNDF_IMPL_BECKMANN_SLOPES_H

#include "beckmann_start.h"
#include "beckmann_terms.h"

VNDF_BEGIN

// The view direction. `steep` is at most 2^53 (double: 2^501): beyond, every density is more than a number.
#if VNDF_DOUBLE
#define VNDF_IMPL_COT_LIMIT 1152921504606846976.0     // 2^60
#define VNDF_IMPL_LOG2E_BITS 6497320848556798.1       // 2^52 / log(2)
#define VNDF_IMPL_STEEP_LIMIT 6.5465360707009880e150  // 2^501
#else
#define VNDF_IMPL_COT_LIMIT 1073741824.0f          // 2^30
#define VNDF_IMPL_LOG2E_BITS 12102203.2f           // 2^23 / log(2)
#define VNDF_IMPL_STEEP_LIMIT 9007199254740992.0f  // 2^53
#endif
struct vndf_impl_incidence_slopes {
    int front;
    VNDF_REAL steep;     // |a|
    VNDF_REAL a;         // |a|, at most 2^30 (double: 2^60): beyond, y is as 1 / |a|
    VNDF_REAL s;         // 2 / (2 + |a|)
    VNDF_REAL exponent;  // in front a^2 where e^(-a^2) counts beside a, behind 0
    VNDF_REAL gaussian;  // e^-exponent
    VNDF_REAL erfcx;     // E(|a|)
    VNDF_REAL ierfcx;    // I(|a|)
    VNDF_REAL hidden;    // I(|a|) gaussian: in front h, behind A
    VNDF_REAL plateau;   // in front a, behind 0
    VNDF_REAL area;      // A
};
// Of the two numbers whose quotient is steep: s, and with it all that is not e^(-a^2), does not wait for it, nor has its
// rounding error.
VNDF_FN struct vndf_impl_incidence_slopes vndf_impl_beckmann_incidence(VNDF_REAL steep, VNDF_REAL height,
                                                                       VNDF_REAL width, int front) {
    struct vndf_impl_incidence_slopes i;
    VNDF_REAL bounded = front ? vndf_impl_min(steep, VNDF_DOUBLE ? VNDF_R(9.0) : VNDF_R(6.0)) : VNDF_R(0.0);
    i.front = front;
    i.steep = steep;
    i.a = vndf_impl_min(steep, VNDF_IMPL_COT_LIMIT);
    VNDF_REAL twice = VNDF_R(2.0) * width;
    i.s = vndf_impl_max(VNDF_DIVIDE(twice, twice + height), VNDF_DIVIDE(VNDF_R(2.0), VNDF_IMPL_COT_LIMIT));
    i.exponent = bounded * bounded;
    i.gaussian = vndf_impl_moderate_exp(-i.exponent);
    struct vndf_impl_scaled_erfc f = vndf_impl_scaled_erfc_at(i.a, i.s);
    i.erfcx = f.erfcx;
    i.ierfcx = f.ierfcx;
    i.hidden = i.gaussian * f.ierfcx;
    i.plateau = front ? i.a : VNDF_R(0.0);
    i.area = i.plateau + i.hidden;
    return i;
}

// A visible slope: x, and y as accurate as it is small.
struct vndf_impl_visible_slope {
    VNDF_REAL x, y;
};

// Integral of 2 (1 - tau) e^(z tau - w tau^2) over 0 < tau < 1, for w <= 1/16 and |z| <= 2/5: in double by the sum of
// 2 h_n / ((n + 1)(n + 2)), where n h_n = z h_(n-1) - 2 w h_(n-2).
VNDF_FN VNDF_REAL vndf_impl_edge_integral(VNDF_REAL z, VNDF_REAL w) {
#if VNDF_DOUBLE
    VNDF_REAL before = 1.0, h = z, v = -2.0 * w, next, sum = VNDF_FMA(0.33333333333333333333, z, 1.0);
    // clang-format off
#define VNDF_IMPL_TERM(n)                                   \
    next = VNDF_FMA(z, h, v * before) * VNDF_DIVIDE(1.0, n);          \
    before = h;                                             \
    h = next;                                               \
    sum = VNDF_FMA(VNDF_DIVIDE(2.0, (n + 1.0) * (n + 2.0)), h, sum);
    VNDF_IMPL_TERM(2.0) VNDF_IMPL_TERM(3.0) VNDF_IMPL_TERM(4.0) VNDF_IMPL_TERM(5.0) VNDF_IMPL_TERM(6.0)
    VNDF_IMPL_TERM(7.0) VNDF_IMPL_TERM(8.0) VNDF_IMPL_TERM(9.0) VNDF_IMPL_TERM(10.0) VNDF_IMPL_TERM(11.0)
    VNDF_IMPL_TERM(12.0) VNDF_IMPL_TERM(13.0) VNDF_IMPL_TERM(14.0) VNDF_IMPL_TERM(15.0) VNDF_IMPL_TERM(16.0)
#undef VNDF_IMPL_TERM
        // clang-format on
        return sum;
#else
    VNDF_REAL z2 = z * z;
#define VNDF_IMPL_IN_Z_W(a, b, c, d, e, f, g, h, i, j, k, l)                                        \
    VNDF_FMA(VNDF_FMA(VNDF_FMA(l, z, k), w, VNDF_FMA(VNDF_FMA(j, z, i), z2, VNDF_FMA(h, z, g))), w, \
             VNDF_FMA(VNDF_FMA(VNDF_FMA(f, z, e), z2, VNDF_FMA(d, z, c)), z2, VNDF_FMA(b, z, a)))
    return VNDF_IMPL_EDGE(VNDF_IMPL_IN_Z_W, VNDF_R);
#undef VNDF_IMPL_IN_Z_W
#endif
}

// Where to start, for the mass u below and q = 1 - u above: a polynomial in the size of a normal's quantile,
// nu = -+sqrt(-log(4 u q)), and s, for x in front and y / s behind the surface. Next to the edge, where the mass q is
// y^2 gaussian / (2 sqrt(pi) A) (1 + 4/3 a y), y by that: to 6 %, its root, quotient and exponential from the bits, with A to
// 3 %, since nothing else of the start waits for the exact ones.
VNDF_FN struct vndf_impl_visible_slope vndf_impl_slope_start(struct vndf_impl_incidence_slopes i, VNDF_REAL u,
                                                             VNDF_REAL q) {
    struct vndf_impl_visible_slope r;
    VNDF_REAL size = VNDF_SQRT(vndf_impl_max(
        vndf_impl_rough_minus_log(VNDF_FMA(VNDF_R(-4.0) * u, u, VNDF_R(4.0) * u)), VNDF_R(0.0)));
    VNDF_REAL nu = u < VNDF_R(0.5) ? -size : size, s = i.s;
    int front = i.front;
    VNDF_REAL nu2 = nu * nu, s2 = s * s;
    VNDF_REAL rest = VNDF_FMA(VNDF_R(0.2), s2, VNDF_FMA(VNDF_R(0.045), s, VNDF_R(0.0353)));
    VNDF_REAL area = VNDF_FMA(s2, front ? VNDF_R(0.282) * s2 : rest, i.plateau);
    // 3.7, not 2 sqrt(pi): too far from the edge converges better than too near.
    VNDF_INT one = VNDF_AS_INT(VNDF_R(1.0)), exponent = (VNDF_INT)(i.exponent * VNDF_IMPL_LOG2E_BITS);
    VNDF_REAL close = VNDF_AS_REAL(((VNDF_AS_INT(VNDF_R(3.7) * q * area) + exponent - one) >> 1) + one);
    VNDF_REAL cot = front ? i.a : -i.a, reach = front ? VNDF_R(2.7) : s, least = VNDF_R(0.05) * reach;
    int edge = close < VNDF_R(0.1) * reach;
    VNDF_REAL beside = close * VNDF_FMA(VNDF_R(-0.5) * cot, close, VNDF_R(1.0));

#define VNDF_IMPL_SIDE(f, b) (front ? VNDF_R(f) : VNDF_R(b))
#define VNDF_IMPL_CUBIC(a, b, c, d) VNDF_FMA(VNDF_FMA(d, nu, c), nu2, VNDF_FMA(b, nu, a))
#define VNDF_IMPL_QUARTIC(a, b, c, d, e) \
    VNDF_FMA(VNDF_FMA(VNDF_FMA(e, nu, d), nu, c), nu2, VNDF_FMA(b, nu, a))
    VNDF_REAL c0 = VNDF_IMPL_START_0(VNDF_IMPL_QUARTIC, VNDF_IMPL_SIDE);
    VNDF_REAL c1 = VNDF_IMPL_START_1(VNDF_IMPL_QUARTIC, VNDF_IMPL_SIDE);
    VNDF_REAL c2 = VNDF_IMPL_START_2(VNDF_IMPL_QUARTIC, VNDF_IMPL_SIDE);
    VNDF_REAL c3 = VNDF_IMPL_START_3(VNDF_IMPL_CUBIC, VNDF_IMPL_SIDE);
    VNDF_REAL c4 = VNDF_IMPL_START_4(VNDF_IMPL_CUBIC, VNDF_IMPL_SIDE);
#undef VNDF_IMPL_SIDE
#undef VNDF_IMPL_CUBIC
#undef VNDF_IMPL_QUARTIC
    VNDF_REAL p = VNDF_FMA(VNDF_FMA(VNDF_FMA(c4, s, c3), s, c2), s2, VNDF_FMA(c1, s, c0));

    VNDF_REAL inner = vndf_impl_max(VNDF_FMA(front ? VNDF_R(-1.0) : s, p, i.plateau), least);
    r.y = edge ? beside : inner;
    // Where a is large, a - y has lost the digits of x.
    r.x = front && !edge ? vndf_impl_min(p, i.a - least) : cot - r.y;
    return r;
}

// A C e^(x^2) next to x, in front with y = a - x put in; for x > 0 less a e^(x^2): weight E / 2 + I, with E and I by math.h's
// formula, but as a sum of which the last term has r, since all wait for it.
VNDF_FN VNDF_REAL vndf_impl_slope_mass(struct vndf_impl_incidence_slopes i,
                                       struct vndf_impl_visible_slope r) {
    VNDF_REAL size = VNDF_STD(fabs)(r.x), v = VNDF_DIVIDE(VNDF_R(2.0), VNDF_R(2.0) + size);
    int right = r.x > VNDF_R(0.0), front = i.front, tail = !front && size >= VNDF_R(0.4);
    VNDF_REAL last = vndf_impl_scaled_erfc_rest(v), v2 = v * v, v3 = v2 * v;
    VNDF_REAL first = VNDF_R(0.5) * VNDF_1_SQRT_PI, third = VNDF_IMPL_ERFCX_THIRD;
    // For small x behind the surface I is (1 / sqrt(pi) - x E) / 2.
    VNDF_REAL weight = VNDF_R(0.5) * (front ? (right ? -i.a : i.a) : (tail ? r.y : r.y - size));
    VNDF_REAL erfcx = v * VNDF_FMA(v2, third, VNDF_FMA(v, first, first));
    VNDF_REAL ierfcx = v2 * VNDF_FMA(v, third, VNDF_IMPL_IERFCX_SECOND);
    VNDF_REAL factor = VNDF_FMA(weight * v, v3, tail ? v3 * (v - VNDF_R(1.0)) : VNDF_R(0.0));
    return VNDF_FMA(factor, last, VNDF_FMA(weight, erfcx, tail ? ierfcx : first));
}

// One step towards the slope of mass u, of fifth order in Z = y^2: A C' = -e^(-x^2) / (2 sqrt(pi)) there, without a zero at
// the edge, and (log A C')' = x / y. With v = 2 sqrt(pi) (A C - A u) e^(x^2) / y, the ratios of derivatives are powers of
// k = v x and of -a v^2 / (2 y). Processors wait for this chain longer than they
// compute: its order is that of what is waited for, and the fastest of those tried.
VNDF_FN struct vndf_impl_visible_slope vndf_impl_slope_step(struct vndf_impl_incidence_slopes i, VNDF_REAL u,
                                                            VNDF_REAL q, struct vndf_impl_visible_slope r) {
    VNDF_REAL y = r.y, x = r.x;
    int right = x > VNDF_R(0.0), front = i.front;
    VNDF_REAL e = vndf_impl_moderate_exp((front ? x : y) * (front ? x : VNDF_R(2.0) * i.a + y));
    VNDF_REAL target = VNDF_FMA(right ? -q : u, i.plateau, u * i.hidden);
    // Next to the edge the same from q, since masses near 1 are nearly equal.
    VNDF_REAL square = y * y, lean = VNDF_R(-2.0) * x * y;
    int edge = y <= VNDF_R(0.25) && VNDF_STD(fabs)(lean) <= VNDF_R(0.4);
    VNDF_REAL above =
        square * vndf_impl_edge_integral(edge ? lean : VNDF_R(0.0), edge ? square : VNDF_R(0.0));
    VNDF_REAL mass = vndf_impl_slope_mass(i, r);
    VNDF_REAL rcp = VNDF_DIVIDE(VNDF_R(1.0), y);
    VNDF_REAL excess =
        VNDF_FMA(edge ? q * i.area : -target, e, edge ? VNDF_R(-0.5) * VNDF_1_SQRT_PI * above : mass);

    VNDF_REAL v = VNDF_R(2.0) * VNDF_SQRT_PI * rcp * excess, v2 = v * v, k = v * x, k2 = k * k;
    VNDF_REAL cot = front ? i.a : -i.a, second = VNDF_R(-0.5) * cot * rcp;
    VNDF_REAL l = second * v2, m = VNDF_R(-0.0625) * second * rcp * (v2 * v);
    VNDF_REAL high = VNDF_FMA(l, VNDF_R(0.16666666666666666667),
                              VNDF_FMA(k2, VNDF_R(0.16666666666666666667), VNDF_R(1.0) + k));
    VNDF_REAL powers = VNDF_FMA(VNDF_FMA(k, VNDF_R(0.041666666666666666667), VNDF_R(0.58333333333333333333)),
                                k2, VNDF_FMA(k, VNDF_R(1.5), VNDF_R(1.0)));
    VNDF_REAL low = VNDF_FMA(l, VNDF_FMA(k, VNDF_R(0.125), VNDF_R(0.33333333333333333333)), powers) + m;
    // Z grows by n / low of its size, never as far as to the edge; its root by Pade's approximant, y (1 + n / low +
    // 3/16 (n / low)^2) over the sum below, whose factors have (3 +- sqrt(5)) / 8.
    VNDF_REAL n = vndf_impl_max(v * rcp * high, -low);
    VNDF_REAL under =
        VNDF_FMA(VNDF_R(0.65450849718747371205), n, low) * VNDF_FMA(VNDF_R(0.095491502812526287949), n, low);
    VNDF_REAL twice = VNDF_DIVIDE(y * n * VNDF_FMA(VNDF_R(0.5), n, low), under);
    r.y = VNDF_FMA(VNDF_R(0.5), twice, y);
    r.x = VNDF_FMA(VNDF_R(-0.5), twice, x);
    return r;
}

// The slope with the mass u below it, monotone in u.
VNDF_FN struct vndf_impl_visible_slope vndf_impl_slope_of_mass(struct vndf_impl_incidence_slopes i,
                                                               VNDF_REAL u) {
    VNDF_REAL q = VNDF_R(1.0) - u;
    struct vndf_impl_visible_slope r = vndf_impl_slope_start(i, u, q);
#if VNDF_DOUBLE
    r = vndf_impl_slope_step(i, u, q, r);
#endif
    return vndf_impl_slope_step(i, u, q, r);
}

// --- Slopes as arguments give them ---

// A slope within +-2^16 (double: 2^30): the cotangents that a cosine can have lie within, and beyond nothing of a Gaussian
// is left.
VNDF_FN VNDF_REAL vndf_impl_bounded_slope(VNDF_REAL x) {
    VNDF_REAL limit = VNDF_DOUBLE ? VNDF_R(1073741824.0) : VNDF_R(65536.0);
    return vndf_impl_min(vndf_impl_max(x, -limit), limit);
}

VNDF_FN struct vndf_impl_incidence_slopes vndf_impl_beckmann_angle(VNDF_REAL cos_theta) {
    VNDF_REAL sine = vndf_impl_sin_from_cos(cos_theta);
    VNDF_REAL steep = VNDF_DIVIDE(vndf_impl_abs(cos_theta), sine > VNDF_R(0.0) ? sine : VNDF_R(1.0));
    return vndf_impl_beckmann_incidence(sine > VNDF_R(0.0) ? steep : VNDF_IMPL_STEEP_LIMIT,
                                        vndf_impl_abs(cos_theta), sine, cos_theta >= VNDF_R(0.0));
}

// A slope x: its visible cosine, and y, how far it is from the edge cot(theta), 0 beyond.
struct vndf_impl_seen_slope {
    struct vndf_impl_incidence_slopes slopes;
    VNDF_REAL x, visible, y;
};
VNDF_FN struct vndf_impl_seen_slope vndf_impl_beckmann_seen_slope(VNDF_REAL cos_theta, VNDF_REAL slope) {
    struct vndf_impl_seen_slope s;
    VNDF_REAL sine = vndf_impl_sin_from_cos(cos_theta);
    s.slopes = vndf_impl_beckmann_angle(cos_theta);
    s.x = vndf_impl_bounded_slope(slope);
    s.visible = vndf_impl_visible_cosine(cos_theta, s.x);
    VNDF_REAL y = VNDF_DIVIDE(vndf_impl_max(s.visible, VNDF_R(0.0)), sine > VNDF_R(0.0) ? sine : VNDF_R(1.0));
    s.y = sine > VNDF_R(0.0) ? y : s.slopes.a;
    return s;
}

// scale e^(-x^2), behind the surface relative to e^(-a^2). The square carries its rounding error along.
VNDF_FN VNDF_REAL vndf_impl_slope_gaussian(struct vndf_impl_seen_slope s, VNDF_REAL scale) {
    int front = s.slopes.front;
    VNDF_REAL p = front ? s.x : s.y, q = front ? s.x : VNDF_FMA(VNDF_R(2.0), s.slopes.a, s.y), square = p * q;
    return vndf_impl_scaled_exp(-square, -VNDF_FMA(p, q, -square), scale);
}

// --- What the samplers share ---

// The normal that leans by t towards and by y across e before the stretch, and its density, `weight` in slopes: times
// |g|^3 / (alpha_x alpha_y) for g = (alpha_x h_x, alpha_y h_y, 1).
VNDF_FN struct vndf_impl_sample vndf_impl_beckmann_unstretch(VNDF_REAL ex, VNDF_REAL ey, VNDF_REAL t,
                                                             VNDF_REAL y, VNDF_REAL alpha_x,
                                                             VNDF_REAL alpha_y, VNDF_REAL weight) {
    struct vndf_impl_sample m;
    // Two forms: alike they would be packed (impl/stretch.h).
    VNDF_REAL gx = VNDF_FMA(alpha_x * ex, t, -(alpha_x * ey * y)),
              gy = VNDF_FMA(alpha_y * ex, y, alpha_y * ey * t);
    VNDF_REAL length2 = VNDF_FMA(gx, gx, VNDF_FMA(gy, gy, VNDF_R(1.0))), length = VNDF_SQRT(length2);
    VNDF_REAL rcp = VNDF_DIVIDE(VNDF_R(1.0), length);
    m.x = gx * rcp;
    m.y = gy * rcp;
    m.z = rcp;
    // The cube of a length may be no number.
    struct vndf_impl_power rise = vndf_impl_split(length);
    VNDF_REAL part = VNDF_DIVIDE(weight * rise.part, alpha_x * alpha_y) * rise.part * rise.part;
    m.pdf = vndf_impl_times_power(part, 3 * rise.exponent);
    return m;
}

VNDF_END

#endif
