#define VNDF_REAL float
#include "vndf/ggx_tilted2026.h"

#include "tilted_claims.h"

namespace vndf::claims {

Kept count_kept(std::uint64_t samples) {
    std::atomic<std::uint64_t> outside{0};
    std::atomic<double> over_tilt{0};
    for_blocks(samples / samples_of_lobe, [&](Random& random) {
        const TiltedLobe t = random_tilt(random, 1e-4, 4);
        const auto f = [](double x) { return static_cast<float>(x); };
        const vndf_float3 wo{f(t.at.x), f(t.at.y), f(t.at.z)}, ng{f(t.x), f(t.y), f(t.z)};
        const vndf_float2 alpha{f(t.at.alpha_x), f(t.at.alpha_y)};
        const vndf_ggx_tilted2026 lobe = vndf_ggx_tilted2026_lobe(wo, ng, alpha);
        std::uint64_t bad = 0;
        for (std::uint64_t i = 0; i < samples_of_lobe; ++i) {
            const auto [u1, u2] = random_u(random, i);
            const vndf_float4 wi = vndf_ggx_sample_wi_tilted2026_lobe_with_pdf(lobe, {u1, u2});
            const double x = wi.x, y = wi.y, z = wi.z, length = std::sqrt(x * x + y * y + z * z);
            if (length == 0 && wi.w == 0) continue;
            bad += !(z > 0) || !(x * ng.x + y * ng.y + z * ng.z > -4 * 0x1p-24) ||
                   !(std::abs(length - 1) < 5e-7) || !(wi.w > 0);
        }
        outside += bad;
        if (t.at.alpha_x > 1 || t.at.alpha_y > 1) return;
        const float least = std::min(vndf_ggx_sigma_visible(wo, alpha), vndf_ggx_sigma_cap(wo, ng, 1, alpha)),
                    tilt = std::atan2(std::hypot(ng.x, ng.y), ng.z) / VNDF_PI;
        // What rounding leaves of the difference of two areas.
        const double lost = 1 - vndf_ggx_sigma_tilted(wo, ng, alpha) / least - 1e-4;
        raise(over_tilt, lost / tilt);
    });
    return {outside, over_tilt};
}

}  // namespace vndf::claims
