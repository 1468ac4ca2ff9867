// What wo sees of a material: set up once, for values, densities and samples.
#ifndef VNDF_BSDF_VIEW_H
#define VNDF_BSDF_VIEW_H

#include "bsdf_material.h"
#include "impl/stretch.h"
#if VNDF_IMPL_FACETS
#include "bsdf_facets.h"
#endif
#if VNDF_DIELECTRIC
#include "bsdf_dielectric.h"
#endif
#if VNDF_DIELECTRIC && VNDF_SPECULAR
#include "bsdf_gloss.h"
#endif
#if VNDF_DIELECTRIC && (VNDF_ABSORPTION || VNDF_DISPERSION)
#include "medium.h"
#endif
#if VNDF_CONDUCTOR && !VNDF_CHOSEN(VNDF_ENERGY, none)
#include "bsdf_energy.h"
#endif
#if VNDF_IMPL_GLASS_ENERGY
#include "bsdf_energy_glass.h"
#endif
#if VNDF_COAT
#include "bsdf_coat.h"
#endif

VNDF_BEGIN

#if VNDF_DIELECTRIC

// The dielectric as wo sees it.
struct vndf_impl_interface {
    VNDF_REAL eta;           // behind over before, seen from wo
    VNDF_REAL transmission;  // of what gets in
    int transmits, body;     // body: and bends what goes through
    VNDF_REAL specular;      // the probability of its own two lobes: all but the diffuse one's
    int by_normal;  // the lobe is chosen by the reflectance of the normal that was drawn, or before by the expected one
    int plain;  // visible normals, whatever VNDF_SAMPLING
#if VNDF_SPECULAR
    struct vndf_impl_gloss gloss;
#endif
#if !VNDF_IMPL_CHOICE_BY_NORMAL
    VNDF_REAL expected;
#endif
#if VNDF_IMPL_GLASS_ENERGY
    VNDF_REAL returned, refracted;  // factors for what scatters between facets
#endif
};
VNDF_FN VNDF_REAL vndf_impl_bsdf_index(struct vndf_bsdf b) {
#if VNDF_DISPERSION
    // Fraunhofer's C, d and F.
    return vndf_eta_dispersed(
        b.ior, b.dispersion,
        b.channel == 1 ? VNDF_R(587.56) : (b.channel == 2 ? VNDF_R(486.13) : VNDF_R(656.27)));
#else
    return vndf_impl_min(vndf_impl_max(b.ior, VNDF_R(1e-3)), VNDF_R(1e3));
#endif
}
// Of a facet, or of the surface where it is smooth, that reflects f by its index: the parts that its brightest channel reflects, or
// one with this excess, and that get in.
#if VNDF_SPECULAR
VNDF_FN VNDF_REAL vndf_impl_interface_reflects(struct vndf_impl_interface n, VNDF_REAL excess, VNDF_REAL f) {
    VNDF_REAL part = vndf_impl_gloss_reflects(n.gloss, excess, f);
    return n.plain && f >= VNDF_R(1.0) ? f : part;
}
VNDF_FN VNDF_REAL vndf_impl_interface_passes(struct vndf_impl_interface n, VNDF_REAL excess, VNDF_REAL f) {
    VNDF_REAL part = vndf_impl_gloss_passes(n.gloss, excess, f);
    return n.plain && f >= VNDF_R(1.0) ? VNDF_R(0.0) : part;
}
VNDF_FN VNDF_REAL vndf_impl_interface_most(struct vndf_impl_interface n) {
    return n.gloss.most;
}
// For the probability of a reflection where one facet stands for all: a dark colour makes it no less likely, since the others
// reflect all the same.
VNDF_FN VNDF_REAL vndf_impl_interface_likely(struct vndf_impl_interface n) {
    return vndf_impl_max(n.gloss.most, VNDF_R(0.0));
}
#else
VNDF_FN VNDF_REAL vndf_impl_interface_reflects(struct vndf_impl_interface n, VNDF_REAL excess, VNDF_REAL f) {
    (void)n;
    (void)excess;
    return f;
}
VNDF_FN VNDF_REAL vndf_impl_interface_passes(struct vndf_impl_interface n, VNDF_REAL excess, VNDF_REAL f) {
    (void)n;
    (void)excess;
    return VNDF_R(1.0) - f;
}
VNDF_FN VNDF_REAL vndf_impl_interface_most(struct vndf_impl_interface n) {
    (void)n;
    return VNDF_R(0.0);
}
VNDF_FN VNDF_REAL vndf_impl_interface_likely(struct vndf_impl_interface n) {
    (void)n;
    return VNDF_R(0.0);
}
#endif

