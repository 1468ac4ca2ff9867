#include "vndf/vndf.h"

// A rough, perfectly conducting mirror: wi sampled for each wo, its weight brdf * cos(theta_i) / density, and the
// density itself (per steradian of wi), which multiple importance sampling needs.
//
// one: 1.0f. LLVM would pack neighbours of which the same is computed, and PoCL then not vectorise across work-items: a
// factor of eight. Multiplied by a number that it does not know, every second component is something else to it.
kernel void sample_metal(global const float* wo, global const float* u, float2 roughness, float one,
                         global float* wi, global float* weight, global float* pdf) {
    const size_t i = get_global_id(0);
    const float2 alpha = (float2)(roughness.x, one * roughness.y);
    const float3 o = (float3)(wo[3 * i], one * wo[3 * i + 1], wo[3 * i + 2]);
    const struct vndf_ggx_lobe lobe = vndf_ggx_lobe_of(o, alpha);
    const float4 m = vndf_ggx_sample_wm_dupuy2023_lobe_with_pdf(lobe, (float2)(u[2 * i], one * u[2 * i + 1]));
    const float3 r = vndf_reflect(o, m.xyz);
    wi[3 * i] = r.x, wi[3 * i + 1] = one * r.y, wi[3 * i + 2] = r.z;
    weight[i] = vndf_ggx_weight_lobe(lobe, r);  // 0 below the horizon
    pdf[i] = m.w * vndf_jacobian_reflect(o, m.xyz);
}
