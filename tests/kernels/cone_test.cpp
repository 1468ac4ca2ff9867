// Reflections into caps: what holds of them and of nothing else. Slices of the claims; conic_claims counts in full.
#include <cmath>
#include <cstring>

#define VNDF_REAL double
#include "vndf/ggx_cone2026.h"

#include "support/catch.h"
#include "support/cone_claims.h"

using namespace vndf::claims;

namespace {

double off(const vndf_double3& a, const vndf_double3& b) {
    return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z);
}

}  // namespace

TEST_CASE("cones: no reflection misses its cap") {
    CHECK(count_missed(std::uint64_t{1} << 21) == 0);
}

TEST_CASE("cones: no direction of a cap is lost, and the inverse is one") {
    const Lost lost = count_lost_in_caps(std::uint64_t{1} << 19);
    CHECK(lost.outside == 0);
    CHECK(lost.worst_round_trip < 1e-16);
}

TEST_CASE("cones: the projected area is the integral over the cap") {
    CHECK(worst_sigma_cap(64) < 1e-12);
}

TEST_CASE("cones: the density has the integral 1 over the cap") {
    CHECK(worst_cap_integral(24) < 1e-8);
}

TEST_CASE("cones: the cap about z with 90 degrees is what is above the horizon") {
    Random random(1);
    double worst = 0;
    for (int i = 0; i < 20000; ++i) {
        const Lobe at = random_lobe(random, 1e-3, 2);
        if (at.z < 1e-2 || at.z > 0.99) continue;  // where either loses digits
        const vndf_double3 wo{at.x, at.y, at.z}, l{0, 0, 1};
        const vndf_double2 alpha{at.alpha_x, at.alpha_y}, u{random.uniform(), 0.999 * random.uniform()};
        const vndf_double4 a = vndf_ggx_sample_wi_conic2026_with_pdf(wo, alpha, u),
                           b = vndf_ggx_sample_wi_cone2026_with_pdf(wo, l, 1, alpha, u);
        worst =
            std::max({worst, off({a.x, a.y, a.z}, {b.x, b.y, b.z}), std::abs(a.w / b.w - 1),
                      std::abs(vndf_ggx_sigma_cap(wo, l, 1, alpha) / vndf_ggx_sigma_visible(wo, alpha) - 1)});
    }
    CHECK(worst < 1e-10);
}

TEST_CASE("cones: the density of a small cap is the plain one over what the cap has of it") {
    Random random(2);
    for (int i = 0; i < 1000; ++i) {
        const CapLobe c = random_cap(random, 0.1, 1, true);
        const vndf_double3 wo{c.at.x, c.at.y, c.at.z}, l{c.lx, c.ly, c.lz};
        const vndf_double2 alpha{c.at.alpha_x, c.at.alpha_y};
        for (const double omc : {1e-12, 1e-20, 1e-30, 1e-40}) {
            const double p = vndf_ggx_cap_probability(wo, l, omc, alpha);
            CHECK(p / (2 * VNDF_PI * omc) == Catch::Approx(vndf_ggx_pdf_wi(wo, l, alpha)).epsilon(1e-6));
            CHECK(off(vndf_ggx_sample_wi_cone2026(wo, l, omc, alpha, {0.3, 0.7}), l) <
                  2 * std::sqrt(omc) + 1e-15);
        }
    }
}

