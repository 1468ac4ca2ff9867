// Reflections above the shading and a geometric normal, and what is seen of polygons and caps: what holds of them and of nothing
// else. Slices of the claims; conic_claims counts in full.
#include <cmath>
#include <cstring>

#define VNDF_REAL double
#include "vndf/ggx_polygon.h"
#include "vndf/ggx_tilted2026.h"

#include "support/catch.h"
#include "support/tilted_claims.h"

using namespace vndf::claims;

namespace {

constexpr vndf_double3 up{0, 0, 1};

vndf_double4 sample(const vndf_double3& wo, const vndf_double3& ng, const vndf_double2& alpha,
                    const vndf_double2& u) {
    return vndf_ggx_sample_wi_tilted2026_with_pdf(wo, ng, alpha, u);
}
bool is_lost(const vndf_double4& s) {
    return s.x == 0 && s.y == 0 && s.z == 0 && s.w == 0;
}

}  // namespace

TEST_CASE("tilted: about the shading normal the bits are those of all that is above the horizon") {
    Random random(1);
    for (int i = 0; i < 4096; ++i) {
        const Lobe at = random_lobe(random, 1e-6, 1e2);
        const vndf_double3 wo{at.x, at.y, at.z};
        const vndf_double2 alpha{at.alpha_x, at.alpha_y}, u{random.uniform(), random.uniform()};
        const vndf_double4 a = sample(wo, up, alpha, u),
                           b = vndf_ggx_sample_wi_conic2026_with_pdf(wo, alpha, u);
        CHECK(std::memcmp(&a, &b, sizeof a) == 0);
        const vndf_double3 wi{b.x, b.y, b.z};
        CHECK(vndf_ggx_pdf_wi_tilted2026(wo, up, wi, alpha) == vndf_ggx_pdf_wi_conic2026(wo, wi, alpha));
        CHECK(vndf_ggx_sigma_tilted(wo, up, alpha) == vndf_ggx_sigma_visible(wo, alpha));
    }
}

TEST_CASE("tilted: a lobe for many samples gives the bits of the single call") {
    Random random(2);
    for (int i = 0; i < 4096; ++i) {
        const TiltedLobe t = random_tilt(random, 1e-6, 1e2);
        const vndf_double3 wo{t.at.x, t.at.y, i % 4 ? t.at.z : -t.at.z}, ng{t.x, t.y, t.z};
        const vndf_double2 alpha{t.at.alpha_x, t.at.alpha_y}, u{random.uniform(), random.uniform()};
        const vndf_ggx_tilted2026 lobe = vndf_ggx_tilted2026_lobe(wo, ng, alpha);
        const vndf_double4 a = sample(wo, ng, alpha, u),
                           b = vndf_ggx_sample_wi_tilted2026_lobe_with_pdf(lobe, u);
        const vndf_double3 wi = vndf_ggx_sample_wi_tilted2026_lobe(lobe, u);
        CHECK(std::memcmp(&a, &b, sizeof a) == 0);
        CHECK((wi.x == a.x && wi.y == a.y && wi.z == a.z));
        CHECK(vndf_ggx_pdf_wi_tilted2026_lobe(lobe, wi) == vndf_ggx_pdf_wi_tilted2026(wo, ng, wi, alpha));
    }
}

TEST_CASE(
    "tilted: what is kept is above both normals, and of all that is lost no more than the tilt over half a "
    "turn") {
    const Kept kept = count_kept(std::uint64_t{1} << 21);
    CHECK(kept.outside == 0);
    CHECK(kept.over_tilt < 1 + 1e-12);
    // The larger of both cones would lose more.
    CHECK(kept.over_tilt > 0.5);
}

TEST_CASE("tilted: the projected area above both normals is the integral over the lune") {
    CHECK(worst_sigma_tilted(48) < 1e-12);
}

TEST_CASE("polygons: the mass is the integral over the part above the horizon") {
    CHECK(worst_polygon_mass(96) < 1e-12);
}

