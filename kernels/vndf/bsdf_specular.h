// The specular lobes of a material: of the conductor and of the dielectric, which share their facets and one sampler.
#ifndef VNDF_BSDF_SPECULAR_H
#define VNDF_BSDF_SPECULAR_H

#include "bsdf_material.h"
#if VNDF_CONDUCTOR || VNDF_DIELECTRIC
#include "bsdf_facets.h"
#endif
#if VNDF_DIELECTRIC
#include "bsdf_dielectric.h"
#endif
#if VNDF_CONDUCTOR && !VNDF_CHOSEN(VNDF_ENERGY, none)
#include "bsdf_energy.h"
#endif

VNDF_BEGIN

#if VNDF_CONDUCTOR || VNDF_DIELECTRIC

#if VNDF_DIELECTRIC

// The dielectric as wo sees it.
struct vndf_impl_interface {
    VNDF_REAL eta;           // behind over before, seen from wo
    VNDF_REAL transmission;  // of what gets in
    int transmits;
    VNDF_REAL specular;  // the probability of its own two lobes: all but the diffuse one's
#if !VNDF_IMPL_CHOICE_BY_NORMAL
    VNDF_REAL expected;  // reflectance, by which the lobe is chosen
#endif
};
VNDF_FN VNDF_REAL vndf_impl_bsdf_index(struct vndf_bsdf b) {
    return vndf_impl_min(vndf_impl_max(b.ior, VNDF_R(1e-3)), VNDF_R(1e3));
}
VNDF_FN struct vndf_impl_interface vndf_impl_interface_of(VNDF_REAL3 o, struct vndf_bsdf b, VNDF_REAL side) {
    struct vndf_impl_interface n;
    VNDF_REAL ior = vndf_impl_bsdf_index(b), metal = vndf_impl_bsdf_metal(b);
#if VNDF_LAMBERT
    n.transmission = vndf_impl_share(vndf_impl_max(b.transmission, VNDF_R(0.0)));
#else
    n.transmission = VNDF_R(1.0);
#endif
    n.transmits = n.transmission > VNDF_R(0.0) && metal < VNDF_R(1.0);
    n.eta = n.transmits && side < VNDF_R(0.0) ? VNDF_R(1.0) / ior : ior;
    n.specular = VNDF_R(1.0) - metal;
#if VNDF_LAMBERT
    n.specular *= VNDF_FMA(VNDF_R(1.0) - n.transmission, vndf_fresnel_dielectric(o.z, n.eta), n.transmission);
#else
    (void)o;
#endif
#if !VNDF_IMPL_CHOICE_BY_NORMAL
    n.expected = vndf_impl_expected_reflectance(o, vndf_impl_bsdf_alpha(b), n.eta);
#endif
    return n;
}

// The probabilities of a reflection by the dielectric, and of a refraction. reflectance: of the facet.
struct vndf_impl_odds {
    VNDF_REAL reflected, refracted;
};
VNDF_FN struct vndf_impl_odds vndf_impl_odds_of(struct vndf_impl_interface n, VNDF_REAL reflectance) {
    struct vndf_impl_odds odds;
#if VNDF_IMPL_CHOICE_BY_NORMAL
    VNDF_REAL f = reflectance;
#else
    VNDF_REAL f = n.expected;
    (void)reflectance;
#endif
    VNDF_REAL through = (VNDF_R(1.0) - f) * n.transmission;
#if VNDF_LAMBERT
    // Of what is neither reflected nor transmitted nobody asks here.
    VNDF_REAL sum = f + through, rcp = VNDF_R(1.0) / (sum > VNDF_R(0.0) ? sum : VNDF_R(1.0));
    f *= rcp;
    through *= rcp;
#endif
    odds.reflected = n.specular * f;
    odds.refracted = n.specular * through;
    return odds;
}

#endif

// What the specular lobes make of a pair of directions: the probability that one of those that lead to wi's side is drawn, and
// the BSDF times |cos(theta_i)| over that and over the density of the lobe.
struct vndf_impl_specular {
    struct vndf_rgb weight;
    VNDF_REAL share;
#if VNDF_DIELECTRIC
    struct vndf_impl_facing facet;
#endif
};

