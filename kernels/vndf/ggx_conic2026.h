// GGX reflections without waste: no sample falls below the horizon, and no reflection above it is lost.
//
// Source: this package; derivation, figures and how to verify it: ggx_conic2026.md. No earlier publication was found.
//     In the axes of the cone of impl/cone.h, the stretched normals that reflect above the horizon project onto
//     the ellipse (m1 / p)^2 + (m2 / q)^2 < 1. Three straight moves take the point (p Y, q X) of it to a normal m,
//     and two of them are shears that preserve the projected area s . m:
//       P  = (M, p Y, q X)  on the chord between the two rim points of the slice m1 = p Y, M = m0 at both;
//       P2 = P + epsilon s' on the chord between the two rim points with that component across s', s' = s without s1;
//       m  = P2 + tau s     on the sphere.
//     All three steps are roots of quadratics, written as sums of positive terms.
//     Here every vector is taken along axes of any length, and with them the roots of their lengths go.
// Symbols: those of impl/cone.h, where mu is 1; v = (v0, v1, v2) in the axes e0, e1, e2; p^2 = 1 / (1 + m1),
//     q^2 = 1 / (1 + m2). In the proof of ggx_conic2026.md v is the unit vector s.
#ifndef VNDF_GGX_CONIC2026_H
#define VNDF_GGX_CONIC2026_H

#include "ggx.h"
#include "impl/cone.h"
#include "impl/mirror.h"

VNDF_BEGIN

// --- What both forms share ---

// A point (X, Y) = sqrt(u2) (cosine, sine) of the unit disk by its parts; rest = 1 - u2. The root is left to where it
// is scaled.
struct vndf_impl_disk {
    VNDF_REAL cosine, sine, u2, rest;
};
VNDF_FN struct vndf_impl_disk vndf_impl_disk_of(VNDF_REAL2 u) {
    struct vndf_impl_disk d;
    VNDF_REAL u1 = vndf_impl_u(u.x);
    d.u2 = vndf_impl_u(u.y);
    d.cosine = vndf_impl_circle_cos(u1);
    d.sine = vndf_impl_circle_sin(u1);
    d.rest = VNDF_R(1.0) - d.u2;
    return d;
}

// Behind the surface: the plain cap, which wastes nothing there. (x, y): the tangential part of v times a power of
// two that brings it near 1, 1 / back; l2 its square, area = l2 / (r + |z|); p = r + z in the scale of v, gap = -2 z.
struct vndf_impl_conic_cap {
    VNDF_REAL x, y, l2, area, p, gap, back;
};

// The squared radius of the cap's reflections about z, over u2.
VNDF_FN VNDF_REAL vndf_impl_conic_cap_spread(struct vndf_impl_conic_cap c, VNDF_REAL rest) {
    return VNDF_FMA(rest * c.area, c.p, c.l2);
}

// A stretched normal, and one by its parts along (x, y) and across it, all of any length.
struct vndf_impl_conic_normal {
    VNDF_REAL x, y, z;
};
struct vndf_impl_conic_turned {
    VNDF_REAL in, across, z;
};
VNDF_FN struct vndf_impl_conic_normal vndf_impl_conic_turn(struct vndf_impl_conic_turned m, VNDF_REAL x,
                                                           VNDF_REAL y) {
    struct vndf_impl_conic_normal h;
    h.x = VNDF_FMA(m.in, x, -m.across * y);
    h.y = VNDF_FMA(m.in, y, m.across * x);
    h.z = m.z;
    return h;
}

// The cap's half vector times l2, (ex, ey) the tangential part of the reflection. Where it nearly vanishes, opposite
// to (x, y), it is taken l2 - d times as long, d = (ex, ey) . (x, y), and l2^2 - d^2 as a sum of positive terms.
VNDF_FN struct vndf_impl_conic_turned vndf_impl_conic_cap_half(struct vndf_impl_conic_cap c, VNDF_REAL ex,
                                                               VNDF_REAL ey, VNDF_REAL rest) {
    struct vndf_impl_conic_turned h;
    VNDF_REAL d = VNDF_FMA(ex, c.x, ey * c.y), across = VNDF_FMA(ey, c.x, -ex * c.y), height = rest * c.area;
    int opposite = d < VNDF_R(0.0);
    VNDF_REAL factor = opposite ? c.l2 - d : VNDF_R(1.0);
    VNDF_REAL lacking = c.l2 * height * VNDF_FMA(rest, c.p, c.gap);
    h.in = opposite ? VNDF_FMA(across, across, lacking) : c.l2 + d;
    h.across = factor * across;
    h.z = factor * (height * (c.back * c.l2));
    return h;
}

