// A material: a rough conductor, Lambert's diffuse reflection, or a mix of both, with the effects of effects.h alone.
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
// Where shading and geometric normal differ, light ends abruptly at the geometric horizon; VNDF_TERMINATOR fades it out
// before, and is not reciprocal, as no such correction is.
#ifndef VNDF_BSDF_H
#define VNDF_BSDF_H

#include "effects.h"
#include "fresnel.h"
#include "impl/exact.h"
#if VNDF_CONDUCTOR
#include "bsdf_conductor.h"
#if !VNDF_CHOSEN(VNDF_ENERGY, none)
#include "energy.h"
#endif
#endif

// What is drawn by the cosine law: Lambert's reflection, Kulla and Conty's, or both at once.
#define VNDF_IMPL_KULLA_CONTY (VNDF_CONDUCTOR && VNDF_CHOSEN(VNDF_ENERGY, kulla_conty))
#define VNDF_IMPL_DIFFUSE (VNDF_LAMBERT || VNDF_IMPL_KULLA_CONTY)
#if VNDF_IMPL_DIFFUSE
#include "bsdf_lambert.h"
#endif

VNDF_BEGIN

// A material at a point. Every member of a reflectance is in [0, 1].
struct vndf_bsdf {
#if VNDF_CONDUCTOR
    // alpha as everywhere in the library, in [1e-8, 1e3]; alpha_x stands for both without VNDF_ANISOTROPIC.
    VNDF_REAL alpha_x;
#if VNDF_ANISOTROPIC
    VNDF_REAL alpha_y;
#endif
    // conductor: eta, k for each channel, over the index outside. schlick: f0 for each channel, f90. f82: f0 and the tint at 82
    // degrees for each channel.
    VNDF_IMPL_FRESNEL_MEMBERS
#if VNDF_TINT
    struct vndf_rgb tint;  // a factor on the whole conductor
#endif
#endif
#if VNDF_LAMBERT
    struct vndf_rgb albedo;
#endif
#if VNDF_CONDUCTOR && VNDF_LAMBERT
    VNDF_REAL
    metal;  // the share of the conductor, and the probability that it is sampled; the rest is Lambert's
#endif
#if VNDF_SHADING_NORMAL
    VNDF_REAL ng_x, ng_y,
        ng_z;  // the geometric normal, a unit vector in the local frame; (0, 0, 1): no other than the shading one
#endif
};

// What vndf_bsdf_sample tells of the lobe that it drew from.
#define VNDF_BSDF_CONDUCTOR 0
#define VNDF_BSDF_LAMBERT 1

// BSDF times |cos(theta_i)|, and the density of vndf_bsdf_sample.
struct vndf_bsdf_value {
    struct vndf_rgb f;
    VNDF_REAL pdf;
};

// A direction, BSDF times |cos(theta_i)| over its density, the density per steradian, and the lobe: 0 the conductor's, 1 by the
// cosine law, Lambert's and of VNDF_ENERGY kulla_conty.
struct vndf_bsdf_direction {
    VNDF_REAL wi_x, wi_y, wi_z;
    struct vndf_rgb weight;
    VNDF_REAL pdf;
    int lobe;
};

// --- The side of the surface ---

// What turns z to the side of wo: -1 behind a surface with two sides, 1 otherwise.
VNDF_FN VNDF_REAL vndf_impl_bsdf_side(VNDF_REAL3 wo, struct vndf_bsdf b) {
#if VNDF_BACK_FACING
#if VNDF_SHADING_NORMAL
    int backwards = VNDF_FMA(wo.x, b.ng_x, VNDF_FMA(wo.y, b.ng_y, wo.z * b.ng_z)) < VNDF_R(0.0);
#else
    int backwards = wo.z < VNDF_R(0.0);
#endif
    (void)b;
    return backwards ? VNDF_R(-1.0) : VNDF_R(1.0);
#else
    (void)wo;
    (void)b;
    return VNDF_R(1.0);
#endif
}

// A conductor with one normal has the weight 0 below its horizon by itself.
#define VNDF_IMPL_SIDES (VNDF_IMPL_DIFFUSE || VNDF_SHADING_NORMAL)

#if VNDF_IMPL_SIDES

