// GGX reflections above the surface and above a geometric normal, too: nearly none is drawn in vain.
//
// Source: this package; derivation, figures and how to verify it: ggx_cone2026.md. None found published, in a short search.
//     Both half-spaces of reflections are cones of stretched normals: that of the shading normal z is the one of
//     ggx_conic2026.h, that of the geometric normal ng a cap of 90 degrees, ggx_cone2026.h. What is above both, a lune of
//     directions, is where they overlap: the smaller of the two is sampled, and what the other lacks is lost.
// When it pays: at grazing views from a tilt of 15 degrees on, anywhere from 30 degrees. Below 5 degrees, and for small lights
//     away from grazing, ggx_conic2026.h and a test of the sample do as well, for less time.
#ifndef VNDF_GGX_TILTED2026_H
#define VNDF_GGX_TILTED2026_H

#include "ggx_cone2026_arc.h"

VNDF_BEGIN

// What all samples of a lobe share. Made by vndf_ggx_tilted2026_lobe, used by the functions with _lobe in their names; its
// members are internals.
struct vndf_ggx_tilted2026 {
    struct vndf_ggx_conic2026 map;  // of the smaller cone
    VNDF_REAL nx, ny, nz, rcp_n2;   // ng as long as wo
    VNDF_REAL slack;                // the square of how far below ng rounding may move wi
    int about_ng;                   // the smaller cone is that of ng
};

// The numbers of a map that samplers read: of b, or of a.
VNDF_FN struct vndf_ggx_conic2026 vndf_impl_tilted_choice(int other, struct vndf_ggx_conic2026 a,
                                                          struct vndf_ggx_conic2026 b) {
    a.twice_sigma = other ? b.twice_sigma : a.twice_sigma;
    a.spread = other ? b.spread : a.spread;
    a.x = other ? b.x : a.x;
    a.y = other ? b.y : a.y;
    a.z = other ? b.z : a.z;
    a.length2 = other ? b.length2 : a.length2;
    a.e = other ? b.e : a.e;
    a.f = other ? b.f : a.f;
    a.g = other ? b.g : a.g;
    a.e1x = other ? b.e1x : a.e1x;
    a.e1y = other ? b.e1y : a.e1y;
    a.e1z = other ? b.e1z : a.e1z;
    a.e2x = other ? b.e2x : a.e2x;
    a.e2y = other ? b.e2y : a.e2y;
    a.e2z = other ? b.e2z : a.e2z;
    a.step_1 = other ? b.step_1 : a.step_1;
    a.step_2 = other ? b.step_2 : a.step_2;
    a.along_1 = other ? b.along_1 : a.along_1;
    a.along_2 = other ? b.along_2 : a.along_2;
    a.s0 = other ? b.s0 : a.s0;
    a.s2 = other ? b.s2 : a.s2;
    a.rim_0 = other ? b.rim_0 : a.rim_0;
    a.rim_1 = other ? b.rim_1 : a.rim_1;
    a.slope_0 = other ? b.slope_0 : a.slope_0;
    a.slope_2 = other ? b.slope_2 : a.slope_2;
    a.share = other ? b.share : a.share;
    a.bend = other ? b.bend : a.bend;
    return a;
}

