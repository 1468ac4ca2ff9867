// Projected areas of regions of stretched normals between arcs: each the image of a part of a great circle of reflections.
//
// Source: this package; derivation and how to verify it: ggx_cone2026.md, 3. None found published, in a short search.
//     A region whose boundary runs through the unit normals m has the vector area V = 1/2 sum of the integrals of m x dm, and
//     v = A wo sees v . V / pi of it. Along a great circle of reflections m runs on the rim of a cone (impl/cap_cone.h),
//     m = (M, p cos phi, q sin phi) in its axes, and an arc from m_a to m_b has 1/2 m_a x m_b, which is the triangle to the
//     origin, and the segment between arc and chord,
//         1/2 (p q (d - sin d), -q P^2 / k (e - sin e), p Q^2 / k (f - sinh f)),
//     d, e, f the differences of phi, asin(k sin(phi) / P) and asinh(k cos(phi) / Q), P^2 = 1 - p^2, Q^2 = 1 - q^2, k^2 = P^2 -
//     Q^2. All of their sines are parts of the one vector m_a x m_b, so that what is small is not a difference of large numbers.
#ifndef VNDF_GGX_CONE2026_ARC_H
#define VNDF_GGX_CONE2026_ARC_H

#include "ggx_cone2026.h"

VNDF_BEGIN

// (atan(t) / t - 1 / (1 + t^2)) / t^2 for z = t^2 in [-1/4, 1/4]. Accuracy: 2 / 2.
VNDF_FN VNDF_REAL vndf_impl_segment(VNDF_REAL z) {
#define VNDF_IMPL_FIRST(c) VNDF_REAL p = VNDF_R(c);
#define VNDF_IMPL_NEXT(c) p = VNDF_FMA(p, z, VNDF_R(c));
    VNDF_IMPL_SEGMENT(VNDF_IMPL_FIRST, VNDF_IMPL_NEXT)
#undef VNDF_IMPL_FIRST
#undef VNDF_IMPL_NEXT
    return p;
}

// d - sin d over the sine's unit, d in (-pi, pi], of the angle of (cosine, sine), both times `unit`: times unit^3 / 2, as
// tangent^3 times a segment, tangent = unit tan(d / 2), where it is small.
VNDF_FN VNDF_REAL vndf_impl_arc_rest(VNDF_REAL cosine, VNDF_REAL sine) {
    VNDF_REAL size = VNDF_SQRT(VNDF_FMA(cosine, cosine, sine * sine)), sum = size + vndf_impl_abs(cosine);
    VNDF_REAL t = VNDF_DIVIDE(sine, sum > VNDF_R(0.0) ? sum : VNDF_R(1.0)), z = t * t;
    VNDF_REAL turn = vndf_impl_turn(cosine, sine);
    turn = turn > VNDF_R(0.5) ? turn - VNDF_R(1.0) : turn;
    VNDF_REAL rest =
        VNDF_FMA(VNDF_R(2.0) * VNDF_PI, turn, -VNDF_DIVIDE(sine, size > VNDF_R(0.0) ? size : VNDF_R(1.0)));
    int little = cosine > VNDF_R(0.0) && z < VNDF_R(0.25);
    return little ? VNDF_R(2.0) * t * z * vndf_impl_segment(vndf_impl_min(z, VNDF_R(0.25))) : rest;
}

// In float an alpha counts as at least 1e-6 and 2^-17 of the other, below which nothing is left of the digits of a cone; areas
// are as far off as that part of them.
VNDF_FN VNDF_REAL vndf_impl_arc_alpha(VNDF_REAL alpha, VNDF_REAL other) {
    VNDF_REAL least = VNDF_DOUBLE ? VNDF_R(0.0) : VNDF_FMA(other, VNDF_R(7.62939453125e-06), VNDF_R(1e-6));
    return vndf_impl_max(alpha, least);
}

// A stretched normal of unit length, and the reciprocal of the length that it had.
struct vndf_impl_arc_end {
    VNDF_REAL x, y, z, rcp;
};
VNDF_FN struct vndf_impl_arc_end vndf_impl_arc_end_of(VNDF_REAL hx, VNDF_REAL hy, VNDF_REAL hz,
                                                      VNDF_REAL alpha_x, VNDF_REAL alpha_y) {
    struct vndf_impl_arc_end e;
    VNDF_REAL sx = VNDF_DIVIDE(hx, alpha_x), sy = VNDF_DIVIDE(hy, alpha_y);
    VNDF_REAL length2 = VNDF_FMA(sx, sx, VNDF_FMA(sy, sy, hz * hz));
    e.rcp = VNDF_DIVIDE(VNDF_R(1.0), VNDF_SQRT(length2 > VNDF_R(0.0) ? length2 : VNDF_R(1.0)));
    e.x = sx * e.rcp;
    e.y = sy * e.rcp;
    e.z = hz * e.rcp;
    return e;
}