// A reflection m, moved to (x, y, z), as a unit vector, and its density D / (2 n) for a normaliser n of wo as given.
VNDF_FN struct vndf_impl_sample vndf_impl_conic_unit(struct vndf_impl_mirror m, VNDF_REAL x, VNDF_REAL y,
                                                     VNDF_REAL z, VNDF_REAL alpha_x, VNDF_REAL alpha_y,
                                                     VNDF_REAL n) {
    struct vndf_impl_sample o;
    // Only the direction of wo counts: the length that the mirror kept is divided out.
    VNDF_REAL o2 = VNDF_FMA(x, x, VNDF_FMA(y, y, z * z)), rcp = VNDF_DIVIDE(VNDF_R(1.0), VNDF_SQRT(o2));
    o.x = x * rcp;
    o.y = y * rcp;
    o.z = z * rcp;
    VNDF_REAL pdf = vndf_impl_reflection_density(m.ratio, n * rcp, alpha_x, alpha_y);
    o.pdf = m.defined && n > VNDF_R(0.0) ? vndf_impl_finite(pdf) : VNDF_R(0.0);
    return vndf_impl_where(o2 > VNDF_R(0.0) && o2 <= VNDF_REAL_MAX, o);
}

// The unit reflection of wo about the unstretched normal of h, and its density D / (2 n), n = 2 sigma_vis of wo as
// given. above: whether it is known to be above the surface.
VNDF_FN struct vndf_impl_sample vndf_impl_conic_reflect(struct vndf_impl_conic_normal h, VNDF_REAL wo_x,
                                                        VNDF_REAL wo_y, VNDF_REAL wo_z, VNDF_REAL alpha_x,
                                                        VNDF_REAL alpha_y, VNDF_REAL n, int above) {
    struct vndf_impl_mirror m = vndf_impl_mirror_of(wo_x, wo_y, wo_z, h.x, h.y, h.z, alpha_x, alpha_y);
    // Above the surface the height is positive, and rounding denies it within its error of the horizon alone: mirrored
    // there, which keeps the length, and never 0.
    VNDF_REAL height = vndf_impl_max(vndf_impl_abs(m.z), VNDF_R(0.0625) * VNDF_EPSILON);
    return vndf_impl_conic_unit(m, m.x, m.y, above ? height : m.z, alpha_x, alpha_y, n);
}

// --- The lobe of one wo and alpha ---

// What all samples of a lobe share. Made by vndf_ggx_conic2026_lobe, used by the functions with _lobe in their names;
// its members are internals.
struct vndf_ggx_conic2026 {
    VNDF_REAL wo_x, wo_y, wo_z;
    VNDF_REAL alpha_x, alpha_y;              // clamped
    VNDF_REAL twice_sigma;                   // of sigma_vis
    VNDF_REAL spread, rcp_spread;            // the squared radius of the disk
    VNDF_REAL x, y, z, length2;              // v and its square, mu = 1
    VNDF_REAL e, f, g;                       // parallel to e0; g is 1 but for a cone of ggx_cone2026.h
    VNDF_REAL e1x, e1y, e1z, e2x, e2y, e2z;  // parallel to e1 and e2
    VNDF_REAL step_1, step_2;                // from a radius times a direction to parts along e1 and e2
    VNDF_REAL along_1, along_2;              // v . e1 and v . e2 of these
    VNDF_REAL s0, s2;                        // of v: parts along (e, f, g) and e2
    VNDF_REAL dual_1, dual_2;                // from the product with e1 or e2 to the part along it
    VNDF_REAL rim_0, rim_1;
    VNDF_REAL slope_0, slope_2, share, bend;
    VNDF_REAL unit;  // 1 / mu of v = alpha wo
    struct vndf_impl_conic_cap cap;
};

