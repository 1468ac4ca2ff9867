// GGX reflections without waste: no sample falls below the horizon, and no reflection above it is lost.
//
// Source: this package; derivation, figures and how to verify it: ggx_conic2026.md. No earlier publication was found.
//     In the axes of the cone of impl/cone.h, the stretched normals that reflect above the horizon project onto
//     the ellipse (m1 / p)^2 + (m2 / q)^2 < 1. Three straight moves take the point (p Y, q X) of it to a normal m, and two
//     of them are shears that preserve the projected area s . m:
//       P  = (M, p Y, q X)  on the chord between the two rim points of the slice m1 = p Y, M = m0 at both;
//       P2 = P + epsilon s' on the chord between the two rim points with that component across s', s' = s without s1;
//       m  = P2 + tau s     on the sphere.
//     All three steps are roots of quadratics, written as sums of positive terms.
// Symbols: those of impl/cone.h; s = (s0, s1, s2) in the axes e0, e1, e2, n = |s'|, c0 = s0 / n, c2 = s2 / n,
//     p^2 = mu / (mu + mu1), q^2 = mu / (mu + mu2), rho = (mu1 - mu2) / (mu + mu1), a = c0^2 + rho c2^2.
#ifndef VNDF_GGX_CONIC2026_H
#define VNDF_GGX_CONIC2026_H

#include "ggx.h"
#include "impl/caps.h"
#include "impl/cone.h"
#include "impl/mirror.h"

VNDF_BEGIN

// --- What both forms share ---

// A point of the unit disk: x = sqrt(u2) cos(2 pi u1), y alike, rest = 1 - u2.
struct vndf_impl_disk {
    VNDF_REAL x, y, rest;
};
VNDF_FN struct vndf_impl_disk vndf_impl_disk_of(VNDF_REAL2 u) {
    struct vndf_impl_disk d;
    VNDF_REAL u1 = vndf_impl_u(u.x), u2 = vndf_impl_u(u.y), radius = VNDF_SQRT(u2);
    d.x = radius * vndf_impl_circle_cos(u1);
    d.y = radius * vndf_impl_circle_sin(u1);
    d.rest = VNDF_R(1.0) - u2;
    return d;
}

// A stretched normal of any length.
struct vndf_impl_conic_normal {
    VNDF_REAL x, y, z;
};

// The plain cap of ggx_dupuy2023.h: behind the surface it wastes nothing.
struct vndf_impl_plain_cap {
    VNDF_REAL x, y;  // the azimuth of the stretched view direction
    VNDF_REAL z, p, q, sqrt_p, sqrt_q;
};
VNDF_FN struct vndf_impl_plain_cap vndf_impl_plain_cap_of(struct vndf_impl_view v) {
    struct vndf_impl_plain_cap plain;
    struct vndf_impl_cap cap = vndf_impl_cap_of(v);
    plain.x = vndf_impl_azimuth_x(v);
    plain.y = vndf_impl_azimuth_y(v);
    plain.z = cap.z;
    plain.p = cap.p;
    plain.q = cap.q;
    plain.sqrt_p = cap.sqrt_p;
    plain.sqrt_q = cap.sqrt_q;
    return plain;
}

// The cap's half vector for the same disk point, whose direction is the azimuth and 1 - rest the height.
VNDF_FN struct vndf_impl_cap_half vndf_impl_conic_cap_half(struct vndf_impl_plain_cap cap,
                                                           struct vndf_impl_disk d) {
    VNDF_REAL scale = VNDF_SQRT(VNDF_FMA(d.rest, cap.p, cap.q)), ex = scale * d.x, ey = scale * d.y;
    return vndf_impl_cap_half_of(cap.x, cap.y, cap.sqrt_q, cap.q, ex, ey, VNDF_FMA(ex, ex, ey * ey),
                                 d.rest * VNDF_FMA(-d.rest, cap.p, VNDF_R(2.0) * cap.z), d.rest * cap.sqrt_p);
}

