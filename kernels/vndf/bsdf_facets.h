// Microfacets without their reflectance: what a rough conductor and a rough dielectric share, with the choices of effects.h.
//
// What they reflect, BSDF times cos(theta_i), is F D G2 / (4 wo.z): the density of the sampler that is chosen, times the
// weight of a sample. The weight is F G2 / G1(wo), over what the sampler's density has on that of mirrored visible normals;
// the density cancels, so that it is accurate where the density is not.
//
// Samples are lost below the geometric normal ng, too, but with VNDF_SAMPLING tilted next to none.
//
// Everything asked of a distribution stands here, once for each choice; no other file of a material knows them.
#ifndef VNDF_BSDF_FACETS_H
#define VNDF_BSDF_FACETS_H

#include "effects.h"

// The cone that reflections are drawn from, and whether it may be about the geometric normal.
#if VNDF_CHOSEN(VNDF_SAMPLING, tilted) && VNDF_SHADING_NORMAL
#define VNDF_IMPL_TILTED 1
#define VNDF_IMPL_CONIC 1
#define VNDF_IMPL_CONE tilted.map
#elif VNDF_CHOSEN(VNDF_SAMPLING, conic) || VNDF_CHOSEN(VNDF_SAMPLING, tilted)
#define VNDF_IMPL_TILTED 0
#define VNDF_IMPL_CONIC 1
#define VNDF_IMPL_CONE conic
#else
#define VNDF_IMPL_TILTED 0
#define VNDF_IMPL_CONIC 0
#endif

#if VNDF_CHOSEN(VNDF_NDF, beckmann)
#include "beckmann_jakob2014.h"
#include "impl/mirror.h"
#else
#include "ggx.h"
#if VNDF_CHOSEN(VNDF_SAMPLING, bounded)
#include "ggx_eto2023.h"
#elif VNDF_IMPL_TILTED
#include "ggx_tilted2026.h"
#elif VNDF_IMPL_CONIC
#include "ggx_conic2026.h"
#endif
#endif

VNDF_BEGIN

// --- Density, weight and sample of one view direction ---

#if VNDF_DIELECTRIC
// The facet of a pair of directions: its normal of any length by their half vector.
struct vndf_impl_facing {
    VNDF_REAL x, y, z, wo_h;
    VNDF_REAL spread;  // 4 cos cos eta^2 / |h|^2 where light crosses; 0 where no facet refracts wo to wi
    VNDF_REAL cos_o;   // of wo and the normal
    int crosses;
};
// A reflection, and a visible normal to refract at.
struct vndf_impl_facets_pair {
    struct vndf_impl_sample mirrored, normal;
};
#endif

#if VNDF_CHOSEN(VNDF_NDF, beckmann)

// What the functions below share.
struct vndf_impl_facets {
    struct vndf_beckmann_lobe lobe;
};
VNDF_FN struct vndf_impl_facets vndf_impl_facets_of(VNDF_REAL3 wo, VNDF_REAL2 alpha, VNDF_REAL3 ng) {
    struct vndf_impl_facets c;
    (void)ng;
    c.lobe = vndf_beckmann_lobe_of(wo, alpha);
    return c;
}

VNDF_FN VNDF_REAL vndf_impl_facets_pdf(struct vndf_impl_facets c, VNDF_REAL3 wi) {
    return vndf_beckmann_pdf_wi_lobe(c.lobe, wi);
}

// At least 0, and known when all else is.
VNDF_FN VNDF_REAL vndf_impl_facets_seen(struct vndf_impl_facets c) {
    return c.lobe.square.head;
}
// The same facets, known after a number >= 0: what is made of them LLVM's SLP pass cannot pack with what led to that.
VNDF_FN struct vndf_impl_facets vndf_impl_facets_after(struct vndf_impl_facets c, VNDF_REAL last) {
    c.lobe.wo_z = last >= VNDF_R(0.0) ? c.lobe.wo_z : VNDF_R(1.0);
    return c;
}

// G1 of another direction.
VNDF_FN VNDF_REAL vndf_impl_facets_g1(struct vndf_impl_facets c, VNDF_REAL3 w) {
    return vndf_impl_beckmann_g1(vndf_impl_beckmann_other(c.lobe, w));
}