#if VNDF_DIELECTRIC

VNDF_FN struct vndf_rgb vndf_impl_bsdf_transmitted(struct vndf_bsdf b, struct vndf_impl_interface n,
                                                   VNDF_REAL part) {
#if VNDF_CHOSEN(VNDF_TRANSPORT, radiance)
    // A beam that is bent into a narrower cone is brighter for it.
    part /= n.eta * n.eta;
#else
    (void)n;
#endif
#if VNDF_TINT
    return vndf_impl_rgb_scaled(b.transmittance, part);
#else
    (void)b;
    return vndf_impl_rgb(part, part, part);
#endif
}

VNDF_FN struct vndf_impl_specular vndf_impl_bsdf_specular(struct vndf_bsdf b, struct vndf_impl_facets c,
                                                          struct vndf_impl_interface n, VNDF_REAL3 o,
                                                          VNDF_REAL3 i) {
    struct vndf_impl_specular s;
    s.facet = vndf_impl_facing_of(o, i, n.eta, n.transmits && i.z < VNDF_R(0.0));
    VNDF_REAL metal = vndf_impl_bsdf_metal(b), rest = VNDF_R(1.0) - metal;
    VNDF_REAL f = vndf_fresnel_dielectric(s.facet.cos_o, n.eta), passed = (VNDF_R(1.0) - f) * n.transmission;
    struct vndf_impl_odds odds = vndf_impl_odds_of(n, f);
    s.share = s.facet.crosses ? odds.refracted : metal + odds.reflected;
    VNDF_REAL rcp = VNDF_R(1.0) / (s.share > VNDF_R(0.0) ? s.share : VNDF_R(1.0));
    VNDF_REAL3 raised = VNDF_MAKE3(i.x, i.y, vndf_impl_abs(i.z));
    // Straight through is not masked.
    VNDF_REAL masked = n.eta == VNDF_R(1.0) ? VNDF_R(1.0) : vndf_impl_facets_shadowing(c, raised);
    struct vndf_rgb through = vndf_impl_bsdf_transmitted(b, n, rest * passed * rcp * masked);
    VNDF_REAL mirrored = vndf_impl_facets_weight(c, raised), other = rest * f * rcp;
#if VNDF_CONDUCTOR
    VNDF_REAL own = s.share == metal ? VNDF_R(1.0) : metal * rcp;
    struct vndf_rgb back = vndf_impl_bsdf_reflectance(b, s.facet.cos_o);
    back = vndf_impl_rgb(VNDF_FMA(own, back.r, other), VNDF_FMA(own, back.g, other),
                         VNDF_FMA(own, back.b, other));
#else
    struct vndf_rgb back = vndf_impl_rgb(other, other, other);
#endif
    back = vndf_impl_rgb_scaled(back, mirrored);
    s.weight = vndf_impl_rgb(s.facet.crosses ? through.r : back.r, s.facet.crosses ? through.g : back.g,
                             s.facet.crosses ? through.b : back.b);
    return s;
}

// The direction that is judged by the front of the surface.
VNDF_FN VNDF_REAL3 vndf_impl_bsdf_onward(VNDF_REAL3 i, int crosses) {
    VNDF_REAL turn = crosses ? VNDF_R(-1.0) : VNDF_R(1.0);
    return VNDF_MAKE3(turn * i.x, turn * i.y, turn * i.z);
}

VNDF_FN VNDF_REAL vndf_impl_bsdf_specular_pdf(struct vndf_impl_facets c, struct vndf_impl_specular s,
                                              VNDF_REAL3 i) {
    return vndf_impl_facets_either_pdf(c, s.facet, i);
}

#else

VNDF_FN struct vndf_impl_specular vndf_impl_bsdf_specular(struct vndf_bsdf b, struct vndf_impl_facets c,
                                                          VNDF_REAL3 o, VNDF_REAL3 i) {
    struct vndf_impl_specular s;
    s.share = vndf_impl_bsdf_metal(b);
    s.weight = vndf_impl_rgb_scaled(vndf_impl_bsdf_reflectance(b, vndf_impl_half_cosine(o, i)),
                                    vndf_impl_facets_weight(c, i));
#if VNDF_CHOSEN(VNDF_ENERGY, turquin)
    s.weight = vndf_impl_bsdf_raised(b, s.weight, o);
#endif
    return s;
}

