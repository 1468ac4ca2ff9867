// The smallest material, written by hand and without switches: a GGX conductor with one alpha, Schlick's reflectance, bounded
// sampling and correlated masking, seen from the front. What bsdf.h with every effect off is measured against
// (bench/effects.py): the same formulas, the same arrays.
#include "../../kernels/vndf/fresnel_schlick.h"
#include "../../kernels/vndf/ggx_eto2023.h"

#define ARRAYS                                                                    \
    __global const float* restrict alpha, __global const float* restrict f0_r,    \
        __global const float* restrict f0_g, __global const float* restrict f0_b, \
        __global const float* restrict f90

VNDF_FN float cosine_between(float3 wo, float3 wi) {
    float x = wo.x + wi.x, y = wo.y + wi.y, z = wo.z + wi.z;
    return 0.5f * sqrt(fma(x, x, fma(y, y, z * z)));
}

VNDF_FN float bounded_weight(struct vndf_ggx_lobe lobe, struct vndf_impl_bound bound, float3 wi) {
    float whole = lobe.axis.height, share = bound.height / (whole > 0.0f ? whole : 1.0f);
    return vndf_ggx_weight_lobe(lobe, wi) * vndf_impl_share(share);
}

__kernel void vndf_batch_minimal_eval_pdf(__global const float* restrict wo_x,
                                          __global const float* restrict wo_y,
                                          __global const float* restrict wo_z,
                                          __global const float* restrict wi_x,
                                          __global const float* restrict wi_y,
                                          __global const float* restrict wi_z, ARRAYS,
                                          __global float* restrict f_r, __global float* restrict f_g,
                                          __global float* restrict f_b, __global float* restrict pdf) {
    const size_t i = get_global_id(0);
    const float3 wo = (float3)(wo_x[i], wo_y[i], wo_z[i]), wi = (float3)(wi_x[i], wi_y[i], wi_z[i]);
    const struct vndf_ggx_lobe lobe = vndf_ggx_lobe_of(wo, (float2)(alpha[i], alpha[i]));
    const struct vndf_impl_bound bound = vndf_impl_ggx_bound(lobe);
    const float cosine = cosine_between(wo, wi), weight = bounded_weight(lobe, bound, wi);
    const float density = vndf_impl_ggx_bounded_pdf(lobe, wi, bound);
    f_r[i] = vndf_fresnel_schlick(cosine, f0_r[i], f90[i]) * weight * density;
    f_g[i] = vndf_fresnel_schlick(cosine, f0_g[i], f90[i]) * weight * density;
    f_b[i] = vndf_fresnel_schlick(cosine, f0_b[i], f90[i]) * weight * density;
    pdf[i] = density;
}

__kernel void vndf_batch_minimal_sample(__global const float* restrict wo_x,
                                        __global const float* restrict wo_y,
                                        __global const float* restrict wo_z,
                                        __global const float* restrict u1, __global const float* restrict u2,
                                        ARRAYS, __global float* restrict wi_x, __global float* restrict wi_y,
                                        __global float* restrict wi_z, __global float* restrict weight_r,
                                        __global float* restrict weight_g, __global float* restrict weight_b,
                                        __global float* restrict pdf, __global float* restrict which) {
    const size_t i = get_global_id(0);
    const float3 wo = (float3)(wo_x[i], wo_y[i], wo_z[i]);
    const struct vndf_ggx_lobe lobe = vndf_ggx_lobe_of(wo, (float2)(alpha[i], alpha[i]));
    const struct vndf_impl_bound bound = vndf_impl_ggx_bound(lobe);
    const struct vndf_impl_sample s = vndf_impl_lobe_reflection(
        lobe, bound.height, vndf_impl_bounded_half(lobe, bound, (float2)(u1[i], u2[i])));
    const float3 wi = (float3)(s.x, s.y, s.z);
    const float cosine = cosine_between(wo, wi), weight = bounded_weight(lobe, bound, wi);
    wi_x[i] = s.x;
    wi_y[i] = s.y;
    wi_z[i] = s.z;
    weight_r[i] = vndf_fresnel_schlick(cosine, f0_r[i], f90[i]) * weight;
    weight_g[i] = vndf_fresnel_schlick(cosine, f0_g[i], f90[i]) * weight;
    weight_b[i] = vndf_fresnel_schlick(cosine, f0_b[i], f90[i]) * weight;
    pdf[i] = s.pdf;
    which[i] = 0.0f;
}
