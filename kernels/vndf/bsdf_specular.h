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
    int crosses;  // the surface
#endif
};

// How often the conductor is drawn, of its share.
VNDF_FN VNDF_REAL vndf_impl_bsdf_often(struct vndf_impl_bsdf_view v) {
#if VNDF_IMPL_KULLA_CONTY
    return VNDF_R(1.0) - v.multiple.share;
#else
    (void)v;
    return VNDF_R(1.0);
#endif
}
VNDF_FN VNDF_REAL vndf_impl_bsdf_metal_drawn(struct vndf_impl_bsdf_view v) {
    return vndf_impl_bsdf_metal(v.b) * vndf_impl_bsdf_often(v);
}

#if VNDF_CONDUCTOR
// What it reflects, over that.
VNDF_FN struct vndf_rgb vndf_impl_bsdf_metallic(struct vndf_impl_bsdf_view v, VNDF_REAL cosine) {
    VNDF_REAL often = vndf_impl_bsdf_often(v);
    struct vndf_rgb f = vndf_impl_bsdf_reflectance(v.b, cosine);
#if VNDF_CHOSEN(VNDF_ENERGY, turquin)
    f = vndf_impl_bsdf_raised(v.b, f, vndf_impl_real3(v.o));
#endif
    return vndf_impl_rgb_scaled(f, VNDF_DIVIDE(VNDF_R(1.0), often > VNDF_R(0.0) ? often : VNDF_R(1.0)));
}

#endif

#if VNDF_DIELECTRIC

VNDF_FN struct vndf_rgb vndf_impl_bsdf_transmitted(struct vndf_impl_bsdf_view v, VNDF_REAL part) {
#if VNDF_CHOSEN(VNDF_TRANSPORT, radiance)
    // A beam that is bent into a narrower cone is brighter for it.
#if VNDF_THIN_WALLED
    VNDF_REAL eta = v.media.body ? v.media.eta : VNDF_R(1.0);
#else
    VNDF_REAL eta = v.media.eta;
#endif
    part = VNDF_DIVIDE(part, eta * eta);
#endif
#if VNDF_TINT
    return vndf_impl_rgb_scaled(v.b.transmittance, part);
#else
    return vndf_impl_rgb(part, part, part);
#endif
}

// What the interface reflects of each channel, f by its index.
VNDF_FN VNDF_REAL vndf_impl_bsdf_mirrored_channel(struct vndf_impl_interface n, VNDF_REAL excess,
                                                  VNDF_REAL f) {
    return vndf_impl_interface_returns(n, f, vndf_impl_interface_reflects(n, excess, f));
}
VNDF_FN struct vndf_rgb vndf_impl_bsdf_mirrored(struct vndf_impl_interface n, VNDF_REAL f) {
#if VNDF_SPECULAR
    VNDF_REAL red = vndf_impl_bsdf_mirrored_channel(n, n.gloss.excess.r, f);
    VNDF_REAL green = vndf_impl_bsdf_mirrored_channel(n, vndf_impl_next_channel(n.gloss.excess.g, red), f);
    VNDF_REAL blue = vndf_impl_bsdf_mirrored_channel(n, vndf_impl_next_channel(n.gloss.excess.b, green), f);
    return vndf_impl_rgb(red, green, blue);
#else
    VNDF_REAL all = vndf_impl_bsdf_mirrored_channel(n, VNDF_R(0.0), f);
    return vndf_impl_rgb(all, all, all);
#endif
}

VNDF_FN struct vndf_impl_specular vndf_impl_bsdf_specular(struct vndf_impl_bsdf_view v, VNDF_REAL3 i) {
    struct vndf_impl_specular s;
    struct vndf_impl_interface n = v.media;
    VNDF_REAL3 raised = VNDF_MAKE3(i.x, i.y, vndf_impl_abs(i.z));
    s.crosses = n.transmits && i.z < VNDF_R(0.0);
#if VNDF_THIN_WALLED
    int bends = s.crosses && n.body;
    VNDF_REAL3 w = VNDF_MAKE3(i.x, i.y, s.crosses && !n.body ? raised.z : i.z);
#else
    int bends = s.crosses;
    VNDF_REAL3 w = i;
#endif
    struct vndf_impl_facing facet = vndf_impl_facing_of(vndf_impl_real3(v.o), w, n.eta, bends);
    VNDF_REAL metal = vndf_impl_bsdf_metal(v.b), rest = VNDF_R(1.0) - metal;
    VNDF_REAL f = vndf_fresnel_dielectric(facet.cos_o, n.eta);
    VNDF_REAL passed =
        vndf_impl_interface_lets_in(n, vndf_impl_interface_passes(n, vndf_impl_interface_most(n), f)) *
        n.transmission;
    struct vndf_impl_odds odds = vndf_impl_odds_of(n, f);
    VNDF_REAL drawn = vndf_impl_bsdf_metal_drawn(v);
    VNDF_REAL share = s.crosses ? odds.refracted : drawn + odds.reflected;
    VNDF_REAL rcp = VNDF_DIVIDE(VNDF_R(1.0), share > VNDF_R(0.0) ? share : VNDF_R(1.0));
    VNDF_REAL mirrored = vndf_impl_facets_weight(v.facets, raised);
    // Straight through is not masked.
    VNDF_REAL masked = n.eta == VNDF_R(1.0) ? VNDF_R(1.0) : vndf_impl_facets_shadowing(v.facets, raised);
#if VNDF_THIN_WALLED
    masked = n.body ? masked : mirrored;
#endif
    struct vndf_rgb through = vndf_impl_bsdf_transmitted(v, rest * passed * rcp * masked);
    struct vndf_rgb back = vndf_impl_bsdf_mirrored(n, f);
    back = vndf_impl_rgb_scaled(vndf_impl_rgb_scaled(back, rest), rcp);
#if VNDF_CONDUCTOR
    VNDF_REAL own = share == drawn ? VNDF_R(1.0) : drawn * rcp;
    struct vndf_rgb metals = vndf_impl_bsdf_metallic(v, facet.cos_o);
    back = vndf_impl_rgb(VNDF_FMA(own, metals.r, back.r), VNDF_FMA(own, metals.g, back.g),
                         VNDF_FMA(own, metals.b, back.b));
#endif
    back = vndf_impl_rgb_scaled(back, mirrored);
    s.lobe.weight = vndf_impl_rgb(s.crosses ? through.r : back.r, s.crosses ? through.g : back.g,
                                  s.crosses ? through.b : back.b);
    s.lobe.share = share;
    s.lobe.pdf = vndf_impl_facets_either_pdf(v.facets, facet, w);
    return s;
}

