// GGX reflections into a spherical cap, all of them and no other: a sphere light, or the sun, or a tilted half-space.
//
// Source: this package; derivation, figures and how to verify it: ggx_cone2026.md. None found published, in a short search.
//     The stretched normals that reflect wo into the cap wi . l > cos beta fill one elliptic cone (impl/cap_cone.h), as those
//     that reflect it above the horizon do, the cap about z with beta = 90 degrees; and the map of ggx_conic2026.h takes the
//     disk to any such cone.
// The cone may leave the hemisphere of normals: theta_o + theta_l + beta <= pi keeps it inside, whatever the alphas. Beyond,
//     samples whose half vector is below the surface have density 0: no light comes from there.
// Symbols: mu, mu1, mu2, e0, kappa: as in impl/cap_cone.h; p^2 = mu / (mu + mu1), q^2 = mu / (mu + mu2).
#ifndef VNDF_GGX_CONE2026_H
#define VNDF_GGX_CONE2026_H

#include "ggx_conic2026.h"
#include "impl/cap_cone.h"

VNDF_BEGIN

// --- The cone of one wo, alpha and cap ---

// What all samples of a cone share. Made by vndf_ggx_cone2026_lobe, used by the functions with _lobe in their names; its
// members are internals.
struct vndf_ggx_cone2026 {
    struct vndf_ggx_conic2026 map;  // mu = 1 and v . e0 = 1, e0 a unit vector; unit is 1 + m1
    VNDF_REAL length;               // 1 / (v . e0) of v = alpha wo
    VNDF_REAL lx, ly, lz;           // as long as wo
    VNDF_REAL gap, limit, rcp_mu;  // (1 - cos beta) |wo|^2; the squared chord that rounding may reach; 1 / mu
    VNDF_REAL rcp_rim;             // 1 / sin^2 beta
    int inside, defined;           // -wo is outside the cap
};

// 1 - cos beta over what it counts as.
VNDF_FN VNDF_REAL vndf_impl_cap_part(VNDF_REAL one_minus_cos) {
    return vndf_impl_share(VNDF_DIVIDE(vndf_impl_max(one_minus_cos, VNDF_R(0.0)), VNDF_IMPL_CAP_LEAST));
}

// sigma_C of the cone; for a cap of no size it shrinks with 1 - cos beta.
VNDF_FN VNDF_REAL vndf_impl_cap_sigma(struct vndf_impl_cap c, struct vndf_impl_cap_cone k,
                                      VNDF_REAL one_minus_cos) {
    VNDF_REAL sigma = VNDF_DIVIDE(k.mu, VNDF_SQRT(k.sum)) * k.along;
    return c.defined && k.length > VNDF_R(0.0) ? sigma * vndf_impl_cap_part(one_minus_cos) : VNDF_R(0.0);
}

// Two vectors that are orthonormal with the unit vector e, a x b = e: b across z, or along y where e is z. (x, y): along
// (ex, ey), and at hand before it.
struct vndf_impl_cap_frame {
    VNDF_REAL ax, ay, az, bx, by;
};
VNDF_FN struct vndf_impl_cap_frame vndf_impl_cap_frame_of(VNDF_REAL x, VNDF_REAL y, VNDF_REAL ex,
                                                          VNDF_REAL ey, VNDF_REAL ez) {
    struct vndf_impl_cap_frame f;
    // Of two shapes: alike they would be packed (impl/stretch.h).
    VNDF_REAL size = vndf_impl_abs(x) + vndf_impl_max(y, -y);
    int level = size > VNDF_R(0.0);
    VNDF_REAL scale = vndf_impl_scale(level ? size : VNDF_R(1.0)), sx = level ? x * scale : VNDF_R(1.0),
              sy = y * scale;
    VNDF_REAL rcp = VNDF_DIVIDE(VNDF_R(1.0), VNDF_SQRT(VNDF_FMA(sx, sx, sy * sy)));
    f.by = sx * rcp;
    f.bx = -(sy * rcp);
    f.ax = f.by * ez;
    f.ay = -(f.bx * ez);
    f.az = -VNDF_FMA(f.by, ex, -f.bx * ey);
    return f;
}

#define VNDF_IMPL_CAP_DOWN VNDF_R(9.31322574615478515625e-10)  // 2^-30
#define VNDF_IMPL_CAP_LESS VNDF_R(8.67361737988403547e-19)     // 2^-60