TEST_CASE("caps: the mass is the integral over the cap, of normals above the surface alone") {
    CHECK(worst_cap_mass(24) < 1e-9);  // what quadrature reaches where the rim is cut
}

TEST_CASE("tilted: corners of the domain are as documented") {
    const vndf_double3 wo{0.6, 0, 0.8};
    const vndf_double2 alpha{0.5, 0.3};
    for (int i = 0; i < 64; ++i) {
        const vndf_double2 u{(i + 0.5) / 64, 0.9};
        // Nothing is above both, and no direction is none.
        for (const vndf_double3& ng : {vndf_double3{0, 0, -1}, vndf_double3{0, 0, 0}})
            CHECK(is_lost(sample(wo, ng, alpha, u)));
        CHECK(is_lost(sample({0, 0, -1}, {0.6, 0, 0.8}, alpha, u)));
        CHECK(is_lost(sample({0, 0, 0}, {0.6, 0, 0.8}, alpha, u)));
        // Only the direction of ng counts.
        const vndf_double4 a = sample(wo, {0.28, 0.6, 0.75}, alpha, u),
                           b = sample(wo, {2.8, 6, 7.5}, alpha, u);
        CHECK(std::hypot(a.x - b.x, a.y - b.y, a.z - b.z) < 1e-14);
    }
    CHECK(vndf_ggx_sigma_tilted(wo, {0, 0, -1}, alpha) == 0);
    // wo below either normal, or both: what is above both keeps its density.
    for (const vndf_double3& o : {wo, vndf_double3{0.6, 0, -0.8}})
        for (const vndf_double3& ng : {vndf_double3{-0.8, 0, 0.3}, vndf_double3{0.8, 0, -0.1}}) {
            int kept = 0;
            for (int i = 0; i < 256; ++i) {
                const vndf_double4 s =
                    sample(o, ng, alpha, {std::fmod(i * 0.7548776662, 1), std::fmod(i * 0.5698402910, 1)});
                if (is_lost(s)) continue;
                ++kept;
                CHECK((s.z > 0 && s.x * ng.x + s.y * ng.y + s.z * ng.z > -1e-15));
                CHECK(
                    s.w ==
                    Catch::Approx(vndf_ggx_pdf_wi_tilted2026(o, ng, {s.x, s.y, s.z}, alpha)).epsilon(1e-10));
            }
            CHECK(kept > 0);
            CHECK(vndf_ggx_sigma_tilted(o, ng, alpha) > 0);
        }
    CHECK(std::isnan(vndf_ggx_sigma_tilted(wo, {NAN, 0, 0.8}, alpha)));
}