#else

VNDF_FN struct vndf_impl_specular vndf_impl_bsdf_specular(struct vndf_impl_bsdf_view v, VNDF_REAL3 i) {
    struct vndf_impl_specular s;
    s.lobe.weight =
        vndf_impl_rgb_scaled(vndf_impl_bsdf_metallic(v, vndf_impl_half_cosine(vndf_impl_real3(v.o), i)),
                             vndf_impl_facets_weight(v.facets, i));
    s.lobe.share = vndf_impl_bsdf_metal_drawn(v);
    s.lobe.pdf = vndf_impl_facets_pdf(v.facets, i);
    return s;
}

#endif

#if VNDF_DIELECTRIC

// Which lobe: by u_lobe, the conductor first, then reflection, refraction and what is diffuse. The end of u_lobe may be 1.
// metal: the probability of that.
VNDF_FN int vndf_impl_bsdf_chosen(struct vndf_impl_interface n, struct vndf_impl_odds odds, VNDF_REAL metal,
                                  VNDF_REAL u_lobe) {
    VNDF_REAL mirrored = metal + odds.reflected;
    int lobe = n.transmits ? VNDF_BSDF_TRANSMISSION : VNDF_BSDF_REFLECTION;
#if VNDF_IMPL_DIFFUSE
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
    VNDF_REAL metal = vndf_impl_bsdf_metal_drawn(v);
    // Before the normal, where that does not decide.
    int early = vndf_impl_bsdf_chosen(n, vndf_impl_odds_of(n, VNDF_R(0.0)), metal, u_lobe);
    int mirrors = early != VNDF_BSDF_TRANSMISSION;
#if VNDF_THIN_WALLED
    int thin = n.transmits && !n.body;
    mirrors = mirrors || thin;
#endif
    struct vndf_impl_facets_pair both = vndf_impl_facets_both(v.facets, u, mirrors);
    VNDF_REAL cosine = VNDF_FMA(v.o.x, both.normal.x, VNDF_FMA(v.o.y, both.normal.y, v.o.z * both.normal.z));
#if VNDF_THIN_WALLED
    VNDF_REAL between = vndf_impl_half_cosine(vndf_impl_real3(v.o),
                                              VNDF_MAKE3(both.mirrored.x, both.mirrored.y, both.mirrored.z));
    cosine = thin ? between : cosine;
#endif
    VNDF_REAL f = vndf_fresnel_dielectric(cosine, n.eta);
    int late = vndf_impl_bsdf_chosen(n, vndf_impl_odds_of(n, f), metal, u_lobe);
    d.lobe = n.by_normal ? late : early;
    struct vndf_impl_sample refracted = vndf_impl_refracted(vndf_impl_real3(v.o), both.normal, n.eta);
    int crosses = d.lobe == VNDF_BSDF_TRANSMISSION;
#if VNDF_THIN_WALLED
    refracted.x = thin ? both.mirrored.x : refracted.x;
    refracted.y = thin ? both.mirrored.y : refracted.y;
    refracted.z = thin ? -both.mirrored.z : refracted.z;
    refracted.pdf = thin ? both.mirrored.pdf : refracted.pdf;
#endif
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
    VNDF_REAL share = vndf_impl_bsdf_metal_drawn(v);
    d.w = vndf_impl_facets_sample(v.facets, u);
    // The end of u_lobe may be 1.
    d.lobe = u_lobe < share || share >= VNDF_R(1.0) ? VNDF_BSDF_CONDUCTOR : VNDF_BSDF_LAMBERT;
    return d;
}

#endif

#endif

VNDF_END

#endif