#if VNDF_DOUBLE
#define VNDF_IMPL_ARC_LEAST VNDF_R(8.67361737988403547206e-19)  // 2^-60
#else
#define VNDF_IMPL_ARC_LEAST VNDF_R(9.31322574615478515625e-10)  // 2^-30
#endif

// The axis of a cone again, across q and N (v x w): where v and w point apart omega v + w is the difference of large numbers.
VNDF_FN struct vndf_impl_cap_cone vndf_impl_cap_axis_apart(struct vndf_impl_cap_cone k,
                                                           struct vndf_impl_cap c, VNDF_REAL3 wo,
                                                           VNDF_REAL alpha_x, VNDF_REAL alpha_y) {
    VNDF_REAL x2 = alpha_x * alpha_x, y2 = alpha_y * alpha_y;
    struct vndf_impl_vector w = vndf_impl_cross(wo, VNDF_MAKE3(c.lx, c.ly, c.lz));
    // N (v x w) / (alpha_x alpha_y), times alpha_x and alpha_y.
    VNDF_REAL nx = alpha_y * (VNDF_FMA(k.kappa, x2, k.mu) * w.x),
              ny = VNDF_FMA(k.kappa, y2, k.mu) * (w.y * alpha_x),
              nz = (k.kappa + k.mu) * w.z * (alpha_x * alpha_y);
    VNDF_REAL ex = vndf_impl_difference_of_products(ny, k.qz, nz, k.qy),
              ey = vndf_impl_difference_of_products(nz, k.qx, nx, k.qz),
              ez = vndf_impl_difference_of_products(nx, k.qy, ny, k.qx);
    VNDF_REAL size2 = VNDF_FMA(ex, ex, VNDF_FMA(ey, ey, ez * ez)),
              rcp = VNDF_DIVIDE(VNDF_R(1.0), VNDF_SQRT(vndf_impl_max(size2, VNDF_IMPL_LEAST)));
    int apart = VNDF_FMA(x2 * wo.x, c.lx, VNDF_FMA(y2 * wo.y, c.ly, wo.z * c.lz)) < VNDF_R(0.0) &&
                size2 > VNDF_IMPL_LEAST;
    // omega itself, which may be next to nothing.
    VNDF_REAL gx = VNDF_DIVIDE(x2, VNDF_FMA(k.kappa, x2, k.mu)),
              gy = VNDF_DIVIDE(y2, rcp > VNDF_R(0.0) ? VNDF_FMA(k.kappa, y2, k.mu) : VNDF_R(1.0)),
              gz = VNDF_DIVIDE(VNDF_R(1.0), gy > VNDF_R(0.0) ? k.kappa + k.mu : VNDF_R(1.0));
    VNDF_REAL vv = VNDF_FMA(gx * wo.x, wo.x, VNDF_FMA(gy * wo.y, wo.y, gz * wo.z * wo.z));
    VNDF_REAL ww = VNDF_FMA(gx * c.lx, c.lx, VNDF_FMA(gy * c.ly, c.ly, gz * c.lz * c.lz));
    VNDF_REAL omega = VNDF_SQRT(VNDF_DIVIDE(ww, vv > VNDF_R(0.0) ? vv : VNDF_R(1.0)));
    int defined = k.inside && omega > VNDF_R(0.0);
    k.omega = defined ? omega : k.omega;
    k.rcp = defined ? VNDF_DIVIDE(VNDF_R(1.0), omega * k.mu) : k.rcp;
    k.ex = apart ? ex * rcp : k.ex;
    k.ey = apart ? ey * rcp : k.ey;
    k.ez = apart ? ez * rcp : k.ez;
    return k;
}

