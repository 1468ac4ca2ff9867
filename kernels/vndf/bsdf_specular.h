// The specular lobes of a material: of the conductor and of the dielectric, which share their facets and one sampler.
#ifndef VNDF_BSDF_SPECULAR_H
#define VNDF_BSDF_SPECULAR_H

#include "bsdf_view.h"

VNDF_BEGIN

#if VNDF_IMPL_SPECULAR

// The specular lobes that lead to wi's side, as one.
struct vndf_impl_specular {
    struct vndf_impl_bsdf_lobe lobe;
#if VNDF_DIELECTRIC
    struct vndf_impl_facing facet;
#endif
};

#if VNDF_DIELECTRIC

VNDF_FN struct vndf_rgb vndf_impl_bsdf_transmitted(struct vndf_impl_bsdf_view v, VNDF_REAL part) {
#if VNDF_CHOSEN(VNDF_TRANSPORT, radiance)
    // A beam that is bent into a narrower cone is brighter for it.
    part /= v.media.eta * v.media.eta;
#endif
#if VNDF_TINT
    return vndf_impl_rgb_scaled(v.b.transmittance, part);
#else
    return vndf_impl_rgb(part, part, part);
#endif
}

VNDF_FN struct vndf_impl_specular vndf_impl_bsdf_specular(struct vndf_impl_bsdf_view v, VNDF_REAL3 i) {
    struct vndf_impl_specular s;
    struct vndf_impl_interface n = v.media;
    s.facet = vndf_impl_facing_of(v.o, i, n.eta, n.transmits && i.z < VNDF_R(0.0));
    VNDF_REAL metal = vndf_impl_bsdf_metal(v.b), rest = VNDF_R(1.0) - metal;
    VNDF_REAL f = vndf_fresnel_dielectric(s.facet.cos_o, n.eta), passed = (VNDF_R(1.0) - f) * n.transmission;
    struct vndf_impl_odds odds = vndf_impl_odds_of(n, f);
    VNDF_REAL share = s.facet.crosses ? odds.refracted : metal + odds.reflected;
    VNDF_REAL rcp = VNDF_R(1.0) / (share > VNDF_R(0.0) ? share : VNDF_R(1.0));
    VNDF_REAL3 raised = VNDF_MAKE3(i.x, i.y, vndf_impl_abs(i.z));
    // Straight through is not masked.
    VNDF_REAL masked = n.eta == VNDF_R(1.0) ? VNDF_R(1.0) : vndf_impl_facets_shadowing(v.facets, raised);
    struct vndf_rgb through = vndf_impl_bsdf_transmitted(v, rest * passed * rcp * masked);
    VNDF_REAL mirrored = vndf_impl_facets_weight(v.facets, raised), other = rest * f * rcp;
#if VNDF_CONDUCTOR
    VNDF_REAL own = share == metal ? VNDF_R(1.0) : metal * rcp;
    struct vndf_rgb back = vndf_impl_bsdf_reflectance(v.b, s.facet.cos_o);
    back = vndf_impl_rgb(VNDF_FMA(own, back.r, other), VNDF_FMA(own, back.g, other),
                         VNDF_FMA(own, back.b, other));
#else
    struct vndf_rgb back = vndf_impl_rgb(other, other, other);
#endif
    back = vndf_impl_rgb_scaled(back, mirrored);
    s.lobe.weight = vndf_impl_rgb(s.facet.crosses ? through.r : back.r, s.facet.crosses ? through.g : back.g,
                                  s.facet.crosses ? through.b : back.b);
    s.lobe.share = share;
    s.lobe.pdf = vndf_impl_facets_either_pdf(v.facets, s.facet, i);
    return s;
}

#else

// The probability of the conductor, and what its weight is divided by for being drawn less often than its share.
VNDF_FN VNDF_REAL vndf_impl_bsdf_often(struct vndf_impl_bsdf_view v) {
#if VNDF_IMPL_KULLA_CONTY
    return VNDF_R(1.0) - v.multiple.share;
#else
    (void)v;
    return VNDF_R(1.0);
#endif
}

