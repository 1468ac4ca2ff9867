// The reflections of a GGX lobe above the horizon: how many there are.
//
// Source: this package; derivation, figures and how to verify it: ggx_conic2026.md. No earlier publication was found.
//     A visible normal, stretched back to the unit vector m, reflects wo above the horizon where m^T Q m > 0,
//     Q = s z^T + z s^T - s.z A^2, s the unit stretched view direction, A = diag(alpha_x, alpha_y, 1): inside an
//     elliptic cone. As visible normals have the density s . m in stretched space, their share is the projected solid
//     angle of that cone, which has a closed form.
// Symbols: v = A wo of any length: Q scales with it, its axes do not, and v is taken as long as makes the positive
//     eigenvalue 1; -m2 >= -m1 the others; e0, e2, e1 the axes.
#ifndef VNDF_IMPL_CONE_H
#define VNDF_IMPL_CONE_H

#include "stretch.h"

VNDF_BEGIN

// With A_x = z alpha_x^2, the eigenvalue mu is the positive root of mu = z + x^2 / (mu + A_x) + y^2 / (mu + A_y).
// m1 and m2 are those of the two by two matrix diag(A_x, A_y) + w w^T, w = (x / sqrt(1 + A_x), y / sqrt(1 + A_y)).
struct vndf_impl_cone {
    VNDF_REAL x, y, z;                // v / mu
    VNDF_REAL ax, ay;                 // A_x / mu, A_y / mu
    VNDF_REAL bx, by;                 // 1 + ax, 1 + ay
    VNDF_REAL poles, rcp_poles;       // their product
    VNDF_REAL e, f;                   // x / bx, y / by: (e, f, 1) is parallel to e0
    VNDF_REAL xx, yy;                 // squares of w
    VNDF_REAL trace, product, whole;  // m1 + m2, m1 m2, (1 + m1)(1 + m2)
    VNDF_REAL unit;                   // 1 / mu
};

// 1 / x for a power of two that vndf_impl_scale gave. (Two calls of that would be packed, see impl/stretch.h.)
VNDF_FN VNDF_REAL vndf_impl_rcp_power(VNDF_REAL x) {
    VNDF_INT twice = (VNDF_INT)(2 * VNDF_IMPL_EXPONENT_BIAS) << VNDF_IMPL_MANTISSA_BITS;
    return VNDF_AS_REAL(twice - VNDF_AS_INT(x));
}

// v times a power of two that brings |x| + |y| + z near 1. Behind the surface, where there is no cone, that of x and y
// alone, and z is 1.
struct vndf_impl_cone_view {
    VNDF_REAL x, y, z, scale;
};
VNDF_FN struct vndf_impl_cone_view vndf_impl_cone_view_of(VNDF_REAL x, VNDF_REAL y, VNDF_REAL z) {
    struct vndf_impl_cone_view v;
    int above = z > VNDF_R(0.0);
    v.scale = vndf_impl_scale(vndf_impl_abs(x) + vndf_impl_abs(y) + (above ? z : VNDF_R(0.0)));
    v.x = x * v.scale;
    v.y = y * v.scale;
    v.z = above ? z * v.scale : VNDF_R(1.0);
    return v;
}

struct vndf_impl_ratio {
    VNDF_REAL num, den;
};

// The positive root of a x^2 + b x = c, a, c > 0.
VNDF_FN struct vndf_impl_ratio vndf_impl_cone_root(VNDF_REAL a, VNDF_REAL b, VNDF_REAL c) {
    struct vndf_impl_ratio x;
    VNDF_REAL sum = VNDF_SQRT(VNDF_FMA(b, b, VNDF_R(4.0) * a * c)) + vndf_impl_abs(b);
    int falling = b < VNDF_R(0.0);
    x.num = falling ? sum : VNDF_R(2.0) * c;
    x.den = falling ? VNDF_R(2.0) * a : sum;
    return x;
}

// mu within 3.3 %, never above it: the term of the larger pole is taken for its tangent at the guess u.
VNDF_FN struct vndf_impl_ratio vndf_impl_cone_start(VNDF_REAL u, VNDF_REAL x2, VNDF_REAL y2, VNDF_REAL z,
                                                    VNDF_REAL ax, VNDF_REAL ay) {
    int swap = ax < ay;
    VNDF_REAL larger = swap ? ay : ax, least = swap ? ax : ay, top = swap ? y2 : x2, rest = swap ? x2 : y2;
    VNDF_REAL b = u + larger, b2 = b * b, slope = b2 + top, value = VNDF_FMA(z, b2, top * (b + u));
    return vndf_impl_cone_root(slope, VNDF_FMA(slope, least, -value), VNDF_FMA(value, least, b2 * rest));
}