// The part of the light that passes between wo and wi, both turned by `side`: 0 where the rule above forbids it.
// Source of the part near the geometric horizon: Chiang, Li & Burley, Taming the Shadow Terminator, 2019: G + G^2 - G^3,
//     G = min(ng . wi / ((ns . wi) (ns . ng)), 1).
VNDF_FN VNDF_REAL vndf_impl_bsdf_passing(VNDF_REAL3 wo, VNDF_REAL3 wi, struct vndf_bsdf b, VNDF_REAL side) {
    int above = wo.z > VNDF_R(0.0) && wi.z > VNDF_R(0.0);
#if VNDF_SHADING_NORMAL
    VNDF_REAL x = side * b.ng_x, y = side * b.ng_y, z = b.ng_z;
    VNDF_REAL height_o = VNDF_FMA(wo.x, x, VNDF_FMA(wo.y, y, wo.z * z));
    // Made dependent on the other height, so that LLVM's SLP pass does not pack the two; where it is none, above is 0.
    above = above && height_o > VNDF_R(0.0);
    VNDF_REAL height_i = VNDF_FMA(wi.x, x, VNDF_FMA(wi.y, y, wi.z * z));
    above = above && height_i > VNDF_R(0.0);
#if VNDF_TERMINATOR
    VNDF_REAL most = wi.z * z;
    int fading = height_i < most;
    VNDF_REAL g = fading ? height_i / (fading ? most : VNDF_R(1.0)) : VNDF_R(1.0);
    VNDF_REAL part = g * VNDF_FMA(g, VNDF_R(1.0) - g, VNDF_R(1.0));
    return above ? part : VNDF_R(0.0);
#endif
#else
    (void)b;
    (void)side;
#endif
    return above ? VNDF_R(1.0) : VNDF_R(0.0);
}

#endif

// --- The conductor's share of a material ---

#if VNDF_CONDUCTOR

VNDF_FN VNDF_REAL2 vndf_impl_bsdf_alpha(struct vndf_bsdf b) {
#if VNDF_ANISOTROPIC
    return VNDF_MAKE2(b.alpha_x, b.alpha_y);
#else
    return VNDF_MAKE2(b.alpha_x, b.alpha_x);
#endif
}

// The cosine of wo and wi with the normal between them: half the length of wo + wi.
VNDF_FN VNDF_REAL vndf_impl_half_cosine(VNDF_REAL3 wo, VNDF_REAL3 wi) {
    VNDF_REAL x = wo.x + wi.x, y = wo.y + wi.y, z = wo.z + wi.z;
    return VNDF_R(0.5) * VNDF_SQRT(VNDF_FMA(x, x, VNDF_FMA(y, y, z * z)));
}

#if VNDF_CHOSEN(VNDF_FRESNEL, conductor) || VNDF_CHOSEN(VNDF_FRESNEL, f82)
// A parameter of the next channel, made dependent on the last one's reflectance, so that LLVM's SLP pass does not pack the alike
// formulas (impl/stretch.h); the other choice is never taken.
VNDF_FN VNDF_REAL vndf_impl_next_channel(VNDF_REAL parameter, VNDF_REAL last) {
    return last >= VNDF_R(0.0) ? parameter : VNDF_R(1.0);
}
#endif

VNDF_FN struct vndf_rgb vndf_impl_bsdf_reflectance(struct vndf_bsdf b, VNDF_REAL cosine) {
#if VNDF_CHOSEN(VNDF_FRESNEL, conductor)
    VNDF_REAL red = vndf_fresnel_conductor(cosine, b.eta.r, b.k.r);
    VNDF_REAL green = vndf_fresnel_conductor(cosine, vndf_impl_next_channel(b.eta.g, red), b.k.g);
    VNDF_REAL blue = vndf_fresnel_conductor(cosine, vndf_impl_next_channel(b.eta.b, green), b.k.b);
#elif VNDF_CHOSEN(VNDF_FRESNEL, schlick)
    VNDF_REAL red = vndf_fresnel_schlick(cosine, b.f0.r, b.f90),
              green = vndf_fresnel_schlick(cosine, b.f0.g, b.f90),
              blue = vndf_fresnel_schlick(cosine, b.f0.b, b.f90);
#elif VNDF_CHOSEN(VNDF_FRESNEL, f82)
    VNDF_REAL red = vndf_fresnel_f82(cosine, b.f0.r, b.f82.r);
    VNDF_REAL green = vndf_fresnel_f82(cosine, vndf_impl_next_channel(b.f0.g, red), b.f82.g);
    VNDF_REAL blue = vndf_fresnel_f82(cosine, vndf_impl_next_channel(b.f0.b, green), b.f82.b);
#else
    VNDF_REAL red = VNDF_R(1.0), green = VNDF_R(1.0), blue = VNDF_R(1.0);
    (void)cosine;
#endif
    struct vndf_rgb f = vndf_impl_rgb(red, green, blue);
#if VNDF_TINT
    return vndf_impl_rgb_product(f, b.tint);
#else
    (void)b;
    return f;
#endif
}