// e1 and e2 by a rotation of two vectors across e0, and the numbers of the map. Across e0, with P = kappa A^2,
//     -f^T Q f = (mu f^T P f + g^T adj(P) g) / (mu + e0^T P e0) + (f . q)^2 / (2 omega),  g = e0 x f,
// a sum of positive terms; its part without the trace keeps the differences of the alphas exact.
VNDF_FN struct vndf_ggx_conic2026 vndf_impl_cap_axes(struct vndf_ggx_conic2026 l,
                                                     struct vndf_impl_cap_cone k) {
    VNDF_REAL x2 = l.alpha_x * l.alpha_x, y2 = l.alpha_y * l.alpha_y;
    struct vndf_impl_cap_frame f = vndf_impl_cap_frame_of(k.wide_x, k.wide_y, k.ex, k.ey, k.ez);
    VNDF_REAL rcp = k.rcp, rcp_mu = rcp * k.omega, share = VNDF_R(0.5) * k.scale * rcp * VNDF_IMPL_CAP_DOWN;
    VNDF_REAL kappa = k.kappa * rcp_mu;
    // P / (1 + e0^T P e0) for mu = 1, and with it all of the matrix times 2^-30: its products may be as large as numbers get.
    VNDF_REAL across_x = VNDF_FMA(k.ey, k.ey, k.ez * k.ez), across_y = VNDF_FMA(k.ex, k.ex, k.ez * k.ez),
              across_z = VNDF_FMA(k.ex, k.ex, k.ey * k.ey);
    VNDF_REAL along = VNDF_FMA(x2 * k.ex, k.ex, VNDF_FMA(y2 * k.ey, k.ey, k.ez * k.ez));
    VNDF_REAL part = VNDF_DIVIDE(VNDF_IMPL_CAP_DOWN * kappa, VNDF_FMA(kappa, along, VNDF_R(1.0)));
    VNDF_REAL qa = VNDF_FMA(f.ax, k.qx, VNDF_FMA(f.ay, k.qy, f.az * k.qz));
    VNDF_REAL qb = VNDF_FMA(f.bx, k.qx, f.by * k.qy);
    // Of diagonal forms whatever is the same for all three axes makes no difference: that of x or y, which is more across e0.
    int other = across_x > across_y;
    VNDF_REAL fa = other ? f.ay : f.ax, fb = other ? f.by : f.bx, less = other ? l.alpha_x : l.alpha_y,
              more2 = other ? y2 : x2;
    VNDF_REAL slant = (l.alpha_x - l.alpha_y) * (l.alpha_x + l.alpha_y);
    VNDF_REAL flat = part * (other ? -slant : slant) * (VNDF_R(1.0) + kappa);
    VNDF_REAL steep =
        part * ((VNDF_R(1.0) - less) * (VNDF_R(1.0) + less)) * VNDF_FMA(kappa, more2, VNDF_R(1.0));
    VNDF_REAL d =
        VNDF_FMA(flat * (fa - fb), fa + fb, VNDF_FMA(steep * f.az, f.az, share * (qa - qb) * (qa + qb)));
    VNDF_REAL cross = VNDF_R(2.0) * VNDF_FMA(flat * fa, fb, share * qa * qb);
    VNDF_REAL plane = VNDF_FMA(x2, across_x, VNDF_FMA(y2, across_y, across_z));
    VNDF_REAL minors = VNDF_FMA(y2, across_x, VNDF_FMA(x2, across_y, x2 * y2 * across_z));
    VNDF_REAL trace = VNDF_FMA(part, VNDF_FMA(kappa, minors, plane), share * VNDF_FMA(qa, qa, qb * qb));
    trace = k.inside ? trace : VNDF_R(1.0);
    // A round cone has no axes: 1e-18 takes the first.
    VNDF_REAL scale = vndf_impl_scale(vndf_impl_max(trace, VNDF_IMPL_LEAST));
    d = VNDF_FMA(d, scale, VNDF_R(1e-18));
    cross *= scale;
    VNDF_REAL size = VNDF_SQRT(VNDF_FMA(d, d, cross * cross)), larger = size + vndf_impl_abs(d);
    int swap = d < VNDF_R(0.0);
    VNDF_REAL ca = swap ? cross : larger, cb = swap ? larger : cross;
    l.e1x = VNDF_FMA(ca, f.ax, cb * f.bx);
    l.e1y = VNDF_FMA(ca, f.ay, cb * f.by);
    l.e1z = ca * f.az;
    l.e2x = VNDF_FMA(ca, f.bx, -cb * f.ax);
    l.e2y = VNDF_FMA(ca, f.by, -cb * f.ay);
    l.e2z = -cb * f.az;
    l.rcp_spread = VNDF_R(2.0) * size * larger;
    l.spread = VNDF_DIVIDE(VNDF_R(1.0), l.rcp_spread);
    l.dual_1 = l.spread;
    l.dual_2 = l.spread;
    VNDF_REAL gap = size * vndf_impl_rcp_power(scale), m1 = VNDF_R(0.5) * (trace + gap),
              most = VNDF_R(1e36) * VNDF_IMPL_CAP_DOWN;
    gap = VNDF_DIVIDE(vndf_impl_min(gap, most), VNDF_IMPL_CAP_DOWN);
    m1 = VNDF_DIVIDE(vndf_impl_min(m1, most), VNDF_IMPL_CAP_DOWN);
    // 1 / (1 + m2) and m2 / (1 + m2) as m1 and m1 m2 over m1 + m1 m2, large ones less.
    VNDF_REAL down = m1 > VNDF_R(1.0) ? VNDF_IMPL_CAP_LESS : VNDF_R(1.0);
    VNDF_REAL first = m1 * down, both = vndf_impl_min(k.product * rcp_mu * down * rcp_mu, m1 * first);
    gap = k.inside ? gap : VNDF_R(0.0);
    m1 = k.inside ? m1 : VNDF_R(0.0);
    VNDF_REAL rcp_g1 = VNDF_DIVIDE(VNDF_R(1.0), VNDF_R(1.0) + m1);
    // Made dependent on the first, so that the two are not packed (impl/stretch.h).
    VNDF_REAL rcp_both = VNDF_DIVIDE(VNDF_R(1.0), rcp_g1 > VNDF_R(0.0) ? first + both : VNDF_R(1.0));
    VNDF_REAL rcp_g2 = first * rcp_both;
    // v . f = (e^T P f + q . f) / (2 omega), e = size e0: over v . e0.
    VNDF_REAL p = k.kappa * k.size, half_omega = VNDF_R(0.5) * (rcp * k.mu) * k.length;
    VNDF_REAL tx = VNDF_FMA(p * x2, k.ex, k.qx), ty = VNDF_FMA(p * y2, k.ey, k.qy),
              tz = VNDF_FMA(p, k.ez, k.qz);
    l.along_1 = half_omega * VNDF_FMA(tx, l.e1x, VNDF_FMA(ty, l.e1y, tz * l.e1z));
    l.along_2 = half_omega * VNDF_FMA(tx, l.e2x, VNDF_FMA(ty, l.e2y, tz * l.e2z));
    l.along_1 = k.inside ? l.along_1 : VNDF_R(0.0);
    l.along_2 = k.inside ? l.along_2 : VNDF_R(0.0);
    l.s0 = VNDF_R(1.0);
    l.s2 = l.along_2 * l.spread;
    VNDF_REAL root_1 = VNDF_SQRT(rcp_g1), root_2 = VNDF_SQRT(root_1 > VNDF_R(0.0) ? rcp_g2 : VNDF_R(1.0));
    // The sign of e1 is that of q . e1 >= 0.
    int turned = VNDF_FMA(ca, qa, cb * qb) < VNDF_R(0.0);
    l.step_1 = turned ? -root_1 : root_1;
    l.step_2 = turned ? -root_2 : root_2;
    l.rim_0 = vndf_impl_max(both * rcp_both, VNDF_R(1e-30));  // so that M > 0
    // The steps of the map times 1 + m1, which may be as large as numbers get: as much less of v.
    VNDF_REAL skew = gap * rcp_g1;
    l.rim_1 = skew * rcp_g2;
    l.slope_0 = VNDF_R(1.0);
    l.slope_2 = skew * l.along_2;
    l.share = l.rim_1;
    l.bend = VNDF_FMA(l.slope_2, l.s2, VNDF_R(1.0));
    l.x = k.x * k.length;
    l.y = k.y * k.length;
    l.z = k.z * k.length;
    l.length2 = VNDF_FMA(l.x, l.x, VNDF_FMA(l.y, l.y, l.z * l.z)) * rcp_g1;
    l.x *= rcp_g1;
    l.y *= rcp_g1;
    l.z *= rcp_g1;
    l.unit = VNDF_R(1.0) + m1;
    return l;
}