VNDF_FN struct vndf_impl_specular vndf_impl_bsdf_specular(struct vndf_impl_bsdf_view v, VNDF_REAL3 i) {
    struct vndf_impl_specular s;
    VNDF_REAL often = vndf_impl_bsdf_often(v);
    s.lobe.weight = vndf_impl_rgb_scaled(vndf_impl_bsdf_reflectance(v.b, vndf_impl_half_cosine(v.o, i)),
                                         vndf_impl_facets_weight(v.facets, i));
#if VNDF_CHOSEN(VNDF_ENERGY, turquin)
    s.lobe.weight = vndf_impl_bsdf_raised(v.b, s.lobe.weight, v.o);
#endif
    // Beside another lobe it is less often drawn and heavier.
    s.lobe.weight =
        vndf_impl_rgb_scaled(s.lobe.weight, VNDF_R(1.0) / (often > VNDF_R(0.0) ? often : VNDF_R(1.0)));
    s.lobe.share = vndf_impl_bsdf_metal(v.b) * often;
    s.lobe.pdf = vndf_impl_facets_pdf(v.facets, i);
    return s;
}

#endif

#if VNDF_DIELECTRIC

// Which lobe: by u_lobe, the conductor first, then reflection, refraction and what is diffuse. The end of u_lobe may be 1.
VNDF_FN int vndf_impl_bsdf_chosen(struct vndf_impl_interface n, struct vndf_impl_odds odds, VNDF_REAL metal,
                                  VNDF_REAL u_lobe) {
    VNDF_REAL mirrored = metal + odds.reflected;
    int lobe = n.transmits ? VNDF_BSDF_TRANSMISSION : VNDF_BSDF_REFLECTION;
#if VNDF_LAMBERT
    VNDF_REAL specular = metal + n.specular;
    lobe = u_lobe < specular || specular >= VNDF_R(1.0) ? lobe : VNDF_BSDF_LAMBERT;
#endif
    lobe = u_lobe < mirrored || mirrored >= VNDF_R(1.0) ? VNDF_BSDF_REFLECTION : lobe;
    return u_lobe < metal || metal >= VNDF_R(1.0) ? VNDF_BSDF_CONDUCTOR : lobe;
}

// A direction of the specular lobes; the lobe is Lambert's where it is to be drawn instead.
VNDF_FN struct vndf_impl_drawn vndf_impl_bsdf_drawn_specular(struct vndf_impl_bsdf_view v, VNDF_REAL2 u,
                                                             VNDF_REAL u_lobe) {
    struct vndf_impl_drawn d;
    struct vndf_impl_interface n = v.media;
    VNDF_REAL metal = vndf_impl_bsdf_metal(v.b);
    // Before the normal, where that does not decide.
    int early = vndf_impl_bsdf_chosen(n, vndf_impl_odds_of(n, VNDF_R(0.0)), metal, u_lobe);
    struct vndf_impl_facets_pair both = vndf_impl_facets_both(v.facets, u, early != VNDF_BSDF_TRANSMISSION);
    VNDF_REAL f = vndf_fresnel_dielectric(
        VNDF_FMA(v.o.x, both.normal.x, VNDF_FMA(v.o.y, both.normal.y, v.o.z * both.normal.z)), n.eta);
    int late = vndf_impl_bsdf_chosen(n, vndf_impl_odds_of(n, f), metal, u_lobe);
    d.lobe = n.by_normal ? late : early;
    struct vndf_impl_sample refracted = vndf_impl_refracted(v.o, both.normal, n.eta);
    int crosses = d.lobe == VNDF_BSDF_TRANSMISSION;
    d.w.x = crosses ? refracted.x : both.mirrored.x;
    d.w.y = crosses ? refracted.y : both.mirrored.y;
    d.w.z = crosses ? refracted.z : both.mirrored.z;
    d.w.pdf = crosses ? refracted.pdf : both.mirrored.pdf;
    return d;
}

#else

VNDF_FN struct vndf_impl_drawn vndf_impl_bsdf_drawn_specular(struct vndf_impl_bsdf_view v, VNDF_REAL2 u,
                                                             VNDF_REAL u_lobe) {
    struct vndf_impl_drawn d;
    VNDF_REAL share = vndf_impl_bsdf_metal(v.b) * vndf_impl_bsdf_often(v);
    d.w = vndf_impl_facets_sample(v.facets, u);
    // The end of u_lobe may be 1.
    d.lobe = u_lobe < share || share >= VNDF_R(1.0) ? VNDF_BSDF_CONDUCTOR : VNDF_BSDF_LAMBERT;
    return d;
}

#endif

#endif

VNDF_END

#endif
