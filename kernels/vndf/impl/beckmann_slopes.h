// The visible slopes of the Beckmann distribution in the plane of incidence, at alpha = 1, and what the samplers share.
//
// c, s are cosine and sine of the polar angle of the view direction, a = c / s. A normal (-x, ., 1) has the slope t = -x
// towards the view direction, and the distance y = t + a > 0 from the edge of the visible. The density of t is
// s y e^(-t^2) / (sqrt(pi) sigma); with I of beckmann.h, the distribution function of x = -t is
//     C = [s y erfcx(t) / 2 + s I(t)] e^(-t^2) / sigma,
// all terms positive for t > 0. Masses above 3/4 are replaced by their complements, also formed without cancellation.
#ifndef VNDF_IMPL_BECKMANN_SLOPES_H
#define VNDF_IMPL_BECKMANN_SLOPES_H

#include "beckmann_terms.h"

VNDF_BEGIN

// The view direction, s > 0 or c > 0. Behind the surface s e^(-a^2) is left out of all terms: s is 1, sigma and the
// exponents are relative to it.
struct vndf_impl_incidence_slopes {
    VNDF_REAL c, s;
    VNDF_REAL a;         // |a|
    VNDF_REAL gaussian;  // e^(-a^2)
    VNDF_REAL sigma;
    VNDF_REAL hidden;  // in front, the mass of slopes that face away, over sigma
    VNDF_REAL reach2;  // 1 - C tends to y^2 / reach2 at the edge
    int front;
};
VNDF_FN struct vndf_impl_incidence_slopes vndf_impl_beckmann_incidence(VNDF_REAL c, VNDF_REAL s) {
    struct vndf_impl_incidence_slopes i;
    struct vndf_impl_slopes slopes = vndf_impl_slopes_of(s, c);
    VNDF_REAL edge = s * slopes.gaussian, hidden = edge * slopes.hidden;
    i.front = c >= VNDF_R(0.0);
    i.c = c;
    i.s = i.front ? s : VNDF_R(1.0);
    i.a = slopes.a;
    i.gaussian = slopes.gaussian;
    i.sigma = i.front ? hidden + c : slopes.hidden;
    i.hidden = hidden / i.sigma;
    // Far from the edge its Gaussian underflows: any large number serves, whose product with a logarithm is one.
    VNDF_REAL least = VNDF_R(256.0) * VNDF_IMPL_ROOT_LEAST * VNDF_IMPL_ROOT_LEAST;
    i.reach2 = VNDF_R(2.0) * VNDF_SQRT_PI * i.sigma / (i.front ? vndf_impl_max(edge, least) : VNDF_R(1.0));
    return i;
}

// A slope is t = base + offset. `edge`: the base is -a and the offset y; elsewhere they are 0 and t: the offset keeps the
// digits that matter. Masses `upper` are those near the edge; from t = -8 on, where no mass of 2^-53 lies beyond, it is out
// of reach.
VNDF_FN int vndf_impl_slope_is_edge(struct vndf_impl_incidence_slopes i, int upper) {
    return !i.front || (upper && i.a < VNDF_R(8.0));
}
VNDF_FN VNDF_REAL vndf_impl_slope_base(struct vndf_impl_incidence_slopes i, int edge) {
    return edge ? (i.front ? -i.a : i.a) : VNDF_R(0.0);
}

// s y, without the factor s behind the surface.
VNDF_FN VNDF_REAL vndf_impl_slope_projection(struct vndf_impl_incidence_slopes i, int edge,
                                             VNDF_REAL offset) {
    return edge ? i.s * offset : VNDF_FMA(i.s, offset, i.c);
}

// scale e^(-t^2 - y^2), behind the surface relative to e^(-a^2). The squares carry their rounding errors along.
VNDF_FN VNDF_REAL vndf_impl_slope_gaussian(struct vndf_impl_incidence_slopes i, int edge, VNDF_REAL offset,
                                           VNDF_REAL y, VNDF_REAL scale) {
    VNDF_REAL base = vndf_impl_slope_base(i, edge), t = base + offset;
    VNDF_REAL p = i.front ? t : offset, q = i.front ? t : base + t;
    VNDF_REAL square = p * q, exponent = VNDF_FMA(y, y, square);
    VNDF_REAL low = VNDF_FMA(y, y, square - exponent);
    return vndf_impl_scaled_exp(-exponent, -low - VNDF_FMA(p, q, -square), scale);
}

