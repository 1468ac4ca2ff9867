// Entry points of a material (bsdf.h), with the choices and effects that the program is built with: arrays in, arrays out. The
// arrays are the same whatever is switched off; those of a parameter that is not in the program are not read.
//
//   vndf_batch_bsdf_eval_pdf   wo, wi, the material -> f for each channel, pdf
//   vndf_batch_bsdf_transmittance   distance, the material -> what is left of each channel
//   vndf_batch_bsdf_sample     wo, u1, u2, u_lobe, the material -> wi, the weight for each channel, pdf, the lobe
#include "../vndf/bsdf.h"
#include "bsdf_parameters.h"

#define VNDF_BSDF_IN(v) __global const VNDF_REAL *restrict in_##v,
#define VNDF_BSDF_OUT(v) __global VNDF_REAL *restrict out_##v,
#define VNDF_BSDF_LOAD_RGB(member, c) \
    b.member.r = in_##c##_r[i];       \
    b.member.g = in_##c##_g[i];       \
    b.member.b = in_##c##_b[i];
#define VNDF_BSDF_STORE_RGB(c, value) \
    out_##c##_r[i] = value.r;         \
    out_##c##_g[i] = value.g;         \
    out_##c##_b[i] = value.b;

// The effects' members, each where it exists.
#if VNDF_CONDUCTOR || VNDF_DIELECTRIC
#define VNDF_BSDF_LOAD_ALPHA_X b.alpha_x = in_alpha_x[i];
#else
#define VNDF_BSDF_LOAD_ALPHA_X
#endif
#if VNDF_CONDUCTOR
#if VNDF_CHOSEN(VNDF_FRESNEL, conductor)
#define VNDF_BSDF_LOAD_FRESNEL VNDF_BSDF_LOAD_RGB(eta, first) VNDF_BSDF_LOAD_RGB(k, second)
#elif VNDF_CHOSEN(VNDF_FRESNEL, schlick)
#define VNDF_BSDF_LOAD_FRESNEL VNDF_BSDF_LOAD_RGB(f0, first) b.f90 = in_second_r[i];
#elif VNDF_CHOSEN(VNDF_FRESNEL, f82)
#define VNDF_BSDF_LOAD_FRESNEL VNDF_BSDF_LOAD_RGB(f0, first) VNDF_BSDF_LOAD_RGB(f82, second)
#else
#define VNDF_BSDF_LOAD_FRESNEL
#endif
#else
#define VNDF_BSDF_LOAD_FRESNEL
#endif
#if (VNDF_CONDUCTOR || VNDF_DIELECTRIC) && VNDF_ANISOTROPIC
#define VNDF_BSDF_LOAD_ALPHA_Y b.alpha_y = in_alpha_y[i];
#else
#define VNDF_BSDF_LOAD_ALPHA_Y
#endif
#if VNDF_CONDUCTOR && VNDF_TINT
#define VNDF_BSDF_LOAD_TINT VNDF_BSDF_LOAD_RGB(tint, tint)
#else
#define VNDF_BSDF_LOAD_TINT
#endif
#if VNDF_DIELECTRIC && VNDF_TINT
#define VNDF_BSDF_LOAD_TRANSMITTANCE VNDF_BSDF_LOAD_RGB(transmittance, transmittance)
#else
#define VNDF_BSDF_LOAD_TRANSMITTANCE
#endif
#if VNDF_DIELECTRIC && VNDF_SPECULAR
#define VNDF_BSDF_LOAD_SPECULAR  \
    b.specular = in_specular[i]; \
    VNDF_BSDF_LOAD_RGB(specular_colour, specular_colour)
#else
#define VNDF_BSDF_LOAD_SPECULAR
#endif
#if VNDF_DIELECTRIC && VNDF_THIN_WALLED
#define VNDF_BSDF_LOAD_THIN_WALLED b.thin_walled = in_thin_walled[i] != VNDF_R(0.0);
#else
#define VNDF_BSDF_LOAD_THIN_WALLED
#endif
#if VNDF_DIELECTRIC && VNDF_DISPERSION
#define VNDF_BSDF_LOAD_DISPERSION    \
    b.dispersion = in_dispersion[i]; \
    b.channel = (int)in_channel[i];
#else
#define VNDF_BSDF_LOAD_DISPERSION
#endif
#if VNDF_DIELECTRIC && VNDF_ABSORPTION
#define VNDF_BSDF_LOAD_ABSORPTION VNDF_BSDF_LOAD_RGB(absorption, absorption)
#else
#define VNDF_BSDF_LOAD_ABSORPTION
#endif
#if VNDF_LAMBERT
#define VNDF_BSDF_LOAD_ALBEDO VNDF_BSDF_LOAD_RGB(albedo, albedo)
#else
#define VNDF_BSDF_LOAD_ALBEDO
#endif
#if VNDF_CONDUCTOR && (VNDF_LAMBERT || VNDF_DIELECTRIC)
#define VNDF_BSDF_LOAD_METAL b.metal = in_metal[i];
#else
#define VNDF_BSDF_LOAD_METAL
#endif
#if VNDF_DIELECTRIC && VNDF_LAMBERT
#define VNDF_BSDF_LOAD_IOR \
    b.ior = in_ior[i];     \
    b.transmission = in_transmission[i];
