// A material: a rough conductor, a rough dielectric, what lies under it: another medium or Lambert's diffuse reflection; or a
// mix; with the effects of effects.h alone.
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

#if (VNDF_CONDUCTOR || VNDF_DIELECTRIC) && VNDF_IMPL_DIFFUSE
// Its weight and density from those of its parts. Where one part has the whole share those of that part, to the bit.
VNDF_FN struct vndf_rgb vndf_impl_bsdf_mixed(struct vndf_impl_specular s, VNDF_REAL specular_pdf,
                                             struct vndf_impl_diffuse d, VNDF_REAL lambert_pdf) {
    VNDF_REAL own = s.share * specular_pdf, other = d.share * lambert_pdf, sum = own + other;
    // The smaller share by a quotient, the larger as what is left: both keep their digits, and 0 leaves 1. Where rounding
    // has left nothing of either density it is the specular one's.
    int less = other <= own;
    VNDF_REAL lesser = (less ? other : own) / (sum > VNDF_R(0.0) ? sum : VNDF_R(1.0)),
              greater = VNDF_R(1.0) - lesser;
    VNDF_REAL share = less ? lesser : greater, rest = less ? greater : lesser;
    return vndf_impl_rgb(VNDF_FMA(share, d.weight.r, rest * s.weight.r),
                         VNDF_FMA(share, d.weight.g, rest * s.weight.g),
                         VNDF_FMA(share, d.weight.b, rest * s.weight.b));
}
VNDF_FN VNDF_REAL vndf_impl_bsdf_mixed_pdf(struct vndf_impl_specular s, VNDF_REAL specular_pdf,
                                           struct vndf_impl_diffuse d, VNDF_REAL lambert_pdf) {
    return VNDF_FMA(s.share, specular_pdf, d.share * lambert_pdf);
}
#endif