// 2 J = integral of 2 tau e^(2 a y tau - y^2 tau^2) over 0 < tau < 1, where 1 - C = 2 J y^2 / reach2, for |2 a y| <= 1 and
// y <= 0.55: the sum of 2 H_n(a) y^n / (n! (n + 2)), of which the first omitted is below 2^-25 (double: 2^-54). Not `exact`,
// it is good to 1e-3.
VNDF_FN VNDF_REAL vndf_impl_edge_series(VNDF_REAL two_ay, VNDF_REAL y, int exact) {
    VNDF_REAL w = VNDF_R(-2.0) * y * y, before = VNDF_R(1.0), g = two_ay, next;
    VNDF_REAL sum = VNDF_FMA(VNDF_R(0.66666666666666666667), g, VNDF_R(1.0));
    // clang-format off
#define VNDF_IMPL_TERM(n)                                               \
    next = VNDF_FMA(two_ay, g, w * before) * (VNDF_R(1.0) / VNDF_R(n)); \
    before = g;                                                         \
    g = next;                                                           \
    sum = VNDF_FMA(VNDF_R(2.0) / (VNDF_R(n) + VNDF_R(2.0)), g, sum);
    VNDF_IMPL_TERM(2.0) VNDF_IMPL_TERM(3.0) VNDF_IMPL_TERM(4.0) VNDF_IMPL_TERM(5.0)
    VNDF_REAL rough = sum;
    VNDF_IMPL_TERM(6.0) VNDF_IMPL_TERM(7.0) VNDF_IMPL_TERM(8.0) VNDF_IMPL_TERM(9.0)
    VNDF_IMPL_TERM(10.0) VNDF_IMPL_TERM(11.0) VNDF_IMPL_TERM(12.0) VNDF_IMPL_TERM(13.0)
#if VNDF_DOUBLE
    VNDF_IMPL_TERM(14.0) VNDF_IMPL_TERM(15.0) VNDF_IMPL_TERM(16.0) VNDF_IMPL_TERM(17.0)
    VNDF_IMPL_TERM(18.0) VNDF_IMPL_TERM(19.0) VNDF_IMPL_TERM(20.0) VNDF_IMPL_TERM(21.0)
    VNDF_IMPL_TERM(22.0) VNDF_IMPL_TERM(23.0) VNDF_IMPL_TERM(24.0) VNDF_IMPL_TERM(25.0)
#endif
#undef VNDF_IMPL_TERM
        // clang-format on
        return exact
        ? sum
        : rough;
}

// The mass C beyond t (upper: 1 - C, on this side of it), and the density of t.
struct vndf_impl_slope_mass {
    VNDF_REAL mass, density;
    VNDF_REAL bend;  // derivative of the density over the density
};
VNDF_FN struct vndf_impl_slope_mass vndf_impl_slope_mass_of(struct vndf_impl_incidence_slopes i, int edge,
                                                            VNDF_REAL offset, int upper, int exact) {
    struct vndf_impl_slope_mass r;
    VNDF_REAL base = vndf_impl_slope_base(i, edge), t = base + offset, x = vndf_impl_abs(t);
    VNDF_REAL projection = vndf_impl_slope_projection(i, edge, offset);
    VNDF_REAL e = vndf_impl_slope_gaussian(i, edge, offset, VNDF_R(0.0), VNDF_R(1.0) / i.sigma);
    // For t < 0 the formula for C, with t replaced by |t|, gives 1 - C less the slopes that face away.
    VNDF_REAL unit = e / vndf_impl_erfcx_denominator(x);
    VNDF_REAL body = VNDF_R(0.5) * projection * vndf_impl_erfcx_numerator(x) * unit;
    VNDF_REAL wing = i.s * vndf_impl_ierfcx_numerator(x) * unit;
    int beyond = t >= VNDF_R(0.0);
    VNDF_REAL mass = body + (beyond ? wing : i.hidden - wing);
    mass = beyond == upper ? VNDF_R(1.0) - mass : mass;
    // Next to the edge 1 - C is a difference of nearly equal terms.
    VNDF_REAL two_ay = VNDF_R(-2.0) * base * offset;
    int series = upper && edge && vndf_impl_abs(two_ay) <= VNDF_R(1.0) && offset <= VNDF_R(0.55);
    VNDF_REAL y = series ? offset : VNDF_R(0.0);
    VNDF_REAL close = y / i.reach2 * y * vndf_impl_edge_series(series ? two_ay : VNDF_R(0.0), y, exact);
    r.mass = series ? close : mass;
    r.density = VNDF_1_SQRT_PI * projection * e;
    r.bend = i.s / (projection > VNDF_R(0.0) ? projection : VNDF_R(1.0)) - VNDF_R(2.0) * t;
    return r;
}