// e1 and e2 by a half turn: an eigenvector (c, s) of the two by two matrix of impl/cone.h is one of Q as
// (sqrt(bx) c, sqrt(by) s, .), the third component across e0. The larger of c and s is formed as a sum; e2 = e0 x e1.
// The signs are those of v1 >= 0: the axes jump where wo crosses a plane in which v1 vanishes, and turn with wo for
// alpha_x = alpha_y.
VNDF_FN struct vndf_ggx_conic2026 vndf_impl_conic_axes(struct vndf_ggx_conic2026 l, struct vndf_impl_cone c) {
    VNDF_REAL scale = vndf_impl_scale(c.trace), xx = c.xx * scale, yy = c.yy * scale;
    VNDF_REAL poles = c.z * ((l.alpha_x - l.alpha_y) * (l.alpha_x + l.alpha_y));  // ax - ay
    // A round cone has no axes: 1e-18 takes x and y, and nothing from any other.
    VNDF_REAL d = VNDF_FMA(poles, scale, xx - yy) + VNDF_R(1e-18);
    VNDF_REAL size = VNDF_SQRT(VNDF_FMA(d, d, VNDF_R(4.0) * xx * yy)), larger = size + vndf_impl_abs(d);
    VNDF_REAL cross = VNDF_R(2.0) * c.x * (c.y * scale);
    int swap = d < VNDF_R(0.0);
    VNDF_REAL b = swap ? c.by : c.bx, major = b * larger;
    l.e1x = swap ? cross : major;
    l.e1y = swap ? major : cross;
    VNDF_REAL w1 = VNDF_FMA(c.e, l.e1x, c.f * l.e1y);
    l.e1z = -w1;
    l.rcp_spread = VNDF_R(2.0) * size * major;
    VNDF_REAL spread = VNDF_DIVIDE(VNDF_R(1.0), l.rcp_spread);
    l.e2x = -l.e1y * c.bx;
    l.e2y = l.e1x * c.by;
    VNDF_REAL w2 = VNDF_FMA(c.y, l.e1x, -c.x * l.e1y);
    l.e2z = -w2;
    VNDF_REAL gap = size * vndf_impl_rcp_power(scale), m1 = VNDF_R(0.5) * (c.trace + gap);
    VNDF_REAL rcp = VNDF_DIVIDE(VNDF_R(1.0), m1 * c.whole), rcp_whole = rcp * m1,
              m2 = c.product * (rcp * c.whole);
    VNDF_REAL g1 = VNDF_R(1.0) + m1, rcp_g2 = g1 * rcp_whole, rcp_g1 = (VNDF_R(1.0) + m2) * rcp_whole;
    l.s0 = c.poles * rcp_whole;
    l.dual_1 = spread * rcp_g1;
    VNDF_REAL rcp_2 = c.rcp_poles * rcp_g2;
    l.dual_2 = spread * rcp_2;
    l.along_1 = m1 * w1;
    l.along_2 = m2 * w2;
    l.s2 = l.along_2 * l.dual_2;
    l.step_1 = w1 < VNDF_R(0.0) ? -rcp_g1 : rcp_g1;
    VNDF_REAL step_2 = VNDF_SQRT(c.poles) * rcp_2;
    l.step_2 = w1 < VNDF_R(0.0) ? -step_2 : step_2;
    l.rim_0 = vndf_impl_max(l.s0 * (m2 * rcp_g2), VNDF_R(1e-30));  // so that M > 0
    l.rim_1 = l.s0 * (gap * rcp_whole);
    l.slope_0 = g1;
    l.slope_2 = gap * l.along_2;
    l.share = gap * rcp_g2;
    l.bend = VNDF_FMA(g1, l.s0, l.slope_2 * l.s2);
    l.spread = spread;
    return l;
}

VNDF_FN struct vndf_impl_conic_cap vndf_impl_conic_cap_of(struct vndf_impl_cone_view v, VNDF_REAL z) {
    struct vndf_impl_conic_cap cap;
    cap.x = v.x;
    cap.y = v.y;
    cap.l2 = VNDF_FMA(v.x, v.x, v.y * v.y);
    cap.back = vndf_impl_rcp_power(v.scale);
    VNDF_REAL back2 = cap.back * cap.back;
    cap.area = VNDF_DIVIDE(cap.l2, (VNDF_SQRT(VNDF_FMA(z, z, cap.l2 * back2)) + vndf_impl_abs(z)));
    cap.p = cap.area * back2;
    cap.gap = VNDF_R(-2.0) * z;
    return cap;
}

// What the samples of a lobe take beside it.
// lobe: of vndf_ggx_lobe_of.
// return: a struct for vndf_ggx_sample_wi_conic2026_lobe, _lobe_with_pdf and vndf_ggx_pdf_wi_conic2026_lobe.
VNDF_FN struct vndf_ggx_conic2026 vndf_ggx_conic2026_of(struct vndf_ggx_lobe lobe) {
    struct vndf_ggx_conic2026 l;
    l.alpha_x = lobe.alpha_x;
    l.alpha_y = lobe.alpha_y;
    l.wo_x = lobe.wo_x;
    l.wo_y = lobe.wo_y;
    l.wo_z = lobe.wo_z;
    int above = l.wo_z > VNDF_R(0.0);
    struct vndf_impl_cone_view v = vndf_impl_cone_view_of(l.alpha_x * l.wo_x, l.alpha_y * l.wo_y, l.wo_z);
    struct vndf_impl_cone c = vndf_impl_cone_of(v, l.alpha_x, l.alpha_y);
    l = vndf_impl_conic_axes(l, c);
    l.x = c.x;
    l.y = c.y;
    l.z = c.z;
    l.length2 = VNDF_FMA(c.x, c.x, VNDF_FMA(c.y, c.y, c.z * c.z));
    l.e = c.e;
    l.f = c.f;
    l.g = VNDF_R(1.0);
    l.unit = above ? c.unit * v.scale : VNDF_R(1.0);
    l.cap = vndf_impl_conic_cap_of(v, l.wo_z);
    l.cap.x = above ? VNDF_R(0.0) : l.cap.x;
    l.cap.y = above ? VNDF_R(0.0) : l.cap.y;
    l.twice_sigma = above ? VNDF_R(2.0) * vndf_impl_cone_area(c, v.scale) : l.cap.p;
    return l;
}

// The lobe of wo and alpha: all that does not depend on u.
// wo: unit vector, local frame, anywhere on the sphere.
// alpha: in [1e-8, 1e3] each.
// return: as vndf_ggx_conic2026_of, which is faster where a lobe is at hand.
VNDF_FN struct vndf_ggx_conic2026 vndf_ggx_conic2026_lobe(VNDF_REAL3 wo, VNDF_REAL2 alpha) {
    return vndf_ggx_conic2026_of(vndf_ggx_lobe_of(wo, alpha));
}