#if VNDF_CHOSEN(VNDF_ENERGY, turquin)
// The reflectance at normal incidence. last: of the other angle, on which it is made dependent, so that LLVM's SLP pass does not
// pack the two; the other choice is never taken.
VNDF_FN struct vndf_rgb vndf_impl_bsdf_upright_reflectance(struct vndf_bsdf b, VNDF_REAL last) {
#if VNDF_CHOSEN(VNDF_FRESNEL, schlick) || VNDF_CHOSEN(VNDF_FRESNEL, f82)
    struct vndf_rgb f = vndf_impl_rgb(vndf_impl_reflectance(b.f0.r), vndf_impl_reflectance(b.f0.g),
                                      vndf_impl_reflectance(b.f0.b));
    (void)last;
#if VNDF_TINT
    f = vndf_impl_rgb_product(f, b.tint);
#endif
    return f;
#else
    return vndf_impl_bsdf_reflectance(b, last >= VNDF_R(0.0) ? VNDF_R(1.0) : last);
#endif
}
#endif

// Its weight: BSDF times cos(theta_i) over its own density.
VNDF_FN struct vndf_rgb vndf_impl_bsdf_conductor_weight(struct vndf_bsdf b, struct vndf_impl_conductor c,
                                                        VNDF_REAL3 wo, VNDF_REAL3 wi) {
    struct vndf_rgb weight = vndf_impl_rgb_scaled(
        vndf_impl_bsdf_reflectance(b, vndf_impl_half_cosine(wo, wi)), vndf_impl_conductor_weight(c, wi));
#if VNDF_CHOSEN(VNDF_ENERGY, turquin)
    VNDF_REAL loss = vndf_energy_loss(wo, vndf_impl_bsdf_alpha(b));
    weight = vndf_impl_turquin(weight, vndf_impl_bsdf_upright_reflectance(b, weight.b), loss);
#endif
    return weight;
}

#if VNDF_IMPL_KULLA_CONTY

// The mean of the reflectance by the cosine law: Gauss and Jacobi's rule of four cosines, exact for schlick and f82, and within
// 7e-4 for metals of eta in [0.05, 5] and k in [0.5, 10].
VNDF_FN struct vndf_rgb vndf_impl_bsdf_average_and(struct vndf_rgb sum, struct vndf_bsdf b, VNDF_REAL cosine,
                                                   VNDF_REAL share) {
    // Dependent on the sum before, so that LLVM's SLP pass does not pack the nodes; the other choice is never taken.
    struct vndf_rgb f = vndf_impl_bsdf_reflectance(b, sum.b >= VNDF_R(0.0) ? cosine : VNDF_R(1.0));
    return vndf_impl_rgb(VNDF_FMA(share, f.r, sum.r), VNDF_FMA(share, f.g, sum.g),
                         VNDF_FMA(share, f.b, sum.b));
}
VNDF_FN struct vndf_rgb vndf_impl_bsdf_average_reflectance(struct vndf_bsdf b) {
    struct vndf_rgb sum = vndf_impl_rgb(VNDF_R(0.0), VNDF_R(0.0), VNDF_R(0.0));
    sum = vndf_impl_bsdf_average_and(sum, b, VNDF_R(0.13975986434378057), VNDF_R(0.062361941900016114));
    sum = vndf_impl_bsdf_average_and(sum, b, VNDF_R(0.41640956763108317), VNDF_R(0.259695095216465));
    sum = vndf_impl_bsdf_average_and(sum, b, VNDF_R(0.7231569863618762), VNDF_R(0.40692913602054293));
    return vndf_impl_bsdf_average_and(sum, b, VNDF_R(0.94289580388548233), VNDF_R(0.27101382686297598));
}