VNDF_FN VNDF_REAL vndf_impl_facets_weight(struct vndf_impl_facets c, VNDF_REAL3 wi) {
#if VNDF_CHOSEN(VNDF_MASKING, separable)
    VNDF_REAL masked = vndf_impl_facets_g1(c, wi);
    return c.lobe.wo_z > VNDF_R(0.0) ? masked : VNDF_R(0.0);
#else
    return vndf_beckmann_weight_lobe(c.lobe, wi);
#endif
}

VNDF_FN struct vndf_impl_sample vndf_impl_facets_sample(struct vndf_impl_facets c, VNDF_REAL2 u) {
    struct vndf_impl_sample m = vndf_impl_beckmann_jakob2014(c.lobe, u);
    return vndf_impl_mirrored(c.lobe.wo_x, c.lobe.wo_y, c.lobe.wo_z, m);
}

#if VNDF_DIELECTRIC
VNDF_FN struct vndf_impl_facets vndf_impl_facets_plain(struct vndf_impl_facets c, int plain) {
    (void)plain;
    return c;
}

VNDF_FN VNDF_REAL vndf_impl_facets_either_pdf(struct vndf_impl_facets c, struct vndf_impl_facing f,
                                              VNDF_REAL3 wi) {
    VNDF_REAL weight = f.crosses ? VNDF_R(0.25) * f.spread : VNDF_R(0.25);
    struct vndf_impl_power pdf = vndf_impl_beckmann_along(c.lobe, f.x, f.y, f.z, f.wo_h, 0, weight);
    VNDF_REAL through = vndf_impl_finite(vndf_impl_times_power(pdf.part, pdf.exponent)),
              mirrored = vndf_impl_facets_pdf(c, wi);
    return f.crosses ? through : mirrored;
}
VNDF_FN VNDF_REAL vndf_impl_facets_shadowing(struct vndf_impl_facets c, VNDF_REAL3 w) {
    return vndf_impl_facets_g1(c, w);
}

VNDF_FN struct vndf_impl_facets_pair vndf_impl_facets_both(struct vndf_impl_facets c, VNDF_REAL2 u,
                                                           int mirrors) {
    struct vndf_impl_facets_pair both;
    (void)mirrors;
    both.normal = vndf_impl_beckmann_jakob2014(c.lobe, u);
    both.mirrored = vndf_impl_mirrored(c.lobe.wo_x, c.lobe.wo_y, c.lobe.wo_z, both.normal);
    return both;
}
#endif

#else

struct vndf_impl_facets {
    struct vndf_ggx_lobe lobe;
#if VNDF_CHOSEN(VNDF_SAMPLING, bounded)
    struct vndf_impl_bound bound;
#elif VNDF_IMPL_TILTED
    struct vndf_ggx_tilted2026 tilted;
#elif VNDF_IMPL_CONIC
    struct vndf_ggx_conic2026 conic;
#endif
#if VNDF_IMPL_CONIC
    int plain;  // visible normals mirrored instead
#endif
};
VNDF_FN struct vndf_impl_facets vndf_impl_facets_of(VNDF_REAL3 wo, VNDF_REAL2 alpha, VNDF_REAL3 ng) {
    struct vndf_impl_facets c;
    c.lobe = vndf_ggx_lobe_of(wo, alpha);
#if VNDF_CHOSEN(VNDF_SAMPLING, bounded)
    c.bound = vndf_impl_ggx_bound(c.lobe);
#elif VNDF_IMPL_TILTED
    // From behind all visible normals are mirrored.
    int front = wo.z > VNDF_R(0.0);
    c.tilted = vndf_ggx_tilted2026_of(
        c.lobe,
        VNDF_MAKE3(front ? ng.x : VNDF_R(0.0), front ? ng.y : VNDF_R(0.0), front ? ng.z : VNDF_R(1.0)));
    c.plain = 0;
#elif VNDF_IMPL_CONIC
    c.conic = vndf_ggx_conic2026_lobe(wo, alpha);
    c.plain = 0;
#endif
    (void)ng;
    return c;
}
#if VNDF_IMPL_TILTED
// Whether directions below either horizon count, too.
VNDF_FN int vndf_impl_facets_everywhere(struct vndf_impl_facets c) {
    return c.plain || !(c.lobe.wo_z > VNDF_R(0.0));
}
#endif

