// The rough conductor: reflection by microfacets, with the choices and effects of effects.h.
//
// Its BSDF times cos(theta_i) is F D G2 / (4 wo.z): the density of the sampler that is chosen, times the weight of a sample.
// The weight is F G2 / G1(wo), over what the sampler's density has on that of mirrored visible normals; the density cancels,
// so that it is accurate where the density is not.
//
// Everything asked of a distribution stands here, once for each choice; no other file of a material knows them.
#ifndef VNDF_BSDF_CONDUCTOR_H
#define VNDF_BSDF_CONDUCTOR_H

#include "effects.h"
#include "fresnel.h"

#if VNDF_CHOSEN(VNDF_NDF, beckmann)
#include "beckmann_jakob2014.h"
#include "impl/mirror.h"
#else
#include "ggx.h"
#if VNDF_CHOSEN(VNDF_SAMPLING, bounded)
#include "ggx_eto2023.h"
#elif VNDF_CHOSEN(VNDF_SAMPLING, conic)
#include "ggx_conic2026.h"
#endif
#endif

VNDF_BEGIN

// --- Any conductor, without its reflectance: density, weight and sample of one view direction ---

#if VNDF_CHOSEN(VNDF_NDF, beckmann)

// What the functions below share.
struct vndf_impl_conductor {
    struct vndf_beckmann_lobe lobe;
};
VNDF_FN struct vndf_impl_conductor vndf_impl_conductor_of(VNDF_REAL3 wo, VNDF_REAL2 alpha) {
    struct vndf_impl_conductor c;
    c.lobe = vndf_beckmann_lobe_of(wo, alpha);
    return c;
}

VNDF_FN VNDF_REAL vndf_impl_conductor_pdf(struct vndf_impl_conductor c, VNDF_REAL3 wi) {
    return vndf_beckmann_pdf_wi_lobe(c.lobe, wi);
}

VNDF_FN VNDF_REAL vndf_impl_conductor_weight(struct vndf_impl_conductor c, VNDF_REAL3 wi) {
#if VNDF_CHOSEN(VNDF_MASKING, separable)
    VNDF_REAL masked = vndf_impl_beckmann_g1(vndf_impl_beckmann_other(c.lobe, wi));
    return c.lobe.wo_z > VNDF_R(0.0) ? masked : VNDF_R(0.0);
#else
    return vndf_beckmann_weight_lobe(c.lobe, wi);
#endif
}

VNDF_FN struct vndf_impl_sample vndf_impl_conductor_sample(struct vndf_impl_conductor c, VNDF_REAL2 u) {
    struct vndf_impl_sample m = vndf_impl_beckmann_jakob2014(c.lobe, u);
    return vndf_impl_mirrored(c.lobe.wo_x, c.lobe.wo_y, c.lobe.wo_z, m);
}

#else

struct vndf_impl_conductor {
    struct vndf_ggx_lobe lobe;
#if VNDF_CHOSEN(VNDF_SAMPLING, bounded)
    struct vndf_impl_bound bound;
#elif VNDF_CHOSEN(VNDF_SAMPLING, conic)
    struct vndf_ggx_conic2026 conic;
#endif
};
VNDF_FN struct vndf_impl_conductor vndf_impl_conductor_of(VNDF_REAL3 wo, VNDF_REAL2 alpha) {
    struct vndf_impl_conductor c;
    c.lobe = vndf_ggx_lobe_of(wo, alpha);
#if VNDF_CHOSEN(VNDF_SAMPLING, bounded)
    c.bound = vndf_impl_ggx_bound(c.lobe);
#elif VNDF_CHOSEN(VNDF_SAMPLING, conic)
    c.conic = vndf_ggx_conic2026_lobe(wo, alpha);
#endif
    return c;
}

VNDF_FN VNDF_REAL vndf_impl_conductor_pdf(struct vndf_impl_conductor c, VNDF_REAL3 wi) {
#if VNDF_CHOSEN(VNDF_SAMPLING, bounded)
    return vndf_impl_ggx_bounded_pdf(c.lobe, wi, c.bound);
#elif VNDF_CHOSEN(VNDF_SAMPLING, conic)
    return vndf_ggx_pdf_wi_conic2026_lobe(c.conic, wi);
#else
    return vndf_ggx_pdf_wi_lobe(c.lobe, wi);
#endif
}

// The share of the visible normals that the sampler draws from: what its density has on theirs, turned over.
VNDF_FN VNDF_REAL vndf_impl_conductor_share(struct vndf_impl_conductor c) {
#if VNDF_CHOSEN(VNDF_SAMPLING, bounded)
    // (k z + t) / (z + t). At wo = -z both are 0.
    VNDF_REAL whole = c.lobe.axis.height;
    return vndf_impl_share(c.bound.height / (whole > VNDF_R(0.0) ? whole : VNDF_R(1.0)));
#elif VNDF_CHOSEN(VNDF_SAMPLING, conic)
    // sigma_vis / sigma.
    VNDF_REAL whole = vndf_impl_lobe_twice_sigma(c.lobe);
    return vndf_impl_share(c.conic.twice_sigma / (whole > VNDF_R(0.0) ? whole : VNDF_R(1.0)));
#else
    (void)c;
    return VNDF_R(1.0);
#endif
}

VNDF_FN VNDF_REAL vndf_impl_conductor_weight(struct vndf_impl_conductor c, VNDF_REAL3 wi) {
#if VNDF_CHOSEN(VNDF_MASKING, separable)
    VNDF_REAL masked = vndf_ggx_g1(wi, VNDF_MAKE2(c.lobe.alpha_x, c.lobe.alpha_y));
    masked = c.lobe.wo_z > VNDF_R(0.0) ? masked : VNDF_R(0.0);
#else
    VNDF_REAL masked = vndf_ggx_weight_lobe(c.lobe, wi);
#endif
    return masked * vndf_impl_conductor_share(c);
}

#if VNDF_CHOSEN(VNDF_SAMPLING, plain)
// The plain cap, as in ggx_dupuy2023.h.
VNDF_FN struct vndf_impl_vector vndf_impl_cap_half(struct vndf_ggx_lobe v, VNDF_REAL2 u) {
    VNDF_REAL u1 = vndf_impl_u(u.x), u2 = vndf_impl_u(u.y), rest = VNDF_R(1.0) - u2;
    VNDF_REAL l2 = VNDF_FMA(v.x, v.x, v.y * v.y), height2 = v.axis.height * v.axis.height;
    return vndf_impl_cap_sum(v, l2, u1, rest * v.axis.height, u2 * VNDF_FMA(rest, height2, l2),
                             rest * VNDF_FMA(u2, height2, -l2));
}
#endif

VNDF_FN struct vndf_impl_sample vndf_impl_conductor_sample(struct vndf_impl_conductor c, VNDF_REAL2 u) {
#if VNDF_CHOSEN(VNDF_SAMPLING, bounded)
    return vndf_impl_lobe_reflection(c.lobe, c.bound.height, vndf_impl_bounded_half(c.lobe, c.bound, u));
#elif VNDF_CHOSEN(VNDF_SAMPLING, conic)
    return vndf_impl_conic2026(c.conic, u);
#else
    return vndf_impl_lobe_reflection(c.lobe, c.lobe.axis.height, vndf_impl_cap_half(c.lobe, u));
#endif
}

#endif

VNDF_END

#endif