TEST_CASE("cones: a lobe for many samples gives the bits of the single call") {
    Random random(3);
    for (int i = 0; i < 4096; ++i) {
        const CapLobe c = random_cap(random, 1e-6, 1e2, false);
        const vndf_double3 wo{c.at.x, c.at.y, i % 4 ? c.at.z : -c.at.z}, l{c.lx, c.ly, c.lz};
        const vndf_double2 alpha{c.at.alpha_x, c.at.alpha_y}, u{random.uniform(), random.uniform()};
        const vndf_ggx_cone2026 cone = vndf_ggx_cone2026_lobe(wo, l, c.one_minus_cos, alpha);
        const vndf_double4 a = vndf_ggx_sample_wi_cone2026_with_pdf(wo, l, c.one_minus_cos, alpha, u),
                           b = vndf_ggx_sample_wi_cone2026_lobe_with_pdf(cone, u);
        const vndf_double3 wi = vndf_ggx_sample_wi_cone2026_lobe(cone, u);
        CHECK(std::memcmp(&a, &b, sizeof a) == 0);
        CHECK((wi.x == a.x && wi.y == a.y && wi.z == a.z));
        CHECK(vndf_ggx_pdf_wi_cone2026_lobe(cone, wi) ==
              vndf_ggx_pdf_wi_cone2026(wo, l, c.one_minus_cos, wi, alpha));
    }
}

TEST_CASE("cones: corners of the domain are as documented") {
    const vndf_double3 wo{0.6, 0, 0.8}, back{-0.6, 0, -0.8};
    const vndf_double2 alpha{0.5, 0.3}, u{0.3, 0.6};
    // -wo in the cap: all normals that face wo, in the cap with density D / (4 t), outside with none.
    const double t = std::hypot(0.5 * 0.6, 0.8);
    CHECK(vndf_ggx_sigma_cap(wo, back, 0.5, alpha) == Catch::Approx(t).epsilon(1e-15));
    int hit = 0, missed = 0;
    for (int i = 0; i < 64; ++i) {
        const vndf_double4 s =
            vndf_ggx_sample_wi_cone2026_with_pdf(wo, back, 0.9, alpha, {(i + 0.5) / 64, 0.9});
        const bool inside = s.x * back.x + s.z * back.z > 1 - 0.9, up = wo.z + s.z > 0;
        CHECK((s.w > 0) == (inside && up));
        if (s.w > 0)
            CHECK(s.w ==
                  Catch::Approx(vndf_ggx_pdf_wi(wo, {s.x, s.y, s.z}, alpha) * vndf_ggx_sigma(wo, alpha) / t)
                      .epsilon(1e-12));
        ++(s.w > 0 ? hit : missed);
    }
    CHECK(hit > 0);
    CHECK(missed > 0);
    // The whole sphere, nothing, and no direction.
    CHECK(vndf_ggx_sigma_cap(wo, wo, 2, alpha) == Catch::Approx(t).epsilon(1e-15));
    CHECK(vndf_ggx_sigma_cap(wo, wo, 0, alpha) == 0);
    CHECK(vndf_ggx_pdf_wi_cone2026(wo, wo, 0, wo, alpha) == 0);
    const vndf_double4 none = vndf_ggx_sample_wi_cone2026_with_pdf(wo, {0, 0, 0}, 0.1, alpha, u);
    CHECK((none.x == 0 && none.y == 0 && none.z == 1 && none.w == 0));
    CHECK(vndf_ggx_sigma_cap(wo, {0, 0, 0}, 0.1, alpha) == 0);
    // Outside the cap, and below the surface.
    CHECK(vndf_ggx_pdf_wi_cone2026(wo, wo, 0.1, {0, 0, 1}, alpha) == 0);
    CHECK(vndf_ggx_pdf_wi_cone2026(wo, wo, 0.3, {0, 0, 1}, alpha) > 0);
    const vndf_double3 below{0, 0.6, -0.8000001};
    CHECK(vndf_ggx_pdf_wi_cone2026(wo, below, 0.01, below, alpha) == 0);
    CHECK(vndf_ggx_sample_wi_cone2026_with_pdf(wo, {0, 0.6, -0.9}, 1e-4, alpha, u).w == 0);
    // Only the direction of l counts.
    const vndf_double3 a = vndf_ggx_sample_wi_cone2026(wo, {0, 0.6, 0.8}, 0.1, alpha, u),
                       b = vndf_ggx_sample_wi_cone2026(wo, {0, 6, 8}, 0.1, alpha, u);
    CHECK(off(a, b) < 1e-14);
    CHECK(std::isnan(vndf_ggx_sigma_cap({NAN, 0, 0.8}, wo, 0.1, alpha)));
}