VNDF_FN VNDF_REAL vndf_impl_facets_pdf(struct vndf_impl_facets c, VNDF_REAL3 wi) {
#if VNDF_CHOSEN(VNDF_SAMPLING, bounded)
    return vndf_impl_ggx_bounded_pdf(c.lobe, wi, c.bound);
#elif VNDF_IMPL_TILTED
    return vndf_impl_tilted_pdf(c.tilted, wi, vndf_impl_facets_everywhere(c));
#elif VNDF_IMPL_CONIC
    return vndf_ggx_pdf_wi_conic2026_lobe(c.conic, wi);
#else
    return vndf_ggx_pdf_wi_lobe(c.lobe, wi);
#endif
}

// At least 0, and known when all else is.
VNDF_FN VNDF_REAL vndf_impl_facets_seen(struct vndf_impl_facets c) {
#if VNDF_CHOSEN(VNDF_SAMPLING, bounded)
    return c.bound.height;
#elif VNDF_IMPL_CONIC
    return c.VNDF_IMPL_CONE.twice_sigma;
#else
    return c.lobe.axis.height;
#endif
}
// The same facets, known after a number >= 0: what is made of them LLVM's SLP pass cannot pack with what led to that.
VNDF_FN struct vndf_impl_facets vndf_impl_facets_after(struct vndf_impl_facets c, VNDF_REAL last) {
    int known = last >= VNDF_R(0.0);
#if VNDF_CHOSEN(VNDF_SAMPLING, bounded)
    c.bound.height = known ? c.bound.height : VNDF_R(1.0);
#elif VNDF_IMPL_CONIC
    c.VNDF_IMPL_CONE.twice_sigma = known ? c.VNDF_IMPL_CONE.twice_sigma : VNDF_R(1.0);
#else
    c.lobe.axis.height = known ? c.lobe.axis.height : VNDF_R(1.0);
#endif
    return c;
}

// The share of the visible normals that the sampler draws from: what its density has on theirs, turned over.
VNDF_FN VNDF_REAL vndf_impl_facets_share(struct vndf_impl_facets c) {
#if VNDF_CHOSEN(VNDF_SAMPLING, bounded)
    // (k z + t) / (z + t). At wo = -z both are 0.
    VNDF_REAL whole = c.lobe.axis.height;
    return vndf_impl_share(VNDF_DIVIDE(c.bound.height, whole > VNDF_R(0.0) ? whole : VNDF_R(1.0)));
#elif VNDF_IMPL_CONIC
    // sigma_vis / sigma.
    VNDF_REAL whole = vndf_impl_lobe_twice_sigma(c.lobe);
    return vndf_impl_share(
        VNDF_DIVIDE(c.VNDF_IMPL_CONE.twice_sigma, whole > VNDF_R(0.0) ? whole : VNDF_R(1.0)));
#else
    (void)c;
    return VNDF_R(1.0);
#endif
}

// G1 of another direction.
VNDF_FN VNDF_REAL vndf_impl_facets_g1(struct vndf_impl_facets c, VNDF_REAL3 w) {
    return vndf_ggx_g1(w, VNDF_MAKE2(c.lobe.alpha_x, c.lobe.alpha_y));
}

VNDF_FN VNDF_REAL vndf_impl_facets_weight(struct vndf_impl_facets c, VNDF_REAL3 wi) {
#if VNDF_CHOSEN(VNDF_MASKING, separable)
    VNDF_REAL masked = vndf_impl_facets_g1(c, wi);
    masked = c.lobe.wo_z > VNDF_R(0.0) ? masked : VNDF_R(0.0);
#else
    VNDF_REAL masked = vndf_ggx_weight_lobe(c.lobe, wi);
#endif
    return masked * vndf_impl_facets_share(c);
}

