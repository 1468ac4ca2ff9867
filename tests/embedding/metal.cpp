#include <cstdio>

#include "vndf/vndf.h"

int main() {
    const vndf_float3 wo = {0.6f, 0.0f, 0.8f};  // unit, away from the surface, z along its normal
    const vndf_float2 alpha = {0.5f, 0.1f};
    const vndf_float2 u = {0.25f, 0.75f};  // uniform in [0, 1)
    const vndf_float3 wm = vndf_ggx_sample_wm_dupuy2023(wo, alpha, u);
    const vndf_float3 wi = vndf_reflect(wo, wm);
    const float weight = wi.z > 0 ? vndf_ggx_weight(wo, wi, alpha) : 0;
    const float pdf = vndf_ggx_pdf_wi(wo, wi, alpha);
    std::printf("wi = (%.6f, %.6f, %.6f), weight %.6f, density %.6f\n", wi.x, wi.y, wi.z, weight, pdf);
}
