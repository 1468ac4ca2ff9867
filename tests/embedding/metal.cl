#include "vndf/vndf.h"

// A rough, perfectly conducting mirror: wi sampled for each wo, its weight brdf * cos(theta_i) / density, and the
// density itself (per steradian of wi), which multiple importance sampling needs.
kernel void sample_metal(global const float* wo, global const float* u, float2 alpha, global float* wi,
                         global float* weight, global float* pdf) {
    const size_t i = get_global_id(0);
    const float3 o = vload3(i, wo);
    const float3 m = vndf_ggx_sample_wm_dupuy2023(o, alpha, vload2(i, u));
    const float3 r = vndf_reflect(o, m);
    vstore3(r, i, wi);
    weight[i] = r.z > 0.0f ? vndf_ggx_g2(o, r, alpha) / vndf_ggx_g1(o, alpha) : 0.0f;
    pdf[i] = vndf_ggx_pdf_wi(o, r, alpha);
}
