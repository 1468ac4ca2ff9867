// Spherical caps: the polar angle of the stretched view direction, and half vectors of a cap of reflections.
#ifndef VNDF_IMPL_CAPS_H
#define VNDF_IMPL_CAPS_H

#include "stretch.h"

VNDF_BEGIN

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
    VNDF_REAL larger = large_root * large_root, smaller = small_root * small_root;
    int front = v.z >= VNDF_R(0.0);
    cap.z = v.z * (large_root * v.rcp_t);
    cap.sine = v.l * (large_root * v.rcp_t);
    cap.sqrt_p = front ? large_root : small_root;
    cap.sqrt_q = front ? small_root : large_root;
    cap.p = front ? larger : smaller;
    cap.q = front ? smaller : larger;
    cap.tangent = front ? v.rcp_t : large_root * v.rcp_l;
    return cap;
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
    int at_rim = rest < VNDF_R(0.5);
    return VNDF_FMA(at_rim ? -rest : u2, b, at_rim ? z_b : -q);
}

VNDF_END

#endif