// With what scattering between facets adds to the part that one of them reflects: of a body, to what that is by the index, no more
// than there is, and nothing to what a colour adds; and to the part that gets in.
#if VNDF_IMPL_GLASS_ENERGY
VNDF_FN VNDF_REAL vndf_impl_interface_returns(struct vndf_impl_interface n, VNDF_REAL f, VNDF_REAL part) {
#if VNDF_SPECULAR
    VNDF_REAL own = vndf_impl_min(n.plain && f >= VNDF_R(1.0) ? f : n.gloss.strength * f, part);
    own = n.body ? own : part;
#else
    VNDF_REAL own = f;
#endif
    return VNDF_FMA(own, n.returned - VNDF_R(1.0), part);
}
VNDF_FN VNDF_REAL vndf_impl_interface_lets_in(struct vndf_impl_interface n, VNDF_REAL part) {
    return n.refracted * part;
}
#else
VNDF_FN VNDF_REAL vndf_impl_interface_returns(struct vndf_impl_interface n, VNDF_REAL f, VNDF_REAL part) {
    (void)n;
    (void)f;
    return part;
}
VNDF_FN VNDF_REAL vndf_impl_interface_lets_in(struct vndf_impl_interface n, VNDF_REAL part) {
    (void)n;
    return part;
}
#endif

VNDF_FN struct vndf_impl_interface vndf_impl_interface_of(VNDF_REAL3 o, struct vndf_bsdf b, VNDF_REAL side) {
    struct vndf_impl_interface n;
    VNDF_REAL ior = vndf_impl_bsdf_index(b), metal = vndf_impl_bsdf_metal(b);
    n.transmission = vndf_impl_bsdf_transmission(b);
    n.transmits = n.transmission > VNDF_R(0.0) && metal < VNDF_R(1.0);
#if VNDF_THIN_WALLED
    n.body = n.transmits && !b.thin_walled;
#else
    n.body = n.transmits;
#endif
    n.eta = n.body && side < VNDF_R(0.0) ? VNDF_DIVIDE(VNDF_R(1.0), ior) : ior;
    n.plain = n.body && n.eta < VNDF_R(1.0);
#if VNDF_SPECULAR
    n.gloss = vndf_impl_gloss_of(b.specular, b.specular_colour, ior);
#endif
    n.specular = VNDF_R(1.0) - metal;
#if VNDF_LAMBERT
    VNDF_REAL chance =
        vndf_impl_interface_reflects(n, vndf_impl_interface_likely(n), vndf_fresnel_dielectric(o.z, n.eta));
    n.specular *= VNDF_FMA(VNDF_R(1.0) - n.transmission, chance, n.transmission);
#else
    (void)o;
#endif
    // From the denser side many normals reflect all there is, and which do decides nearly everything: a choice before the normal
    // would leave the few that transmit, or reflect in part, samples that weigh much.
    n.by_normal = VNDF_IMPL_CHOICE_BY_NORMAL || n.plain;
#if VNDF_THIN_WALLED
    // What goes through a thin wall is a reflection turned around, by the same normals.
    n.by_normal = n.by_normal || (n.transmits && !n.body);
#endif
#if !VNDF_IMPL_CHOICE_BY_NORMAL
    n.expected = vndf_impl_interface_reflects(
        n, vndf_impl_interface_likely(n), vndf_impl_expected_reflectance(o, vndf_impl_bsdf_alpha(b), n.eta));
#endif
#if VNDF_IMPL_GLASS_ENERGY
    VNDF_REAL counts = n.transmission, weaker = VNDF_R(1.0);
#if VNDF_SPECULAR
    // The table is of an interface as its index makes it. A brighter one scatters less through its facets, and of a weaker one more
    // gets in at once: by as much less is given back, so that there is never much more than falls on it.
    VNDF_REAL bright = VNDF_R(1.0) - vndf_impl_interface_likely(n);
    VNDF_REAL upright = vndf_fresnel_dielectric(VNDF_R(1.0), n.eta),
              in = vndf_impl_interface_passes(n, vndf_impl_interface_most(n), upright);
    weaker = vndf_impl_share(VNDF_DIVIDE(VNDF_R(1.0) - upright, in > VNDF_R(0.0) ? in : VNDF_R(1.0)));
    weaker = n.body && in > VNDF_R(0.0) ? weaker : VNDF_R(1.0);
    counts *= n.body ? bright : VNDF_R(1.0);
#endif
    struct vndf_energy_factors factors =
        vndf_impl_bsdf_glass_factors(o, vndf_impl_bsdf_alpha(b), n.eta, counts, n.body);
    n.returned = factors.reflected;
    n.refracted = factors.refracted * weaker;
#endif
    return n;
}