// An arc of reflections: from one to another, unit vectors, counter-clockwise about l, of any length.
struct vndf_impl_arc {
    struct vndf_impl_vector from, to, l;
};
VNDF_FN struct vndf_impl_arc vndf_impl_arc_choice(int other, struct vndf_impl_arc a, struct vndf_impl_arc b) {
    a.from = vndf_impl_vector_of(other ? b.from.x : a.from.x, other ? b.from.y : a.from.y,
                                 other ? b.from.z : a.from.z);
    a.to = vndf_impl_vector_of(other ? b.to.x : a.to.x, other ? b.to.y : a.to.y, other ? b.to.z : a.to.z);
    a.l = vndf_impl_vector_of(other ? b.l.x : a.l.x, other ? b.l.y : a.l.y, other ? b.l.z : a.l.z);
    return a;
}

// pi times what v sees of the region to the left of an arc of a circle about l; negative to the right. The region is bounded by the
// arc and by straight lines from its ends to the origin.
VNDF_FN VNDF_REAL vndf_impl_arc_area(VNDF_REAL3 wo, VNDF_REAL alpha_x, VNDF_REAL alpha_y,
                                     struct vndf_impl_arc arc, VNDF_REAL one_minus_cos) {
    struct vndf_impl_vector from = arc.from, to = arc.to, l_of = arc.l;
    // With -wo in the cap the same arc backwards, about -l.
    VNDF_REAL kappa =
        vndf_impl_cap_of(wo.x, wo.y, wo.z, VNDF_MAKE3(l_of.x, l_of.y, l_of.z), one_minus_cos).kappa;
    int turned = kappa < VNDF_R(0.0);
    VNDF_REAL ax = turned ? to.x : from.x, ay = turned ? to.y : from.y, az = turned ? to.z : from.z;
    VNDF_REAL bx = turned ? from.x : to.x, by = turned ? from.y : to.y, bz = turned ? from.z : to.z;
    VNDF_REAL side = turned ? VNDF_R(-1.0) : VNDF_R(1.0);
    struct vndf_impl_cap cap =
        vndf_impl_cap_of(wo.x, wo.y, wo.z, VNDF_MAKE3(side * l_of.x, side * l_of.y, side * l_of.z),
                         turned ? VNDF_R(2.0) - one_minus_cos : one_minus_cos);
    // Edge-on, wo in the plane: two half planes.
    cap.kappa = vndf_impl_max(vndf_impl_abs(kappa), VNDF_EPSILON * VNDF_EPSILON * cap.wo2);
    struct vndf_impl_cap_cone c = vndf_impl_cap_axis_apart(
        vndf_impl_cap_cone_of(cap, wo.x, wo.y, wo.z, alpha_x, alpha_y), cap, wo, alpha_x, alpha_y);
    struct vndf_ggx_conic2026 l;
    l.alpha_x = alpha_x;
    l.alpha_y = alpha_y;
    l = vndf_impl_cap_axes(l, c);
    VNDF_REAL p = vndf_impl_max(vndf_impl_abs(l.step_1), VNDF_IMPL_ARC_LEAST),
              q = vndf_impl_max(vndf_impl_abs(l.step_2), VNDF_IMPL_ARC_LEAST);
    VNDF_REAL co_q2 = l.rim_0, k2 = l.rim_1, co_p2 = co_q2 + k2, root_k = VNDF_SQRT(k2);
    VNDF_REAL root = VNDF_SQRT(root_k >= VNDF_R(0.0) ? l.spread : VNDF_R(1.0));
    VNDF_REAL e1x = l.e1x * root, e1y = l.e1y * root, e1z = l.e1z * root;
    VNDF_REAL e2x = l.e2x * root, e2y = l.e2y * root, e2z = l.e2z * root;
    // The ends, and their vector product from (wo + a) x (b - a), which keeps the digits of a short arc.
    struct vndf_impl_arc_end a = vndf_impl_arc_end_of(wo.x + ax, wo.y + ay, wo.z + az, alpha_x, alpha_y);
    struct vndf_impl_arc_end b =
        vndf_impl_arc_end_of(a.rcp > VNDF_R(0.0) ? wo.x + bx : wo.x, wo.y + by, wo.z + bz, alpha_x, alpha_y);
    struct vndf_impl_vector w =
        vndf_impl_cross(VNDF_MAKE3(wo.x + ax, wo.y + ay, wo.z + az), VNDF_MAKE3(bx - ax, by - ay, bz - az));
    VNDF_REAL rcp = VNDF_DIVIDE(a.rcp, alpha_x) * VNDF_DIVIDE(b.rcp, alpha_y);
    VNDF_REAL wx = alpha_x * (w.x * rcp), wy = alpha_y * (w.y * rcp), wz = w.z * rcp;
    VNDF_REAL chord = VNDF_FMA(c.x, wx, VNDF_FMA(c.y, wy, c.z * wz));
    VNDF_REAL w0 = VNDF_FMA(c.ex, wx, VNDF_FMA(c.ey, wy, c.ez * wz));
    VNDF_REAL w1 = VNDF_FMA(e1x, wx, VNDF_FMA(e1y, wy, e1z * wz));
    VNDF_REAL w2 = VNDF_FMA(e2x, wx, VNDF_FMA(e2y, wy, e2z * wz));
    VNDF_REAL a1 = VNDF_FMA(e1x, a.x, VNDF_FMA(e1y, a.y, e1z * a.z)),
              b1 = VNDF_FMA(e1x, b.x, VNDF_FMA(e1y, b.y, e1z * b.z));
    VNDF_REAL a2 = VNDF_FMA(e2x, a.x, VNDF_FMA(e2y, a.y, e2z * a.z)),
              b2 = VNDF_FMA(e2x, b.x, VNDF_FMA(e2y, b.y, e2z * b.z));
    VNDF_REAL rcp_p = VNDF_DIVIDE(VNDF_R(1.0), p), rcp_q = VNDF_DIVIDE(VNDF_R(1.0), q);
    a1 *= rcp_p;
    b1 *= rcp_p;
    a2 *= rcp_q;
    b2 *= rcp_q;
    // The height of the rim, M = sqrt(P^2 cos^2 + Q^2 sin^2).
    VNDF_REAL am = VNDF_SQRT(VNDF_FMA(co_p2 * a1, a1, co_q2 * (a2 * a2)));
    VNDF_REAL bm = VNDF_SQRT(VNDF_FMA(co_p2 * b1, b1, co_q2 * (am >= VNDF_R(0.0) ? b2 * b2 : b1)));
    VNDF_REAL heights = am * bm;

    // Around e0: all the way where it ends on the left of its beginning, but not where that may be the rounding of the ends of a
    // great circle's arc, and its middle is as near.
    VNDF_REAL reach = vndf_impl_abs(wx) + vndf_impl_abs(wy) + vndf_impl_abs(wz);
    VNDF_REAL hx = vndf_impl_abs(wo.x + ax), hy = vndf_impl_abs(wo.y + ay), hz = vndf_impl_abs(wo.z + az);
    VNDF_REAL slip =
        VNDF_FMA(vndf_impl_abs(c.ex) * alpha_x, hy + hz,
                 VNDF_FMA(vndf_impl_abs(c.ey) * alpha_y, hx + hz, vndf_impl_abs(c.ez) * (hx + hy)));
    VNDF_REAL sx = ax + bx, sy = ay + by, sz = az + bz, s2 = VNDF_FMA(sx, sx, VNDF_FMA(sy, sy, sz * sz)),
              rcp_s = VNDF_DIVIDE(VNDF_R(1.0), VNDF_SQRT(vndf_impl_max(s2, VNDF_EPSILON)));
    struct vndf_impl_arc_end m = vndf_impl_arc_end_of(VNDF_FMA(sx, rcp_s, wo.x), VNDF_FMA(sy, rcp_s, wo.y),
                                                      VNDF_FMA(sz, rcp_s, wo.z), alpha_x, alpha_y);
    VNDF_REAL m1 = rcp_p * VNDF_FMA(e1x, m.x, VNDF_FMA(e1y, m.y, e1z * m.z)),
              m2 = VNDF_FMA(e2x, m.x, VNDF_FMA(e2y, m.y, e2z * m.z)) * rcp_q;
    VNDF_REAL to_m = VNDF_FMA(a1, m1, a2 * m2), from_m = VNDF_FMA(b2, m2, b1 * m1);
    int near_m = to_m > VNDF_R(0.9) && from_m > VNDF_R(0.9) && s2 > VNDF_R(1.0) &&
                 one_minus_cos == VNDF_R(1.0) && w0 > VNDF_R(-8.0) * VNDF_EPSILON * (slip * rcp);
    VNDF_REAL around = vndf_impl_arc_rest(VNDF_FMA(a1, b1, a2 * b2), w0 * (rcp_p * rcp_q));
    around += w0 < VNDF_R(-8.0) * VNDF_EPSILON * reach && !near_m ? VNDF_R(2.0) * VNDF_PI : VNDF_R(0.0);
    VNDF_REAL area = p * q * around * VNDF_R(0.5);

    VNDF_REAL less_k = VNDF_DIVIDE(VNDF_R(1.0), vndf_impl_max(root_k, VNDF_IMPL_ARC_LEAST));
    // Along e1, divided by k^2 where little is left of the angle.
    VNDF_REAL cosine = VNDF_FMA(k2, a2 * b2, heights), over = -w1 * rcp_q, sine = root_k * over;
    VNDF_REAL size = VNDF_SQRT(VNDF_FMA(cosine, cosine, sine * sine)), sum = size + vndf_impl_abs(cosine);
    VNDF_REAL t = VNDF_DIVIDE(over, sum > VNDF_R(0.0) ? sum : VNDF_R(1.0)), t2 = t * t, z = k2 * t2;
    VNDF_REAL little = k2 * (t * t2) * vndf_impl_segment(vndf_impl_min(z, VNDF_R(0.25)));
    VNDF_REAL large = VNDF_R(0.5) * less_k * vndf_impl_arc_rest(cosine, sine);
    VNDF_REAL first = q * co_p2 * (cosine > VNDF_R(0.0) && z < VNDF_R(0.25) ? little : large);

    // Along e2, hyperbolic.
    VNDF_REAL cc = k2 * (a1 * b1);
    VNDF_REAL both = VNDF_FMA(k2 * co_q2, VNDF_FMA(a1, a1, b1 * b1), co_q2 * co_q2);
    VNDF_REAL cosh_q =
        cc > VNDF_R(0.0) ? VNDF_DIVIDE(both, cc > VNDF_R(0.0) ? heights + cc : VNDF_R(1.0)) : heights - cc;
    VNDF_REAL h = VNDF_DIVIDE(w2 * rcp_p, vndf_impl_max(cosh_q + co_q2, VNDF_IMPL_LEAST)), h2 = h * h,
              y = k2 * h2;
    VNDF_REAL sinh_q = root_k * (w2 * rcp_p);
    VNDF_REAL log_q = vndf_impl_log(vndf_impl_max(
        VNDF_DIVIDE(cosh_q + vndf_impl_abs(sinh_q), vndf_impl_max(co_q2, VNDF_IMPL_LEAST)), VNDF_R(1.0)));
    VNDF_REAL outer = VNDF_R(0.5) * VNDF_FMA(p * co_q2 * less_k, sinh_q < VNDF_R(0.0) ? -log_q : log_q, -w2);
    VNDF_REAL inner = -p * co_q2 * k2 * (h * h2) * vndf_impl_segment(-vndf_impl_min(y, VNDF_R(0.25)));
    VNDF_REAL second = y < VNDF_R(0.25) ? inner : outer;

    VNDF_REAL v0 = VNDF_FMA(c.x, c.ex, VNDF_FMA(c.y, c.ey, c.z * c.ez));
    VNDF_REAL v1 = VNDF_FMA(c.x, e1x, VNDF_FMA(c.y, e1y, c.z * e1z));
    VNDF_REAL v2 = VNDF_FMA(c.x, e2x, VNDF_FMA(c.y, e2y, c.z * e2z));
    VNDF_REAL seen = VNDF_FMA(v0, area, VNDF_FMA(-v1, first, VNDF_FMA(v2, second, VNDF_R(0.5) * chord)));
    // Of alphas next to 1e-8, whose squares leave the range of numbers, nothing.
    int known = vndf_impl_abs(seen) <= VNDF_REAL_MAX;
    return c.inside && known ? side * seen : VNDF_R(0.0);
}

