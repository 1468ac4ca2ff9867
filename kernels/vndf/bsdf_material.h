// The parameters of a material (bsdf.h), the sides of its surface, and its reflectance.
#ifndef VNDF_BSDF_MATERIAL_H
#define VNDF_BSDF_MATERIAL_H

#include "effects.h"
#include "fresnel.h"
#include "impl/range.h"

VNDF_BEGIN

// What has facets under a coat, and with it; and what is drawn by the cosine law: Lambert's reflection, Kulla and Conty's, or both at once.
#define VNDF_IMPL_SPECULAR (VNDF_CONDUCTOR || VNDF_DIELECTRIC)
#define VNDF_IMPL_FACETS (VNDF_IMPL_SPECULAR || VNDF_COAT)
#define VNDF_IMPL_KULLA_CONTY (VNDF_CONDUCTOR && VNDF_CHOSEN(VNDF_ENERGY, kulla_conty))
#define VNDF_IMPL_DIFFUSE (VNDF_LAMBERT || VNDF_IMPL_KULLA_CONTY)
// What gives a dielectric energy back.
#define VNDF_IMPL_GLASS_ENERGY (VNDF_DIELECTRIC && VNDF_CHOSEN(VNDF_ENERGY, turquin))

// A material at a point. Every member of a reflectance is in [0, 1].
struct vndf_bsdf {
#if VNDF_IMPL_SPECULAR
    // alpha as everywhere in the library, in [1e-8, 1e3]; alpha_x stands for both without VNDF_ANISOTROPIC.
    VNDF_REAL alpha_x;
#if VNDF_ANISOTROPIC
    VNDF_REAL alpha_y;
#endif
#endif
#if VNDF_CONDUCTOR
    // conductor: eta, k for each channel, over the index outside. schlick: f0 for each channel, f90. f82: f0 and the tint at 82
    // degrees for each channel.
    VNDF_IMPL_FRESNEL_MEMBERS
#if VNDF_TINT
    struct vndf_rgb tint;  // a factor on the whole conductor
#endif
#endif
#if VNDF_LAMBERT
    struct vndf_rgb albedo;
#if VNDF_ROUGH_DIFFUSE
    VNDF_REAL diffuse_roughness;  // of Lambert's surface, in [0, 1]; 0: Lambert's law
#endif
#endif
#if VNDF_CONDUCTOR && (VNDF_LAMBERT || VNDF_DIELECTRIC)
    VNDF_REAL metal;  // the share of the conductor, and the probability that it is sampled
#endif
#if VNDF_DIELECTRIC
    // The index of refraction behind the surface over that in front, in [1e-3, 1e3]; 1: no interface.
    VNDF_REAL ior;
#if VNDF_LAMBERT
    VNDF_REAL transmission;  // the share that goes through of the light that gets in; 1 without VNDF_LAMBERT
#endif
#if VNDF_TINT
    struct vndf_rgb transmittance;  // a factor on what goes through
#endif
#if VNDF_SPECULAR
    // How strong the interface reflects, in [0, 1], and a factor >= 0 on its reflectance at normal incidence for each channel
    // (bsdf_gloss.h).
    VNDF_REAL specular;
    struct vndf_rgb specular_colour;
#endif
#if VNDF_THIN_WALLED
    int thin_walled;  // not 0: what transmits is a wall without thickness and bounds no body
#endif
#if VNDF_DISPERSION
    VNDF_REAL dispersion;  // 20 over Abbe's number (medium.h); 0: one index for all light
    int channel;           // whose index counts: 0, red, 1, green, or 2, blue
#endif
#if VNDF_ABSORPTION
    struct vndf_rgb absorption;  // what the body behind absorbs in a unit of length, >= 0
#endif
#endif
#if VNDF_COAT
    VNDF_REAL coat,
        coat_alpha;  // how much of a coat of index 1.5 there is, in [0, 1], and its alpha, in [1e-8, 1]
#endif
#if VNDF_SHADING_NORMAL
    VNDF_REAL ng_x, ng_y,
        ng_z;  // the geometric normal, a unit vector in the local frame; (0, 0, 1): no other than the shading one
#endif
};