VNDF_FN struct vndf_impl_kulla_conty vndf_impl_bsdf_kulla_conty(struct vndf_bsdf b, VNDF_REAL3 wo) {
    VNDF_REAL2 alpha = vndf_impl_bsdf_alpha(b);
    return vndf_impl_kulla_conty_of(vndf_impl_bsdf_average_reflectance(b), vndf_energy_loss(wo, alpha),
                                    vndf_energy_average_loss(alpha));
}

#endif

#endif

// --- The mix ---

#if VNDF_CONDUCTOR && VNDF_IMPL_DIFFUSE
// The share of the conductor.
VNDF_FN VNDF_REAL vndf_impl_bsdf_conducting(struct vndf_bsdf b) {
#if VNDF_LAMBERT
    return vndf_impl_share(vndf_impl_max(b.metal, VNDF_R(0.0)));
#else
    (void)b;
    return VNDF_R(1.0);
#endif
}

// What the cosine law draws of a material seen from wo.
struct vndf_impl_bsdf_diffuse {
    VNDF_REAL mirrored, rest;  // the chance of the other lobe and of this one
#if VNDF_IMPL_KULLA_CONTY
    struct vndf_impl_kulla_conty lobe;
#endif
};
VNDF_FN struct vndf_impl_bsdf_diffuse vndf_impl_bsdf_diffuse_of(struct vndf_bsdf b, VNDF_REAL3 wo) {
    struct vndf_impl_bsdf_diffuse d;
    d.mirrored = vndf_impl_bsdf_conducting(b);
    d.rest = VNDF_R(1.0) - d.mirrored;
#if VNDF_IMPL_KULLA_CONTY
    d.lobe = vndf_impl_bsdf_kulla_conty(b, wo);
    d.rest = VNDF_FMA(d.mirrored, d.lobe.share, d.rest);
    d.mirrored *= VNDF_R(1.0) - d.lobe.share;
#else
    (void)wo;
#endif
    return d;
}

// Its weight and density from those of its parts: the weight of what the cosine law draws is `diffuse`. Where one part has no
// share those of the other, to the bit.
VNDF_FN struct vndf_rgb vndf_impl_bsdf_mixed(struct vndf_impl_bsdf_diffuse d, struct vndf_rgb diffuse,
                                             struct vndf_rgb weight, VNDF_REAL conductor_pdf,
                                             VNDF_REAL diffuse_pdf) {
    VNDF_REAL own = d.mirrored * conductor_pdf, other = d.rest * diffuse_pdf, sum = own + other;
    // The smaller share by a quotient, the larger as what is left: both keep their digits, and 0 leaves 1. Where rounding
    // has left nothing of either density it is the conductor's.
    int less = other <= own;
    VNDF_REAL lesser = (less ? other : own) / (sum > VNDF_R(0.0) ? sum : VNDF_R(1.0)),
              greater = VNDF_R(1.0) - lesser;
    VNDF_REAL share = less ? lesser : greater, rest = less ? greater : lesser;
    return vndf_impl_rgb(VNDF_FMA(share, diffuse.r, rest * weight.r),
                         VNDF_FMA(share, diffuse.g, rest * weight.g),
                         VNDF_FMA(share, diffuse.b, rest * weight.b));
}
VNDF_FN VNDF_REAL vndf_impl_bsdf_mixed_pdf(struct vndf_impl_bsdf_diffuse d, VNDF_REAL conductor_pdf,
                                           VNDF_REAL diffuse_pdf) {
    return VNDF_FMA(d.mirrored, conductor_pdf, d.rest * diffuse_pdf);
}