// The same of an arc of the horizon of normals, m.z = 0, from one half vector to another, less than half a turn.
VNDF_FN VNDF_REAL vndf_impl_level_area(VNDF_REAL wo_z, VNDF_REAL alpha_x, VNDF_REAL alpha_y, VNDF_REAL ax,
                                       VNDF_REAL ay, VNDF_REAL bx, VNDF_REAL by) {
    VNDF_REAL across = vndf_impl_difference_of_products(ax, by, ay, bx) * (alpha_x * alpha_y);
    VNDF_REAL along = VNDF_FMA(ax * bx, alpha_y * alpha_y, ay * by * (alpha_x * alpha_x));
    VNDF_REAL turn = vndf_impl_turn(along, across);
    return VNDF_PI * wo_z * (turn > VNDF_R(0.5) ? turn - VNDF_R(1.0) : turn);
}

// The part of a cap's rim that is above -wo.z, whose normals are above the surface: an arc about an axis, with -wo outside of the
// cap, which is turned over where it is not.
struct vndf_impl_rim {
    struct vndf_impl_cap cap;
    struct vndf_impl_arc arc;
    VNDF_REAL gap;        // 1 - cos of the cap about the arc's l
    int crosses, turned;  // crosses: there is such an arc
};
VNDF_FN struct vndf_impl_rim vndf_impl_rim_of(VNDF_REAL3 wo, VNDF_REAL3 l, VNDF_REAL one_minus_cos) {
    struct vndf_impl_rim r;
    VNDF_REAL kappa = vndf_impl_cap_of(wo.x, wo.y, wo.z, l, one_minus_cos).kappa;
    r.turned = kappa < VNDF_R(0.0);
    VNDF_REAL side = r.turned ? VNDF_R(-1.0) : VNDF_R(1.0);
    r.gap = r.turned ? VNDF_R(2.0) - one_minus_cos : one_minus_cos;
    r.arc.l = vndf_impl_vector_of(side * l.x, side * l.y, side * l.z);
    r.cap = vndf_impl_cap_of(wo.x, wo.y, wo.z, VNDF_MAKE3(r.arc.l.x, r.arc.l.y, r.arc.l.z), r.gap);
    r.cap.kappa = vndf_impl_max(vndf_impl_abs(kappa), VNDF_EPSILON * VNDF_EPSILON * r.cap.wo2);
    // Where it has the height -wo.z: along its azimuth, and to either side.
    VNDF_REAL across2 = VNDF_FMA(r.cap.lx, r.cap.lx, r.cap.ly * r.cap.ly),
              rcp = VNDF_DIVIDE(VNDF_R(1.0), VNDF_SQRT(across2 > VNDF_R(0.0) ? across2 : VNDF_R(1.0)));
    VNDF_REAL dx = r.cap.lx * rcp, dy = r.cap.ly * rcp, along = VNDF_FMA(wo.z, r.cap.lz, r.cap.cosine) * rcp;
    VNDF_REAL rest = VNDF_FMA(wo.x, wo.x, VNDF_FMA(wo.y, wo.y, -along * along));
    r.crosses = rest > VNDF_R(0.0) && across2 > VNDF_R(0.0);
    VNDF_REAL off = VNDF_SQRT(r.crosses ? rest : VNDF_R(0.0));
    r.arc.from.x = VNDF_FMA(along, dx, -off * dy);
    r.arc.from.y = VNDF_FMA(along, dy, off * dx);
    r.arc.to.x = VNDF_FMA(along, dx, off * dy);
    r.arc.to.y = VNDF_FMA(along, dy, -off * dx);
    r.arc.from.z = r.arc.to.z = -wo.z;
    return r;
}