// A slope within +-2^16 (double: 2^30): the cotangents that a cosine can have lie within, and beyond nothing of a Gaussian
// is left.
VNDF_FN VNDF_REAL vndf_impl_bounded_slope(VNDF_REAL x) {
    VNDF_REAL limit = VNDF_DOUBLE ? VNDF_R(1073741824.0) : VNDF_R(65536.0);
    return vndf_impl_min(vndf_impl_max(x, -limit), limit);
}

// A slope x as arguments give it: its visible cosine, and y, how far it is from the edge cot(theta), 0 beyond.
struct vndf_impl_seen_slope {
    struct vndf_impl_incidence_slopes slopes;
    VNDF_REAL x, visible, y;
};
VNDF_FN struct vndf_impl_seen_slope vndf_impl_beckmann_seen_slope(VNDF_REAL cos_theta, VNDF_REAL slope) {
    struct vndf_impl_seen_slope s;
    VNDF_REAL sine = vndf_impl_sin_from_cos(cos_theta);
    s.slopes = vndf_impl_beckmann_incidence(cos_theta, sine);
    s.x = vndf_impl_bounded_slope(slope);
    s.visible = vndf_impl_visible_cosine(cos_theta, s.x);
    s.y = vndf_impl_max(s.visible, VNDF_R(0.0)) / (sine > VNDF_R(0.0) ? sine : VNDF_R(1.0));
    return s;
}

// Where to start. In front, with g = a + erfcinv(2 u) by Winitzki's approximation: y is near g + 0.35 / g for large g, where
// the Gaussian is cut far away, and below sqrt(L reach2), L = -log(u). Behind the surface y (y + 2 |a|) lies between L, for
// a = 0, and the root of v - log(1 + v) = L, for a = -infinity, near sqrt(2 L) + 3/4 L.
VNDF_FN VNDF_REAL vndf_impl_slope_start(struct vndf_impl_incidence_slopes i, int near_edge, VNDF_REAL u) {
    VNDF_REAL rest = VNDF_R(1.0) - u, m = vndf_impl_min(u, rest);
    VNDF_REAL log_r = vndf_impl_log(VNDF_R(4.0) * u * rest);
    // -log(1 - m) to 1 % on [0, 1/2], and log(u) from it.
    VNDF_REAL q =
        VNDF_FMA(VNDF_FMA(VNDF_FMA(VNDF_R(0.534), m, VNDF_R(0.278)), m, VNDF_R(0.5)), m, VNDF_R(1.0)) * m;
    VNDF_REAL l = u > VNDF_R(0.5) ? q : VNDF_R(1.38629436) - log_r - q;
    // In front, beyond a = 32, the edge is out of reach.
    int distant = i.front && i.a > VNDF_R(32.0);
    VNDF_REAL edge = distant ? VNDF_R(0.25) * VNDF_REAL_MAX : VNDF_SQRT(l * i.reach2);

    VNDF_REAL part = VNDF_FMA(VNDF_R(0.5), log_r, VNDF_R(4.33074675));
    VNDF_REAL square = VNDF_SQRT(VNDF_FMA(part, part, VNDF_R(-6.80272109) * log_r)) - part;
    VNDF_REAL size = VNDF_SQRT(vndf_impl_max(square, VNDF_R(0.0))), normal = u > VNDF_R(0.5) ? -size : size;
    VNDF_REAL g = normal + i.a;
    VNDF_REAL bow = VNDF_R(0.7) / (vndf_impl_abs(g) + VNDF_SQRT(VNDF_FMA(g, g, VNDF_R(1.4))));
    VNDF_REAL in_front = near_edge ? vndf_impl_min(vndf_impl_max(g, VNDF_R(0.0)) + bow, edge)
                                   : vndf_impl_min(vndf_impl_max(normal, -i.a) + bow, edge - i.a);

    // a^2 reach2 rises from 0 at a = 0 to 1/2.
    VNDF_REAL steep = i.front ? VNDF_R(0.0) : i.a * (i.a * i.reach2);
    VNDF_REAL twice = i.front ? VNDF_R(0.0) : VNDF_R(2.0) * i.a;
    VNDF_REAL v = VNDF_FMA(twice, edge, l * VNDF_FMA(VNDF_R(-0.5), steep, VNDF_R(1.0)));
    VNDF_REAL behind = v / (i.a + VNDF_SQRT(VNDF_FMA(i.a, i.a, v)));
    return i.front ? in_front : behind;
}