TEST_CASE("polygons: corners of the domain are as documented") {
    const vndf_double3 wo{0.6, 0, 0.8}, a{-0.7, 0.2, 0.5}, b{-0.5, -0.3, 0.6}, c{0.1, 0.1, 1},
        d{-0.3, 0.6, 0.7};
    const vndf_double2 alpha{0.5, 0.3};
    const double mass = vndf_ggx_triangle_mass(wo, a, b, c, alpha);
    CHECK(mass > 0.01);
    // In either order, from any vertex, of any length.
    CHECK(vndf_ggx_triangle_mass(wo, c, b, a, alpha) == Catch::Approx(mass).epsilon(1e-14));
    CHECK(vndf_ggx_triangle_mass(wo, b, c, a, alpha) == Catch::Approx(mass).epsilon(1e-14));
    CHECK(vndf_ggx_triangle_mass(wo, {-7, 2, 5}, b, {1e-4, 1e-4, 1e-3}, alpha) ==
          Catch::Approx(mass).epsilon(1e-14));
    // A quadrilateral is two triangles.
    CHECK(vndf_ggx_quad_mass(wo, a, b, c, d, alpha) ==
          Catch::Approx(mass + vndf_ggx_triangle_mass(wo, a, c, d, alpha)).epsilon(1e-13));
    // Without area, edge-on to wo or not.
    CHECK(vndf_ggx_triangle_mass(wo, a, a, c, alpha) < 1e-16);
    CHECK(vndf_ggx_triangle_mass(wo, a, b, {-1.2, -0.1, 1.1}, alpha) < 1e-15);
    CHECK(vndf_ggx_triangle_mass(wo, wo, a, {-0.1, 0.2, 1.3}, alpha) < 1e-15);
    // Edge-on: the edge from the mirror direction through the normal to wo.
    const double left = vndf_ggx_triangle_mass(wo, {-0.6, 0, 0.8}, {0.6, 0, 0.8}, {0, 0.9, 0.4}, alpha),
                 right = vndf_ggx_triangle_mass(wo, {-0.6, 0, 0.8}, {0.6, 0, 0.8}, {0, -0.9, 0.4}, alpha);
    CHECK(left == Catch::Approx(right).epsilon(1e-13));
    // Below the horizon, through it, behind.
    CHECK(vndf_ggx_triangle_mass(wo, {-0.7, 0.2, -0.5}, {-0.5, -0.3, -0.6}, {0.1, 0.1, -1}, alpha) == 0);
    const vndf_double3 low{-0.9, 0.1, -0.4}, left_low{-0.6, 0.6, -0.3};
    CHECK(vndf_ggx_triangle_mass(wo, low, left_low, c, alpha) > 0);
    CHECK(vndf_ggx_triangle_mass({0.6, 0, -0.8}, a, b, c, alpha) == 0);
    // Four quarters of the upper half are all that is above the horizon.
    double quarters = 0;
    const vndf_double3 around[] = {{1, 0, -0.1}, {0, 1, -0.1}, {-1, 0, -0.1}, {0, -1, -0.1}};
    for (int i = 0; i < 4; ++i)
        quarters += vndf_ggx_triangle_mass(wo, up, around[i], around[(i + 1) % 4], alpha);
    CHECK(quarters == Catch::Approx(vndf_ggx_sigma_visible(wo, alpha)).epsilon(1e-13));
    // A small triangle: its solid angle times the density.
    const double h = 1e-4, small = vndf_ggx_triangle_mass(wo, {-0.6, 0, 0.8}, {-0.6, h, 0.8},
                                                          {-0.6 + 0.8 * h, 0, 0.8 + 0.6 * h}, alpha);
    CHECK(
        small / (h * h / 2) ==
        Catch::Approx(vndf_ggx_pdf_wi(wo, {-0.6, 0, 0.8}, alpha) * vndf_ggx_sigma(wo, alpha)).epsilon(1e-3));
    CHECK(std::isnan(vndf_ggx_triangle_mass({NAN, 0, 0.8}, a, b, c, alpha)));
}

TEST_CASE("caps: above the surface the mass is sigma_C, and a cap and what it leaves are all") {
    Random random(3);
    for (int i = 0; i < 2000; ++i) {
        const CapLobe c = random_cap(random, 1e-2, 4, true);
        const vndf_double3 wo{c.at.x, c.at.y, c.at.z}, l{c.lx, c.ly, c.lz};
        const vndf_double2 alpha{c.at.alpha_x, c.at.alpha_y};
        CHECK(vndf_ggx_cap_mass(wo, l, c.one_minus_cos, alpha) ==
              Catch::Approx(vndf_ggx_sigma_cap(wo, l, c.one_minus_cos, alpha)).epsilon(1e-9));
        const CapLobe any = random_cap(random, 1e-2, 4, false);
        const vndf_double3 o{any.at.x, any.at.y, i % 2 ? any.at.z : -any.at.z}, m{any.lx, any.ly, any.lz};
        const double sigma = vndf_ggx_sigma(o, alpha);
        CHECK(vndf_ggx_cap_mass(o, m, any.one_minus_cos, alpha) +
                  vndf_ggx_cap_mass(o, {-m.x, -m.y, -m.z}, 2 - any.one_minus_cos, alpha) ==
              Catch::Approx(sigma).epsilon(1e-12));
    }
}