// What the samples of a lobe and a geometric normal take beside the lobe.
// lobe: of vndf_ggx_lobe_of.
// ng: unit vector, local frame, anywhere on the sphere: the geometric normal, where z is the shading normal.
// return: a struct for vndf_ggx_sample_wi_tilted2026_lobe, _lobe_with_pdf and vndf_ggx_pdf_wi_tilted2026_lobe.
VNDF_FN struct vndf_ggx_tilted2026 vndf_ggx_tilted2026_of(struct vndf_ggx_lobe lobe, VNDF_REAL3 ng) {
    struct vndf_ggx_tilted2026 t;
    struct vndf_ggx_conic2026 z = vndf_ggx_conic2026_of(lobe);
    // Made dependent on the first cone, so that the two are not packed (impl/stretch.h).
    int ready = z.twice_sigma <= VNDF_REAL_MAX;
    VNDF_REAL3 after = VNDF_MAKE3(ready ? ng.x : ng.z, ready ? ng.y : ng.x, ready ? ng.z : ng.y);
    struct vndf_impl_cap cap = vndf_impl_cap_of(lobe.wo_x, lobe.wo_y, lobe.wo_z, after, VNDF_R(1.0));
    struct vndf_impl_cap_cone k = vndf_impl_cap_axis_apart(
        vndf_impl_cap_cone_of(cap, lobe.wo_x, lobe.wo_y, lobe.wo_z, lobe.alpha_x, lobe.alpha_y), cap,
        VNDF_MAKE3(lobe.wo_x, lobe.wo_y, lobe.wo_z), lobe.alpha_x, lobe.alpha_y);
    struct vndf_ggx_conic2026 n;
    n.alpha_x = lobe.alpha_x;
    n.alpha_y = lobe.alpha_y;
    n = vndf_impl_cap_axes(n, k);
    n.e = k.ex;
    n.f = k.ey;
    n.g = k.ez;
    n.twice_sigma = VNDF_R(2.0) * vndf_impl_cap_sigma(cap, k, VNDF_R(1.0));
    // With wo below ng the cone is that of all normals that face wo, which is not the smaller one; and where ng is z they are
    // one and the same, with the digits of the simpler.
    int tilted = VNDF_FMA(ng.x, ng.x, ng.y * ng.y) > VNDF_R(0.0);
    t.about_ng = tilted && k.inside && n.twice_sigma > VNDF_R(0.0) && n.twice_sigma < z.twice_sigma;
    t.map = vndf_impl_tilted_choice(t.about_ng, z, n);
    t.nx = cap.lx;
    t.ny = cap.ly;
    t.nz = cap.lz;
    VNDF_REAL n2 = VNDF_FMA(t.nx, t.nx, VNDF_FMA(t.ny, t.ny, t.nz * t.nz)), unit = VNDF_R(4.0) * VNDF_EPSILON;
    t.rcp_n2 = n2 > VNDF_R(0.0) ? VNDF_DIVIDE(VNDF_R(1.0), n2) : VNDF_R(0.0);
    t.slack = unit * unit * n2;
    return t;
}

// The lobe of wo, alpha and a geometric normal: all that does not depend on u.
// wo, alpha: as vndf_ggx_lobe_of takes them.
// ng, return: as vndf_ggx_tilted2026_of, which is faster where a lobe is at hand.
VNDF_FN struct vndf_ggx_tilted2026 vndf_ggx_tilted2026_lobe(VNDF_REAL3 wo, VNDF_REAL3 ng, VNDF_REAL2 alpha) {
    return vndf_ggx_tilted2026_of(vndf_ggx_lobe_of(wo, alpha), ng);
}