// The normal of a disk point, (ex, ey) its direction times the radius.
VNDF_FN struct vndf_impl_conic_normal vndf_impl_conic_normal_of(struct vndf_ggx_conic2026 l, VNDF_REAL ex,
                                                                VNDF_REAL ey, VNDF_REAL y2, VNDF_REAL rest) {
    struct vndf_impl_conic_normal h;
    // P on the first chord: parts of e0, e1 and e2 as given.
    VNDF_REAL rim = VNDF_SQRT(VNDF_FMA(l.rim_1, y2, l.rim_0)), m1 = l.step_1 * ey, m2 = l.step_2 * ex;
    // The cone along s': bend e^2 + 2 slope e - share rest = 0.
    VNDF_REAL slope = VNDF_FMA(l.slope_2, m2, l.slope_0 * rim), bend = l.bend * l.share;
    VNDF_REAL root = VNDF_SQRT(VNDF_FMA(slope, slope, bend * rest));
    int rising = slope > VNDF_R(0.0);
    VNDF_REAL step = VNDF_DIVIDE(rising ? rest : root - slope, rising ? slope + root : bend);
    VNDF_REAL epsilon = l.share * step, m0 = VNDF_FMA(epsilon, l.s0, rim);
    m2 = VNDF_FMA(epsilon, l.s2, m2);
    // What is left of the second chord; the sphere along v from P2: length2 tau^2 + 2 along tau - left = 0.
    VNDF_REAL left = step * (rim + m0);
    VNDF_REAL along = VNDF_FMA(l.along_1, m1, VNDF_FMA(l.along_2, m2, m0));
    along = along > VNDF_R(0.0) ? along : VNDF_R(0.0);  // it is, but for rounding
    VNDF_REAL tau = VNDF_DIVIDE(left, (along + VNDF_SQRT(VNDF_FMA(along, along, l.length2 * left))));
    h.x = VNDF_FMA(tau, l.x, VNDF_FMA(m0, l.e, VNDF_FMA(m1, l.e1x, m2 * l.e2x)));
    h.y = VNDF_FMA(tau, l.y, VNDF_FMA(m0, l.f, VNDF_FMA(m1, l.e1y, m2 * l.e2y)));
    h.z = VNDF_FMA(tau, l.z, VNDF_FMA(m1, l.e1z, VNDF_FMA(m2, l.e2z, m0 * l.g)));
    return h;
}

// above: by the cone, not by the plain cap.
VNDF_FN struct vndf_impl_conic_normal vndf_impl_conic_sampled_by(struct vndf_ggx_conic2026 l, VNDF_REAL2 u,
                                                                 int above) {
    struct vndf_impl_disk d = vndf_impl_disk_of(u);
    VNDF_REAL spread = above ? l.spread : vndf_impl_conic_cap_spread(l.cap, d.rest);
    VNDF_REAL radius = VNDF_SQRT(d.u2 * spread), ex = radius * d.cosine, ey = radius * d.sine;
    struct vndf_impl_conic_normal front =
        vndf_impl_conic_normal_of(l, ex, ey, d.u2 * (d.sine * d.sine), d.rest);
    struct vndf_impl_conic_normal h =
        vndf_impl_conic_turn(vndf_impl_conic_cap_half(l.cap, ex, ey, d.rest), l.cap.x, l.cap.y);
    h.x = above ? front.x : h.x;
    h.y = above ? front.y : h.y;
    h.z = above ? front.z : h.z;
    return h;
}
VNDF_FN struct vndf_impl_conic_normal vndf_impl_conic_sampled(struct vndf_ggx_conic2026 l, VNDF_REAL2 u) {
    return vndf_impl_conic_sampled_by(l, u, l.wo_z > VNDF_R(0.0));
}
VNDF_FN struct vndf_impl_sample vndf_impl_conic2026(struct vndf_ggx_conic2026 l, VNDF_REAL2 u) {
    return vndf_impl_conic_reflect(vndf_impl_conic_sampled(l, u), l.wo_x, l.wo_y, l.wo_z, l.alpha_x,
                                   l.alpha_y, l.twice_sigma, l.wo_z > VNDF_R(0.0));
}

// A reflection of a lobe: as vndf_ggx_sample_wi_conic2026, for many u and one wo and alpha.
// Accuracy: angle to the exact map, 99th percentile: 2 eps (1 + condition number), 1.5 behind the surface; double 2, 1.5.
VNDF_FN VNDF_REAL3 vndf_ggx_sample_wi_conic2026_lobe(struct vndf_ggx_conic2026 lobe, VNDF_REAL2 u) {
    return vndf_impl_direction(vndf_impl_conic2026(lobe, u));
}

// The same; w: its density per steradian of wi, from the sampler's own terms.
VNDF_FN VNDF_REAL4 vndf_ggx_sample_wi_conic2026_lobe_with_pdf(struct vndf_ggx_conic2026 lobe, VNDF_REAL2 u) {
    return vndf_impl_direction_pdf(vndf_impl_conic2026(lobe, u));
}

