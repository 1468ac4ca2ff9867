// A material: a rough conductor, a rough dielectric, what lies under it: another medium or diffuse reflection, Lambert's or that of
// a rough surface; or a mix; and a coat over it; with the effects of effects.h alone.
//
// Conventions of vndf.h: wo and wi are unit vectors in the local frame, z the shading normal. All functions take the material
// by value; a member exists only where its effect is on.
//
// What is reflected. Light passes only between directions on the same side of the surface: wi and wo must both lie above the
// shading normal's horizon and above the geometric one's, so that nothing leaks through the surface on either account. Seen
// from behind, a surface is black, or with VNDF_BACK_FACING the mirror image of its front: both normals are turned around
// where wo lies below the geometric horizon. A wo above one horizon and below the other sees black: where a normal map or a
// coarse mesh makes that happen, bend the shading normal towards wo before the frame is made.
//
// A dielectric also lets light through. The part `transmission` of what it lets in goes on in the medium behind, on the other
// side of both normals; the rest meets a Lambertian surface. A material with transmission > 0 bounds a body: seen from behind
// its index is turned over. Without it, behind is as in front.
//
// So it is of a material that is thin_walled (VNDF_THIN_WALLED): a wall without thickness, as glTF has it, reflects as the front of
// a body does, and what gets in goes straight through, a reflection turned to the other side: rough walls blur what is seen through
// them, with any index, and nothing is bent. Light between the sides of the wall does not count: a smooth one reflects F and lets
// 1 - F through, of a pane it would be 2 F / (1 + F) and the rest. A coat lies on both sides, and counts once.
//
// With VNDF_DISPERSION the index is that of one channel. A path takes one of its channels, at the first surface with a dispersion,
// with a random number of its own and a probability in proportion to what it carries in each, and carries on the sum in that one: what
// was chosen once is chosen for certain from there on, and nothing is biased. (A mix of the channels' densities, hero wavelengths,
// would have every material evaluated three times, and where the glass is smooth, where it shows, the three have no direction in
// common: it gains nothing there.)
//
// Where shading and geometric normal differ, light ends abruptly at the geometric horizon; VNDF_TERMINATOR fades it out
// before, and is not reciprocal, as no such correction is.
#ifndef VNDF_BSDF_H
#define VNDF_BSDF_H

#include "bsdf_diffuse.h"
#include "bsdf_specular.h"

VNDF_BEGIN

// BSDF times |cos(theta_i)|, and the density of vndf_bsdf_sample.
struct vndf_bsdf_value {
    struct vndf_rgb f;
    VNDF_REAL pdf;
};

// A direction, BSDF times |cos(theta_i)| over its density, the density per steradian, and the lobe.
struct vndf_bsdf_direction {
    VNDF_REAL wi_x, wi_y, wi_z;
    struct vndf_rgb weight;
    VNDF_REAL pdf;
    int lobe;
};

// --- The mix ---

// All lobes at a pair of directions.
struct vndf_impl_bsdf_lobes {
#if VNDF_IMPL_SPECULAR
    struct vndf_impl_specular specular;
#endif
#if VNDF_IMPL_DIFFUSE
    struct vndf_impl_bsdf_lobe diffuse;
#endif
#if VNDF_COAT
    struct vndf_impl_bsdf_lobe coat;
    VNDF_REAL base, let_through;  // of what lies under it: the probability, and a factor on its weight
#endif
};
// Whether light crosses the surface.
VNDF_FN int vndf_impl_bsdf_crosses(struct vndf_impl_bsdf_lobes l) {
#if VNDF_DIELECTRIC
    return l.specular.crosses;
#else
    (void)l;
    return 0;
#endif
}

