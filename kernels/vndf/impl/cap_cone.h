// The normals of a GGX lobe that reflect into a spherical cap: an elliptic cone, from one cubic equation.
//
// Source: this package; derivation, figures and how to verify it: ggx_cone2026.md. None found published, in a short search.
//     wi . l > cos beta, l of the length of wo, is m^T Q m > 0 of the stretched normal m, Q = v w^T + w v^T - kappa A^2 with
//     v = A wo, w = A l, A = diag(alpha_x, alpha_y, 1), kappa = cos beta |wo|^2 + wo . l. For kappa > 0, that is -wo outside
//     the cap, Q has one positive eigenvalue mu and two negative, -mu2 >= -mu1.
#ifndef VNDF_IMPL_CAP_CONE_H
#define VNDF_IMPL_CAP_CONE_H

#include "exact.h"
#include "stretch.h"

VNDF_BEGIN

// The cap as it is computed with: l as long as wo, gap = (1 - cos beta) |wo|^2, from the sums of wo and l, in which nothing
// but the arguments is rounded.
struct vndf_impl_cap {
    VNDF_REAL lx, ly, lz;
    VNDF_REAL sum_x, sum_y, sum_z;     // l + wo
    VNDF_REAL more_x, more_y, more_z;  // l - wo
    VNDF_REAL gap, wo2, kappa, top;    // top = Q.zz, 2 wo.z l.z - kappa
    VNDF_REAL rcp_rim;                 // 1 / sin^2 beta, of caps up to 172 degrees
    int wide;                          // beta > 60 degrees: by products of wo and l, not by sums
    VNDF_REAL cosine;                  // of those: cos beta |wo|^2
    int defined;                       // neither wo nor l is a zero vector
};

// Where nothing is left of the digits of kappa: -wo counts as inside a cap that it is so near.
#define VNDF_IMPL_CAP_EDGE VNDF_R(0.000244140625)  // 2^-12

// What a 1 - cos beta of 0 counts as: a cap smaller than the rounding of its directions.
#if VNDF_DOUBLE
#define VNDF_IMPL_CAP_LEAST VNDF_R(3.08148791101957736489e-33)  // 2^-108
#else
#define VNDF_IMPL_CAP_LEAST VNDF_R(8.8817841970012523e-16)  // 2^-50
#endif

VNDF_FN struct vndf_impl_cap vndf_impl_cap_of(VNDF_REAL wo_x, VNDF_REAL wo_y, VNDF_REAL wo_z, VNDF_REAL3 l,
                                              VNDF_REAL one_minus_cos) {
    struct vndf_impl_cap c;
    VNDF_REAL sx = wo_x + l.x, sy = wo_y + l.y, sz = wo_z + l.z;
    VNDF_REAL dx = l.x - wo_x, dy = l.y - wo_y, dz = l.z - wo_z;
    c.wo2 = VNDF_FMA(wo_x, wo_x, VNDF_FMA(wo_y, wo_y, wo_z * wo_z));
    VNDF_REAL l2 = VNDF_FMA(l.x, l.x, VNDF_FMA(l.y, l.y, l.z * l.z));
    // |wo| / |l| - 1, from |wo|^2 - |l|^2 as the product of sum and difference.
    VNDF_REAL less = -VNDF_FMA(sx, dx, VNDF_FMA(sy, dy, sz * dz));
    VNDF_REAL length = l2 + VNDF_SQRT(c.wo2 * l2);
    c.defined = vndf_impl_min(l2, c.wo2) > VNDF_R(0.0) && length <= VNDF_REAL_MAX;
    c.gap = c.wo2 * vndf_impl_min(vndf_impl_max(one_minus_cos, VNDF_IMPL_CAP_LEAST), VNDF_R(2.0));
    VNDF_REAL stretch = VNDF_DIVIDE(less, c.defined ? length : VNDF_R(1.0));
    c.rcp_rim = VNDF_DIVIDE(VNDF_R(1.0), c.gap * vndf_impl_max(VNDF_R(2.0) - c.gap, VNDF_R(0.01)));
    c.lx = VNDF_FMA(stretch, l.x, l.x);
    c.ly = VNDF_FMA(stretch, l.y, l.y);
    c.lz = VNDF_FMA(stretch, l.z, l.z);
    c.sum_x = VNDF_FMA(stretch, l.x, sx);
    c.sum_y = VNDF_FMA(stretch, l.y, sy);
    c.sum_z = VNDF_FMA(stretch, l.z, sz);
    c.more_x = VNDF_FMA(stretch, l.x, dx);
    c.more_y = VNDF_FMA(stretch, l.y, dy);
    c.more_z = VNDF_FMA(stretch, l.z, dz);
    VNDF_REAL across2 = VNDF_FMA(c.sum_x, c.sum_x, c.sum_y * c.sum_y);
    VNDF_REAL sum2 = VNDF_FMA(c.sum_z, c.sum_z, across2), mirror2 = VNDF_FMA(c.more_z, c.more_z, across2);
    c.wide = c.gap > VNDF_R(0.5) * c.wo2;
    c.cosine = c.wo2 - c.gap;
    VNDF_REAL xy = vndf_impl_difference_of_products(wo_x, c.lx, -wo_y, c.ly), zz = wo_z * c.lz;
    c.kappa = c.wide ? c.cosine + (xy + zz) : VNDF_FMA(VNDF_R(0.5), sum2, -c.gap);
    c.top = c.wide ? (zz - xy) - c.cosine : VNDF_FMA(VNDF_R(-0.5), mirror2, c.gap);
    return c;
}