// The probabilities of a reflection by the dielectric, and of a refraction. f: the facet's reflectance
// by its index.
struct vndf_impl_odds {
    VNDF_REAL reflected, refracted;
};
VNDF_FN struct vndf_impl_odds vndf_impl_odds_of(struct vndf_impl_interface n, VNDF_REAL f) {
    struct vndf_impl_odds odds;
    VNDF_REAL most = vndf_impl_interface_most(n);
    VNDF_REAL back = vndf_impl_interface_reflects(n, most, f), in = vndf_impl_interface_passes(n, most, f);
#if !VNDF_IMPL_CHOICE_BY_NORMAL
    back = n.by_normal ? back : n.expected;
    in = n.by_normal ? in : VNDF_R(1.0) - n.expected;
#endif
    back = vndf_impl_interface_returns(n, n.by_normal ? f : back, back);
    VNDF_REAL through = vndf_impl_interface_lets_in(n, in) * n.transmission;
#if VNDF_LAMBERT || VNDF_IMPL_GLASS_ENERGY
    // Of what is neither reflected nor transmitted nobody asks here. Where all is, rounding is left alone.
#if VNDF_IMPL_GLASS_ENERGY
    VNDF_REAL sum = back + through;
#else
    VNDF_REAL sum = n.transmission < VNDF_R(1.0) ? back + through : VNDF_R(1.0);
#endif
    VNDF_REAL rcp = VNDF_DIVIDE(VNDF_R(1.0), sum > VNDF_R(0.0) ? sum : VNDF_R(1.0));
    back *= rcp;
    through *= rcp;
#endif
    odds.reflected = n.specular * back;
    odds.refracted = n.specular * through;
    return odds;
}

#endif

struct vndf_impl_bsdf_view {
    struct vndf_bsdf b;
    VNDF_REAL side;              // what turns z to the side of wo
    struct vndf_impl_vector o;   // wo on that side
    struct vndf_impl_vector ng;  // the geometric normal there
#if VNDF_IMPL_FACETS
    struct vndf_impl_facets facets;  // of the base; the coat's where there are no others
#endif
#if VNDF_DIELECTRIC
    struct vndf_impl_interface media;
#endif
#if VNDF_IMPL_KULLA_CONTY
    struct vndf_impl_kulla_conty multiple;
#endif
#if VNDF_COAT
    struct vndf_impl_coat coat;
#endif
};
VNDF_FN struct vndf_impl_bsdf_view vndf_impl_bsdf_view_of(VNDF_REAL3 wo, struct vndf_bsdf b) {
    struct vndf_impl_bsdf_view v;
    v.b = b;
    v.side = vndf_impl_bsdf_side(wo, b);
    VNDF_REAL3 o = VNDF_MAKE3(wo.x, wo.y, v.side * wo.z), ng = vndf_impl_bsdf_ng(v.side, b);
    v.o = vndf_impl_vector_of(o.x, o.y, o.z);
    v.ng = vndf_impl_vector_of(ng.x, ng.y, ng.z);
#if VNDF_IMPL_SPECULAR
    v.facets = vndf_impl_facets_of(o, vndf_impl_bsdf_alpha(b), vndf_impl_bsdf_facets_ng(ng, b));
#endif
#if VNDF_DIELECTRIC
    v.media = vndf_impl_interface_of(o, b, v.side);
    v.facets = vndf_impl_facets_plain(v.facets, v.media.plain);
#endif
#if VNDF_IMPL_KULLA_CONTY
    v.multiple = vndf_impl_bsdf_kulla_conty(b, o);
#endif
#if VNDF_COAT
#if VNDF_DIELECTRIC
    int within = v.media.body && v.side < VNDF_R(0.0);
#else
    int within = 0;
#endif
#if VNDF_IMPL_SPECULAR
    VNDF_REAL last = vndf_impl_facets_seen(v.facets);
#else
    VNDF_REAL last = VNDF_R(1.0);
#endif
    v.coat = vndf_impl_coat_of(o, ng, b, within, last);
#if !VNDF_IMPL_SPECULAR
    v.facets = v.coat.facets;
#endif
#endif
    return v;
}