VNDF_FN struct vndf_impl_conic_normal vndf_impl_tilted_sampled(struct vndf_ggx_tilted2026 t, VNDF_REAL2 u) {
    return vndf_impl_conic_sampled_by(t.map, u, t.about_ng || t.map.wo_z > VNDF_R(0.0));
}
// Below a horizon the density is 0. everywhere: it is not; of normals from all the visible hemisphere, whose area twice_sigma is.
VNDF_FN struct vndf_impl_sample vndf_impl_tilted_reflect(struct vndf_ggx_tilted2026 t,
                                                         struct vndf_impl_conic_normal h, int everywhere) {
    struct vndf_ggx_conic2026 l = t.map;
    int above = l.wo_z > VNDF_R(0.0), about_ng = t.about_ng && !everywhere;
    struct vndf_impl_mirror m =
        vndf_impl_mirror_of(l.wo_x, l.wo_y, l.wo_z, h.x, h.y, h.z, l.alpha_x, l.alpha_y);
    // The horizon of the cone itself is denied by rounding alone: mirrored there, which keeps the length.
    VNDF_REAL height = vndf_impl_max(vndf_impl_abs(m.z), VNDF_R(0.0625) * VNDF_EPSILON),
              z = above && !about_ng && !everywhere ? height : m.z;
    VNDF_REAL over = vndf_impl_dot(m.x, m.y, z, t.nx, t.ny, t.nz);
    VNDF_REAL lift = about_ng && over < VNDF_R(0.0) ? VNDF_R(-2.0) * over * t.rcp_n2 : VNDF_R(0.0);
    struct vndf_impl_sample o =
        vndf_impl_conic_unit(m, VNDF_FMA(lift, t.nx, m.x), VNDF_FMA(lift, t.ny, m.y), VNDF_FMA(lift, t.nz, z),
                             l.alpha_x, l.alpha_y, l.twice_sigma);
    // The other horizon; and the normals of the cone of ng that are below the surface.
    int meets = about_ng ? h.z > VNDF_R(0.0) : over > VNDF_R(0.0);
    o.pdf = everywhere || (meets && o.z > VNDF_R(0.0)) ? o.pdf : VNDF_R(0.0);
    return o;
}
VNDF_FN struct vndf_impl_sample vndf_impl_tilted2026(struct vndf_ggx_tilted2026 t, VNDF_REAL2 u) {
    struct vndf_impl_sample o = vndf_impl_tilted_reflect(t, vndf_impl_tilted_sampled(t, u), 0);
    int kept = o.pdf > VNDF_R(0.0);
    // Of four shapes: of choices of 0 and a number some would be packed for the vector that is returned (impl/stretch.h). And by
    // choices alone: x * 0 + 0 has the sign of x for compilers that do not know a zero's (Mesa's).
    o.x = kept && vndf_impl_abs(o.x) > VNDF_R(0.0) ? o.x : VNDF_R(0.0);
    o.y = kept ? o.y : VNDF_R(0.0);
    o.z = vndf_impl_max(kept ? o.z : VNDF_R(-1.0), VNDF_R(0.0));
    o.pdf = kept ? o.pdf : VNDF_R(0.0);
    return o;
}
// Whether wi is above both, or rounding may have moved it below ng.
VNDF_FN int vndf_impl_tilted_above(struct vndf_ggx_tilted2026 t, VNDF_REAL3 wi) {
    VNDF_REAL over = vndf_impl_dot(wi.x, wi.y, wi.z, t.nx, t.ny, t.nz);
    return wi.z > VNDF_R(0.0) && (over > VNDF_R(0.0) || over * over < t.slack);
}
VNDF_FN VNDF_REAL vndf_impl_tilted_pdf(struct vndf_ggx_tilted2026 t, VNDF_REAL3 wi, int everywhere) {
    struct vndf_ggx_conic2026 l = t.map;
    struct vndf_impl_half h = vndf_impl_half_of(VNDF_MAKE3(l.wo_x, l.wo_y, l.wo_z), wi, l.alpha_x, l.alpha_y);
    VNDF_REAL pdf = vndf_impl_ggx_reflection_pdf(h, l.twice_sigma, l.alpha_x, l.alpha_y);
    return everywhere || vndf_impl_tilted_above(t, wi) ? pdf : VNDF_R(0.0);
}

// A reflection of a lobe: as vndf_ggx_sample_wi_tilted2026, for many u and one wo, ng and alpha.
// Accuracy: angle to the exact map, 99th percentile: 3 eps (1 + condition number), 3 behind the surface; double 3, 3.
VNDF_FN VNDF_REAL3 vndf_ggx_sample_wi_tilted2026_lobe(struct vndf_ggx_tilted2026 lobe, VNDF_REAL2 u) {
    return vndf_impl_direction(vndf_impl_tilted2026(lobe, u));
}

// The same; w: its density per steradian of wi, from the sampler's own terms.
VNDF_FN VNDF_REAL4 vndf_ggx_sample_wi_tilted2026_lobe_with_pdf(struct vndf_ggx_tilted2026 lobe,
                                                               VNDF_REAL2 u) {
    return vndf_impl_direction_pdf(vndf_impl_tilted2026(lobe, u));
}