// What the samples of a lobe and a cap take beside the lobe.
// lobe: of vndf_ggx_lobe_of.
// l: unit vector, local frame, anywhere on the sphere: the centre of the cap.
// one_minus_cos: in [0, 2]: 1 - cos beta of its half angle beta, which for a small light keeps its digits, as 2 sin^2(beta / 2).
// return: a struct for vndf_ggx_sample_wi_cone2026_lobe, _lobe_with_pdf, vndf_ggx_pdf_wi_cone2026_lobe and
//     vndf_ggx_invert_wi_cone2026_lobe.
VNDF_FN struct vndf_ggx_cone2026 vndf_ggx_cone2026_of(struct vndf_ggx_lobe lobe, VNDF_REAL3 l,
                                                      VNDF_REAL one_minus_cos) {
    struct vndf_ggx_cone2026 c;
    struct vndf_impl_cap cap = vndf_impl_cap_of(lobe.wo_x, lobe.wo_y, lobe.wo_z, l, one_minus_cos);
    struct vndf_impl_cap_cone k =
        vndf_impl_cap_cone_of(cap, lobe.wo_x, lobe.wo_y, lobe.wo_z, lobe.alpha_x, lobe.alpha_y);
    c.lx = cap.lx;
    c.ly = cap.ly;
    c.lz = cap.lz;
    c.inside = k.inside;
    c.defined = cap.defined && k.length > VNDF_R(0.0);
    c.gap = cap.gap;
    c.rcp_rim = cap.rcp_rim;
    VNDF_REAL chord = VNDF_SQRT(k.mu > VNDF_R(0.0) ? VNDF_R(2.0) * cap.gap : VNDF_R(1.0)),
              reach = chord + VNDF_R(32.0) * VNDF_EPSILON;
    c.limit = reach * reach;
    c.rcp_mu = k.scale * (k.rcp * k.omega);
    c.map.alpha_x = lobe.alpha_x;
    c.map.alpha_y = lobe.alpha_y;
    c.map.wo_x = lobe.wo_x;
    c.map.wo_y = lobe.wo_y;
    c.map.wo_z = lobe.wo_z;
    c.map = vndf_impl_cap_axes(c.map, k);
    c.map.e = k.ex;
    c.map.f = k.ey;
    c.map.g = k.ez;
    c.length = k.length;
    c.map.twice_sigma = VNDF_R(2.0) * vndf_impl_cap_sigma(cap, k, one_minus_cos);
    return c;
}