// The part of the light that passes between wo and wi: 0 where the rule about sides (bsdf.h) forbids it.
// Source of the part near the geometric horizon: Chiang, Li & Burley, Taming the Shadow Terminator, 2019: G + G^2 - G^3,
//     G = min(ng . wi / ((ns . wi) (ns . ng)), 1).
VNDF_FN VNDF_REAL vndf_impl_bsdf_passing(struct vndf_impl_bsdf_view v, VNDF_REAL3 i, int crosses) {
#if VNDF_IMPL_DIFFUSE || VNDF_SHADING_NORMAL || VNDF_DIELECTRIC
    // A direction behind is judged by its opposite.
    VNDF_REAL turn = crosses ? VNDF_R(-1.0) : VNDF_R(1.0);
    VNDF_REAL3 wi = VNDF_MAKE3(turn * i.x, turn * i.y, turn * i.z);
    int above = v.o.z > VNDF_R(0.0) && wi.z > VNDF_R(0.0);
#if VNDF_SHADING_NORMAL
    VNDF_REAL x = v.ng.x, y = v.ng.y, z = v.ng.z;
    VNDF_REAL height_o = VNDF_FMA(v.o.x, x, VNDF_FMA(v.o.y, y, v.o.z * z));
    // Made dependent on the other height, so that LLVM's SLP pass does not pack the two; where it is none, above is 0.
    above = above && height_o > VNDF_R(0.0);
    VNDF_REAL height_i = VNDF_FMA(wi.x, x, VNDF_FMA(wi.y, y, wi.z * z));
    above = above && height_i > VNDF_R(0.0);
#if VNDF_TERMINATOR
    VNDF_REAL most = wi.z * z;
    int fading = height_i < most;
    VNDF_REAL g = fading ? VNDF_DIVIDE(height_i, fading ? most : VNDF_R(1.0)) : VNDF_R(1.0);
    VNDF_REAL part = g * VNDF_FMA(g, VNDF_R(1.0) - g, VNDF_R(1.0));
    return above ? part : VNDF_R(0.0);
#endif
#endif
    return above ? VNDF_R(1.0) : VNDF_R(0.0);
#else
    // A conductor with one normal has the weight 0 below its horizon by itself.
    (void)v;
    (void)i;
    (void)crosses;
    return VNDF_R(1.0);
#endif
}

// A lobe at a pair of directions: BSDF times |cos(theta_i)| over its density and over the probability that it is drawn.
struct vndf_impl_bsdf_lobe {
    struct vndf_rgb weight;
    VNDF_REAL share, pdf;
};

#if VNDF_COAT

// The coat's lobe: the base's specular lobe without its colours.
VNDF_FN struct vndf_impl_bsdf_lobe vndf_impl_bsdf_coat(struct vndf_impl_bsdf_view v, VNDF_REAL3 i,
                                                       int crosses, VNDF_REAL last) {
    struct vndf_impl_bsdf_lobe l;
    struct vndf_impl_facets facets = vndf_impl_facets_after(v.coat.facets, last);
    VNDF_REAL3 wi = VNDF_MAKE3(i.x, i.y, last >= VNDF_R(0.0) ? i.z : VNDF_R(1.0));
    VNDF_REAL f =
        vndf_fresnel_dielectric(vndf_impl_half_cosine(vndf_impl_real3(v.o), wi), VNDF_IMPL_COAT_IOR);
    VNDF_REAL share = v.coat.share, light = v.coat.factor * f * vndf_impl_facets_weight(facets, wi);
    VNDF_REAL weight = VNDF_DIVIDE(light, share > VNDF_R(0.0) ? share : VNDF_R(1.0));
    l.weight = vndf_impl_rgb(weight, weight, weight);
    l.share = crosses ? VNDF_R(0.0) : share;
    l.pdf = vndf_impl_facets_pdf(facets, wi);
    return l;
}

// The coat's facets, or the base's. Chosen by their alpha, since two samplers would be packed by LLVM's SLP pass.
VNDF_FN struct vndf_impl_facets vndf_impl_bsdf_chosen_facets(struct vndf_impl_bsdf_view v, int coated) {
#if VNDF_IMPL_SPECULAR
    VNDF_REAL2 alpha = vndf_impl_bsdf_alpha(v.b);
    VNDF_REAL x = coated ? v.coat.alpha : alpha.x, y = coated ? v.coat.alpha : alpha.y;
    // Dependent on the coat's own, so that LLVM's SLP pass does not pack the two; the other choice is never taken.
    VNDF_REAL z = vndf_impl_facets_seen(v.coat.facets) >= VNDF_R(0.0) ? v.o.z : VNDF_R(1.0);
    VNDF_REAL3 own = vndf_impl_bsdf_facets_ng(vndf_impl_real3(v.ng), v.b);
    VNDF_REAL3 ng = VNDF_MAKE3(coated ? v.ng.x : own.x, coated ? v.ng.y : own.y, coated ? v.ng.z : own.z);
    struct vndf_impl_facets facets = vndf_impl_facets_of(VNDF_MAKE3(v.o.x, v.o.y, z), VNDF_MAKE2(x, y), ng);
#if VNDF_DIELECTRIC
    facets = vndf_impl_facets_plain(facets, v.media.plain && !coated);
#endif
    return facets;
#else
    (void)coated;
    return v.coat.facets;
#endif
}

#endif

// A direction that was drawn, and from which lobe. The density is that of the facets' sampler, whichever lobe it is.
struct vndf_impl_drawn {
    struct vndf_impl_sample w;
    int lobe;
};

VNDF_END

#endif