// mu^3 - t mu^2 + m mu - d = 0: minus the characteristic polynomial of Q.
struct vndf_impl_cubic {
    VNDF_REAL t, m, d;
};
VNDF_FN VNDF_REAL vndf_impl_cap_minor(struct vndf_impl_cap c, VNDF_REAL sum, VNDF_REAL squares,
                                      VNDF_REAL products, VNDF_REAL across) {
    VNDF_REAL a = c.wide ? c.kappa : c.cosine * sum, b = c.wide ? c.cosine + products : sum;
    VNDF_REAL d = c.wide ? -across : -c.gap, e = c.wide ? across : squares - c.gap;
    return VNDF_FMA(a, b, d * e);
}
VNDF_FN struct vndf_impl_cubic vndf_impl_cap_cubic(struct vndf_impl_cap c, VNDF_REAL wo_x, VNDF_REAL wo_y,
                                                   VNDF_REAL wo_z, VNDF_REAL x2, VNDF_REAL y2) {
    struct vndf_impl_cubic q;
    VNDF_REAL square = c.gap * (c.wo2 + c.cosine);  // sin^2 beta
    VNDF_REAL xx = wo_x * c.lx, yy = wo_y * c.ly, zz = wo_z * c.lz;
    q.t = c.top + VNDF_FMA(x2, VNDF_FMA(VNDF_R(2.0), xx, -c.kappa), y2 * VNDF_FMA(VNDF_R(2.0), yy, -c.kappa));
    // The minors of Q over those of A^2, (wo + l)^2 - 2 gap wo l - sin^2 beta of each component: by what wo and l have across
    // it, or by wo x l.
    VNDF_REAL square_x = VNDF_FMA(wo_x, wo_x, c.lx * c.lx), square_y = VNDF_FMA(c.ly, c.ly, wo_y * wo_y),
              square_z = VNDF_FMA(wo_z, wo_z, c.lz * c.lz);
    VNDF_REAL ox = vndf_impl_difference_of_products(wo_y, c.lz, wo_z, c.ly),
              oy = vndf_impl_difference_of_products(wo_z, c.lx, wo_x, c.lz),
              oz = vndf_impl_difference_of_products(wo_x, c.ly, wo_y, c.lx);
    // Each one sum of two products, whose factors are chosen first: of three alike choices of sums two would be packed
    // (impl/stretch.h).
    VNDF_REAL minor_x = vndf_impl_cap_minor(c, c.sum_x, square_y + square_z, (xx - yy) - zz, ox);
    VNDF_REAL minor_y = vndf_impl_cap_minor(c, minor_x < VNDF_REAL_MAX ? c.sum_y : c.sum_x,
                                            square_z + square_x, (yy - zz) - xx, oy);
    VNDF_REAL minor_z = vndf_impl_cap_minor(c, minor_y < VNDF_REAL_MAX ? c.sum_z : c.sum_y,
                                            square_x + square_y, (zz - xx) - yy, oz);
    q.m = VNDF_FMA(y2, minor_x, VNDF_FMA(x2, minor_y, x2 * y2 * minor_z));
    q.d = x2 * y2 * square * c.kappa;
    return q;
}