// The density of a lobe's reflections: as vndf_ggx_pdf_wi_tilted2026.
// Accuracy: 256 eps (1 + condition number); double 64.
VNDF_FN VNDF_REAL vndf_ggx_pdf_wi_tilted2026_lobe(struct vndf_ggx_tilted2026 lobe, VNDF_REAL3 wi) {
    return vndf_impl_tilted_pdf(lobe, wi, 0);
}

// A reflection of wo above the shading normal z and a geometric normal.
// wo: unit vector, local frame, anywhere on the sphere. Of a wo below either normal there are reflections above both as well:
//     give them no weight where the surface hides it.
// ng: unit vector, local frame, anywhere on the sphere: the geometric normal. For ng = z the samples and densities are those of
//     vndf_ggx_sample_wi_conic2026; for ng = -z nothing is above both.
// alpha: in [1e-8, 1e3] each.
// u: a point of the unit disk, u.x its azimuth, u.y its squared radius. The map is continuous in u and preserves area:
//     stratified points stay stratified.
// return: unit vector wi, wi.z > 0 and wi . ng > 0 but for the rounding of wi, with density
//     vndf_ggx_pdf_wi_tilted2026(wo, ng, wi, alpha); or a zero vector with density 0, where the sample is lost: nothing comes from
//     there. One try: the densities of what is kept have the integral vndf_ggx_sigma_tilted / min(sigma), the part that is not
//     lost. Zero, too, at wo = -z, for ng = 0 and where a vector leaves the range of numbers.
// Accuracy: angle to the exact map, 99th percentile: 3 eps (1 + condition number), 3 behind the surface; double 3, 3.
VNDF_FN VNDF_REAL3 vndf_ggx_sample_wi_tilted2026(VNDF_REAL3 wo, VNDF_REAL3 ng, VNDF_REAL2 alpha,
                                                 VNDF_REAL2 u) {
    return vndf_impl_direction(vndf_impl_tilted2026(vndf_ggx_tilted2026_lobe(wo, ng, alpha), u));
}

// The same; w: its density per steradian of wi, from the sampler's own terms.
VNDF_FN VNDF_REAL4 vndf_ggx_sample_wi_tilted2026_with_pdf(VNDF_REAL3 wo, VNDF_REAL3 ng, VNDF_REAL2 alpha,
                                                          VNDF_REAL2 u) {
    return vndf_impl_direction_pdf(vndf_impl_tilted2026(vndf_ggx_tilted2026_lobe(wo, ng, alpha), u));
}

// The density of the samples that are not lost: D / (4 sigma), of the smaller of the two cones.
// Source: ggx_cone2026.md.
// wo, wi: unit vectors, local frame, anywhere on the sphere.
// ng: as vndf_ggx_tilted2026_of takes it.
// alpha: in [1e-8, 1e3] each.
// return: per steradian of wi; 0 below either normal, of ng with a slack of 4 eps for the rounding of wi, and where the half
//     vector is below the surface.
// Accuracy: 256 eps (1 + condition number); double 64.
//     256 is where alphas are 1e9 apart; 99th percentile 1. Of a wo across ng to within 64 eps the density is that of either cone.
//     Below alpha = 1e-2 the rounding of wi moves the density by more than that: use the sampler's _with_pdf form there.
VNDF_FN VNDF_REAL vndf_ggx_pdf_wi_tilted2026(VNDF_REAL3 wo, VNDF_REAL3 ng, VNDF_REAL3 wi, VNDF_REAL2 alpha) {
    return vndf_ggx_pdf_wi_tilted2026_lobe(vndf_ggx_tilted2026_lobe(wo, ng, alpha), wi);
}

// --- How much of a lobe is above both ---