// The density of a lobe's reflections: as vndf_ggx_pdf_wi_conic2026.
// Accuracy: 24 eps; double 22.
VNDF_FN VNDF_REAL vndf_ggx_pdf_wi_conic2026_lobe(struct vndf_ggx_conic2026 lobe, VNDF_REAL3 wi) {
    struct vndf_impl_half h =
        vndf_impl_half_of(VNDF_MAKE3(lobe.wo_x, lobe.wo_y, lobe.wo_z), wi, lobe.alpha_x, lobe.alpha_y);
    VNDF_REAL pdf = vndf_impl_ggx_reflection_pdf(h, lobe.twice_sigma, lobe.alpha_x, lobe.alpha_y);
    return wi.z > VNDF_R(0.0) || lobe.wo_z <= VNDF_R(0.0) ? pdf : VNDF_R(0.0);
}

// A reflection of wo above the horizon.
// wo: unit vector, local frame, anywhere on the sphere. For wo.z <= 0 the plain cap. At
//     wo = -z, where nothing is visible: a unit vector with density 0.
// alpha: in [1e-8, 1e3] each.
// u: a point of the unit disk, u.x its azimuth, u.y its squared radius. The map is continuous in u and preserves area:
//     stratified points stay stratified.
// return: unit vector wi, wi.z > 0 for wo.z > 0, with density vndf_ggx_pdf_wi_conic2026(wo, wi, alpha). For reflection
//     alone: refraction needs a plain visible normal.
// Accuracy: angle to the exact map, 99th percentile: 2 eps (1 + condition number), 1.5 behind the surface; double 2, 1.5.
VNDF_FN VNDF_REAL3 vndf_ggx_sample_wi_conic2026(VNDF_REAL3 wo, VNDF_REAL2 alpha, VNDF_REAL2 u) {
    return vndf_impl_direction(vndf_impl_conic2026(vndf_ggx_conic2026_lobe(wo, alpha), u));
}

// The same; w: its density per steradian of wi, from the sampler's own terms.
VNDF_FN VNDF_REAL4 vndf_ggx_sample_wi_conic2026_with_pdf(VNDF_REAL3 wo, VNDF_REAL2 alpha, VNDF_REAL2 u) {
    return vndf_impl_direction_pdf(vndf_impl_conic2026(vndf_ggx_conic2026_lobe(wo, alpha), u));
}

// --- How much of a lobe is reflected above the horizon ---

// Twice that part, or twice the whole for w.z <= 0.
VNDF_FN VNDF_REAL vndf_impl_twice_sigma_visible(VNDF_REAL3 w, VNDF_REAL alpha_x, VNDF_REAL alpha_y) {
    struct vndf_impl_cone_view v = vndf_impl_cone_view_of(alpha_x * w.x, alpha_y * w.y, w.z);
    VNDF_REAL visible = VNDF_R(2.0) * vndf_impl_cone_area(vndf_impl_cone_of(v, alpha_x, alpha_y), v.scale);
    VNDF_REAL behind = vndf_impl_conic_cap_of(v, w.z).p;
    return w.z > VNDF_R(0.0) ? visible : behind;
}

// The part of the projected area of the microsurface whose normals reflect wo above the horizon.
// Source: ggx_conic2026.md: t mu^2 / ((1 + e^2 + f^2) sqrt((mu + A_x)(mu + A_y))).
// w: unit vector, local frame, anywhere on the sphere. For w.z <= 0 every visible normal reflects above the horizon:
//     vndf_ggx_sigma.
// alpha: in [1e-8, 1e3] each.
// return: in [0, sigma(w)], per unit area of the macrosurface: sigma times the integral of vndf_ggx_pdf_wi over wi.z > 0.
// Accuracy: 16 eps; double 21.
//     Double against quadrature along the horizon: 1e-12.
VNDF_FN VNDF_REAL vndf_ggx_sigma_visible(VNDF_REAL3 w, VNDF_REAL2 alpha) {
    VNDF_REAL sigma =
        VNDF_R(0.5) * vndf_impl_twice_sigma_visible(w, vndf_impl_alpha(alpha.x), vndf_impl_alpha_y(alpha.y));
    return vndf_impl_finite(sigma) + vndf_impl_zero(w.x, w.y, w.z);
}

// The probability that the reflection of wo about a visible normal lies above the horizon.
// Source: ggx_conic2026.md: sigma_vis / sigma.
// w: unit vector, local frame, anywhere on the sphere.
// alpha: in [1e-8, 1e3] each.
// return: in [0, 1]; 1 for w.z <= 0.
// Accuracy: 16 eps; double 20.
VNDF_FN VNDF_REAL vndf_ggx_reflection_probability(VNDF_REAL3 w, VNDF_REAL2 alpha) {
    VNDF_REAL alpha_x = vndf_impl_alpha(alpha.x), alpha_y = vndf_impl_alpha_y(alpha.y);
    struct vndf_impl_cone_view v = vndf_impl_cone_view_of(alpha_x * w.x, alpha_y * w.y, w.z);
    struct vndf_impl_cone c = vndf_impl_cone_of(v, alpha_x, alpha_y);
    VNDF_REAL t = VNDF_SQRT(VNDF_FMA(c.x, c.x, VNDF_FMA(c.y, c.y, c.z * c.z)));
    VNDF_REAL rcp = VNDF_DIVIDE(VNDF_R(1.0), c.whole * (t + c.z));
    VNDF_REAL p = VNDF_R(2.0) * VNDF_SQRT(c.poles * rcp * rcp);  // one root feeds the other (impl/stretch.h)
    return w.z > VNDF_R(0.0) ? vndf_impl_share(p) + vndf_impl_zero(w.x, w.y, w.z) : VNDF_R(1.0);
}