// Halley's step, from above and to above the root.
VNDF_FN VNDF_REAL vndf_impl_cap_halley(VNDF_REAL x, struct vndf_impl_cubic q) {
    VNDF_REAL f = VNDF_FMA(VNDF_FMA(x - q.t, x, q.m), x, -q.d);
    VNDF_REAL slope = VNDF_FMA(VNDF_FMA(VNDF_R(3.0), x, VNDF_R(-2.0) * q.t), x, q.m);
    VNDF_REAL den = VNDF_FMA(slope, slope, -f * VNDF_FMA(VNDF_R(3.0), x, -q.t));
    return den > VNDF_R(0.0) ? VNDF_FMA(-f, VNDF_DIVIDE(slope, den), x) : x;
}

// The positive root, for d > 0.
VNDF_FN VNDF_REAL vndf_impl_cap_mu(struct vndf_impl_cubic q, VNDF_REAL reach) {
    VNDF_REAL above = (q.t + VNDF_R(2.0) * reach) * VNDF_R(0.333333333333333333333);
    // For t <= 0 also the root without the cube.
    VNDF_REAL t = vndf_impl_min(q.t, VNDF_R(0.0)), square = VNDF_FMA(q.m, q.m, VNDF_R(-4.0) * t * q.d);
    VNDF_REAL root = VNDF_SQRT(square), sum = root + vndf_impl_abs(q.m);
    int rising = q.m > VNDF_R(0.0);
    VNDF_REAL num = rising ? VNDF_R(2.0) * q.d : sum, den = rising ? sum : VNDF_R(-2.0) * t;
    int quotient = q.t <= VNDF_R(0.0) && num < above * den;
    VNDF_REAL x = quotient ? VNDF_DIVIDE(num, quotient ? den : VNDF_R(1.0)) : above;
    x = vndf_impl_cap_halley(x, q);
    x = vndf_impl_cap_halley(x, q);
#if VNDF_DOUBLE
    x = vndf_impl_cap_halley(x, q);
    x = vndf_impl_cap_halley(x, q);
#endif
    return vndf_impl_cap_halley(x, q);
}