// The cone of wo, alpha and a cap: all that does not depend on u.
// wo, alpha: as vndf_ggx_lobe_of takes them.
// l, one_minus_cos, return: as vndf_ggx_cone2026_of, which is faster where a lobe is at hand.
VNDF_FN struct vndf_ggx_cone2026 vndf_ggx_cone2026_lobe(VNDF_REAL3 wo, VNDF_REAL3 l, VNDF_REAL one_minus_cos,
                                                        VNDF_REAL2 alpha) {
    return vndf_ggx_cone2026_of(vndf_ggx_lobe_of(wo, alpha), l, one_minus_cos);
}

// --- Samples and their density ---

// The squared chord between the unit vectors along wi and l, times |wi| |l|.
VNDF_FN VNDF_REAL vndf_impl_cap_chord2(struct vndf_ggx_cone2026 c, VNDF_REAL wx, VNDF_REAL wy, VNDF_REAL wz) {
    VNDF_REAL x = wx - c.lx, y = wy - c.ly, z = wz - c.lz;
    VNDF_REAL more = VNDF_FMA(x, wx + c.lx, VNDF_FMA(y, wy + c.ly, z * (wz + c.lz)));
    return VNDF_FMA(VNDF_R(-0.25) * more, more, VNDF_FMA(x, x, VNDF_FMA(y, y, z * z)));
}