#if VNDF_IMPL_KULLA_CONTY
// Beside the other lobe of the conductor: less often drawn, heavier.
VNDF_FN struct vndf_impl_specular vndf_impl_bsdf_beside(struct vndf_impl_specular s,
                                                        struct vndf_impl_kulla_conty m) {
    VNDF_REAL often = VNDF_R(1.0) - m.share;
    s.share *= often;
    s.weight = vndf_impl_rgb_scaled(s.weight, VNDF_R(1.0) / (often > VNDF_R(0.0) ? often : VNDF_R(1.0)));
    return s;
}
#endif

VNDF_FN VNDF_REAL vndf_impl_bsdf_specular_pdf(struct vndf_impl_facets c, struct vndf_impl_specular s,
                                              VNDF_REAL3 i) {
    (void)s;
    return vndf_impl_facets_pdf(c, i);
}

#endif

#endif

#if VNDF_CONDUCTOR || VNDF_DIELECTRIC

// A direction of the specular lobes and the density of its lobe; the lobe is Lambert's where it is to be drawn instead.
struct vndf_impl_drawn {
    struct vndf_impl_sample w;
    int lobe;
};

#if VNDF_DIELECTRIC

// Which lobe: by u_lobe, the conductor first, then reflection, refraction and what is diffuse. The end of u_lobe may be 1.
VNDF_FN int vndf_impl_bsdf_lobe(struct vndf_impl_interface n, struct vndf_impl_odds odds, VNDF_REAL metal,
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

VNDF_FN struct vndf_impl_drawn vndf_impl_bsdf_drawn(struct vndf_bsdf b, struct vndf_impl_facets c,
                                                    struct vndf_impl_interface n, VNDF_REAL3 o, VNDF_REAL2 u,
                                                    VNDF_REAL u_lobe) {
    struct vndf_impl_drawn d;
    VNDF_REAL metal = vndf_impl_bsdf_metal(b), f = VNDF_R(0.0);
#if VNDF_IMPL_CHOICE_BY_NORMAL
    struct vndf_impl_facets_pair both = vndf_impl_facets_both(c, u, 1);
    f = vndf_fresnel_dielectric(
        VNDF_FMA(o.x, both.normal.x, VNDF_FMA(o.y, both.normal.y, o.z * both.normal.z)), n.eta);
    d.lobe = vndf_impl_bsdf_lobe(n, vndf_impl_odds_of(n, f), metal, u_lobe);
#else
    d.lobe = vndf_impl_bsdf_lobe(n, vndf_impl_odds_of(n, f), metal, u_lobe);
    struct vndf_impl_facets_pair both = vndf_impl_facets_both(c, u, d.lobe != VNDF_BSDF_TRANSMISSION);
#endif
    struct vndf_impl_sample refracted = vndf_impl_refracted(o, both.normal, n.eta);
    int crosses = d.lobe == VNDF_BSDF_TRANSMISSION;
    d.w.x = crosses ? refracted.x : both.mirrored.x;
    d.w.y = crosses ? refracted.y : both.mirrored.y;
    d.w.z = crosses ? refracted.z : both.mirrored.z;
    d.w.pdf = crosses ? refracted.pdf : both.mirrored.pdf;
    return d;
}

#else

// share: of the conductor.
VNDF_FN struct vndf_impl_drawn vndf_impl_bsdf_drawn(struct vndf_impl_facets c, VNDF_REAL2 u, VNDF_REAL share,
                                                    VNDF_REAL u_lobe) {
    struct vndf_impl_drawn d;
    d.w = vndf_impl_facets_sample(c, u);
    // The end of u_lobe may be 1.
    d.lobe = u_lobe < share || share >= VNDF_R(1.0) ? VNDF_BSDF_CONDUCTOR : VNDF_BSDF_LAMBERT;
    return d;
}

#endif

#endif

VNDF_END

#endif