// The projected area of the normals that reflect wo above both normals: sigma_L.
// Source: ggx_cone2026.md: by the arcs of both horizons.
// wo, alpha: as vndf_ggx_lobe_of takes them.
// ng: as vndf_ggx_tilted2026_of takes it.
// return: per unit area of the macrosurface, in [0, sigma(wo)]: the part of vndf_ggx_sample_wi_tilted2026 that is not lost is this
//     over the smaller of vndf_ggx_sigma_visible and vndf_ggx_sigma_cap(wo, ng, 1).
// Accuracy: 8 eps (|alpha wo| + condition number), 99th percentile; double 4096.
//     Absolute: of a tail far from the mirror direction digits are lost. In double with alphas down to 1e-8; in float one below
//     1e-6, or below 2^-17 of the other, counts as that. Where wo is below the surface and within 2^-8 of the plane across ng:
//     no digits. Double against quadrature over directions: 1e-12.
VNDF_FN VNDF_REAL vndf_ggx_sigma_tilted(VNDF_REAL3 wo, VNDF_REAL3 ng, VNDF_REAL2 alpha) {
    VNDF_REAL low_x = vndf_impl_alpha(alpha.x), low_y = vndf_impl_alpha_y(alpha.y);
    VNDF_REAL alpha_x = vndf_impl_arc_alpha(low_x, low_y), alpha_y = vndf_impl_arc_alpha(low_y, low_x);
    VNDF_REAL size = vndf_impl_abs(ng.x) + vndf_impl_max(ng.y, -ng.y),
              scale = vndf_impl_scale(size > VNDF_R(0.0) ? size : VNDF_R(1.0));
    VNDF_REAL x = ng.x * scale, y = ng.y * scale, length2 = VNDF_FMA(x, x, y * y),
              rcp = VNDF_DIVIDE(VNDF_R(1.0), VNDF_SQRT(length2 > VNDF_R(0.0) ? length2 : VNDF_R(1.0)));
    // Between the corners, where both horizons meet. From behind every visible normal reflects above z, and ng is a cap alone.
    struct vndf_impl_arc of_z, of_ng;
    of_z.from = of_ng.to = vndf_impl_vector_of(y * rcp, -x * rcp, VNDF_R(0.0));
    of_z.to = of_ng.from = vndf_impl_vector_of(-y * rcp, x * rcp, VNDF_R(0.0));
    of_z.l = vndf_impl_vector_of(VNDF_R(0.0), VNDF_R(0.0), VNDF_R(1.0));
    of_ng.l = vndf_impl_vector_of(ng.x, ng.y, ng.z);
    struct vndf_impl_rim rim = vndf_impl_rim_of(wo, ng, VNDF_R(1.0));
    int front = wo.z > VNDF_R(0.0);
    VNDF_REAL area = VNDF_R(0.0), sum = VNDF_R(0.0);
    for (int k = 0; k < 2; ++k) {
        struct vndf_impl_arc arc =
            vndf_impl_arc_choice(front, rim.arc, vndf_impl_arc_choice(k == 0, of_ng, of_z));
        area = vndf_impl_arc_area(wo, alpha_x, alpha_y, arc, front ? VNDF_R(1.0) : rim.gap);
        sum += area;
    }
    VNDF_REAL visible = vndf_ggx_sigma_visible(wo, alpha);
    // Where ng is z or -z there are no corners.
    VNDF_REAL level = ng.z > VNDF_R(0.0) ? visible : VNDF_R(0.0);
    VNDF_REAL sigma = size > VNDF_R(0.0) ? VNDF_1_PI * sum : level;
    sigma = vndf_impl_min(vndf_impl_max(sigma, VNDF_R(0.0)), visible);
    VNDF_REAL behind = vndf_impl_rim_mass(rim, wo, alpha_x, alpha_y, area);
    return vndf_impl_finite(front ? sigma : behind) + vndf_impl_zero(wo.x, wo.y, wo.z) +
           vndf_impl_zero(ng.x, ng.y, ng.z);
}

VNDF_END

#endif