// The weight of the mix at wi from that of the conductor's mirrored lobe.
VNDF_FN struct vndf_rgb vndf_impl_bsdf_mixed_weight(struct vndf_bsdf b, struct vndf_impl_bsdf_diffuse d,
                                                    VNDF_REAL3 wi, struct vndf_rgb weight,
                                                    VNDF_REAL conductor_pdf, VNDF_REAL diffuse_pdf) {
#if VNDF_LAMBERT
    struct vndf_rgb diffuse = b.albedo;
#else
    struct vndf_rgb diffuse = vndf_impl_rgb(VNDF_R(0.0), VNDF_R(0.0), VNDF_R(0.0));
#endif
#if VNDF_IMPL_KULLA_CONTY
    // Of both parts' light that of one draw: less often drawn, heavier.
    VNDF_REAL conductor = vndf_impl_bsdf_conducting(b), other = VNDF_R(1.0) - conductor;
    // Made dependent on the look-up of wo, so that LLVM's SLP pass does not pack the two; the other choice is never taken.
    VNDF_REAL z = d.lobe.share >= VNDF_R(0.0) ? wi.z : VNDF_R(1.0);
    VNDF_REAL loss = conductor * vndf_energy_loss(VNDF_MAKE3(wi.x, wi.y, z), vndf_impl_bsdf_alpha(b)),
              rcp = VNDF_R(1.0) / (d.rest > VNDF_R(0.0) ? d.rest : VNDF_R(1.0));
    diffuse = vndf_impl_rgb(rcp * VNDF_FMA(loss, d.lobe.scale.r, other * diffuse.r),
                            rcp * VNDF_FMA(loss, d.lobe.scale.g, other * diffuse.g),
                            rcp * VNDF_FMA(loss, d.lobe.scale.b, other * diffuse.b));
    // Dependent on the quotient above, for the same reason.
    VNDF_REAL often = VNDF_R(1.0) - d.lobe.share, divisor = often > VNDF_R(0.0) ? often : VNDF_R(1.0);
    weight = vndf_impl_rgb_scaled(weight, VNDF_R(1.0) / (rcp >= VNDF_R(0.0) ? divisor : VNDF_R(1.0)));
#else
    (void)b;
    (void)wi;
#endif
    return vndf_impl_bsdf_mixed(d, diffuse, weight, conductor_pdf, diffuse_pdf);
}
#endif

// The BSDF times |cos(theta_i)|, and the density of vndf_bsdf_sample.
// Source: Walter et al. 2007, Equation 20, with the terms of bsdf_conductor.h; Lambert's albedo / pi.
// wo, wi: unit vectors, local frame, anywhere on the sphere.
// return: f for each channel, pdf per steradian of wi: over the whole sphere, also where f is 0 because the surface lies between.
// Accuracy: 24 eps; double 24.
//     Of pdf; of f as vndf_bsdf_eval. Below alpha = 1e-2 the rounding of wi moves both by more than that, and equally.
VNDF_FN struct vndf_bsdf_value vndf_bsdf_eval_pdf(VNDF_REAL3 wo, VNDF_REAL3 wi, struct vndf_bsdf bsdf) {
    struct vndf_bsdf_value value;
    VNDF_REAL side = vndf_impl_bsdf_side(wo, bsdf);
    VNDF_REAL3 o = VNDF_MAKE3(wo.x, wo.y, side * wo.z), i = VNDF_MAKE3(wi.x, wi.y, side * wi.z);
#if VNDF_CONDUCTOR
    struct vndf_impl_conductor c = vndf_impl_conductor_of(o, vndf_impl_bsdf_alpha(bsdf));
    struct vndf_rgb weight = vndf_impl_bsdf_conductor_weight(bsdf, c, o, i);
    value.pdf = vndf_impl_conductor_pdf(c, i);
#if VNDF_IMPL_DIFFUSE
    struct vndf_impl_bsdf_diffuse diffuse = vndf_impl_bsdf_diffuse_of(bsdf, o);
    VNDF_REAL diffuse_pdf = vndf_lambert_pdf_wi(i);
    weight = vndf_impl_bsdf_mixed_weight(bsdf, diffuse, i, weight, value.pdf, diffuse_pdf);
    value.pdf = vndf_impl_bsdf_mixed_pdf(diffuse, value.pdf, diffuse_pdf);
#endif
#else
    struct vndf_rgb weight = bsdf.albedo;
    value.pdf = vndf_lambert_pdf_wi(i);
#endif
#if VNDF_IMPL_SIDES
    weight = vndf_impl_rgb_scaled(weight, vndf_impl_bsdf_passing(o, i, bsdf, side));
#endif
    value.f = vndf_impl_rgb_scaled(weight, value.pdf);
    return value;
}