// The unit reflection of wo about the unstretched normal, and its density D / (2 n), n = 2
// sigma_vis of wo as given. Above the surface the normal is `front`, behind it `behind`, a half vector of the cap.
VNDF_FN struct vndf_impl_sample vndf_impl_conic_reflect(struct vndf_impl_conic_normal front,
                                                        struct vndf_impl_cap_half behind, VNDF_REAL wo_x,
                                                        VNDF_REAL wo_y, VNDF_REAL wo_z, VNDF_REAL alpha_x,
                                                        VNDF_REAL alpha_y, VNDF_REAL n) {
    struct vndf_impl_sample o;
    int above = wo_z > VNDF_R(0.0);
    VNDF_REAL hx = above ? front.x : behind.x, hy = above ? front.y : behind.y,
              hz = above ? front.z : behind.z;
    struct vndf_impl_mirror m = vndf_impl_mirror_of(wo_x, wo_y, wo_z, hx, hy, hz, alpha_x, alpha_y);
    // The height is positive, and rounding denies it within its error of the horizon alone: mirrored there, which keeps
    // the length, and never 0.
    VNDF_REAL height = vndf_impl_max(vndf_impl_abs(m.z), VNDF_R(0.0625) * VNDF_EPSILON);
    VNDF_REAL z = above ? height : m.z;
    // Only the direction of wo counts: the length that the mirror kept is divided out.
    VNDF_REAL o2 = VNDF_FMA(m.x, m.x, VNDF_FMA(m.y, m.y, z * z)), rcp = VNDF_R(1.0) / VNDF_SQRT(o2);
    o.x = m.x * rcp;
    o.y = m.y * rcp;
    o.z = z * rcp;
    VNDF_REAL pdf = vndf_impl_reflection_density(m.ratio, n * rcp, alpha_x, alpha_y);
    o.pdf = m.defined && n > VNDF_R(0.0) ? vndf_impl_finite(pdf) : VNDF_R(0.0);
    return vndf_impl_where(o2 > VNDF_R(0.0) && o2 <= VNDF_REAL_MAX, o);
}

// --- The lobe of one wo and alpha ---

// What all samples of a lobe share. Made by vndf_ggx_conic2026_lobe, used by the functions with _lobe in their names;
// its members are internals.
struct vndf_ggx_conic2026 {
    VNDF_REAL wo_x, wo_y, wo_z;
    VNDF_REAL alpha_x, alpha_y;  // clamped
    VNDF_REAL e0x, e0y, e0z, e1x, e1y, e1z, e2x, e2y, e2z;
    VNDF_REAL s0, s1, s2, n, c0, c2;
    VNDF_REAL p, q, p2, q2, co_p2, co_q2;  // co_p2 = 1 - p2
    VNDF_REAL rho, a;
    VNDF_REAL t, twice_sigma;  // stretched length; sigma_vis
    VNDF_REAL steepness;       // t (mu + mu1)
    VNDF_REAL cap_x, cap_y, cap_z, cap_p, cap_q, cap_sqrt_p, cap_sqrt_q;
};