// What v sees of the normals above the surface that reflect wo into the cap. area: vndf_impl_arc_area of that part of the rim.
VNDF_FN VNDF_REAL vndf_impl_rim_mass(struct vndf_impl_rim r, VNDF_REAL3 wo, VNDF_REAL alpha_x,
                                     VNDF_REAL alpha_y, VNDF_REAL area) {
    VNDF_REAL level = vndf_impl_level_area(wo.z, alpha_x, alpha_y, wo.x + r.arc.to.x, wo.y + r.arc.to.y,
                                           wo.x + r.arc.from.x, wo.y + r.arc.from.y);
    struct vndf_impl_cap_cone c = vndf_impl_cap_axis_apart(
        vndf_impl_cap_cone_of(r.cap, wo.x, wo.y, wo.z, alpha_x, alpha_y), r.cap, wo, alpha_x, alpha_y);
    // On one side of that height altogether.
    VNDF_REAL height = VNDF_FMA(r.cap.lz, r.cap.cosine, wo.z * r.cap.wo2);
    VNDF_REAL whole = height > VNDF_R(0.0) && c.inside ? vndf_impl_cap_sigma(r.cap, c, r.gap) : VNDF_R(0.0);
    VNDF_REAL mass = r.crosses ? VNDF_1_PI * (area + level) : whole;
    VNDF_REAL all = VNDF_R(0.5) * vndf_impl_ggx_twice_sigma(wo.x, wo.y, wo.z, alpha_x, alpha_y);
    mass = r.turned ? all - mass : mass;
    return vndf_impl_min(vndf_impl_max(mass, VNDF_R(0.0)), all);
}

VNDF_END

#endif