VNDF_FN struct vndf_impl_bsdf_lobes vndf_impl_bsdf_lobes_of(struct vndf_impl_bsdf_view v, VNDF_REAL3 i) {
    struct vndf_impl_bsdf_lobes l;
#if VNDF_IMPL_SPECULAR
    l.specular = vndf_impl_bsdf_specular(v, i);
#endif
#if VNDF_IMPL_DIFFUSE
    l.diffuse = vndf_impl_bsdf_diffuse(v, i);
#endif
#if VNDF_COAT
#if VNDF_IMPL_SPECULAR
    // Dependent on both.
    VNDF_REAL last = l.specular.lobe.pdf >= VNDF_R(0.0) ? l.specular.lobe.weight.b : VNDF_R(1.0);
#else
    VNDF_REAL last = VNDF_R(1.0);
#endif
    l.coat = vndf_impl_bsdf_coat(v, i, vndf_impl_bsdf_crosses(l), last);
    l.base = VNDF_R(1.0) - v.coat.share;
    int leaves = vndf_impl_bsdf_crosses(l);
#if VNDF_DIELECTRIC
    leaves = leaves && v.media.body;
#endif
    l.let_through = vndf_impl_coat_lets_through(v.coat, i, leaves, l.coat.weight.b);
#endif
    return l;
}

// Two lobes as one: where one of them has the whole share its weight and density, to the bit.
VNDF_FN VNDF_REAL vndf_impl_mixed_pdf(struct vndf_impl_bsdf_lobe s, struct vndf_impl_bsdf_lobe d) {
    return VNDF_FMA(s.share, s.pdf, d.share * d.pdf);
}
VNDF_FN struct vndf_rgb vndf_impl_mixed(struct vndf_impl_bsdf_lobe s, struct vndf_impl_bsdf_lobe d) {
    VNDF_REAL own = s.share * s.pdf, other = d.share * d.pdf, sum = own + other;
    // The smaller share by a quotient, the larger as what is left: both keep their digits, and 0 leaves 1. Where rounding
    // has left nothing of either density it is the first one's.
    int less = other <= own;
    VNDF_REAL lesser = VNDF_DIVIDE(less ? other : own, sum > VNDF_R(0.0) ? sum : VNDF_R(1.0)),
              greater = VNDF_R(1.0) - lesser;
    VNDF_REAL share = less ? lesser : greater, rest = less ? greater : lesser;
    return vndf_impl_rgb(VNDF_FMA(share, d.weight.r, rest * s.weight.r),
                         VNDF_FMA(share, d.weight.g, rest * s.weight.g),
                         VNDF_FMA(share, d.weight.b, rest * s.weight.b));
}

// What lies under the coat.
VNDF_FN struct vndf_impl_bsdf_lobe vndf_impl_bsdf_base(struct vndf_impl_bsdf_lobes l) {
    struct vndf_impl_bsdf_lobe base;
#if VNDF_IMPL_SPECULAR && VNDF_IMPL_DIFFUSE
    base.weight = vndf_impl_mixed(l.specular.lobe, l.diffuse);
    base.pdf = vndf_impl_mixed_pdf(l.specular.lobe, l.diffuse);
#else
#if VNDF_IMPL_SPECULAR
    struct vndf_impl_bsdf_lobe only = l.specular.lobe;
#else
    struct vndf_impl_bsdf_lobe only = l.diffuse;
#endif
    base.weight = only.weight;
    base.pdf = only.share * only.pdf;
#endif
    base.share = VNDF_R(1.0);
    return base;
}

// All of it.
VNDF_FN struct vndf_impl_bsdf_lobe vndf_impl_bsdf_all(struct vndf_impl_bsdf_lobes l) {
    struct vndf_impl_bsdf_lobe all = vndf_impl_bsdf_base(l);
#if VNDF_COAT
    all.weight = vndf_impl_rgb_scaled(all.weight, l.let_through);
    all.share = l.base;
    all.weight = vndf_impl_mixed(all, l.coat);
    all.pdf = vndf_impl_mixed_pdf(all, l.coat);
    all.share = VNDF_R(1.0);
#endif
    return all;
}