// e1 and e2 by a half turn that takes z to e0 and a rotation about it; h = mu1 - mu2 and the rotation from the two by two
// matrix of -Q across e0, with every difference taken out by Q e0 = mu e0. The signs are those of s1 >= 0: the axes jump
// where wo crosses a plane in which s1 vanishes, and turn with wo for alpha_x = alpha_y.
VNDF_FN struct vndf_ggx_conic2026 vndf_impl_conic_axes(struct vndf_ggx_conic2026 lobe,
                                                       struct vndf_impl_cone c) {
    VNDF_REAL z = VNDF_R(1.0) / VNDF_SQRT(c.norm2), x = c.e * z, y = c.f * z,
              k = VNDF_R(1.0) / (VNDF_R(1.0) + z);
    VNDF_REAL xk = x * k, yk = y * k, x2k = x * xk, y2k = y * yk, xyk = x * yk;
    VNDF_REAL ux = VNDF_R(1.0) - x2k, uy = VNDF_R(1.0) - y2k, w = VNDF_FMA(c.sx, x, c.sy * y);
    // s . f1 and s . f2 of f1 = (ux, -xyk, -x), f2 = (-xyk, uy, -y).
    VNDF_REAL s1 = c.e * VNDF_FMA(c.ax, ux, VNDF_FMA(-c.ay, y2k, w));
    VNDF_REAL s2 = c.f * VNDF_FMA(c.ay, uy, VNDF_FMA(-c.ax, x2k, w));
    VNDF_REAL b11 =
        VNDF_FMA(c.ax * ux, ux, VNDF_FMA(c.ay * xyk, xyk, x * VNDF_FMA(c.sz, x, VNDF_R(2.0) * s1)));
    VNDF_REAL b22 =
        VNDF_FMA(c.ay * uy, uy, VNDF_FMA(c.ax * xyk, xyk, y * VNDF_FMA(c.sz, y, VNDF_R(2.0) * s2)));
    VNDF_REAL b12 = VNDF_FMA(-xyk, VNDF_FMA(c.ax, ux, c.ay * uy), VNDF_FMA(x, VNDF_FMA(c.sz, y, s2), y * s1));
    VNDF_REAL trace = c.ax + c.ay + c.sum, scale = vndf_impl_scale(trace);
    // A round cone has no axes: 1e-18 takes x and y, and nothing from any other.
    VNDF_REAL d = VNDF_FMA(b11 - b22, scale, VNDF_R(1e-18)), e = VNDF_R(2.0) * b12 * scale;
    VNDF_REAL size = VNDF_SQRT(VNDF_FMA(d, d, e * e)), larger = size + vndf_impl_abs(d);
    VNDF_REAL rcp = VNDF_R(1.0) / VNDF_SQRT(VNDF_FMA(larger, larger, e * e));
    VNDF_REAL major = larger * rcp, minor = vndf_impl_abs(e) * rcp;
    VNDF_REAL cosine = d < VNDF_R(0.0) ? minor : major, sine = d < VNDF_R(0.0) ? major : minor;
    sine = e < VNDF_R(0.0) ? -sine : sine;
    int back = VNDF_FMA(cosine, s1, sine * s2) < VNDF_R(0.0);
    cosine = back ? -cosine : cosine;
    sine = back ? -sine : sine;
    VNDF_REAL difference = size / scale, mu1 = VNDF_R(0.5) * (trace + difference);
    VNDF_REAL both = c.mu + mu1, rcp_mu = VNDF_R(1.0) / (both * c.mu * mu1), rcp_both = rcp_mu * c.mu * mu1;
    // mu mu1 mu2 = s.z (alpha_x alpha_y |wo| / t)^2, and (mu + mu1)(mu + mu2) = norm2 poles.
    VNDF_REAL wo2 = VNDF_FMA(lobe.wo_x, lobe.wo_x, VNDF_FMA(lobe.wo_y, lobe.wo_y, lobe.wo_z * lobe.wo_z));
    VNDF_REAL r = lobe.alpha_x * lobe.alpha_y / c.t, mu2 = c.sz * r * (both * rcp_mu) * (r * wo2);
    VNDF_REAL rcp_other = both * c.rcp_poles * (z * z);  // 1 / (mu + mu2)
    lobe.e0x = x;
    lobe.e0y = y;
    lobe.e0z = z;
    lobe.e1x = VNDF_FMA(cosine, ux, -sine * xyk);
    lobe.e1y = VNDF_FMA(sine, uy, -cosine * xyk);
    lobe.e1z = -VNDF_FMA(cosine, x, sine * y);
    lobe.e2x = VNDF_FMA(-sine, ux, -cosine * xyk);
    lobe.e2y = VNDF_FMA(cosine, uy, sine * xyk);
    lobe.e2z = VNDF_FMA(sine, x, -cosine * y);
    lobe.s0 = c.mu * z;
    lobe.s1 = VNDF_FMA(cosine, s1, sine * s2);
    lobe.s2 = VNDF_FMA(cosine, s2, -sine * s1);
    lobe.p2 = c.mu * rcp_both;
    lobe.co_p2 = mu1 * rcp_both;
    lobe.q2 = c.mu * rcp_other;
    lobe.co_q2 = vndf_impl_max(mu2 * rcp_other, VNDF_R(1e-30));  // so that M > 0
    lobe.rho = difference * rcp_both;
    lobe.steepness = c.t * both;
    return lobe;
}

