// Geometry shared by all distributions: clamps, the stretched view direction, reflection, refraction,
// Jacobians.
//
// Internals take and return scalars: vector arithmetic in a body keeps CPU devices from vectorising a kernel.
#ifndef VNDF_FRAME_H
#define VNDF_FRAME_H

#include "config.h"
#include "math.h"

#if VNDF_DOUBLE
#define VNDF_REAL_MAX 1.79769313486231570815e+308
#define VNDF_EPSILON 1.11022302462515654042e-16      // 2^-53
#define VNDF_IMPL_LEAST 2.22507385850720138309e-308  // 2^-1022, the least normal number
#define VNDF_IMPL_ROOT_LEAST \
    7.45834073120020674329e-155  // 2^-512: 1 over the root of what is no number any more
#else
#define VNDF_REAL_MAX 3.40282346638528859812e+38f
#define VNDF_EPSILON 5.96046447753906250000e-08f     // 2^-24
#define VNDF_IMPL_LEAST 1.17549435082228750797e-38f  // 2^-126, the least normal number
#define VNDF_IMPL_ROOT_LEAST \
    5.42101086242752217004e-20f  // 2^-64: 1 over the root of what is no number any more
#endif

// --- Clamps of the public domain ---

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
// 0 if all components are numbers, NaN otherwise: added to a result that is kept finite, it lets NaN through.
VNDF_FN VNDF_REAL vndf_impl_zero(VNDF_REAL x, VNDF_REAL y, VNDF_REAL z) {
    return VNDF_FMA(x, VNDF_R(0.0), VNDF_FMA(y, VNDF_R(0.0), z * VNDF_R(0.0)));
}

// Whether a b is more than the largest finite number, for a, b >= 0, a <= b or a <= 2^64 (double: 2^512). It is judged
// before the product is formed, so that nothing overflows, not even under compiler options that know no infinity; and from
// numbers far from subnormal ones, which are slow.
VNDF_FN int vndf_impl_beyond(VNDF_REAL a, VNDF_REAL b) {
    VNDF_REAL root = VNDF_R(1.0) / VNDF_IMPL_ROOT_LEAST;
    return vndf_impl_min(a, root) * (b * (VNDF_R(0.25) * VNDF_IMPL_ROOT_LEAST)) >= VNDF_R(0.25) * root;
}
// Their product, and the largest finite number where that is more.
VNDF_FN VNDF_REAL vndf_impl_bounded_product(VNDF_REAL a, VNDF_REAL b) {
    return vndf_impl_beyond(a, b) ? VNDF_REAL_MAX : a * b;
}

// a / b for a, b >= 0 in the same way, also for b = 0.
VNDF_FN VNDF_REAL vndf_impl_bounded_quotient(VNDF_REAL a, VNDF_REAL b) {
    VNDF_REAL down = VNDF_R(2.3283064365386963e-10);  // 2^-32
    int beyond =
        a * down >= vndf_impl_min(b, VNDF_R(1.0)) * (down / VNDF_IMPL_ROOT_LEAST / VNDF_IMPL_ROOT_LEAST);
    return beyond ? VNDF_REAL_MAX : a / b;
}

// --- Products and sums with one rounding or little more ---

// a b - c d without cancellation error: at most 1.5 ulp (Kahan).
VNDF_FN VNDF_REAL vndf_impl_difference_of_products(VNDF_REAL a, VNDF_REAL b, VNDF_REAL c, VNDF_REAL d) {
    VNDF_REAL cd = c * d;
    return VNDF_FMA(a, b, -cd) + VNDF_FMA(-c, d, cd);
}

// The rounding error of s = a + b, exactly (Knuth).
VNDF_FN VNDF_REAL vndf_impl_sum_error(VNDF_REAL a, VNDF_REAL b, VNDF_REAL s) {
    VNDF_REAL t = s - a;
    return (a - (s - t)) + (b - t);
}

// a . b as head + tail: as if computed in twice the precision, so that a grazing wm . wo keeps its digits.
struct vndf_impl_pair {
    VNDF_REAL head, tail;
};
VNDF_FN struct vndf_impl_pair vndf_impl_dot_pair(VNDF_REAL ax, VNDF_REAL ay, VNDF_REAL az, VNDF_REAL bx,
                                                 VNDF_REAL by, VNDF_REAL bz) {
    VNDF_REAL px = ax * bx, py = ay * by, pz = az * bz;
    VNDF_REAL xy = px + py, sum = xy + pz;
    struct vndf_impl_pair dot;
    VNDF_REAL products = VNDF_FMA(ax, bx, -px) + VNDF_FMA(ay, by, -py) + VNDF_FMA(az, bz, -pz);
    dot.head = sum;
    dot.tail = products + (vndf_impl_sum_error(px, py, xy) + vndf_impl_sum_error(xy, pz, sum));
    return dot;
}
VNDF_FN VNDF_REAL vndf_impl_dot(VNDF_REAL ax, VNDF_REAL ay, VNDF_REAL az, VNDF_REAL bx, VNDF_REAL by,
                                VNDF_REAL bz) {
    struct vndf_impl_pair dot = vndf_impl_dot_pair(ax, ay, az, bx, by, bz);
    return dot.head + dot.tail;
}