VNDF_FN struct vndf_impl_sample vndf_impl_facets_sample(struct vndf_impl_facets c, VNDF_REAL2 u) {
#if VNDF_CHOSEN(VNDF_SAMPLING, bounded)
    return vndf_impl_lobe_reflection(c.lobe, c.bound.height, vndf_impl_bounded_half(c.lobe, c.bound, u));
#elif VNDF_IMPL_TILTED
    return vndf_impl_tilted_reflect(c.tilted, vndf_impl_tilted_sampled(c.tilted, u),
                                    vndf_impl_facets_everywhere(c));
#elif VNDF_IMPL_CONIC
    return vndf_impl_conic2026(c.conic, u);
#else
    return vndf_impl_lobe_reflection(c.lobe, c.lobe.axis.height, vndf_impl_cap_half(c.lobe, u));
#endif
}

#if VNDF_DIELECTRIC
// The same, but if `plain` with visible normals mirrored, whatever VNDF_SAMPLING.
VNDF_FN struct vndf_impl_facets vndf_impl_facets_plain(struct vndf_impl_facets c, int plain) {
#if VNDF_CHOSEN(VNDF_SAMPLING, bounded)
    c.bound.gap_z = plain ? VNDF_R(0.0) : c.bound.gap_z;
    c.bound.height = plain ? c.lobe.axis.height : c.bound.height;
#elif VNDF_IMPL_CONIC
    c.VNDF_IMPL_CONE.twice_sigma = plain ? vndf_impl_lobe_twice_sigma(c.lobe) : c.VNDF_IMPL_CONE.twice_sigma;
    c.plain = plain;
#else
    (void)plain;
#endif
    return c;
}

// The plain cap, which is the one without a gap, or the one for reflections.
#if VNDF_CHOSEN(VNDF_SAMPLING, bounded)
VNDF_FN struct vndf_impl_bound vndf_impl_facets_cap(struct vndf_impl_facets c, int mirrors) {
    return vndf_impl_facets_plain(c, !mirrors).bound;
}
#endif

// The density of a reflection by its half vector h, and of a refraction: D / (2 n) there, of visible normals, times 4 cos cos
// eta^2 / |h|^2, which for a half vector between reflections is 1.
VNDF_FN VNDF_REAL vndf_impl_facets_either_pdf(struct vndf_impl_facets c, struct vndf_impl_facing f,
                                              VNDF_REAL3 wi) {
    struct vndf_impl_half h = vndf_impl_half_along(f.x, f.y, f.z, c.lobe.alpha_x, c.lobe.alpha_y);
#if VNDF_CHOSEN(VNDF_SAMPLING, bounded)
    VNDF_REAL pdf = vndf_impl_ggx_bounded_half_pdf(c.lobe, h, vndf_impl_facets_cap(c, !f.crosses));
#elif VNDF_IMPL_CONIC
    VNDF_REAL n = f.crosses ? vndf_impl_lobe_twice_sigma(c.lobe) : c.VNDF_IMPL_CONE.twice_sigma;
    VNDF_REAL pdf = vndf_impl_ggx_reflection_pdf(h, n, c.lobe.alpha_x, c.lobe.alpha_y);
#if VNDF_IMPL_TILTED
    pdf = f.crosses || vndf_impl_facets_everywhere(c) || vndf_impl_tilted_above(c.tilted, wi) ? pdf
                                                                                              : VNDF_R(0.0);
#else
    pdf = f.crosses || wi.z > VNDF_R(0.0) || c.lobe.wo_z <= VNDF_R(0.0) ? pdf : VNDF_R(0.0);
#endif
#else
    VNDF_REAL pdf =
        vndf_impl_ggx_reflection_pdf(h, vndf_impl_lobe_twice_sigma(c.lobe), c.lobe.alpha_x, c.lobe.alpha_y);
#endif
    (void)wi;
    return f.crosses ? vndf_impl_finite(pdf * f.spread) : pdf;
}

// G1 of a direction in front of the surface, from the root that the weight has, too.
VNDF_FN VNDF_REAL vndf_impl_facets_shadowing(struct vndf_impl_facets c, VNDF_REAL3 w) {
    VNDF_REAL z = w.z * VNDF_R(134217728.0), sum = z + vndf_impl_ggx_stretched(c.lobe, w);
    return vndf_impl_share(VNDF_DIVIDE(VNDF_R(2.0) * z, sum > VNDF_R(0.0) ? sum : VNDF_R(1.0)));
}