// The lobe of wo and alpha: all that does not depend on u.
// wo: unit vector, local frame, anywhere on the sphere.
// alpha: in [1e-8, 1e3] each.
// return: a struct for vndf_ggx_sample_wi_conic2026_lobe, _lobe_with_pdf and vndf_ggx_pdf_wi_conic2026_lobe.
VNDF_FN struct vndf_ggx_conic2026 vndf_ggx_conic2026_lobe(VNDF_REAL3 wo, VNDF_REAL2 alpha) {
    struct vndf_ggx_conic2026 lobe;
    struct vndf_impl_view v = vndf_impl_stretch(wo, alpha);
    struct vndf_impl_cone c = vndf_impl_cone_of(v);
    struct vndf_impl_plain_cap cap = vndf_impl_plain_cap_of(v);
    lobe.wo_x = wo.x;
    lobe.wo_y = wo.y;
    lobe.wo_z = wo.z;
    lobe.alpha_x = v.alpha_x;
    lobe.alpha_y = v.alpha_y;
    lobe.t = v.r;
    VNDF_REAL visible = VNDF_R(2.0) * v.r * vndf_impl_cone_share(c), behind = vndf_impl_hidden_area(v);
    lobe.twice_sigma = v.z > VNDF_R(0.0) ? visible : behind;
    lobe.cap_x = cap.x;
    lobe.cap_y = cap.y;
    lobe.cap_z = cap.z;
    lobe.cap_p = cap.p;
    lobe.cap_q = cap.q;
    lobe.cap_sqrt_p = cap.sqrt_p;
    lobe.cap_sqrt_q = cap.sqrt_q;
    lobe = vndf_impl_conic_axes(lobe, c);
    lobe.n = VNDF_SQRT(VNDF_FMA(lobe.s0, lobe.s0, lobe.s2 * lobe.s2));
    lobe.c0 = lobe.s0 / lobe.n;
    lobe.c2 = lobe.s2 / lobe.n;
    lobe.a = VNDF_FMA(lobe.c0, lobe.c0, lobe.rho * lobe.c2 * lobe.c2);
    lobe.p = VNDF_SQRT(lobe.p2);
    lobe.q = VNDF_SQRT(lobe.q2);
    return lobe;
}

// The normal of a disk point.
VNDF_FN struct vndf_impl_conic_normal vndf_impl_conic_normal_of(struct vndf_ggx_conic2026 l,
                                                                struct vndf_impl_disk d) {
    struct vndf_impl_conic_normal h;
    // P on the first chord. x^2 + rest = 1 - y^2.
    VNDF_REAL y2 = d.y * d.y, px = l.q * d.x, py = l.p * d.y;
    VNDF_REAL rim = VNDF_SQRT(VNDF_FMA(l.co_p2, y2, l.co_q2 * VNDF_FMA(d.x, d.x, d.rest)));
    // The cone along s': a e^2 + 2 slope e - share rest = 0 at e = epsilon; share_rest / (slope + root).
    VNDF_REAL share = l.rho * l.q2, slope = VNDF_FMA(l.rho * l.c2, px, l.c0 * rim);
    VNDF_REAL root = VNDF_SQRT(VNDF_FMA(slope, slope, l.a * share * d.rest));
    int rising = slope > VNDF_R(0.0);
    VNDF_REAL step = (rising ? d.rest : root - slope) / (rising ? slope + root : l.a * share);
    VNDF_REAL epsilon = share * step;
    // What is left of the second chord; the sphere along s from P2: tau^2 + 2 along tau - left = 0.
    VNDF_REAL left = l.p2 * l.c0 * VNDF_FMA(l.c0, epsilon, VNDF_R(2.0) * rim) * step;
    VNDF_REAL along = VNDF_FMA(l.s0, rim, VNDF_FMA(l.s2, px, VNDF_FMA(l.s1, py, l.n * epsilon)));
    along = along > VNDF_R(0.0) ? along : VNDF_R(0.0);  // it is, but for rounding
    VNDF_REAL cosine = VNDF_SQRT(VNDF_FMA(along, along, left)), tau = left / (along + cosine);
    VNDF_REAL delta = l.n * tau, shift = epsilon + delta;
    VNDF_REAL m0 = VNDF_FMA(l.c0, shift, rim), m1 = VNDF_FMA(l.s1, tau, py), m2 = VNDF_FMA(l.c2, shift, px);
    h.x = VNDF_FMA(m0, l.e0x, VNDF_FMA(m1, l.e1x, m2 * l.e2x));
    h.y = VNDF_FMA(m0, l.e0y, VNDF_FMA(m1, l.e1y, m2 * l.e2y));
    h.z = VNDF_FMA(m0, l.e0z, VNDF_FMA(m1, l.e1z, m2 * l.e2z));
    return h;
}