VNDF_FN struct vndf_impl_sample vndf_impl_cone2026(struct vndf_ggx_cone2026 c, VNDF_REAL2 u) {
    struct vndf_impl_disk d = vndf_impl_disk_of(u);
    VNDF_REAL radius = VNDF_SQRT(d.u2 * c.map.spread);
    struct vndf_impl_conic_normal h = vndf_impl_conic_normal_of(c.map, radius * d.cosine, radius * d.sine,
                                                                d.u2 * (d.sine * d.sine), d.rest);
    struct vndf_impl_mirror m =
        vndf_impl_mirror_of(c.map.wo_x, c.map.wo_y, c.map.wo_z, h.x, h.y, h.z, c.map.alpha_x, c.map.alpha_y);
    // In the cap, as it is but for rounding: moved to the rim along the chord to l, to first order, or to l.
    VNDF_REAL x = m.x - c.lx, y = m.y - c.ly, z = m.z - c.lz;
    VNDF_REAL off = VNDF_R(0.5) * VNDF_FMA(x, x, VNDF_FMA(y, y, z * z));
    VNDF_REAL cut = c.inside
                        ? vndf_impl_max(vndf_impl_min((c.gap - off) * c.rcp_rim, VNDF_R(0.0)), VNDF_R(-1.0))
                        : VNDF_R(0.0);
    struct vndf_impl_sample o =
        vndf_impl_conic_unit(m, VNDF_FMA(cut, x, m.x), VNDF_FMA(cut, y, m.y), VNDF_FMA(cut, z, m.z),
                             c.map.alpha_x, c.map.alpha_y, c.map.twice_sigma);
    // A sample of all normals that face wo may miss the cap.
    int hits = c.inside || off <= c.gap;
    o.pdf = h.z > VNDF_R(0.0) && hits ? o.pdf : VNDF_R(0.0);
    return vndf_impl_where(c.defined, o);
}

// A reflection of a cone: as vndf_ggx_sample_wi_cone2026, for many u and one wo, cap and alpha.
// Accuracy: angle to the exact map, 99th percentile: 3 eps (1 + condition number), 3 behind the surface; double 3, 3.
VNDF_FN VNDF_REAL3 vndf_ggx_sample_wi_cone2026_lobe(struct vndf_ggx_cone2026 cone, VNDF_REAL2 u) {
    return vndf_impl_direction(vndf_impl_cone2026(cone, u));
}

// The same; w: its density per steradian of wi, from the sampler's own terms.
VNDF_FN VNDF_REAL4 vndf_ggx_sample_wi_cone2026_lobe_with_pdf(struct vndf_ggx_cone2026 cone, VNDF_REAL2 u) {
    return vndf_impl_direction_pdf(vndf_impl_cone2026(cone, u));
}

// The density of a cone's reflections: as vndf_ggx_pdf_wi_cone2026.
// Accuracy: 64 eps (1 + condition number); double 64.
VNDF_FN VNDF_REAL vndf_ggx_pdf_wi_cone2026_lobe(struct vndf_ggx_cone2026 cone, VNDF_REAL3 wi) {
    struct vndf_impl_half h = vndf_impl_half_of(VNDF_MAKE3(cone.map.wo_x, cone.map.wo_y, cone.map.wo_z), wi,
                                                cone.map.alpha_x, cone.map.alpha_y);
    VNDF_REAL pdf = vndf_impl_ggx_reflection_pdf(h, cone.map.twice_sigma, cone.map.alpha_x, cone.map.alpha_y);
    int holds = vndf_impl_cap_chord2(cone, wi.x, wi.y, wi.z) <= cone.limit;
    return holds && cone.defined ? pdf : VNDF_R(0.0);
}

// A reflection of wo into the cap wi . l > cos beta.
// wo: unit vector, local frame, anywhere on the sphere.
// l, one_minus_cos: as vndf_ggx_cone2026_of takes them. A cap of no size counts as one of 2^-50 (double: 2^-108), with density
//     0. With -wo in the cap, or within 2^-12 of one below 60 degrees, the samples are those of all normals that face wo.
// alpha: in [1e-8, 1e3] each.
// u: a point of the unit disk, u.x its azimuth, u.y its squared radius. The map is continuous in u and preserves area:
//     stratified points stay stratified.
// return: unit vector wi in the cap, with density vndf_ggx_pdf_wi_cone2026(wo, l, one_minus_cos, wi, alpha). Where the half
//     vector is below the surface, and where all normals are sampled and wi misses the cap: density 0. (0, 0, 1) with density 0
//     for a wo or l that is a zero vector or leaves the range of numbers. A wi below the horizon keeps its density: give it no
//     weight where the surface hides it.
// Accuracy: angle to the exact map, 99th percentile: 3 eps (1 + condition number), 3 behind the surface; double 3, 3.
VNDF_FN VNDF_REAL3 vndf_ggx_sample_wi_cone2026(VNDF_REAL3 wo, VNDF_REAL3 l, VNDF_REAL one_minus_cos,
                                               VNDF_REAL2 alpha, VNDF_REAL2 u) {
    return vndf_impl_direction(vndf_impl_cone2026(vndf_ggx_cone2026_lobe(wo, l, one_minus_cos, alpha), u));
}

