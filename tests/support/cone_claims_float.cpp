#define VNDF_REAL float
#include "vndf/ggx_cone2026.h"

#include "cone_claims.h"

namespace vndf::claims {

std::uint64_t count_missed(std::uint64_t samples) {
    std::atomic<std::uint64_t> missed{0};
    for_blocks(samples / samples_of_lobe, [&](Random& random) {
        const CapLobe c = random_cap(random, 1e-4, 10, false);
        const auto f = [](double x) { return static_cast<float>(x); };
        const vndf_ggx_cone2026 cone =
            vndf_ggx_cone2026_lobe({f(c.at.x), f(c.at.y), f(c.at.z)}, {f(c.lx), f(c.ly), f(c.lz)},
                                   f(c.one_minus_cos), {f(c.at.alpha_x), f(c.at.alpha_y)});
        if (!cone.inside) return;
        const double lx = f(c.lx), ly = f(c.ly), lz = f(c.lz),
                     rcp = 1 / std::sqrt(lx * lx + ly * ly + lz * lz);
        const double reach = std::sqrt(2.0 * f(c.one_minus_cos)) + 32 * 0x1p-24;
        std::uint64_t bad = 0;
        for (std::uint64_t i = 0; i < samples_of_lobe; ++i) {
            const auto [u1, u2] = random_u(random, i);
            const vndf_float4 wi = vndf_ggx_sample_wi_cone2026_lobe_with_pdf(cone, {u1, u2});
            const double x = wi.x, y = wi.y, z = wi.z, length = std::sqrt(x * x + y * y + z * z);
            const double dx = x / length - lx * rcp, dy = y / length - ly * rcp, dz = z / length - lz * rcp;
            bad += !(dx * dx + dy * dy + dz * dz <= reach * reach) || !(std::abs(length - 1) < 5e-7) ||
                   !(wi.w >= 0);
        }
        missed += bad;
    });
    return missed;
}

}  // namespace vndf::claims