// One step from `offset`: Halley's on the logarithm of the mass over k, near 1 equal to 2 (mass - k) / (mass + k). Its
// correction to Newton's is kept between 1/2 and 2.
VNDF_FN VNDF_REAL vndf_impl_slope_step(struct vndf_impl_incidence_slopes i, int edge, VNDF_REAL k, int upper,
                                       int exact, VNDF_REAL offset) {
    struct vndf_impl_slope_mass m = vndf_impl_slope_mass_of(i, edge, offset, upper, exact);
    VNDF_REAL excess = upper ? k - m.mass : m.mass - k, sum = m.mass + k;
    VNDF_REAL scale = m.mass / m.density;
    VNDF_REAL bend = excess * VNDF_FMA(m.bend, scale, upper ? VNDF_R(-1.0) : VNDF_R(1.0));
    bend = vndf_impl_min(vndf_impl_max(bend, VNDF_R(-0.5) * sum), sum);
    return offset + VNDF_R(2.0) * excess * scale / (sum + bend);
}

// The offset of the slope with the mass u beyond it, where u is `upper` and its slope near the `edge`; monotone in u.
// Masses from 3/4 up count as upper: below, C itself is accurate enough, and above the series reaches far enough.
VNDF_FN int vndf_impl_slope_is_upper(VNDF_REAL u) {
    return u > VNDF_R(0.75);
}
VNDF_FN VNDF_REAL vndf_impl_slope_of_mass(struct vndf_impl_incidence_slopes i, int edge, VNDF_REAL u) {
    int upper = vndf_impl_slope_is_upper(u);
    VNDF_REAL k = upper ? VNDF_R(1.0) - u : u;
    // The bracket: from 1/2 to 5/2 of the start in y, otherwise 1 to either side. Three steps (double: four) reach
    // rounding.
    VNDF_REAL start = vndf_impl_slope_start(i, edge, u);
    VNDF_REAL low = edge ? VNDF_R(0.5) * start : start - VNDF_R(1.0);
    VNDF_REAL high = edge ? VNDF_R(2.5) * start : start + VNDF_R(1.0);
#define VNDF_IMPL_STEP(from, exact) \
    vndf_impl_min(vndf_impl_max(vndf_impl_slope_step(i, edge, k, upper, exact, from), low), high)
    VNDF_REAL offset = VNDF_IMPL_STEP(start, 0);
    offset = VNDF_IMPL_STEP(offset, 0);
#if VNDF_DOUBLE
    offset = VNDF_IMPL_STEP(offset, 1);
#endif
    return VNDF_IMPL_STEP(offset, 1);
#undef VNDF_IMPL_STEP
}

// --- What the samplers share ---