// The density of the reflection of wo about a visible normal, given that it lies above the horizon: D / (4 sigma_vis).
// Source: ggx_conic2026.md; it is vndf_ggx_pdf_wi over the reflection probability.
// wo, wi: unit vectors, local frame, anywhere on the sphere.
// alpha: in [1e-8, 1e3] each.
// return: per steradian of wi; 0 for wi.z <= 0 above the surface. For wo.z <= 0 the same as vndf_ggx_pdf_wi.
// Accuracy: 24 eps; double 22.
//     Below alpha = 1e-2 the rounding of wi moves the density by more than that: use the sampler's _with_pdf form there.
VNDF_FN VNDF_REAL vndf_ggx_pdf_wi_conic2026(VNDF_REAL3 wo, VNDF_REAL3 wi, VNDF_REAL2 alpha) {
    VNDF_REAL alpha_x = vndf_impl_alpha(alpha.x), alpha_y = vndf_impl_alpha_y(alpha.y);
    struct vndf_impl_half h = vndf_impl_half_of(wo, wi, alpha_x, alpha_y);
    VNDF_REAL pdf = vndf_impl_ggx_reflection_pdf(h, vndf_impl_twice_sigma_visible(wo, alpha_x, alpha_y),
                                                 alpha_x, alpha_y);
    return wi.z > VNDF_R(0.0) || wo.z <= VNDF_R(0.0) ? pdf : VNDF_R(0.0);
}

// --- The inverse ---

// A point of the disk, of any length, and its squared radius.
struct vndf_impl_disk_square {
    VNDF_REAL x, y, u2;
};

// The stretched normal m between wo and wi: half its cosine with v = alpha wo is |h|^2 / (2 |m|), and |A m|^2 = |h|^2 / |m|^2.
struct vndf_impl_conic_half {
    struct vndf_impl_conic_normal m;
    VNDF_REAL twice, square;  // |h|^2 / |m|, |h|^2 / |m|^2 before m is made a unit vector
    int defined;
};
VNDF_FN struct vndf_impl_conic_half vndf_impl_conic_half_of(struct vndf_ggx_conic2026 l, VNDF_REAL3 wi) {
    VNDF_REAL hx = l.wo_x + wi.x, hy = l.wo_y + wi.y, hz = l.wo_z + wi.z;
    VNDF_REAL sx = VNDF_DIVIDE(hx, l.alpha_x), sy = VNDF_DIVIDE(hy, l.alpha_y);
    VNDF_REAL length2 = VNDF_FMA(sx, sx, VNDF_FMA(sy, sy, hz * hz)),
              h2 = VNDF_FMA(hx, hx, VNDF_FMA(hy, hy, hz * hz));
    VNDF_REAL rcp = length2 > VNDF_R(0.0) ? VNDF_DIVIDE(VNDF_R(1.0), VNDF_SQRT(length2)) : VNDF_R(0.0);
    struct vndf_impl_conic_half h;
    h.m.x = sx * rcp;
    h.m.y = sy * rcp;
    h.m.z = hz * rcp;
    h.twice = h2 * rcp;
    h.square = h.twice * rcp;
    h.defined = length2 > VNDF_R(0.0);
    return h;
}