VNDF_FN struct vndf_impl_sample vndf_impl_conic2026(struct vndf_ggx_conic2026 l, VNDF_REAL2 u) {
    struct vndf_impl_disk d = vndf_impl_disk_of(u);
    struct vndf_impl_plain_cap cap;
    cap.x = l.cap_x;
    cap.y = l.cap_y;
    cap.z = l.cap_z;
    cap.p = l.cap_p;
    cap.q = l.cap_q;
    cap.sqrt_p = l.cap_sqrt_p;
    cap.sqrt_q = l.cap_sqrt_q;
    return vndf_impl_conic_reflect(vndf_impl_conic_normal_of(l, d), vndf_impl_conic_cap_half(cap, d), l.wo_x,
                                   l.wo_y, l.wo_z, l.alpha_x, l.alpha_y, l.twice_sigma);
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

// The part of the projected area of the microsurface whose normals reflect wo above the horizon.
// Source: ggx_conic2026.md: t mu^2 / ((1 + e^2 + f^2) sqrt((mu + A_x)(mu + A_y))).
// w: unit vector, local frame, anywhere on the sphere. For w.z <= 0 every visible normal reflects above the horizon:
//     vndf_ggx_sigma.
// alpha: in [1e-8, 1e3] each.
// return: in [0, sigma(w)], per unit area of the macrosurface: sigma times the integral of vndf_ggx_pdf_wi over wi.z > 0.
// Accuracy: 16 eps; double 21.
//     Double against quadrature along the horizon: 1e-12.
VNDF_FN VNDF_REAL vndf_ggx_sigma_visible(VNDF_REAL3 w, VNDF_REAL2 alpha) {
    VNDF_REAL sigma = VNDF_R(0.5) * vndf_impl_twice_sigma_visible(vndf_impl_stretch(w, alpha));
    return vndf_impl_finite(sigma) + vndf_impl_zero(w.x, w.y, w.z);
}

// The probability that the reflection of wo about a visible normal lies above the horizon.
// Source: ggx_conic2026.md: sigma_vis / sigma.
// w: unit vector, local frame, anywhere on the sphere.
// alpha: in [1e-8, 1e3] each.
// return: in [0, 1]; 1 for w.z <= 0.
// Accuracy: 16 eps; double 20.
VNDF_FN VNDF_REAL vndf_ggx_reflection_probability(VNDF_REAL3 w, VNDF_REAL2 alpha) {
    struct vndf_impl_view v = vndf_impl_stretch(w, alpha);
    struct vndf_impl_cone c = vndf_impl_cone_of(v);
    VNDF_REAL p = VNDF_R(2.0) * vndf_impl_cone_share(c) / (VNDF_R(1.0) + c.sz);
    return v.z > VNDF_R(0.0) ? vndf_impl_share(p) + vndf_impl_zero(w.x, w.y, w.z) : VNDF_R(1.0);
}

// The density of the reflection of wo about a visible normal, given that it lies above the horizon: D / (4 sigma_vis).
// Source: ggx_conic2026.md; it is vndf_ggx_pdf_wi over the reflection probability.
// wo, wi: unit vectors, local frame, anywhere on the sphere.
// alpha: in [1e-8, 1e3] each.
// return: per steradian of wi; 0 for wi.z <= 0 above the surface. For wo.z <= 0 the same as vndf_ggx_pdf_wi.
// Accuracy: 24 eps; double 22.
//     Below alpha = 1e-2 the rounding of wi moves the density by more than that: use the sampler's _with_pdf form there.
VNDF_FN VNDF_REAL vndf_ggx_pdf_wi_conic2026(VNDF_REAL3 wo, VNDF_REAL3 wi, VNDF_REAL2 alpha) {
    struct vndf_impl_view v = vndf_impl_stretch(wo, alpha);
    struct vndf_impl_half h = vndf_impl_half_of(wo, wi, v.alpha_x, v.alpha_y);
    VNDF_REAL pdf = vndf_impl_ggx_reflection_pdf(h, vndf_impl_twice_sigma_visible(v), v.alpha_x, v.alpha_y);
    return wi.z > VNDF_R(0.0) || wo.z <= VNDF_R(0.0) ? pdf : VNDF_R(0.0);
}

// --- The inverse ---

// The stretched normal between wo and wi in the lobe's axes, its cosine with s, and m^T Q m / (mu + mu1) >= 0.
struct vndf_impl_conic_point {
    VNDF_REAL m0, m1, m2, cosine, height;
};

// The three moves backwards: each length is the root that the map takes, from the normal's side.
VNDF_FN VNDF_REAL2 vndf_impl_conic_invert(struct vndf_ggx_conic2026 l, struct vndf_impl_conic_point m) {
    VNDF_REAL slope = VNDF_FMA(l.c0, m.m0, l.rho * l.c2 * m.m2);
    VNDF_REAL root2 = VNDF_FMA(slope, slope, -l.a * m.height);
    VNDF_REAL root = VNDF_SQRT(root2 > VNDF_R(0.0) ? root2 : VNDF_R(0.0)), sum = slope + root;
    VNDF_REAL delta = sum > VNDF_R(0.0) ? m.height / sum : VNDF_R(0.0), tau = delta / l.n;
    // P2, and what was left of the second chord.
    VNDF_REAL rim2 = VNDF_FMA(-l.c0, delta, m.m0), m2 = VNDF_FMA(-l.c2, delta, m.m2);
    VNDF_REAL y = VNDF_FMA(-l.s1, tau, m.m1) / l.p, left = tau * VNDF_FMA(VNDF_R(2.0), m.cosine, -tau) / l.p2;
    VNDF_REAL y2 = y * y, inside = VNDF_R(1.0) - y2;
    VNDF_REAL rim = VNDF_SQRT(VNDF_FMA(l.co_p2, y2, l.co_q2 * (inside > VNDF_R(0.0) ? inside : VNDF_R(0.0))));
    VNDF_REAL rims = l.c0 * (rim + rim2), share = l.rho * l.q2;
    VNDF_REAL part = rims > VNDF_R(0.0) ? left / rims : VNDF_R(0.0);
    VNDF_REAL px = VNDF_FMA(-l.c2 * share, part, m2), x = px / l.q;
    VNDF_REAL rest = part * (VNDF_FMA(l.rho * l.c2, px, l.c0 * rim) + root), square = VNDF_FMA(x, x, y2);
    VNDF_REAL u2 = square > VNDF_R(0.5) ? VNDF_R(1.0) - rest : square;
    return VNDF_MAKE2(vndf_impl_turn(x, y), u2);
}

// The u at which vndf_ggx_sample_wi_conic2026 gives wi.
// wo, wi: unit vectors, local frame, anywhere on the sphere.
// alpha: in [1e-8, 1e3] each.
// return: (u.x, u.y) in [0, 1]. A wi below the horizon, which no u gives, counts as one on it; (0, 0) for wi = -wo.
// Accuracy: 2 eps (1 + condition number), 99th percentile; double 2.
//     Where wi is the mirror image of wo to within rounding.
VNDF_FN VNDF_REAL2 vndf_ggx_invert_wi_conic2026(VNDF_REAL3 wo, VNDF_REAL3 wi, VNDF_REAL2 alpha) {
    struct vndf_ggx_conic2026 l = vndf_ggx_conic2026_lobe(wo, alpha);
    VNDF_REAL hx = l.wo_x + wi.x, hy = l.wo_y + wi.y, hz = l.wo_z + wi.z;
    VNDF_REAL sx = hx / l.alpha_x, sy = hy / l.alpha_y;
    VNDF_REAL length2 = VNDF_FMA(sx, sx, VNDF_FMA(sy, sy, hz * hz)),
              h2 = VNDF_FMA(hx, hx, VNDF_FMA(hy, hy, hz * hz));
    VNDF_REAL rcp = length2 > VNDF_R(0.0) ? VNDF_R(1.0) / VNDF_SQRT(length2) : VNDF_R(0.0);
    VNDF_REAL mx = sx * rcp, my = sy * rcp, mz = hz * rcp, cosine = VNDF_R(0.5) * h2 * rcp / l.t;
    struct vndf_impl_conic_point m;
    m.m0 = VNDF_FMA(mx, l.e0x, VNDF_FMA(my, l.e0y, mz * l.e0z));
    m.m1 = VNDF_FMA(mx, l.e1x, VNDF_FMA(my, l.e1y, mz * l.e1z));
    m.m2 = VNDF_FMA(mx, l.e2x, VNDF_FMA(my, l.e2y, mz * l.e2z));
    m.cosine = cosine;
    // h^T Q h / |h|^2 = wi.z |h|^2 / t of the half vector.
    VNDF_REAL height = vndf_impl_max(wi.z, VNDF_R(0.0)) * (h2 * rcp * rcp) / l.steepness;
    m.height = height;
    VNDF_REAL2 front = vndf_impl_conic_invert(l, m);
    // The cap: 1 - u2 = 2 (s . m) m.z / p, and the stretched reflection, whose part across z has the square
    // u2 p ((1 - u2) p + q).
    VNDF_REAL twice = VNDF_R(2.0) * cosine, rcp_t = VNDF_R(1.0) / l.t;
    VNDF_REAL rcp_p = l.cap_p > VNDF_R(0.0) ? VNDF_R(1.0) / l.cap_p : VNDF_R(0.0);
    VNDF_REAL ox = VNDF_FMA(twice, mx, -l.alpha_x * l.wo_x * rcp_t),
              oy = VNDF_FMA(twice, my, -l.alpha_y * l.wo_y * rcp_t);
    VNDF_REAL rest = twice * mz * rcp_p, part = VNDF_FMA(vndf_impl_max(rest, VNDF_R(0.0)), l.cap_p, l.cap_q);
    VNDF_REAL u2 = VNDF_FMA(ox, ox, oy * oy) * rcp_p / (part > VNDF_R(0.0) ? part : VNDF_R(1.0));
    u2 = rest < VNDF_R(0.5) ? VNDF_R(1.0) - rest : u2;
    int above = l.wo_z > VNDF_R(0.0), defined = length2 > VNDF_R(0.0);
    VNDF_REAL u1 = above ? front.x : vndf_impl_turn(ox, oy);
    u2 = vndf_impl_share(vndf_impl_max(above ? front.y : u2, VNDF_R(0.0)));
    return VNDF_MAKE2(defined ? vndf_impl_share(u1) : VNDF_R(0.0), defined ? u2 : VNDF_R(0.0));
}

// --- One alpha ---

// For alpha_x = alpha_y = alpha the plane of incidence holds e0 and e1, and s2 = c2 = 0: mu by one quadratic, M of P2 in
// one step.
VNDF_FN struct vndf_impl_sample vndf_impl_conic2026_isotropic(VNDF_REAL3 wo, VNDF_REAL alpha, VNDF_REAL2 u) {
    struct vndf_impl_view v = vndf_impl_stretch(wo, VNDF_MAKE2(alpha, alpha));
    struct vndf_impl_disk d = vndf_impl_disk_of(u);
    // Behind the surface, where this is not used, as at normal incidence: no quotient of it overflows.
    int above = v.z > VNDF_R(0.0);
    VNDF_REAL rcp_t = VNDF_R(1.0) / v.r, sz = above ? v.z * rcp_t : VNDF_R(1.0),
              sine = above ? v.l * rcp_t : VNDF_R(0.0);
    VNDF_REAL pole = sz * (v.alpha_x * v.alpha_x), weight = sine * sine;
    VNDF_REAL mu = vndf_impl_cone_quadratic(sz, pole, weight), b = mu + pole, rcp_b = VNDF_R(1.0) / b;
    VNDF_REAL difference = weight * rcp_b, mu1 = pole + difference, rcp_both = VNDF_R(1.0) / (mu + mu1);
    VNDF_REAL e = sine * rcp_b, norm2 = VNDF_FMA(e, e, VNDF_R(1.0)),
              rcp_norm = VNDF_R(1.0) / VNDF_SQRT(norm2);
    VNDF_REAL p2 = mu * rcp_both, q2 = mu * rcp_b, p = VNDF_SQRT(p2), q = VNDF_SQRT(q2);
    VNDF_REAL s0 = mu * rcp_norm, s1 = e * VNDF_FMA(e, sine, pole) * rcp_norm;
    VNDF_REAL py = p * d.y, m2 = q * d.x;
    VNDF_REAL rim = VNDF_SQRT(VNDF_FMA(mu1 * rcp_both, VNDF_FMA(d.y, d.y, d.rest), pole * rcp_b * d.x * d.x));
    VNDF_REAL left = p2 * d.rest, along = VNDF_FMA(s0, rim, s1 * py);
    along = along > VNDF_R(0.0) ? along : VNDF_R(0.0);  // it is, but for rounding
    VNDF_REAL cosine = VNDF_SQRT(VNDF_FMA(along, along, left)), tau = left / (along + cosine);
    VNDF_REAL delta = s0 * tau, m0 = rim + delta, m1 = VNDF_FMA(s1, tau, py);
    VNDF_REAL across = VNDF_FMA(m0, e, m1) * rcp_norm;
    VNDF_REAL ex = vndf_impl_azimuth_x(v), ey = vndf_impl_azimuth_y(v);
    struct vndf_impl_conic_normal h;
    h.x = VNDF_FMA(across, ex, -m2 * ey);
    h.y = VNDF_FMA(across, ey, m2 * ex);
    h.z = VNDF_FMA(-m1, e, m0) * rcp_norm;
    // sqrt((mu + A)^2) is no root here.
    VNDF_REAL visible = VNDF_R(2.0) * v.r * mu * (mu * rcp_b) / norm2, hidden = vndf_impl_hidden_area(v);
    struct vndf_impl_plain_cap cap = vndf_impl_plain_cap_of(v);
    return vndf_impl_conic_reflect(h, vndf_impl_conic_cap_half(cap, d), wo.x, wo.y, wo.z, v.alpha_x,
                                   v.alpha_y, v.z > VNDF_R(0.0) ? visible : hidden);
}

// A reflection of wo above the horizon for alpha_x = alpha_y: the same map as vndf_ggx_sample_wi_conic2026, less work.
// wo: as there. At normal incidence the azimuth 0 counts as the one of wo.
// alpha: in [1e-8, 1e3].
// u, return: as there.
// Accuracy: angle to the exact map, 99th percentile: 2 eps (1 + condition number), 2 behind the surface; double 2, 2.
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