// The plane of incidence of a stretched view direction: its azimuth, (1, 0) if it has none, and its slopes.
struct vndf_impl_beckmann_frame {
    VNDF_REAL alpha_x, alpha_y, ex, ey, z, l;
    struct vndf_impl_incidence_slopes slopes;
};
VNDF_FN struct vndf_impl_beckmann_frame vndf_impl_beckmann_frame_of(VNDF_REAL3 wo, VNDF_REAL2 alpha) {
    struct vndf_impl_view v = vndf_impl_stretch(wo, alpha);
    struct vndf_impl_beckmann_frame f;
    VNDF_REAL rcp_r = VNDF_R(1.0) / v.r;
    f.alpha_x = v.alpha_x;
    f.alpha_y = v.alpha_y;
    f.ex = vndf_impl_azimuth_x(v);
    f.ey = vndf_impl_azimuth_y(v);
    f.z = v.z;
    f.l = v.l;
    f.slopes = vndf_impl_beckmann_incidence(v.z * rcp_r, v.l * rcp_r);
    return f;
}

// The normal that leans by t towards and by y across e before the stretch, and its density, `weight` in slopes: times
// |g|^3 / (alpha_x alpha_y) for g = (alpha_x h_x, alpha_y h_y, 1). All is scaled by a power of two near 1 / t: squares of t
// may overflow. `hidden`, a constant: wo may be behind the surface, where t and the density have no bounds.
VNDF_FN struct vndf_impl_sample vndf_impl_beckmann_unstretch(VNDF_REAL ex, VNDF_REAL ey, VNDF_REAL t,
                                                             VNDF_REAL y, VNDF_REAL alpha_x,
                                                             VNDF_REAL alpha_y, VNDF_REAL weight,
                                                             int hidden) {
    struct vndf_impl_sample m;
    VNDF_REAL scale = vndf_impl_scale(VNDF_R(1.0) + vndf_impl_abs(t));
    VNDF_REAL ts = t * scale, ys = y * scale;
    VNDF_REAL gx = alpha_x * vndf_impl_difference_of_products(ts, ex, ys, ey);
    VNDF_REAL gy = alpha_y * vndf_impl_difference_of_products(ts, ey, -ys, ex);
    VNDF_REAL length2 = VNDF_FMA(gx, gx, VNDF_FMA(gy, gy, scale * scale)), length = VNDF_SQRT(length2);
    VNDF_REAL rcp = VNDF_R(1.0) / length, rise = length / scale;
    m.x = gx * rcp;
    m.y = gy * rcp;
    m.z = scale * rcp;
    struct vndf_impl_power up = vndf_impl_split(rise), steep;
    steep.part = weight * up.part / (alpha_x * alpha_y) * up.part * up.part;
    steep.exponent = 3 * up.exponent;
    m.pdf = vndf_impl_finite(hidden ? vndf_impl_bounded_power(steep)
                                    : weight * rise / (alpha_x * alpha_y) * rise * rise);
    return vndf_impl_where(length2 > VNDF_R(0.0) && length2 <= VNDF_REAL_MAX, m);
}

// The normal of a slope in the plane of incidence and of one of y across it, with its visible density.
VNDF_FN struct vndf_impl_sample vndf_impl_beckmann_normal(struct vndf_impl_beckmann_frame f, int edge,
                                                          VNDF_REAL offset, VNDF_REAL y, int hidden) {
    struct vndf_impl_incidence_slopes i = f.slopes;
    VNDF_REAL projection = vndf_impl_max(vndf_impl_slope_projection(i, edge, offset), VNDF_R(0.0));
    VNDF_REAL weight = vndf_impl_slope_gaussian(i, edge, offset, y, VNDF_1_PI * projection / i.sigma);
    // At wo = -z nothing is visible.
    weight = i.front || f.l > VNDF_R(0.0) ? weight : VNDF_R(0.0);
    VNDF_REAL t = vndf_impl_slope_base(i, edge) + offset;
    return vndf_impl_beckmann_unstretch(f.ex, f.ey, t, y, f.alpha_x, f.alpha_y, weight, hidden);
}

VNDF_END

#endif