// The three moves backwards: each length is the root that the map takes, from the normal's side. twice = 2 v . m,
// height = m^T Q m >= 0.
VNDF_FN struct vndf_impl_disk_square vndf_impl_conic_invert(struct vndf_ggx_conic2026 l,
                                                            struct vndf_impl_conic_normal m, VNDF_REAL twice,
                                                            VNDF_REAL height) {
    struct vndf_impl_disk_square d;
    VNDF_REAL m0 = l.s0 * VNDF_FMA(l.e, m.x, VNDF_FMA(l.f, m.y, l.g * m.z));
    VNDF_REAL m1 = l.dual_1 * VNDF_FMA(l.e1x, m.x, VNDF_FMA(l.e1y, m.y, l.e1z * m.z));
    VNDF_REAL m2 = l.dual_2 * VNDF_FMA(l.e2x, m.x, VNDF_FMA(l.e2y, m.y, l.e2z * m.z));
    VNDF_REAL slope = VNDF_FMA(l.slope_0, m0, l.slope_2 * m2),
              root2 = VNDF_FMA(slope, slope, -l.bend * height);
    VNDF_REAL root = VNDF_SQRT(root2 > VNDF_R(0.0) ? root2 : VNDF_R(0.0)), sum = slope + root;
    VNDF_REAL tau = sum > VNDF_R(0.0) ? VNDF_DIVIDE(height, sum) : VNDF_R(0.0);
    // P2, and what was left of the second chord.
    VNDF_REAL rim2 = VNDF_FMA(-tau, l.s0, m0), left = tau * VNDF_FMA(-tau, l.length2, twice);
    m2 = VNDF_FMA(-tau, l.s2, m2);
    d.y = VNDF_DIVIDE(VNDF_FMA(-tau, l.along_1 * l.dual_1, m1), l.step_1);
    VNDF_REAL y2 = d.y * (d.y * l.rcp_spread);
    VNDF_REAL rim = VNDF_SQRT(VNDF_FMA(l.rim_1, vndf_impl_share(y2), l.rim_0)), rims = rim + rim2;
    VNDF_REAL step = rims > VNDF_R(0.0) ? VNDF_DIVIDE(left, rims) : VNDF_R(0.0);
    m2 = VNDF_FMA(-l.share * step, l.s2, m2);
    d.x = VNDF_DIVIDE(m2, l.step_2);
    VNDF_REAL rest = step * (VNDF_FMA(l.slope_2, m2, l.slope_0 * rim) + root);
    VNDF_REAL square = VNDF_FMA(d.x, d.x * l.rcp_spread, y2);
    d.u2 = square > VNDF_R(0.5) ? VNDF_R(1.0) - rest : square;
    return d;
}

// The u at which vndf_ggx_sample_wi_conic2026 gives wi.
// wo, wi: unit vectors, local frame, anywhere on the sphere.
// alpha: in [1e-8, 1e3] each.
// return: (u.x, u.y) in [0, 1]. A wi below the horizon, which no u gives, counts as one on it; (0, 0) for wi = -wo.
// Accuracy: 2 eps (1 + condition number), 99th percentile; double 2.
//     Where wi is the mirror image of wo to within rounding.
VNDF_FN VNDF_REAL2 vndf_ggx_invert_wi_conic2026(VNDF_REAL3 wo, VNDF_REAL3 wi, VNDF_REAL2 alpha) {
    struct vndf_ggx_conic2026 l = vndf_ggx_conic2026_lobe(wo, alpha);
    struct vndf_impl_conic_half h = vndf_impl_conic_half_of(l, wi);
    // m^T Q m for mu = 1: wi.z |A m|^2 / mu.
    VNDF_REAL height = vndf_impl_max(wi.z, VNDF_R(0.0)) * h.square * l.unit;
    struct vndf_impl_disk_square front = vndf_impl_conic_invert(l, h.m, h.twice * l.unit, height);
    // The cap: 1 - u2 = 2 (v . m) m.z / p, and the stretched reflection, whose part across z has the square
    // u2 p ((1 - u2) p + r - z).
    int above = l.wo_z > VNDF_R(0.0);
    VNDF_REAL rcp_p = !above && l.cap.p > VNDF_IMPL_LEAST ? VNDF_DIVIDE(VNDF_R(1.0), l.cap.p) : VNDF_R(0.0);
    VNDF_REAL ox = VNDF_FMA(h.twice, h.m.x, -l.alpha_x * l.wo_x),
              oy = VNDF_FMA(h.twice, h.m.y, -l.alpha_y * l.wo_y);
    VNDF_REAL rest = h.twice * h.m.z * rcp_p;
    VNDF_REAL part = VNDF_FMA(VNDF_R(1.0) + vndf_impl_max(rest, VNDF_R(0.0)), l.cap.p, l.cap.gap);
    VNDF_REAL u2 = VNDF_DIVIDE(VNDF_FMA(ox, ox, oy * oy) * rcp_p, part > VNDF_R(0.0) ? part : VNDF_R(1.0));
    u2 = rest < VNDF_R(0.5) ? VNDF_R(1.0) - rest : u2;
    VNDF_REAL u1 = vndf_impl_turn(above ? front.x : ox, above ? front.y : oy);
    u2 = vndf_impl_share(vndf_impl_max(above ? front.u2 : u2, VNDF_R(0.0)));
    return VNDF_MAKE2(h.defined ? vndf_impl_share(u1) : VNDF_R(0.0), h.defined ? u2 : VNDF_R(0.0));
}

// --- One alpha ---