// --- A sample of it ---

// What is drawn under the coat. The view's facets may be the coat's, for a u_lobe below 0: then it is a reflection by them.
VNDF_FN struct vndf_impl_drawn vndf_impl_bsdf_drawn_base(struct vndf_impl_bsdf_view v, VNDF_REAL2 u,
                                                         VNDF_REAL u_lobe) {
    struct vndf_impl_drawn d;
#if VNDF_IMPL_SPECULAR
    d = vndf_impl_bsdf_drawn_specular(v, u, u_lobe);
#elif VNDF_IMPL_FACETS
    d.w = vndf_impl_facets_sample(v.facets, u);
    d.lobe = u_lobe < VNDF_R(0.0) ? VNDF_BSDF_COAT : VNDF_BSDF_LAMBERT;
#else
    (void)v;
    (void)u_lobe;
    d.lobe = VNDF_BSDF_LAMBERT;
#endif
#if VNDF_IMPL_DIFFUSE
    struct vndf_impl_sample even = vndf_impl_lambert(u);
#if VNDF_IMPL_FACETS
    int by_facets = d.lobe != VNDF_BSDF_LAMBERT;
    d.w.x = by_facets ? d.w.x : even.x;
    d.w.y = by_facets ? d.w.y : even.y;
    d.w.z = by_facets ? d.w.z : even.z;
#else
    d.w = even;
#endif
#endif
    return d;
}

// One sampler for all that has facets: which ones is chosen before, the coat at the end of u_lobe.
VNDF_FN struct vndf_impl_drawn vndf_impl_bsdf_drawn(struct vndf_impl_bsdf_view v, VNDF_REAL2 u,
                                                    VNDF_REAL u_lobe) {
#if VNDF_COAT
    VNDF_REAL rest = VNDF_R(1.0) - v.coat.share;
    int coated = u_lobe >= rest && rest < VNDF_R(1.0);
    VNDF_REAL within = VNDF_DIVIDE(u_lobe, rest > VNDF_R(0.0) ? rest : VNDF_R(1.0));
    struct vndf_impl_bsdf_view chosen = v;
    chosen.facets = vndf_impl_bsdf_chosen_facets(v, coated);
    struct vndf_impl_drawn d = vndf_impl_bsdf_drawn_base(chosen, u, coated ? VNDF_R(-1.0) : within);
    d.lobe = coated ? VNDF_BSDF_COAT : d.lobe;
    return d;
#else
    return vndf_impl_bsdf_drawn_base(v, u, u_lobe);
#endif
}

// All lobes at the direction that was drawn: their weights.
VNDF_FN struct vndf_impl_bsdf_lobes vndf_impl_bsdf_lobes_at(struct vndf_impl_bsdf_view v,
                                                            struct vndf_impl_drawn d) {
    VNDF_REAL z = d.w.z;
#if VNDF_IMPL_FACETS && (VNDF_IMPL_DIFFUSE || VNDF_COAT)
    // Made dependent on the density of the sample, so that LLVM's SLP pass does not pack it with the one at wi (impl/stretch.h);
    // the other choice is never taken.
    z = d.w.pdf < VNDF_R(0.0) ? VNDF_R(1.0) : z;
#endif
    return vndf_impl_bsdf_lobes_of(v, VNDF_MAKE3(d.w.x, d.w.y, z));
}

// Its density from the sampler's own terms where it has facets.
VNDF_FN VNDF_REAL vndf_impl_bsdf_drawn_density(struct vndf_impl_bsdf_lobes l, struct vndf_impl_drawn d) {
#if VNDF_COAT
    l.coat.pdf = d.lobe == VNDF_BSDF_COAT ? d.w.pdf : l.coat.pdf;
#endif
#if VNDF_IMPL_SPECULAR
    int specular = d.lobe != VNDF_BSDF_LAMBERT && d.lobe != VNDF_BSDF_COAT;
    l.specular.lobe.pdf = specular ? d.w.pdf : l.specular.lobe.pdf;
#else
    (void)d;
#endif
    return vndf_impl_bsdf_all(l).pdf;
}