// sin of the angle whose cosine is c: 1 - c c is rounded once.
VNDF_FN VNDF_REAL vndf_impl_sin_from_cos(VNDF_REAL c) {
    VNDF_REAL square = VNDF_FMA(-c, c, VNDF_R(1.0));
    return VNDF_SQRT(square > VNDF_R(0.0) ? square : VNDF_R(0.0));
}

// cos_theta - x sin_theta of the angle between the view direction and the slope x: the
// sine carries its rounding error along, since the difference vanishes at the end of the visible range.
VNDF_FN VNDF_REAL vndf_impl_visible_cosine(VNDF_REAL cos_theta, VNDF_REAL x) {
    VNDF_REAL square = cos_theta * cos_theta, rest = VNDF_R(1.0) - square;
    VNDF_REAL rest_error = ((VNDF_R(1.0) - rest) - square) - VNDF_FMA(cos_theta, cos_theta, -square);
    VNDF_REAL sine = VNDF_SQRT(rest > VNDF_R(0.0) ? rest : VNDF_R(0.0));
    VNDF_REAL sine_error =
        sine > VNDF_R(0.0) ? VNDF_R(0.5) * (VNDF_FMA(-sine, sine, rest) + rest_error) / sine : VNDF_R(0.0);
    return VNDF_FMA(-x, sine, cos_theta) - x * sine_error;
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

// part 2^exponent for a part in [0, 2^126), at most the largest finite number.
VNDF_FN VNDF_REAL vndf_impl_bounded_power(struct vndf_impl_power x) {
    VNDF_INT all = vndf_impl_within(x.exponent, 2 * VNDF_IMPL_EXPONENT_BIAS - 2), first = all >> 1;
    return vndf_impl_power_beyond(x.part, all)
               ? VNDF_REAL_MAX
               : x.part * vndf_impl_exp2i(first) * vndf_impl_exp2i(all - first);
}

// --- Directions and samples as scalars ---

struct vndf_impl_sample {
    VNDF_REAL x, y, z, pdf;
};
VNDF_FN VNDF_REAL3 vndf_impl_direction(struct vndf_impl_sample s) {
    return VNDF_MAKE3(s.x, s.y, s.z);
}
VNDF_FN VNDF_REAL4 vndf_impl_direction_pdf(struct vndf_impl_sample s) {
    return VNDF_MAKE4(s.x, s.y, s.z, s.pdf);
}

// What a sampler returns where its method is not defined, and where the length of wo has left the range of
// numbers: the macroscopic normal, with density 0.
VNDF_FN struct vndf_impl_sample vndf_impl_where(int defined, struct vndf_impl_sample m) {
    struct vndf_impl_sample s;
    s.x = defined ? m.x : VNDF_R(0.0);
    s.y = defined ? m.y : VNDF_R(0.0);
    s.z = defined ? m.z : VNDF_R(1.0);
    s.pdf = defined ? m.pdf : VNDF_R(0.0);
    return s;
}

// The stretched view direction v = (alpha_x wo.x, alpha_y wo.y, wo.z), of any length, in stable terms.
struct vndf_impl_view {
    VNDF_REAL alpha_x, alpha_y;  // clamped
    VNDF_REAL x, y, z;           // v
    VNDF_REAL r, l;              // |v|, and the length of its tangential part
    VNDF_REAL rcp_l;             // 1 / l, 0 for l = 0
    VNDF_REAL t, rcp_t;          // sqrt(r (r + |z|))
};

// Squares of alpha wo.x are formed 2^27 times larger: they keep full precision down to wo.x = 1e-19 for every
// alpha in the domain, and the largest, (2^27 1e3)^2, is far from overflow. Each root feeds the next: LLVM
// packs independent roots into short vectors, and the kernel around them is then not vectorised.
VNDF_FN struct vndf_impl_view vndf_impl_view_of(VNDF_REAL vx, VNDF_REAL vy, VNDF_REAL vz) {
    struct vndf_impl_view v;
    VNDF_REAL kx = vx * VNDF_R(134217728.0), ky = vy * VNDF_R(134217728.0);
    VNDF_REAL kl = VNDF_SQRT(VNDF_FMA(kx, kx, ky * ky));
    v.x = vx;
    v.y = vy;
    v.z = vz;
    v.l = kl * VNDF_R(7.450580596923828125e-09);
    v.rcp_l = v.l > VNDF_R(0.0) ? VNDF_R(1.0) / v.l : VNDF_R(0.0);
    v.r = VNDF_SQRT(VNDF_FMA(v.l, v.l, vz * vz));
    v.t = VNDF_SQRT(v.r * (v.r + vndf_impl_abs(vz)));
    v.rcp_t = VNDF_R(1.0) / v.t;
    v.alpha_x = v.alpha_y = VNDF_R(1.0);
    return v;
}
VNDF_FN struct vndf_impl_view vndf_impl_stretch(VNDF_REAL3 wo, VNDF_REAL2 alpha) {
    VNDF_REAL alpha_x = vndf_impl_alpha(alpha.x), alpha_y = vndf_impl_alpha_y(alpha.y);
    struct vndf_impl_view v = vndf_impl_view_of(alpha_x * wo.x, alpha_y * wo.y, wo.z);
    v.alpha_x = alpha_x;
    v.alpha_y = alpha_y;
    return v;
}

// P = 1 + cos and Q = 1 - cos of the polar angle of v, and their roots. The smaller of the two is formed from
// its own root, l / t, so that neither is ever a difference.
struct vndf_impl_cap {
    VNDF_REAL p, q, sqrt_p, sqrt_q;
    VNDF_REAL z, sine;  // cosine and sine of the polar angle: 1 / r = large_root / t
    VNDF_REAL tangent;  // sqrt_q v_xy / l = tangent v_xy, without 1 / l for a front-facing v
};
VNDF_FN struct vndf_impl_cap vndf_impl_cap_of(struct vndf_impl_view v) {
    struct vndf_impl_cap cap;
    VNDF_REAL large_root = (v.r + vndf_impl_abs(v.z)) * v.rcp_t, small_root = v.l * v.rcp_t;
    VNDF_REAL large = large_root * large_root, small = small_root * small_root;
    int front = v.z >= VNDF_R(0.0);
    cap.z = v.z * (large_root * v.rcp_t);
    cap.sine = v.l * (large_root * v.rcp_t);
    cap.sqrt_p = front ? large_root : small_root;
    cap.sqrt_q = front ? small_root : large_root;
    cap.p = front ? large : small;
    cap.q = front ? small : large;
    cap.tangent = front ? v.rcp_t : large_root * v.rcp_l;
    return cap;
}

// The unit vector along the tangential part of v: azimuth 0 for a v without one.
VNDF_FN VNDF_REAL vndf_impl_azimuth_x(struct vndf_impl_view v) {
    return v.l > VNDF_R(0.0) ? v.x * v.rcp_l : VNDF_R(1.0);
}
VNDF_FN VNDF_REAL vndf_impl_azimuth_y(struct vndf_impl_view v) {
    return v.y * v.rcp_l;
}

// The half vector (e + tangent d, z) of a cap of reflections, times k > 0. d: the azimuth of v; e: the tangential part
// of the reflection, square = |e|^2; tangent2 = tangent^2; excess = square - tangent2.
// The parts along d nearly cancel where the half vector nearly vanishes, opposite to v, and with it goes the sign of
// its cosine with v. There k = tangent - e . d, and the part along d is tangent2 - (e . d)^2 = |e x d|^2 - excess, which
// has no such difference.
struct vndf_impl_cap_half {
    VNDF_REAL x, y, z, k;
};
VNDF_FN struct vndf_impl_cap_half vndf_impl_cap_half_of(VNDF_REAL dx, VNDF_REAL dy, VNDF_REAL tangent,
                                                        VNDF_REAL tangent2, VNDF_REAL ex, VNDF_REAL ey,
                                                        VNDF_REAL square, VNDF_REAL excess, VNDF_REAL z) {
    struct vndf_impl_cap_half h;
    VNDF_REAL e_along = VNDF_FMA(ex, dx, ey * dy), e_across = VNDF_FMA(ey, dx, -ex * dy);
    int opposite = e_along < VNDF_R(0.0) && square < VNDF_R(4.0) * tangent2;
    h.k = opposite ? tangent - e_along : VNDF_R(1.0);
    VNDF_REAL along = opposite ? VNDF_FMA(e_across, e_across, -excess) : e_along + tangent;
    VNDF_REAL across = e_across * h.k;
    h.x = VNDF_FMA(along, dx, -across * dy);
    h.y = VNDF_FMA(along, dy, across * dx);
    h.z = z * h.k;
    return h;
}

// u2 b - q = z_b - (1 - u2) b, where b - q = z_b: by the form whose difference is not the smaller.
VNDF_FN VNDF_REAL vndf_impl_cap_excess(VNDF_REAL u2, VNDF_REAL rest, VNDF_REAL b, VNDF_REAL q,
                                       VNDF_REAL z_b) {
    int near = rest < VNDF_R(0.5);
    return VNDF_FMA(near ? -rest : u2, b, near ? z_b : -q);
}

// --- Public geometry ---

// The mirror direction of wo about wm.
// Source: Walter et al., Microfacet Models for Refraction through Rough Surfaces, 2007, Equation 39 (i = wo,
//     o = the result).
// wo, wm: unit vectors, any frame, any orientation.
// return: 2 (wo . wm) wm - wo, unit to the rounding of the arguments; below the surface where it falls there.
// Accuracy: components within 4 units of 2^-24 (double: 2^-53).
VNDF_FN VNDF_REAL3 vndf_reflect(VNDF_REAL3 wo, VNDF_REAL3 wm) {
    VNDF_REAL twice = VNDF_R(2.0) * vndf_impl_dot(wo.x, wo.y, wo.z, wm.x, wm.y, wm.z);
    VNDF_REAL x = VNDF_FMA(twice, wm.x, -wo.x), y = VNDF_FMA(twice, wm.y, -wo.y),
              z = VNDF_FMA(twice, wm.z, -wo.z);
    int finite = vndf_impl_zero(x, y, z) == VNDF_R(0.0);
    return VNDF_MAKE3(finite ? x : VNDF_R(0.0), finite ? y : VNDF_R(0.0), finite ? z : VNDF_R(0.0));
}

// The refracted direction of wo through a facet wm.
// Source: Walter et al. 2007, Equation 40 (i = wo, o = the result, n = wm, eta_i / eta_o = 1 / eta).
// wo, wm: unit vectors, any frame, wo . wm > 0.
// eta: index of refraction on the far side over the index on wo's side, > 0.
// return: unit vector on the far side of the facet; the zero vector on total internal reflection, for
//     wo . wm <= 0 and for eta <= 0.
// Accuracy: the transmitted cosine is formed without cancellation in eta - 1; its error grows as its inverse
//     towards the critical angle, as does its derivative.
VNDF_FN VNDF_REAL3 vndf_refract(VNDF_REAL3 wo, VNDF_REAL3 wm, VNDF_REAL eta) {
    VNDF_REAL c = vndf_impl_dot(wo.x, wo.y, wo.z, wm.x, wm.y, wm.z);
    // Below 2^-64 (double: 2^-512) the contrast would be no number, and every ray is reflected.
    int thick = eta > VNDF_IMPL_ROOT_LEAST;
    VNDF_REAL rcp_eta = VNDF_R(1.0) / (thick ? eta : VNDF_R(1.0));
    // A dot product of rounded unit vectors can exceed 1.
    VNDF_REAL c1 = vndf_impl_min(c, VNDF_R(1.0));
    VNDF_REAL sin2 = VNDF_FMA(-c1, c1, VNDF_R(1.0));
    VNDF_REAL contrast = ((eta - VNDF_R(1.0)) * rcp_eta) * ((eta + VNDF_R(1.0)) * rcp_eta);
    VNDF_REAL cos2 = VNDF_FMA(sin2, contrast, c1 * c1);
    int valid = c > VNDF_R(0.0) && thick && cos2 >= VNDF_R(0.0);
    VNDF_REAL k = VNDF_FMA(c, rcp_eta, -VNDF_SQRT(cos2 > VNDF_R(0.0) ? cos2 : VNDF_R(0.0)));
    VNDF_REAL x = VNDF_FMA(k, wm.x, -wo.x * rcp_eta);
    VNDF_REAL y = VNDF_FMA(k, wm.y, -wo.y * rcp_eta);
    VNDF_REAL z = VNDF_FMA(k, wm.z, -wo.z * rcp_eta);
    valid = valid & (vndf_impl_zero(x, y, z) == VNDF_R(0.0));
    return VNDF_MAKE3(valid ? x : VNDF_R(0.0), valid ? y : VNDF_R(0.0), valid ? z : VNDF_R(0.0));
}

// |d wm / d wi| of reflection: multiply a density per steradian of wm by it to get one per steradian of wi.
// Source: Walter et al. 2007, Equation 14.
// wo, wm: unit vectors, any frame.
// return: 1 / (4 |wo . wm|), per steradian over steradian; the largest finite number where wo . wm is 0.
// Accuracy: relative error at most 4 units of 2^-24 (double: 2^-53) for the vectors as given.
VNDF_FN VNDF_REAL vndf_jacobian_reflect(VNDF_REAL3 wo, VNDF_REAL3 wm) {
    VNDF_REAL c = vndf_impl_abs(vndf_impl_dot(wo.x, wo.y, wo.z, wm.x, wm.y, wm.z));
    return vndf_impl_finite(vndf_impl_bounded_quotient(VNDF_R(0.25), c));
}

// wo + eta wi of one component, in twice the precision.
VNDF_FN struct vndf_impl_pair vndf_impl_eta_sum(VNDF_REAL o, VNDF_REAL eta, VNDF_REAL i) {
    VNDF_REAL product = eta * i, sum = o + product;
    VNDF_REAL low = vndf_impl_sum_error(o, product, sum) + VNDF_FMA(eta, i, -product);
    struct vndf_impl_pair h;
    h.head = sum + low;
    h.tail = vndf_impl_sum_error(sum, low, h.head);  // where the sum cancels, low may be the larger
    return h;
}

// |d wm / d wi| of refraction, for wm along h = wo + eta wi.
// Source: Walter et al. 2007, Equation 17 (i = wo, o = wi, eta_o / eta_i = eta); as wo . m + eta wi . m = |h|
//     for m = h / |h|, it is eta^2 |wi . m| / |h|^2.
// wo, wi: unit vectors on either side of the facet, any frame.
// eta: index of refraction on wi's side over the index on wo's side, > 0; 1 and anything near it included.
// return: > 0, per steradian over steradian: by how much the direction of h turns with wi, for every pair. A pair with
//     (wo . h)(wi . h) >= 0 is refracted by no facet and has this value all the same: give it no weight. A |wi . m| below
//     2^-48 (double: 2^-106) counts as that, so that nothing that vndf_refract returns has the density 0. The largest
//     finite number where h is 0 (eta = 1, wi = -wo: no facet is defined there).
// Accuracy: relative error at most 16 units of 2^-24 (double: 2^-53) for the arguments as given, where |wi . m| is above
//     one unit; below, the rounding of wi has left nothing of it.
VNDF_FN VNDF_REAL vndf_jacobian_refract(VNDF_REAL3 wo, VNDF_REAL3 wi, VNDF_REAL eta) {
    // Never the second choice: each component waits for the one before, since LLVM would pack the alike sums (see
    // vndf_impl_view_of).
    struct vndf_impl_pair x = vndf_impl_eta_sum(wo.x, eta, wi.x);
    struct vndf_impl_pair y = vndf_impl_eta_sum(wo.y, x.head <= VNDF_REAL_MAX ? eta : VNDF_R(1.0), wi.y);
    struct vndf_impl_pair z = vndf_impl_eta_sum(wo.z, y.head <= VNDF_REAL_MAX ? eta : VNDF_R(1.0), wi.z);
    // h times a power of two, since its square may underflow.
    VNDF_REAL largest = vndf_impl_max(vndf_impl_abs(x.head), y.head);
    largest = vndf_impl_max(vndf_impl_max(largest, -y.head), vndf_impl_abs(z.head));
    VNDF_REAL scale = vndf_impl_scale(largest), hx = x.head * scale, hy = y.head * scale, hz = z.head * scale;
    VNDF_REAL h = VNDF_SQRT(VNDF_FMA(hx, hx, VNDF_FMA(hy, hy, hz * hz)));
    // wi . h in twice the precision: it vanishes at grazing transmission.
    struct vndf_impl_pair dot = vndf_impl_dot_pair(wi.x, wi.y, wi.z, hx, hy, hz);
    VNDF_REAL low = VNDF_FMA(wi.x, x.tail, VNDF_FMA(wi.y, y.tail, wi.z * z.tail));
    VNDF_REAL wi_h = vndf_impl_abs(dot.head + VNDF_FMA(low, scale, dot.tail));
    VNDF_REAL rcp = VNDF_R(1.0) / (largest > VNDF_R(0.0) ? h : VNDF_R(1.0)),
              cosine = vndf_impl_max(wi_h * rcp, VNDF_EPSILON * VNDF_EPSILON);
    VNDF_REAL ratio = eta * scale * rcp;
    VNDF_REAL jacobian = vndf_impl_bounded_product(ratio * cosine, ratio);
    return largest > VNDF_R(0.0) ? vndf_impl_finite(jacobian) : VNDF_REAL_MAX;
}

#endif