// The normal of a half vector of the plain cap, and its density, as in ggx_dupuy2023.h.
VNDF_FN struct vndf_impl_sample vndf_impl_facets_normal(struct vndf_ggx_lobe v, struct vndf_impl_vector h) {
    struct vndf_impl_sample m;
    VNDF_REAL gx = v.alpha_x * h.x, gy = v.alpha_y * h.y,
              length2 = VNDF_FMA(gx, gx, VNDF_FMA(gy, gy, h.z * h.z));
    VNDF_REAL length = VNDF_SQRT(length2), rcp = VNDF_DIVIDE(VNDF_R(1.0), length);
    m.x = gx * rcp;
    m.y = gy * rcp;
    m.z = h.z * rcp;
    VNDF_REAL ratio = VNDF_DIVIDE(length2, VNDF_FMA(h.x, h.x, VNDF_FMA(h.y, h.y, h.z * h.z)));
    m.pdf = VNDF_DIVIDE(VNDF_1_PI * (ratio * length), v.axis.height * (v.alpha_x * v.alpha_y));
    // At wo = -z, where nothing is visible, the height is 0.
    m.pdf = v.axis.height > VNDF_R(0.0) ? vndf_impl_finite(m.pdf) : VNDF_R(0.0);
    return vndf_impl_where(length2 > VNDF_R(0.0) && length2 <= VNDF_REAL_MAX, m);
}

// Of which `mirrors` tells the one that is asked for: one cap for both.
VNDF_FN struct vndf_impl_facets_pair vndf_impl_facets_both(struct vndf_impl_facets c, VNDF_REAL2 u,
                                                           int mirrors) {
    struct vndf_impl_facets_pair both;
#if VNDF_CHOSEN(VNDF_SAMPLING, bounded)
    struct vndf_impl_bound cap = vndf_impl_facets_cap(c, mirrors);
    struct vndf_impl_vector h = vndf_impl_bounded_half(c.lobe, cap, u);
    both.mirrored = vndf_impl_lobe_reflection(c.lobe, cap.height, h);
#elif VNDF_IMPL_CONIC
    struct vndf_impl_vector h = vndf_impl_cap_half(c.lobe, u);
#if VNDF_IMPL_TILTED
    struct vndf_impl_conic_normal g = vndf_impl_tilted_sampled(c.tilted, u);
#else
    struct vndf_impl_conic_normal g = vndf_impl_conic_sampled(c.conic, u);
#endif
    g.x = c.plain ? h.x : g.x;
    g.y = c.plain ? h.y : g.y;
    g.z = c.plain ? h.z : g.z;
#if VNDF_IMPL_TILTED
    both.mirrored = vndf_impl_tilted_reflect(c.tilted, g, vndf_impl_facets_everywhere(c));
#else
    both.mirrored =
        vndf_impl_conic_reflect(g, c.lobe.wo_x, c.lobe.wo_y, c.lobe.wo_z, c.lobe.alpha_x, c.lobe.alpha_y,
                                c.conic.twice_sigma, !c.plain && c.lobe.wo_z > VNDF_R(0.0));
#endif
    (void)mirrors;
#else
    struct vndf_impl_vector h = vndf_impl_cap_half(c.lobe, u);
    both.mirrored = vndf_impl_lobe_reflection(c.lobe, c.lobe.axis.height, h);
    (void)mirrors;
#endif
    both.normal = vndf_impl_facets_normal(c.lobe, h);
    return both;
}
#endif

#endif

// Whether what facets reflected is lost: what tilted sampling has below a horizon. Elsewhere rounding may say otherwise there.
VNDF_FN int vndf_impl_facets_lost(struct vndf_impl_sample mirrored) {
#if VNDF_IMPL_TILTED
    return !(mirrored.pdf > VNDF_R(0.0));
#else
    (void)mirrored;
    return 0;
#endif
}

VNDF_END

#endif