// The same; w: its density per steradian of wi, from the sampler's own terms.
VNDF_FN VNDF_REAL4 vndf_ggx_sample_wi_cone2026_with_pdf(VNDF_REAL3 wo, VNDF_REAL3 l, VNDF_REAL one_minus_cos,
                                                        VNDF_REAL2 alpha, VNDF_REAL2 u) {
    return vndf_impl_direction_pdf(
        vndf_impl_cone2026(vndf_ggx_cone2026_lobe(wo, l, one_minus_cos, alpha), u));
}

// The density of the reflection of wo about a visible normal, given that it lies in the cap: D / (4 sigma_C).
// Source: ggx_cone2026.md; it is vndf_ggx_pdf_wi over the probability of the cap where the cone is above the surface.
// wo, wi: unit vectors, local frame, anywhere on the sphere.
// l, one_minus_cos: as vndf_ggx_cone2026_of takes them.
// alpha: in [1e-8, 1e3] each.
// return: per steradian of wi; 0 outside the cap, which is judged with a slack of 32 eps for the rounding of wi, where the half
//     vector is below the surface, and for a cap of no size.
// Accuracy: 64 eps (1 + condition number); double 64.
//     Below alpha = 1e-2 the rounding of wi moves the density by more than that: use the sampler's _with_pdf form there.
VNDF_FN VNDF_REAL vndf_ggx_pdf_wi_cone2026(VNDF_REAL3 wo, VNDF_REAL3 l, VNDF_REAL one_minus_cos,
                                           VNDF_REAL3 wi, VNDF_REAL2 alpha) {
    return vndf_ggx_pdf_wi_cone2026_lobe(vndf_ggx_cone2026_lobe(wo, l, one_minus_cos, alpha), wi);
}

// --- How much of a lobe is reflected into a cap ---

// The projected area of the normals that reflect wo into a cap: sigma_C.
// Source: ggx_cone2026.md: mu (v . e0) / sqrt((mu + mu1)(mu + mu2)).
// wo, alpha: as vndf_ggx_lobe_of takes them.
// l, one_minus_cos: as vndf_ggx_cone2026_of takes them.
// return: per unit area of the macrosurface; of the whole cone: where it leaves the hemisphere of normals, theta_o + theta_l +
//     beta > 180 degrees, an upper bound, and with -wo in the cap the length of alpha wo, all normals that face wo. 0 for a cap
//     of no size.
// Accuracy: 2000 eps (1 + condition number); double 2000.
//     That is where alphas are 1e6 apart; 99th percentile 2. Double against quadrature over directions: 1e-12.
VNDF_FN VNDF_REAL vndf_ggx_sigma_cap(VNDF_REAL3 wo, VNDF_REAL3 l, VNDF_REAL one_minus_cos, VNDF_REAL2 alpha) {
    VNDF_REAL alpha_x = vndf_impl_alpha(alpha.x), alpha_y = vndf_impl_alpha_y(alpha.y);
    struct vndf_impl_cap cap = vndf_impl_cap_of(wo.x, wo.y, wo.z, l, one_minus_cos);
    VNDF_REAL sigma = vndf_impl_cap_sigma(cap, vndf_impl_cap_cone_of(cap, wo.x, wo.y, wo.z, alpha_x, alpha_y),
                                          one_minus_cos);
    VNDF_REAL zero = vndf_impl_zero(wo.x, wo.y, wo.z) + vndf_impl_zero(l.x, l.y, l.z);
    // Of vectors that are far from unit nothing may be left to divide by.
    return (sigma > VNDF_R(0.0) ? vndf_impl_finite(sigma) : VNDF_R(0.0)) + zero;
}