// The axis e0 and the eigenvalues, Q times a power of two. (x, y, z) = A wo; q = omega v - w, across e0.
struct vndf_impl_cap_cone {
    VNDF_REAL x, y, z;
    VNDF_REAL ex, ey, ez, size;  // e0, a unit vector; N e0 times size is omega v + w
    VNDF_REAL wide_x, wide_y;    // e0 times its length before
    VNDF_REAL length, along;     // 1 / (v . e0), v . e0
    VNDF_REAL qx, qy, qz;
    VNDF_REAL mu, kappa, omega, scale;  // scale: the power of two
    VNDF_REAL rcp;                      // 1 / (omega mu)
    VNDF_REAL sum, product;             // (mu + mu1)(mu + mu2), mu1 mu2
    int inside;                         // kappa > 0: -wo is outside the cap
};
VNDF_FN struct vndf_impl_cap_cone vndf_impl_cap_cone_of(struct vndf_impl_cap c, VNDF_REAL wo_x,
                                                        VNDF_REAL wo_y, VNDF_REAL wo_z, VNDF_REAL alpha_x,
                                                        VNDF_REAL alpha_y) {
    struct vndf_impl_cap_cone k;
    VNDF_REAL x2 = alpha_x * alpha_x, y2 = alpha_y * alpha_y;
    k.inside = c.kappa > (c.wide ? VNDF_R(0.0) : VNDF_IMPL_CAP_EDGE * c.gap) && c.defined;
    struct vndf_impl_cubic q = vndf_impl_cap_cubic(c, wo_x, wo_y, wo_z, x2, y2);
    VNDF_REAL reach2 = VNDF_FMA(q.t, q.t, VNDF_R(-3.0) * q.m);
    VNDF_REAL reach = VNDF_SQRT(vndf_impl_max(reach2, VNDF_IMPL_LEAST));
    VNDF_REAL scale = vndf_impl_scale(reach);
    q.t *= scale;
    q.m *= scale * scale;
    q.d = q.d * scale * (scale * scale);
    q.d = k.inside ? q.d : VNDF_R(1.0);
    k.mu = vndf_impl_cap_mu(q, reach * scale);
    k.scale = scale;
    k.kappa = c.kappa * scale;
    k.x = alpha_x * wo_x;
    k.y = alpha_y * wo_y;
    k.z = wo_z;
    // N = mu + kappa A^2, and v^T v, w^T w over it.
    VNDF_REAL nx = VNDF_FMA(k.kappa, x2, k.mu), ny = VNDF_FMA(k.kappa, y2, k.mu), nz = k.kappa + k.mu;
    // By one quotient, of nx near 1: as they are, nx ny may be less than numbers get.
    VNDF_REAL up = vndf_impl_scale(nx), one = nx * up, rcp = VNDF_DIVIDE(VNDF_R(1.0), one * ny),
              gx = ny * rcp * up, gy = rcp * one, gz = VNDF_DIVIDE(VNDF_R(1.0), nz);
    VNDF_REAL hx = x2 * gx, hy = gy * y2;
    VNDF_REAL vv = VNDF_FMA(hx * wo_x, wo_x, VNDF_FMA(hy * wo_y, wo_y, gz * wo_z * wo_z));
    VNDF_REAL ww = VNDF_FMA(hx * c.lx, c.lx, VNDF_FMA(hy * c.ly, c.ly, gz * c.lz * c.lz));
    // omega = sqrt(ww / vv), and omega - 1 from sums and differences: omega v + w = v + w + (omega - 1) v.
    VNDF_REAL rise =
        VNDF_FMA(hx * c.more_x, c.sum_x, VNDF_FMA(hy * c.more_y, c.sum_y, gz * c.more_z * c.sum_z));
    VNDF_REAL root = VNDF_SQRT(ww * vv), more = k.inside ? VNDF_DIVIDE(rise, root + vv) : VNDF_R(0.0);
    k.omega = VNDF_R(1.0) + more;
    VNDF_REAL ex = alpha_x * gx * VNDF_FMA(more, wo_x, c.sum_x),
              ey = alpha_y * gy * VNDF_FMA(more, wo_y, c.sum_y), ez = gz * VNDF_FMA(more, wo_z, c.sum_z);
    ex = k.inside ? ex : k.x;
    ey = k.inside ? ey : k.y;
    ez = k.inside ? ez : k.z;
    k.wide_x = ex;
    k.wide_y = ey;
    k.size = VNDF_SQRT(VNDF_FMA(ex, ex, VNDF_FMA(ey, ey, ez * ez)));
    // One feeds the other, which waits for its root (impl/stretch.h).
    k.mu = k.inside ? k.mu : VNDF_R(1.0);
    k.rcp = VNDF_DIVIDE(VNDF_R(1.0), k.omega * k.mu);
    VNDF_REAL rcp_e =
        VNDF_DIVIDE(VNDF_R(1.0), k.size > VNDF_R(0.0) && k.rcp > VNDF_R(0.0) ? k.size : VNDF_R(1.0));
    k.length = k.inside ? k.size * scale : rcp_e;
    k.along = k.inside ? rcp_e * vndf_impl_rcp_power(scale) : k.size;
    k.ex = ex * rcp_e;
    k.ey = ey * rcp_e;
    k.ez = ez * rcp_e;
    k.qx = k.inside ? alpha_x * VNDF_FMA(more, wo_x, -c.more_x) : VNDF_R(0.0);
    k.qy = k.inside ? VNDF_FMA(more, wo_y, -c.more_y) * alpha_y : VNDF_R(0.0);
    k.qz = k.inside ? VNDF_FMA(more, wo_z, -c.more_z) : VNDF_R(0.0);
    k.kappa = k.inside ? k.kappa : VNDF_R(0.0);
    k.product = k.inside ? q.d * (k.rcp * k.omega) : VNDF_R(0.0);
    k.sum = VNDF_FMA(k.mu, k.inside ? VNDF_R(2.0) * k.mu - q.t : VNDF_R(1.0), k.product);
    return k;
}

VNDF_END

#endif