// The BSDF times |cos(theta_i)|, and the density of vndf_bsdf_sample.
// Source: Walter et al. 2007, Equations 20 and 21, with the terms of bsdf_facets.h and bsdf_dielectric.h; Lambert's albedo / pi.
// wo, wi: unit vectors, local frame, anywhere on the sphere.
// return: f for each channel, pdf per steradian of wi: over the whole sphere, also where f is 0 because the surface lies
//     between; of a material that transmits, of the lobes that light wi's side alone. Both are 0 of a refraction with ior = 1.
// Accuracy: 24 eps; double 24.
//     Of pdf; of f as vndf_bsdf_eval. Below alpha = 1e-2 the rounding of wi moves both by more than that, and equally.
VNDF_FN struct vndf_bsdf_value vndf_bsdf_eval_pdf(VNDF_REAL3 wo, VNDF_REAL3 wi, struct vndf_bsdf bsdf) {
    struct vndf_bsdf_value value;
    VNDF_REAL side = vndf_impl_bsdf_side(wo, bsdf);
    VNDF_REAL3 o = VNDF_MAKE3(wo.x, wo.y, side * wo.z), i = VNDF_MAKE3(wi.x, wi.y, side * wi.z);
#if VNDF_CONDUCTOR || VNDF_DIELECTRIC
    struct vndf_impl_facets c = vndf_impl_facets_of(o, vndf_impl_bsdf_alpha(bsdf));
#if VNDF_DIELECTRIC
    struct vndf_impl_interface n = vndf_impl_interface_of(o, bsdf, side);
    struct vndf_impl_specular s = vndf_impl_bsdf_specular(bsdf, c, n, o, i);
#else
    struct vndf_impl_specular s = vndf_impl_bsdf_specular(bsdf, c, o, i);
#endif
#if VNDF_IMPL_KULLA_CONTY
    struct vndf_impl_kulla_conty m = vndf_impl_bsdf_kulla_conty(bsdf, o);
    s = vndf_impl_bsdf_beside(s, m);
#endif
    struct vndf_rgb weight = s.weight;
    value.pdf = vndf_impl_bsdf_specular_pdf(c, s, i);
#endif
#if VNDF_IMPL_DIFFUSE
    VNDF_REAL lambert_pdf = vndf_lambert_pdf_wi(i);
#if VNDF_DIELECTRIC
    struct vndf_impl_diffuse d = vndf_impl_bsdf_diffuse(bsdf, n, o, i);
#elif VNDF_IMPL_KULLA_CONTY
    struct vndf_impl_diffuse d = vndf_impl_bsdf_diffuse(bsdf, m, i);
#else
    struct vndf_impl_diffuse d = vndf_impl_bsdf_diffuse(bsdf);
#endif
#if VNDF_CONDUCTOR || VNDF_DIELECTRIC
    weight = vndf_impl_bsdf_mixed(s, value.pdf, d, lambert_pdf);
    value.pdf = vndf_impl_bsdf_mixed_pdf(s, value.pdf, d, lambert_pdf);
#else
    struct vndf_rgb weight = d.weight;
    value.pdf = lambert_pdf;
#endif
#elif VNDF_DIELECTRIC
    value.pdf *= s.share;
#endif
#if VNDF_DIELECTRIC
    VNDF_REAL3 onward = vndf_impl_bsdf_onward(i, s.facet.crosses);
    weight = vndf_impl_rgb_scaled(weight, vndf_impl_bsdf_passing(o, onward, bsdf, side));
#elif VNDF_IMPL_SIDES
    weight = vndf_impl_rgb_scaled(weight, vndf_impl_bsdf_passing(o, i, bsdf, side));
#endif
    value.f = vndf_impl_rgb_scaled(weight, value.pdf);
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
//     Lambert; of no effect where there is one lobe.
// return: the direction, anywhere on the sphere, with weight 0 where nothing goes; its density from the sampler's own terms
//     where it is specular. With ior = 1 what is transmitted goes straight on, with the largest finite density.
// Accuracy: 2 eps; double 2.
//     Of the weight, over max(1, weight), against f / pdf of vndf_bsdf_eval_pdf at wi. In a mix the weight follows that density
//     even where the rounding of wi has left nothing of it (Beckmann, alpha below 1e-6): what the conductor reflects is then lost.
VNDF_FN struct vndf_bsdf_direction vndf_bsdf_sample(VNDF_REAL3 wo, struct vndf_bsdf bsdf, VNDF_REAL2 u,
                                                    VNDF_REAL u_lobe) {
    struct vndf_bsdf_direction d;
    VNDF_REAL side = vndf_impl_bsdf_side(wo, bsdf);
    VNDF_REAL3 o = VNDF_MAKE3(wo.x, wo.y, side * wo.z);
    (void)u_lobe;
#if VNDF_CONDUCTOR || VNDF_DIELECTRIC
    struct vndf_impl_facets c = vndf_impl_facets_of(o, vndf_impl_bsdf_alpha(bsdf));
#if VNDF_DIELECTRIC
    struct vndf_impl_interface n = vndf_impl_interface_of(o, bsdf, side);
    struct vndf_impl_drawn drawn = vndf_impl_bsdf_drawn(bsdf, c, n, o, u, u_lobe);
#else
    VNDF_REAL share = vndf_impl_bsdf_metal(bsdf);
#if VNDF_IMPL_KULLA_CONTY
    struct vndf_impl_kulla_conty m = vndf_impl_bsdf_kulla_conty(bsdf, o);
    share *= VNDF_R(1.0) - m.share;
#endif
    struct vndf_impl_drawn drawn = vndf_impl_bsdf_drawn(c, u, share, u_lobe);
#endif
#endif
#if VNDF_IMPL_DIFFUSE
    struct vndf_impl_sample w = vndf_impl_lambert(u);
    d.lobe = VNDF_BSDF_LAMBERT;
#if VNDF_CONDUCTOR || VNDF_DIELECTRIC
    int specular = drawn.lobe != VNDF_BSDF_LAMBERT;
    w.x = specular ? drawn.w.x : w.x;
    w.y = specular ? drawn.w.y : w.y;
    w.z = specular ? drawn.w.z : w.z;
    d.lobe = drawn.lobe;
#endif
#else
    struct vndf_impl_sample w = drawn.w;
    d.lobe = drawn.lobe;
#endif
    VNDF_REAL3 i = VNDF_MAKE3(w.x, w.y, w.z);
#if VNDF_DIELECTRIC
    struct vndf_impl_specular s = vndf_impl_bsdf_specular(bsdf, c, n, o, i);
#elif VNDF_CONDUCTOR
    struct vndf_impl_specular s = vndf_impl_bsdf_specular(bsdf, c, o, i);
#endif
#if VNDF_IMPL_KULLA_CONTY
    s = vndf_impl_bsdf_beside(s, m);
#endif
#if VNDF_CONDUCTOR || VNDF_DIELECTRIC
    struct vndf_rgb weight = s.weight;
#endif
#if VNDF_IMPL_DIFFUSE
#if VNDF_DIELECTRIC
    struct vndf_impl_diffuse diffuse = vndf_impl_bsdf_diffuse(bsdf, n, o, i);
#elif VNDF_IMPL_KULLA_CONTY
    struct vndf_impl_diffuse diffuse = vndf_impl_bsdf_diffuse(bsdf, m, i);
#else
    struct vndf_impl_diffuse diffuse = vndf_impl_bsdf_diffuse(bsdf);
#endif
#if VNDF_CONDUCTOR || VNDF_DIELECTRIC
    // The weight from the density at wi as rounded, as in vndf_bsdf_eval_pdf. Below the surface nothing is diffuse.
    VNDF_REAL lambert_pdf = vndf_lambert_pdf_wi(i);
    // Made dependent on the density of the sample, so that LLVM's SLP pass does not pack the two (impl/stretch.h); the other
    // choice is never taken.
    VNDF_REAL3 known = VNDF_MAKE3(i.x, i.y, drawn.w.pdf < VNDF_R(0.0) ? VNDF_R(1.0) : i.z);
    VNDF_REAL specular_pdf = vndf_impl_facets_pdf(c, known);
    weight = vndf_impl_bsdf_mixed(s, specular_pdf, diffuse, lambert_pdf);
    w.pdf = vndf_impl_bsdf_mixed_pdf(s, specular ? drawn.w.pdf : specular_pdf, diffuse, lambert_pdf);
#else
    struct vndf_rgb weight = diffuse.weight;
#endif
#elif VNDF_DIELECTRIC
    w.pdf *= s.share;
#endif
#if VNDF_DIELECTRIC
    VNDF_REAL3 onward = vndf_impl_bsdf_onward(i, d.lobe == VNDF_BSDF_TRANSMISSION);
    weight = vndf_impl_rgb_scaled(weight, vndf_impl_bsdf_passing(o, onward, bsdf, side));
#elif VNDF_IMPL_SIDES
    weight = vndf_impl_rgb_scaled(weight, vndf_impl_bsdf_passing(o, i, bsdf, side));
#endif
#if VNDF_DIELECTRIC
    // A reflection below the surface, where refractions count alone; a refraction above it, or one that is none.
    int through = d.lobe == VNDF_BSDF_TRANSMISSION;
    int lost = n.transmits && (s.facet.crosses != through || (through && !(drawn.w.pdf > VNDF_R(0.0))));
    weight = vndf_impl_rgb_scaled(weight, lost ? VNDF_R(0.0) : VNDF_R(1.0));
    w.pdf = lost ? VNDF_R(0.0) : w.pdf;
#endif
    d.weight = weight;
    d.pdf = w.pdf;
    d.wi_x = w.x;
    d.wi_y = w.y;
    d.wi_z = side * w.z;
    return d;
}

#undef VNDF_IMPL_SIDES
#undef VNDF_IMPL_DIFFUSE
#undef VNDF_IMPL_KULLA_CONTY

VNDF_END

#endif