// What vndf_bsdf_sample tells of the lobe that it drew from.
#define VNDF_BSDF_CONDUCTOR 0
#define VNDF_BSDF_LAMBERT 1     // by the cosine law: Lambert's, and of VNDF_ENERGY kulla_conty
#define VNDF_BSDF_REFLECTION 2  // of the dielectric
#define VNDF_BSDF_TRANSMISSION 3
#define VNDF_BSDF_COAT 4

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

// The geometric normal on that side, where there is one of its own.
VNDF_FN VNDF_REAL3 vndf_impl_bsdf_ng(VNDF_REAL side, struct vndf_bsdf b) {
#if VNDF_SHADING_NORMAL
    return VNDF_MAKE3(side * b.ng_x, side * b.ng_y, b.ng_z);
#else
    (void)side;
    (void)b;
    return VNDF_MAKE3(VNDF_R(0.0), VNDF_R(0.0), VNDF_R(1.0));
#endif
}

// --- Microfacets ---

#if VNDF_IMPL_SPECULAR

VNDF_FN VNDF_REAL2 vndf_impl_bsdf_alpha(struct vndf_bsdf b) {
#if VNDF_ANISOTROPIC
    return VNDF_MAKE2(b.alpha_x, b.alpha_y);
#else
    return VNDF_MAKE2(b.alpha_x, b.alpha_x);
#endif
}

#endif

// The share of the conductor.
VNDF_FN VNDF_REAL vndf_impl_bsdf_metal(struct vndf_bsdf b) {
#if VNDF_CONDUCTOR && (VNDF_LAMBERT || VNDF_DIELECTRIC)
    return vndf_impl_share(vndf_impl_max(b.metal, VNDF_R(0.0)));
#else
    (void)b;
    return VNDF_CONDUCTOR ? VNDF_R(1.0) : VNDF_R(0.0);
#endif
}

#if VNDF_DIELECTRIC
// The part that goes through of what gets in.
VNDF_FN VNDF_REAL vndf_impl_bsdf_transmission(struct vndf_bsdf b) {
#if VNDF_LAMBERT
    return vndf_impl_share(vndf_impl_max(b.transmission, VNDF_R(0.0)));
#else
    (void)b;
    return VNDF_R(1.0);
#endif
}
#endif

// The geometric normal that facets are drawn by. What goes straight through a wall is a reflection turned to the other side, and there
// is judged by its opposite: other directions than reflections above ng.
VNDF_FN VNDF_REAL3 vndf_impl_bsdf_facets_ng(VNDF_REAL3 ng, struct vndf_bsdf b) {
#if VNDF_DIELECTRIC && VNDF_THIN_WALLED
    int thin = b.thin_walled && vndf_impl_bsdf_transmission(b) > VNDF_R(0.0) &&
               vndf_impl_bsdf_metal(b) < VNDF_R(1.0);
    return VNDF_MAKE3(thin ? VNDF_R(0.0) : ng.x, thin ? VNDF_R(0.0) : ng.y, thin ? VNDF_R(1.0) : ng.z);
#else
    (void)b;
    return ng;
#endif
}

#if VNDF_IMPL_FACETS
// The cosine of wo and wi with the normal between them: half the length of wo + wi.
VNDF_FN VNDF_REAL vndf_impl_half_cosine(VNDF_REAL3 wo, VNDF_REAL3 wi) {
    VNDF_REAL x = wo.x + wi.x, y = wo.y + wi.y, z = wo.z + wi.z;
    return VNDF_R(0.5) * VNDF_SQRT(VNDF_FMA(x, x, VNDF_FMA(y, y, z * z)));
}
#endif

#if VNDF_CONDUCTOR

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

#endif

VNDF_END

#endif