// Newton's step, from below and to below mu: sums of positive terms.
VNDF_FN struct vndf_impl_ratio vndf_impl_cone_newton(VNDF_REAL mu, VNDF_REAL x2, VNDF_REAL y2, VNDF_REAL z,
                                                     VNDF_REAL ax, VNDF_REAL ay) {
    struct vndf_impl_ratio step;
    VNDF_REAL bx = mu + ax, by = mu + ay, wx = x2 * by, wy = y2 * bx, p = bx * by;
    VNDF_REAL n2 = VNDF_FMA(wx, by, wy * bx);
    step.num = VNDF_FMA(VNDF_FMA(z, p, wx + wy), p, mu * n2);
    step.den = VNDF_FMA(p, p, n2);
    return step;
}

// 1 / mu within 1e-9 for every alpha (double: 3e-16) before rounding, for |x| + |y| + z near 1. The guess is
// (z + sqrt(z^2 + 4 (x^2 + y^2))) / 2, mu for small alpha, to 6 %.
VNDF_FN VNDF_REAL vndf_impl_cone_rcp_mu(VNDF_REAL x, VNDF_REAL y, VNDF_REAL z, VNDF_REAL ax, VNDF_REAL ay) {
    VNDF_REAL x2 = x * x, y2 = y * y, tx = vndf_impl_abs(x), ty = vndf_impl_abs(y);
    VNDF_REAL most = tx < ty ? ty : tx, least = tx < ty ? tx : ty;
    VNDF_REAL u = VNDF_FMA(z, VNDF_R(0.6), VNDF_FMA(most, VNDF_R(0.95), least * VNDF_R(0.3325)));
    struct vndf_impl_ratio mu = vndf_impl_cone_start(u, x2, y2, z, ax, ay);
    mu = vndf_impl_cone_newton(VNDF_DIVIDE(mu.num, mu.den), x2, y2, z, ax, ay);
#if VNDF_DOUBLE
    mu = vndf_impl_cone_newton(VNDF_DIVIDE(mu.num, mu.den), x2, y2, z, ax, ay);
#endif
    mu = vndf_impl_cone_newton(VNDF_DIVIDE(mu.num, mu.den), x2, y2, z, ax, ay);
    return VNDF_DIVIDE(mu.den, mu.num);
}

// For wo.z > 0.
VNDF_FN struct vndf_impl_cone vndf_impl_cone_of(struct vndf_impl_cone_view v, VNDF_REAL alpha_x,
                                                VNDF_REAL alpha_y) {
    struct vndf_impl_cone c;
    VNDF_REAL x2 = alpha_x * alpha_x, y2 = alpha_y * alpha_y;
    VNDF_REAL unit = vndf_impl_cone_rcp_mu(v.x, v.y, v.z, v.z * x2, v.z * y2);
    c.x = v.x * unit;
    c.y = v.y * unit;
    c.z = v.z * unit;
    c.unit = unit;
    c.ax = c.z * x2;
    c.ay = c.z * y2;
    c.bx = VNDF_R(1.0) + c.ax;
    c.by = VNDF_R(1.0) + c.ay;
    c.poles = c.bx * c.by;
    c.rcp_poles = VNDF_DIVIDE(VNDF_R(1.0), c.poles);
    c.e = c.x * (c.by * c.rcp_poles);
    c.f = c.y * c.rcp_poles * c.bx;
    c.xx = c.x * c.e;
    c.yy = c.y * c.f;
    c.trace = c.ax + c.xx + (c.ay + c.yy);
    c.product = VNDF_FMA(c.ax, c.ay + c.yy, c.ay * c.xx);
    c.whole = VNDF_R(1.0) + c.trace + c.product;
    return c;
}

// sqrt(poles) mu / whole: sigma_vis of the v before it was scaled, above the surface.
VNDF_FN VNDF_REAL vndf_impl_cone_area(struct vndf_impl_cone c, VNDF_REAL scale) {
    return VNDF_DIVIDE(VNDF_SQRT(c.poles) * vndf_impl_rcp_power(scale), c.whole * c.unit);
}

VNDF_END

#endif
