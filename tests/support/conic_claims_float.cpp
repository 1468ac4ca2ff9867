#define VNDF_REAL float
#include "vndf/ggx_conic2026.h"

#include "conic_claims.h"

namespace vndf::claims {

std::uint64_t count_below(std::uint64_t samples) {
    std::atomic<std::uint64_t> below{0};
    for_blocks(samples / samples_of_lobe, [&](Random& random) {
        const Lobe at = random_lobe(random, 1e-8, 1e3);
        const vndf_float3 wo{static_cast<float>(at.x), static_cast<float>(at.y), static_cast<float>(at.z)};
        const vndf_float2 alpha{static_cast<float>(at.alpha_x), static_cast<float>(at.alpha_y)};
        const vndf_ggx_conic2026 lobe = vndf_ggx_conic2026_lobe(wo, alpha);
        const bool isotropic = alpha.x == alpha.y && random.bits() % 2;
        std::uint64_t bad = 0;
        for (std::uint64_t i = 0; i < samples_of_lobe; ++i) {
            const auto [u1, u2] = random_u(random, i);
            const vndf_float4 wi =
                isotropic ? vndf_ggx_sample_wi_conic2026_isotropic_with_pdf(wo, alpha.x, {u1, u2})
                          : vndf_ggx_sample_wi_conic2026_lobe_with_pdf(lobe, {u1, u2});
            const float excess = wi.x * wi.x + wi.y * wi.y + wi.z * wi.z - 1;
            bad += !(wi.z > 0) || !(std::abs(excess) < 1e-6f) || !(wi.w > 0);
        }
        below += bad;
    });
    return below;
}

}  // namespace vndf::claims