// What is lost: a reflection below the surface, where refractions count alone; a refraction above it, or one that is none; and
// what the facets' sampler does not keep.
VNDF_FN int vndf_impl_bsdf_lost(struct vndf_impl_bsdf_view v, struct vndf_impl_bsdf_lobes l,
                                struct vndf_impl_drawn d) {
#if VNDF_IMPL_FACETS
    int unkept = d.lobe != VNDF_BSDF_LAMBERT && vndf_impl_facets_lost(d.w);
#else
    int unkept = 0;
#endif
#if VNDF_DIELECTRIC
    int through = d.lobe == VNDF_BSDF_TRANSMISSION;
    return unkept ||
           (v.media.transmits && (l.specular.crosses != through || (through && !(d.w.pdf > VNDF_R(0.0)))));
#else
    (void)v;
    (void)l;
    (void)d;
    return unkept;
#endif
}

// --- Public functions ---

// The BSDF times |cos(theta_i)|, and the density of vndf_bsdf_sample.
// Source: Walter et al. 2007, Equations 20 and 21, with the terms of bsdf_facets.h and bsdf_dielectric.h; Lambert's albedo / pi, or
//     what bsdf_rough_diffuse.h makes of it; bsdf_coat.h.
// wo, wi: unit vectors, local frame, anywhere on the sphere.
// return: f for each channel, pdf per steradian of wi: over the whole sphere, also where f is 0 because the surface lies
//     between; of a material that transmits, of the lobes that light wi's side alone. Both are 0 of a refraction with ior = 1.
// Accuracy: 24 eps; double 24.
//     Of pdf; of f as vndf_bsdf_eval. Below alpha = 1e-2 the rounding of wi moves both by more than that, and equally.
VNDF_FN struct vndf_bsdf_value vndf_bsdf_eval_pdf(VNDF_REAL3 wo, VNDF_REAL3 wi, struct vndf_bsdf bsdf) {
    struct vndf_bsdf_value value;
    struct vndf_impl_bsdf_view v = vndf_impl_bsdf_view_of(wo, bsdf);
    VNDF_REAL3 i = VNDF_MAKE3(wi.x, wi.y, v.side * wi.z);
    struct vndf_impl_bsdf_lobes l = vndf_impl_bsdf_lobes_of(v, i);
    VNDF_REAL passing = vndf_impl_bsdf_passing(v, i, vndf_impl_bsdf_crosses(l));
    struct vndf_impl_bsdf_lobe all = vndf_impl_bsdf_all(l);
    value.pdf = all.pdf;
    value.f = vndf_impl_rgb_scaled(vndf_impl_rgb_scaled(all.weight, passing), all.pdf);
    return value;
}

// The BSDF times |cos(theta_i)| alone.
// Accuracy: 16 eps; double 16.
//     Over 1 + the condition numbers of the reflectance in its arguments and of the height above the geometric horizon; of
//     light that crosses the surface, in the cosines with its facet, too, and from inside in the index; with Beckmann times
//     1 + 2 q.
VNDF_FN struct vndf_rgb vndf_bsdf_eval(VNDF_REAL3 wo, VNDF_REAL3 wi, struct vndf_bsdf bsdf) {
    return vndf_bsdf_eval_pdf(wo, wi, bsdf).f;
}

// The density of vndf_bsdf_sample alone.
// Accuracy: 24 eps; double 24.
//     With Beckmann times 1 + 2 q.
VNDF_FN VNDF_REAL vndf_bsdf_pdf(VNDF_REAL3 wo, VNDF_REAL3 wi, struct vndf_bsdf bsdf) {
    return vndf_bsdf_eval_pdf(wo, wi, bsdf).pdf;
}

