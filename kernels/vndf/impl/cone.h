// The reflections of a GGX lobe above the horizon: how many there are.
//
// Source: this package; derivation, figures and how to verify it: ggx_conic2026.md. No earlier publication was found.
//     A visible normal, stretched back to the unit vector m, reflects wo above the horizon where m^T Q m > 0,
//     Q = s z^T + z s^T - s.z A^2, s the unit stretched view direction, A = diag(alpha_x, alpha_y, 1): inside an
//     elliptic cone. As visible normals have the density s . m in stretched space, their share is the projected solid
//     angle of that cone, which has a closed form.
// Symbols: v = A wo, t = |v|, s = v / t; mu > 0 > -mu2 >= -mu1 the eigenvalues of Q with axes e0, e2, e1.
#ifndef VNDF_IMPL_CONE_H
#define VNDF_IMPL_CONE_H

#include "stretch.h"

VNDF_BEGIN

// The eigenvalue mu is the positive root of mu = s.z + s.x^2 / (mu + A_x) + s.y^2 / (mu + A_y), A_x = s.z alpha_x^2.
struct vndf_impl_cone {
    VNDF_REAL sx, sy, sz, t;
    VNDF_REAL ax, ay;            // A_x, A_y
    VNDF_REAL mu, sum;           // sum = mu - s.z, without the difference
    VNDF_REAL e, f;              // (e, f, 1) is parallel to e0
    VNDF_REAL norm2;             // 1 + e^2 + f^2
    VNDF_REAL poles, rcp_poles;  // (mu + A_x)(mu + A_y)
};

// Below it a squared sine is nothing beside the poles, and its quotients would leave the range of numbers.
#define VNDF_IMPL_CONE_LEAST VNDF_R(1e-30)

// The root of mu = z + weight / (mu + pole), as a sum of positive terms.
VNDF_FN VNDF_REAL vndf_impl_cone_quadratic(VNDF_REAL z, VNDF_REAL pole, VNDF_REAL weight) {
    VNDF_REAL d = z - pole, sum = z + pole;
    VNDF_REAL root = VNDF_SQRT(VNDF_FMA(sum, sum, VNDF_R(4.0) * weight));
    VNDF_REAL top = d < VNDF_R(0.0) ? VNDF_R(2.0) * VNDF_FMA(z, pole, weight) : d + root;
    VNDF_REAL bottom = d < VNDF_R(0.0) ? root - d : VNDF_R(2.0);
    return top / bottom;
}

// One step towards mu, both poles replaced by the one that agrees in value and slope: exact for A_x = A_y. With
// b = mu + A, the value is n1 / (b_x b_y), the slope -n2 / (b_x b_y)^2.
VNDF_FN VNDF_REAL vndf_impl_cone_step(VNDF_REAL mu, VNDF_REAL sx2, VNDF_REAL sy2, VNDF_REAL z, VNDF_REAL ax,
                                      VNDF_REAL ay) {
    VNDF_REAL bx = mu + ax, by = mu + ay, wx = sx2 * by, wy = sy2 * bx;
    VNDF_REAL n1 = wx + wy, n2 = VNDF_FMA(wx, by, wy * bx);
    VNDF_REAL ratio = n2 > VNDF_IMPL_CONE_LEAST ? n1 / n2 : VNDF_R(0.0);
    VNDF_REAL pole = VNDF_FMA(ratio, bx * by, -mu);
    return vndf_impl_cone_quadratic(z, pole > VNDF_R(0.0) ? pole : VNDF_R(0.0), n1 * ratio);
}

// Newton's step: all terms are positive, and so it also removes what the difference `pole` lost.
VNDF_FN VNDF_REAL vndf_impl_cone_newton(VNDF_REAL mu, VNDF_REAL sx2, VNDF_REAL sy2, VNDF_REAL z, VNDF_REAL ax,
                                        VNDF_REAL ay) {
    VNDF_REAL bx = mu + ax, by = mu + ay, wx = sx2 * by, wy = sy2 * bx, p = bx * by;
    VNDF_REAL n2 = VNDF_FMA(wx, by, wy * bx);
    return VNDF_FMA(VNDF_FMA(z, p, wx + wy), p, mu * n2) / VNDF_FMA(p, p, n2);
}