#elif VNDF_DIELECTRIC
#define VNDF_BSDF_LOAD_IOR b.ior = in_ior[i];
#else
#define VNDF_BSDF_LOAD_IOR
#endif
#if VNDF_LAMBERT && VNDF_ROUGH_DIFFUSE
#define VNDF_BSDF_LOAD_ROUGHNESS b.diffuse_roughness = in_diffuse_roughness[i];
#else
#define VNDF_BSDF_LOAD_ROUGHNESS
#endif
#if VNDF_COAT
#define VNDF_BSDF_LOAD_COAT \
    b.coat = in_coat[i];    \
    b.coat_alpha = in_coat_alpha[i];
#else
#define VNDF_BSDF_LOAD_COAT
#endif
#if VNDF_SHADING_NORMAL
#define VNDF_BSDF_LOAD_NG \
    b.ng_x = in_ng_x[i];  \
    b.ng_y = in_ng_y[i];  \
    b.ng_z = in_ng_z[i];
#else
#define VNDF_BSDF_LOAD_NG
#endif
#define VNDF_BSDF_LOAD                                                                             \
    VNDF_BSDF_LOAD_ALPHA_X VNDF_BSDF_LOAD_ALPHA_Y VNDF_BSDF_LOAD_FRESNEL VNDF_BSDF_LOAD_TINT       \
        VNDF_BSDF_LOAD_ALBEDO VNDF_BSDF_LOAD_TRANSMITTANCE VNDF_BSDF_LOAD_METAL VNDF_BSDF_LOAD_IOR \
            VNDF_BSDF_LOAD_SPECULAR VNDF_BSDF_LOAD_THIN_WALLED VNDF_BSDF_LOAD_DISPERSION           \
                VNDF_BSDF_LOAD_ABSORPTION VNDF_BSDF_LOAD_ROUGHNESS VNDF_BSDF_LOAD_COAT VNDF_BSDF_LOAD_NG

// The item of a work-item; bench goes through few groups of them again and again, which stay in cache.
#ifdef VNDF_BSDF_GROUPS
#define VNDF_BSDF_ITEM ((get_group_id(0) % VNDF_BSDF_GROUPS) * get_local_size(0) + get_local_id(0))
#else
#define VNDF_BSDF_ITEM get_global_id(0)
#endif

__kernel void vndf_batch_bsdf_eval_pdf(VNDF_BSDF_XYZ(VNDF_BSDF_IN, wo) VNDF_BSDF_XYZ(VNDF_BSDF_IN, wi)
                                           VNDF_BSDF_PARAMETERS(VNDF_BSDF_IN) VNDF_BSDF_RGB(VNDF_BSDF_OUT, f)
                                               __global VNDF_REAL* restrict out_pdf) {
    const size_t i = VNDF_BSDF_ITEM;
    struct vndf_bsdf b;
    VNDF_BSDF_LOAD
    const struct vndf_bsdf_value value = vndf_bsdf_eval_pdf(
        VNDF_MAKE3(in_wo_x[i], in_wo_y[i], in_wo_z[i]), VNDF_MAKE3(in_wi_x[i], in_wi_y[i], in_wi_z[i]), b);
    VNDF_BSDF_STORE_RGB(f, value.f)
    out_pdf[i] = value.pdf;
}

__kernel void vndf_batch_bsdf_transmittance(VNDF_BSDF_IN(distance) VNDF_BSDF_PARAMETERS(VNDF_BSDF_IN)
                                                __global VNDF_REAL* restrict out_r,
                                            __global VNDF_REAL* restrict out_g,
                                            __global VNDF_REAL* restrict out_b) {
    const size_t i = VNDF_BSDF_ITEM;
    struct vndf_bsdf b;
    VNDF_BSDF_LOAD
    const struct vndf_rgb left = vndf_bsdf_transmittance(b, in_distance[i]);
    out_r[i] = left.r;
    out_g[i] = left.g;
    out_b[i] = left.b;
}

__kernel void vndf_batch_bsdf_sample(VNDF_BSDF_XYZ(VNDF_BSDF_IN, wo) VNDF_BSDF_IN(u1) VNDF_BSDF_IN(u2)
                                         VNDF_BSDF_IN(u_lobe) VNDF_BSDF_PARAMETERS(VNDF_BSDF_IN)
                                             VNDF_BSDF_XYZ(VNDF_BSDF_OUT, wi)
                                                 VNDF_BSDF_RGB(VNDF_BSDF_OUT, weight) VNDF_BSDF_OUT(pdf)
                                                     __global VNDF_REAL* restrict out_lobe) {
    const size_t i = VNDF_BSDF_ITEM;
    struct vndf_bsdf b;
    VNDF_BSDF_LOAD
    const struct vndf_bsdf_direction d = vndf_bsdf_sample(VNDF_MAKE3(in_wo_x[i], in_wo_y[i], in_wo_z[i]), b,
                                                          VNDF_MAKE2(in_u1[i], in_u2[i]), in_u_lobe[i]);
    out_wi_x[i] = d.wi_x;
    out_wi_y[i] = d.wi_y;
    out_wi_z[i] = d.wi_z;
    VNDF_BSDF_STORE_RGB(weight, d.weight)
    out_pdf[i] = d.pdf;
    out_lobe[i] = (VNDF_REAL)d.lobe;
}