// A direction drawn from the material.
// Source: the samplers of bsdf_facets.h, bsdf_dielectric.h and bsdf_lambert.h, combined by one-sample multiple importance sampling.
// wo: unit vector, local frame, anywhere on the sphere.
// u: for the lobe's sampler, with its meaning. Each effect has random numbers of its own: none changes by one that is
//     switched off.
// u_lobe: which lobe, the conductor for u_lobe < metal (kulla_conty: less its diffuse share), then reflection, refraction and
//     Lambert, each times 1 - the coat's probability, and the coat; of no effect where there is one lobe.
// return: the direction, anywhere on the sphere, with weight 0 where nothing goes; its density from the sampler's own terms
//     where it is specular. With ior = 1 what is transmitted goes straight on, with the largest finite density.
// Accuracy: 2 eps; double 2.
//     Of the weight, over max(1, weight), against f / pdf of vndf_bsdf_eval_pdf at wi. In a mix the weight follows that density
//     even where the rounding of wi has left nothing of it (Beckmann, alpha below 1e-6): what the conductor reflects is then lost.
VNDF_FN struct vndf_bsdf_direction vndf_bsdf_sample(VNDF_REAL3 wo, struct vndf_bsdf bsdf, VNDF_REAL2 u,
                                                    VNDF_REAL u_lobe) {
    struct vndf_bsdf_direction d;
    struct vndf_impl_bsdf_view v = vndf_impl_bsdf_view_of(wo, bsdf);
    struct vndf_impl_drawn drawn = vndf_impl_bsdf_drawn(v, u, u_lobe);
    VNDF_REAL3 i = VNDF_MAKE3(drawn.w.x, drawn.w.y, drawn.w.z);
    struct vndf_impl_bsdf_lobes l = vndf_impl_bsdf_lobes_at(v, drawn);
    VNDF_REAL passing = vndf_impl_bsdf_passing(v, i, vndf_impl_bsdf_crosses(l));
    int lost = vndf_impl_bsdf_lost(v, l, drawn);
    d.weight = vndf_impl_rgb_scaled(vndf_impl_bsdf_all(l).weight, lost ? VNDF_R(0.0) : passing);
    d.pdf = lost ? VNDF_R(0.0) : vndf_impl_bsdf_drawn_density(l, drawn);
    d.wi_x = i.x;
    d.wi_y = i.y;
    d.wi_z = v.side * i.z;
    d.lobe = drawn.lobe;
    return d;
}

// What is left for each channel of light that went through the body behind the surface.
// Source: Beer's law, vndf_transmittance.
// distance: of the way, >= 0, in the unit of length of the material's absorption.
// return: in [0, 1]; 1 without VNDF_ABSORPTION, of what lets nothing through nobody asks.
// Accuracy: 1.25 eps (1 + condition number); double 1.25.
VNDF_FN struct vndf_rgb vndf_bsdf_transmittance(struct vndf_bsdf bsdf, VNDF_REAL distance) {
#if VNDF_DIELECTRIC && VNDF_ABSORPTION
    VNDF_REAL red = vndf_transmittance(distance, bsdf.absorption.r);
    VNDF_REAL green = vndf_transmittance(distance, vndf_impl_next_channel(bsdf.absorption.g, red));
    VNDF_REAL blue = vndf_transmittance(distance, vndf_impl_next_channel(bsdf.absorption.b, green));
    return vndf_impl_rgb(red, green, blue);
#else
    (void)bsdf;
    (void)distance;
    return vndf_impl_rgb(VNDF_R(1.0), VNDF_R(1.0), VNDF_R(1.0));
#endif
}

#undef VNDF_IMPL_SPECULAR
#undef VNDF_IMPL_FACETS
#undef VNDF_IMPL_KULLA_CONTY
#undef VNDF_IMPL_DIFFUSE

VNDF_END

#endif
