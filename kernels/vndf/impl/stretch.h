// The stretched view direction, and what GGX is in it.
//
// Internals take and return scalars: vector arithmetic in a body keeps CPU devices from vectorising a kernel.
#ifndef VNDF_IMPL_STRETCH_H
#define VNDF_IMPL_STRETCH_H

#include "range.h"
#include "vector.h"

VNDF_BEGIN

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
    VNDF_REAL z, r, l;  // |v|, and the length of its tangential part
};

// Squares of alpha wo.x are formed 2^27 times larger: they keep full precision down to wo.x = 1e-19 for every
// alpha in the domain, and the largest, (2^27 1e3)^2, is far from overflow. Each root feeds the next: LLVM
// packs independent roots into short vectors, and the kernel around them is then not vectorised.
VNDF_FN struct vndf_impl_view vndf_impl_view_of(VNDF_REAL vx, VNDF_REAL vy, VNDF_REAL vz) {
    struct vndf_impl_view v;
    VNDF_REAL kx = vx * VNDF_R(134217728.0), ky = vy * VNDF_R(134217728.0);
    VNDF_REAL kl = VNDF_SQRT(VNDF_FMA(kx, kx, ky * ky));
    v.z = vz;
    v.l = kl * VNDF_R(7.450580596923828125e-09);
    v.r = VNDF_SQRT(VNDF_FMA(v.l, v.l, vz * vz));
    return v;
}

// Twice the projected area that v sees in front of the surface, r + |z|, and behind it, l^2 / (r + |z|), where r + z would
// cancel. Never infinite, whatever the length of v; NaN stays.
VNDF_FN VNDF_REAL vndf_impl_front_area(struct vndf_impl_view v) {
    return vndf_impl_min(v.r + vndf_impl_abs(v.z), VNDF_REAL_MAX);
}
VNDF_FN VNDF_REAL vndf_impl_hidden_area(struct vndf_impl_view v) {
    VNDF_REAL sum = vndf_impl_front_area(v), l = vndf_impl_min(v.l, sum);
    return l * VNDF_DIVIDE(l, sum);
}

// q of D = 1 / (pi alpha_x alpha_y q^2), for a normal (x, y, z). D takes it squared, so each quotient carries its
// rounding error along.
VNDF_FN VNDF_REAL vndf_impl_ggx_q(VNDF_REAL x, VNDF_REAL y, VNDF_REAL z, VNDF_REAL alpha_x,
                                  VNDF_REAL alpha_y) {
    VNDF_REAL rcp_x = VNDF_DIVIDE(VNDF_R(1.0), alpha_x), rcp_y = VNDF_DIVIDE(VNDF_R(1.0), alpha_y),
              sx = x * rcp_x, sy = y * rcp_y;
    VNDF_REAL low_x = VNDF_FMA(-sx, alpha_x, x) * rcp_x, low_y = VNDF_FMA(-sy, alpha_y, y) * rcp_y;
    VNDF_REAL low = VNDF_R(2.0) * VNDF_FMA(sx, low_x, sy * low_y);
    return VNDF_FMA(sx, sx, VNDF_FMA(sy, sy, VNDF_FMA(z, z, low)));
}

// 2 sigma = z + t, or l^2 / (t - z) for z < 0, where the sum would cancel.
VNDF_FN VNDF_REAL vndf_impl_ggx_twice_sigma(VNDF_REAL x, VNDF_REAL y, VNDF_REAL z, VNDF_REAL alpha_x,
                                            VNDF_REAL alpha_y) {
    struct vndf_impl_view v = vndf_impl_view_of(alpha_x * x, alpha_y * y, z);
    return z >= VNDF_R(0.0) ? vndf_impl_front_area(v) : vndf_impl_hidden_area(v);
}

// Unstretches h, a normal of any length in the stretched frame, and normalises it. The density of the result
// is weight |g|^3 / (pi alpha_x alpha_y |h|^4), g = (alpha_x h.x, alpha_y h.y, h.z): dividing by the length
// that h has, not by the one it should have, keeps the density accurate.
VNDF_FN struct vndf_impl_sample vndf_impl_ggx_unstretch(VNDF_REAL hx, VNDF_REAL hy, VNDF_REAL hz,
                                                        VNDF_REAL alpha_x, VNDF_REAL alpha_y,
                                                        VNDF_REAL weight) {
    struct vndf_impl_sample m;
    VNDF_REAL gx = alpha_x * hx, gy = alpha_y * hy;
    VNDF_REAL length2 = VNDF_FMA(gx, gx, VNDF_FMA(gy, gy, hz * hz));
    VNDF_REAL length = VNDF_SQRT(length2), rcp = VNDF_DIVIDE(VNDF_R(1.0), length);
    // length2 = 0 needs h = 0, the reflection of wo into -wo: no normal is defined, density 0.
    int defined = length2 > VNDF_R(0.0);
    m.x = defined ? gx * rcp : VNDF_R(0.0);
    m.y = defined ? gy * rcp : VNDF_R(0.0);
    m.z = defined ? hz * rcp : VNDF_R(1.0);
    VNDF_REAL h2 = VNDF_FMA(hx, hx, VNDF_FMA(hy, hy, hz * hz)), ratio = VNDF_DIVIDE(length2, h2);
    VNDF_REAL pdf = VNDF_DIVIDE(VNDF_1_PI * (weight * ratio * length), h2 * alpha_x * alpha_y);
    m.pdf = defined && weight > VNDF_R(0.0) ? vndf_impl_finite(pdf) : VNDF_R(0.0);
    return m;
}

VNDF_END

#endif
