#define VNDF_REAL double
#include "vndf/ggx_conic2026.h"

#include "conic_claims.h"

namespace vndf::claims {

Lost count_lost(std::uint64_t directions) {
    std::atomic<std::uint64_t> outside{0};
    std::atomic<double> worst{0};
    for_blocks(directions / samples_of_lobe, [&](Random& random) {
        const Lobe at = random_lobe(random, 1e-4, 4);
        const vndf_double3 wo{at.x, at.y, at.z};
        const vndf_double2 alpha{at.alpha_x, at.alpha_y};
        const vndf_ggx_conic2026 lobe = vndf_ggx_conic2026_lobe(wo, alpha);
        std::uint64_t bad = 0;
        for (std::uint64_t i = 0; i < samples_of_lobe; ++i) {
            const double phi = 2 * VNDF_PI * random.uniform();
            const double z = i % 2 ? random.uniform() + 1e-12 : random.log_uniform(1e-9, 1);
            const double s = std::sqrt((1 - z) * (1 + z));
            const vndf_double3 wi{s * std::cos(phi), s * std::sin(phi), z};
            const vndf_double2 u = vndf_ggx_invert_wi_conic2026(wo, wi, alpha);
            const vndf_double3 back = vndf_ggx_sample_wi_conic2026_lobe(lobe, u);
            bad += is_lost(u, wi, back, vndf_ggx_pdf_wi_conic2026_lobe(lobe, wi), worst);
        }
        outside += bad;
    });
    return {outside, worst};
}

namespace {

reference::Distribution distribution(const Lobe& at) {
    return {"vndf_ggx_pdf_wi_conic2026",
            {.wo = {at.x, at.y, at.z}, .alpha_x = at.alpha_x, .alpha_y = at.alpha_y},
            reference::Precision::f64};
}

}  // namespace

double worst_probability(std::uint64_t lobes) {
    std::atomic<double> worst{0};
    for_blocks(lobes, [&](Random& random) {
        const Lobe at = random_lobe(random, 1e-4, 4);
        const double p = vndf_ggx_reflection_probability({at.x, at.y, at.z}, {at.alpha_x, at.alpha_y});
        raise(worst, std::abs(p / distribution(at).reflection_probability() - 1));
    });
    return worst;
}

double worst_integral(std::uint64_t lobes) {
    std::atomic<double> worst{0};
    for_blocks(lobes, [&](Random& random) {
        const Lobe at = random_lobe(random, 1e-2, 2);
        const vndf_ggx_conic2026 lobe = vndf_ggx_conic2026_lobe({at.x, at.y, at.z}, {at.alpha_x, at.alpha_y});
        raise(worst, off_one(distribution(at).rule(2), [&](double x, double y, double z) {
                  return vndf_ggx_pdf_wi_conic2026_lobe(lobe, {x, y, z});
              }));
    });
    return worst;
}

}  // namespace vndf::claims