// The probability that the reflection of wo about a visible normal lies in a cap.
// Source: ggx_cone2026.md: sigma_C / sigma.
// wo, alpha: as vndf_ggx_lobe_of takes them.
// l, one_minus_cos: as vndf_ggx_cone2026_of takes them.
// return: in [0, 1]; an upper bound where vndf_ggx_sigma_cap is one.
// Accuracy: 400 eps (1 + condition number); double 400.
//     That is where alphas are 1e6 apart; 99th percentile 2.
VNDF_FN VNDF_REAL vndf_ggx_cap_probability(VNDF_REAL3 wo, VNDF_REAL3 l, VNDF_REAL one_minus_cos,
                                           VNDF_REAL2 alpha) {
    VNDF_REAL sigma_cap = vndf_ggx_sigma_cap(wo, l, one_minus_cos, alpha), sigma = vndf_ggx_sigma(wo, alpha);
    int visible = sigma > VNDF_R(0.0) && sigma_cap < sigma;
    return visible ? VNDF_DIVIDE(sigma_cap, sigma) : (sigma_cap > VNDF_R(0.0) ? VNDF_R(1.0) : VNDF_R(0.0));
}

// --- The inverse ---

#if VNDF_DOUBLE
#define VNDF_IMPL_CAP_MOST VNDF_R(1e150)
#else
#define VNDF_IMPL_CAP_MOST VNDF_R(1e18)
#endif

// The u at which a cone gives wi: as vndf_ggx_invert_wi_cone2026.
VNDF_FN VNDF_REAL2 vndf_ggx_invert_wi_cone2026_lobe(struct vndf_ggx_cone2026 cone, VNDF_REAL3 wi) {
    struct vndf_ggx_conic2026 l = cone.map;
    struct vndf_impl_conic_half h = vndf_impl_conic_half_of(l, wi);
    VNDF_REAL twice = h.twice * cone.length;
    // m^T Q m for mu = 1: |A m|^2 (wi . l - cos beta) / mu, of what all normals are, (v . m)^2.
    VNDF_REAL depth = vndf_impl_max(
        VNDF_FMA(VNDF_R(-0.5), vndf_impl_cap_chord2(cone, wi.x, wi.y, wi.z), cone.gap), VNDF_R(0.0));
    VNDF_REAL up2 = VNDF_R(0.25) * (twice * twice);
    VNDF_REAL height = cone.inside ? depth * h.square * cone.rcp_mu : up2;
    // All steps times 1 + m1, as in the map; of more than 1e18 (double: 1e150) squares would leave the range of numbers.
    VNDF_REAL steps = vndf_impl_min(l.unit, VNDF_IMPL_CAP_MOST);
    l.length2 = l.length2 * steps * steps;
    struct vndf_impl_disk_square d =
        vndf_impl_conic_invert(l, h.m, twice * steps, VNDF_DIVIDE(height, steps));
    VNDF_REAL u1 = vndf_impl_share(vndf_impl_turn(d.x, d.y));
    VNDF_REAL u2 = cone.inside || up2 > VNDF_R(0.5) ? d.u2 : VNDF_R(1.0) - up2;
    u2 = vndf_impl_share(vndf_impl_max(u2, VNDF_R(0.0)));
    int defined = h.defined && cone.defined;
    return VNDF_MAKE2(defined ? u1 : VNDF_R(0.0), defined ? u2 : VNDF_R(0.0));
}

// The u at which vndf_ggx_sample_wi_cone2026 gives wi.
// wo, wi: unit vectors, local frame, anywhere on the sphere.
// l, one_minus_cos: as vndf_ggx_cone2026_of takes them.
// alpha: in [1e-8, 1e3] each.
// return: (u.x, u.y) in [0, 1]. A wi outside the cap, which no u gives, counts as one on its rim; (0, 0) for wi = -wo.
// Accuracy: 16 eps (1 + condition number), 99th percentile; double 40.
//     Where wi is the mirror image of wo to within rounding.
VNDF_FN VNDF_REAL2 vndf_ggx_invert_wi_cone2026(VNDF_REAL3 wo, VNDF_REAL3 l, VNDF_REAL one_minus_cos,
                                               VNDF_REAL3 wi, VNDF_REAL2 alpha) {
    return vndf_ggx_invert_wi_cone2026_lobe(vndf_ggx_cone2026_lobe(wo, l, one_minus_cos, alpha), wi);
}

VNDF_END

#endif