// For alpha_x = alpha_y = alpha the plane of incidence holds e0 and e1, and v has no part along e2: mu by one
// quadratic, P2 in one step. The normal is 1 + m1 long. (x, y): the tangential part of v, scaled near 1, azimuth 0
// where there is none; above the surface no larger than z can follow.
VNDF_FN struct vndf_impl_sample vndf_impl_conic2026_isotropic(VNDF_REAL3 wo, VNDF_REAL alpha, VNDF_REAL2 u) {
    // Twice, by two forms: operations on one number would be packed (impl/stretch.h).
    VNDF_REAL alpha_x = vndf_impl_alpha(alpha), alpha_y = vndf_impl_alpha_y(alpha);
    struct vndf_impl_disk d = vndf_impl_disk_of(u);
    int above = wo.z > VNDF_R(0.0);
    VNDF_REAL vx = alpha_x * wo.x, vy = alpha_y * wo.y, size = vndf_impl_abs(vx) + vndf_impl_abs(vy);
    VNDF_REAL most = VNDF_DOUBLE ? VNDF_R(1.2676506002282294e30) : VNDF_R(68719476736.0);  // 2^100, 2^36
    VNDF_REAL scale = vndf_impl_min(vndf_impl_scale(size), above ? most : VNDF_REAL_MAX);
    VNDF_REAL x = size > VNDF_R(0.0) ? vx * scale : VNDF_R(1e-6), y = vy * scale, l2 = VNDF_FMA(x, x, y * y);
    VNDF_REAL back = vndf_impl_rcp_power(scale), back2 = back * back;
    // One root and one quotient: above the surface 1 / mu, of mu^2 + (pole - z) mu = z pole + l2; else l2 / (r + |z|).
    VNDF_REAL z = above ? wo.z * scale : VNDF_R(1.0), pole = z * (alpha_x * alpha_x),
              c = VNDF_R(4.0) * VNDF_FMA(z, pole, l2);
    VNDF_REAL b = above ? pole - z : wo.z;
    VNDF_REAL sum = VNDF_SQRT(VNDF_FMA(b, b, above ? c : l2 * back2)) + vndf_impl_abs(b);
    int rising = b > VNDF_R(0.0);
    VNDF_REAL quotient = VNDF_DIVIDE(above ? (rising ? sum + sum : VNDF_R(2.0)) : l2, rising ? c : sum);
    struct vndf_impl_conic_cap cap;
    cap.x = x;
    cap.y = y;
    cap.l2 = l2;
    cap.area = quotient;
    cap.p = quotient * back2;
    cap.gap = VNDF_R(-2.0) * wo.z;
    cap.back = back;
    VNDF_REAL unit = above ? quotient : VNDF_R(1.0), a = pole * unit, bx = VNDF_R(1.0) + a, w1 = l2 * unit;
    z *= unit;
    VNDF_REAL spread = VNDF_DIVIDE(VNDF_R(1.0), bx * l2), rcp = l2 * spread, tilt2 = w1 * unit,
              xx = tilt2 * rcp;
    VNDF_REAL m1 = a + xx, g1 = bx + xx, m2 = a * g1;
    VNDF_REAL radius = VNDF_SQRT(d.u2 * (above ? spread : vndf_impl_conic_cap_spread(cap, d.rest)));
    VNDF_REAL ex = radius * d.cosine, ey = radius * d.sine;
    VNDF_REAL m0 = VNDF_SQRT(VNDF_FMA(m2 + xx, d.rest, d.u2 * VNDF_FMA(xx * d.sine, d.sine, m2)));
    VNDF_REAL along = VNDF_FMA(m1 * w1, ey, m0);
    along = along > VNDF_R(0.0) ? along : VNDF_R(0.0);  // it is, but for rounding
    VNDF_REAL left = g1 * d.rest;
    VNDF_REAL tau =
        VNDF_DIVIDE(left, (along + VNDF_SQRT(VNDF_FMA(along, along, VNDF_FMA(z, z, tilt2) * left))));
    struct vndf_impl_conic_turned m = vndf_impl_conic_cap_half(cap, ex, ey, d.rest);
    m.in = above ? VNDF_FMA(VNDF_FMA(m0, rcp, tau), unit, ey * bx) : m.in;
    m.across = above ? g1 * ex : m.across;
    m.z = above ? VNDF_FMA(tau, z, VNDF_FMA(-w1, ey, m0)) : m.z;
    VNDF_REAL visible = VNDF_DIVIDE(VNDF_R(2.0) * back, g1 * unit);  // sqrt(poles) is no root here
    return vndf_impl_conic_reflect(vndf_impl_conic_turn(m, x, y), wo.x, wo.y, wo.z, alpha_x, alpha_y,
                                   above ? visible : cap.p, wo.z > VNDF_R(0.0));
}

// A reflection of wo above the horizon for alpha_x = alpha_y: the same map as vndf_ggx_sample_wi_conic2026, less work.
// wo: as there. At normal incidence the azimuth 0 counts as the one of wo.
// alpha: in [1e-8, 1e3].
// u, return: as there.
// Accuracy: angle to the exact map, 99th percentile: 2 eps (1 + condition number), 1.5 behind the surface; double 2, 1.5.
VNDF_FN VNDF_REAL3 vndf_ggx_sample_wi_conic2026_isotropic(VNDF_REAL3 wo, VNDF_REAL alpha, VNDF_REAL2 u) {
    return vndf_impl_direction(vndf_impl_conic2026_isotropic(wo, alpha, u));
}

// The same; w: its density per steradian of wi, from the sampler's own terms.
VNDF_FN VNDF_REAL4 vndf_ggx_sample_wi_conic2026_isotropic_with_pdf(VNDF_REAL3 wo, VNDF_REAL alpha,
                                                                   VNDF_REAL2 u) {
    return vndf_impl_direction_pdf(vndf_impl_conic2026_isotropic(wo, alpha, u));
}

VNDF_END

#endif