// The BSDF times |cos(theta_i)| alone.
// Accuracy: 16 eps; double 16.
//     Over 1 + the condition numbers of the reflectance in its arguments and of the height above the geometric horizon; with
//     Beckmann times 1 + 2 q.
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
// Source: the samplers of bsdf_conductor.h and bsdf_lambert.h, combined by one-sample multiple importance sampling.
// wo: unit vector, local frame, anywhere on the sphere.
// u: for the lobe's sampler, with its meaning. Each effect has random numbers of its own: none changes by one that is
//     switched off.
// u_lobe: which lobe, the conductor for u_lobe < metal (kulla_conty: less its diffuse share); of no effect where there is one
//     lobe.
// return: the direction, anywhere on the sphere, with weight 0 where nothing is reflected; its density from the sampler's own
//     terms where it is the conductor's.
// Accuracy: 2 eps; double 2.
//     Of the weight, over max(1, weight), against f / pdf of vndf_bsdf_eval_pdf at wi. In a mix the weight follows that density
//     even where the rounding of wi has left nothing of it (Beckmann, alpha below 1e-6): what the conductor reflects is then lost.
VNDF_FN struct vndf_bsdf_direction vndf_bsdf_sample(VNDF_REAL3 wo, struct vndf_bsdf bsdf, VNDF_REAL2 u,
                                                    VNDF_REAL u_lobe) {
    struct vndf_bsdf_direction d;
    VNDF_REAL side = vndf_impl_bsdf_side(wo, bsdf);
    VNDF_REAL3 o = VNDF_MAKE3(wo.x, wo.y, side * wo.z);
    (void)u_lobe;
#if VNDF_IMPL_DIFFUSE
    struct vndf_impl_sample s = vndf_impl_lambert(u);
    d.lobe = VNDF_BSDF_LAMBERT;
#endif
#if VNDF_CONDUCTOR
    struct vndf_impl_conductor c = vndf_impl_conductor_of(o, vndf_impl_bsdf_alpha(bsdf));
    struct vndf_impl_sample mirrored = vndf_impl_conductor_sample(c, u);
#if VNDF_IMPL_DIFFUSE
    // The end of u_lobe may be 1.
    struct vndf_impl_bsdf_diffuse diffuse = vndf_impl_bsdf_diffuse_of(bsdf, o);
    int conductor = u_lobe < diffuse.mirrored || diffuse.mirrored >= VNDF_R(1.0);
    s.x = conductor ? mirrored.x : s.x;
    s.y = conductor ? mirrored.y : s.y;
    s.z = conductor ? mirrored.z : s.z;
    d.lobe = conductor ? VNDF_BSDF_CONDUCTOR : VNDF_BSDF_LAMBERT;
#else
    struct vndf_impl_sample s = mirrored;
    d.lobe = VNDF_BSDF_CONDUCTOR;
#endif
    VNDF_REAL3 i = VNDF_MAKE3(s.x, s.y, s.z);
    struct vndf_rgb weight = vndf_impl_bsdf_conductor_weight(bsdf, c, o, i);
#if VNDF_IMPL_DIFFUSE
    // The weight from the density at wi as rounded, as in vndf_bsdf_eval_pdf.
    VNDF_REAL conductor_pdf = vndf_impl_conductor_pdf(c, i), diffuse_pdf = vndf_lambert_pdf_wi(i);
    weight = vndf_impl_bsdf_mixed_weight(bsdf, diffuse, i, weight, conductor_pdf, diffuse_pdf);
    s.pdf = vndf_impl_bsdf_mixed_pdf(diffuse, conductor ? mirrored.pdf : conductor_pdf, diffuse_pdf);
#endif
#else
    VNDF_REAL3 i = VNDF_MAKE3(s.x, s.y, s.z);
    struct vndf_rgb weight = bsdf.albedo;
#endif
#if VNDF_IMPL_SIDES
    weight = vndf_impl_rgb_scaled(weight, vndf_impl_bsdf_passing(o, i, bsdf, side));
#endif
    d.weight = weight;
    d.pdf = s.pdf;
    d.wi_x = s.x;
    d.wi_y = s.y;
    d.wi_z = side * s.z;
    return d;
}

#undef VNDF_IMPL_SIDES
#undef VNDF_IMPL_DIFFUSE
#undef VNDF_IMPL_KULLA_CONTY

VNDF_END

#endif