// mu from the pole that is the mean of both (below mu by Jensen's inequality, exact for A_x = A_y), 2 steps and one of
// Newton's (double: 3 and 2): sigma_vis within 5e-8 (4e-15) for alpha up to 20, 4e-7 (4e-15) up to 1e3.
VNDF_FN VNDF_REAL vndf_impl_cone_mu(VNDF_REAL sx2, VNDF_REAL sy2, VNDF_REAL z, VNDF_REAL ax, VNDF_REAL ay) {
    VNDF_REAL weight = sx2 + sy2;
    VNDF_REAL mean = weight > VNDF_IMPL_CONE_LEAST ? VNDF_FMA(sx2, ax, sy2 * ay) / weight : VNDF_R(0.0);
    VNDF_REAL mu = vndf_impl_cone_quadratic(z, mean, weight);
    mu = vndf_impl_cone_step(mu, sx2, sy2, z, ax, ay);
    mu = vndf_impl_cone_step(mu, sx2, sy2, z, ax, ay);
#if VNDF_DOUBLE
    mu = vndf_impl_cone_step(mu, sx2, sy2, z, ax, ay);
    mu = vndf_impl_cone_newton(mu, sx2, sy2, z, ax, ay);
#endif
    return vndf_impl_cone_newton(mu, sx2, sy2, z, ax, ay);
}

// For v.z > 0. Behind the surface, where it is not used, as at normal incidence: no quotient of it overflows.
VNDF_FN struct vndf_impl_cone vndf_impl_cone_of(struct vndf_impl_view v) {
    struct vndf_impl_cone c;
    int above = v.z > VNDF_R(0.0);
    VNDF_REAL rcp_t = VNDF_R(1.0) / v.r;
    c.sx = above ? v.x * rcp_t : VNDF_R(0.0);
    c.sy = above ? v.y * rcp_t : VNDF_R(0.0);
    c.sz = above ? v.z * rcp_t : VNDF_R(1.0);
    c.t = v.r;
    c.ax = c.sz * (v.alpha_x * v.alpha_x);
    c.ay = c.sz * (v.alpha_y * v.alpha_y);
    VNDF_REAL sx2 = c.sx * c.sx, sy2 = c.sy * c.sy;
    c.mu = vndf_impl_cone_mu(sx2, sy2, c.sz, c.ax, c.ay);
    VNDF_REAL bx = c.mu + c.ax, by = c.mu + c.ay;
    c.poles = bx * by;
    c.rcp_poles = VNDF_R(1.0) / c.poles;
    c.sum = VNDF_FMA(sx2, by, sy2 * bx) * c.rcp_poles;
    c.e = c.sx * by * c.rcp_poles;
    c.f = c.sy * bx * c.rcp_poles;
    c.norm2 = VNDF_FMA(c.e, c.e, VNDF_FMA(c.f, c.f, VNDF_R(1.0)));
    return c;
}

// mu^2 / ((1 + e^2 + f^2) sqrt((mu + A_x)(mu + A_y))): sigma_vis / t.
VNDF_FN VNDF_REAL vndf_impl_cone_share(struct vndf_impl_cone c) {
    return c.mu * (c.mu / (c.norm2 * VNDF_SQRT(c.poles)));
}

// 2 sigma_vis; above the surface alone it differs from 2 sigma.
VNDF_FN VNDF_REAL vndf_impl_twice_sigma_visible(struct vndf_impl_view v) {
    VNDF_REAL plain = vndf_impl_hidden_area(v);
    VNDF_REAL visible = VNDF_R(2.0) * v.r * vndf_impl_cone_share(vndf_impl_cone_of(v));
    return v.z > VNDF_R(0.0) ? visible : plain;
}

#undef VNDF_IMPL_CONE_LEAST

VNDF_END

#endif
