// Lights bring what they must: surfaces that shine, lights at a point and far ones in absolute units, images of an environment;
// sampled, met by chance, or both.
#include "render/environment.h"
#include "scenes.h"

using namespace vndf;
using namespace vndf::test;

namespace {

using render::PunctualLight;

constexpr double pi = std::numbers::pi;

// A matt floor of this albedo in the dark, seen from above at a point.
render::Scene dark_floor(float albedo, float x = 0) {
    render::Scene scene;
    scene.name = "floor in the dark";
    scene.add_square(-50, -50, 50, 50, scene.add_material(render::lambert({albedo, albedo, albedo})));
    scene.sky = render::constant_sky(0);
    scene.camera = {{x, 0.5f, 0}, {x, 0, 0}, 1e-4f, {0, 0, -1}};
    return scene;
}

double seen(const render::Scene& scene, unsigned samples, const std::string& effects = "auto",
            unsigned bounces = 1) {
    Rendered r = rendered(scene, 8, 8, samples);
    r.settings.max_bounces = bounces;
    r.effects = effects;
    const render::Image image = r.image();
    CHECK(image.bad_pixels == 0);
    return mean(image);
}

// The square of side 2 a at height h over the origin, facing down.
void add_lamp(render::Scene& scene, float a, float h, render::Vec emission) {
    render::Material lamp = render::lambert({0, 0, 0});
    lamp.emission = emission;
    const auto first = static_cast<std::uint32_t>(scene.vertices.size());
    scene.add_square(-a, -a, a, a, scene.add_material(lamp));
    for (std::size_t i = first; i < scene.vertices.size(); ++i) scene.vertices[i].place[1] = h;
}

// The irradiance at (x, 0, 0) of that square, of radiance 1, by Lambert's formula for polygons.
double irradiance(double a, double h, double x) {
    const std::array<std::array<double, 3>, 4> corners{
        {{-a - x, h, -a}, {a - x, h, -a}, {a - x, h, a}, {-a - x, h, a}}};
    double sum = 0;
    for (int i = 0; i < 4; ++i) {
        const auto &p = corners[i], &q = corners[(i + 1) % 4];
        const double pq = p[0] * q[0] + p[1] * q[1] + p[2] * q[2], pp = std::hypot(p[0], p[1], p[2]),
                     qq = std::hypot(q[0], q[1], q[2]);
        const double up = p[2] * q[0] - p[0] * q[2],
                     length = std::hypot(p[1] * q[2] - p[2] * q[1], up, p[0] * q[1] - p[1] * q[0]);
        sum += std::acos(pq / (pp * qq)) * up / length;
    }
    return std::abs(sum) / 2;
}

}  // namespace

TEST_CASE("a square that shines lights the floor as Lambert's formula says, sampled or met by chance") {
    for (const float x : {0.0f, 2.0f}) {
        render::Scene scene = dark_floor(0.5f, x);
        add_lamp(scene, 0.75f, 1.5f, {2, 2, 2});
        const double expected = 0.5 / pi * 2 * irradiance(0.75, 1.5, x);
        CAPTURE(x);
        CHECK(seen(scene, 256) == Catch::Approx(expected).epsilon(4e-3));
        // Without lamps as lights every path that meets one counts in full: the same, with more noise.
        CHECK(seen(scene, 4096, "lambert,emission,back_facing") == Catch::Approx(expected).epsilon(2e-2));
    }
}

TEST_CASE("of lamps of different brightness, and next to a mirror, nothing is counted twice or lost") {
    render::Scene scene = dark_floor(0.5f);
    scene.materials[0] = render::conductor({1, 1, 1}, 0.2f, 0.2f);
    scene.camera = {{3, 4, 0}, {0, 0, 0}, 0.5f};
    add_lamp(scene, 0.5f, 2, {1, 2, 3});
    add_lamp(scene, 0.1f, 1, {30, 10, 1});
    const double both = seen(scene, 1024),
                 chance = seen(scene, 16384, "conductor,lambert,emission,back_facing");
    CHECK(both == Catch::Approx(chance).epsilon(0.03));
}

TEST_CASE("lights at a point: candela over the squared distance, spots, lux, and watts as lumens") {
    const auto lit = [](PunctualLight light) {
        render::Scene scene = dark_floor(0.5f);
        scene.lights.push_back(light);
        return seen(scene, 4) * pi / 0.5;  // the irradiance
    };
    CHECK(lit({PunctualLight::Kind::point, {1, 1, 1}, 8, {0, 2, 0}, {}}) == Catch::Approx(2).epsilon(1e-3));
    // Slanting: 8 cd at (2, 2, 0), cos = 1 / sqrt(2), distance^2 = 8.
    CHECK(lit({PunctualLight::Kind::point, {1, 1, 1}, 8, {2, 2, 0}, {}}) ==
          Catch::Approx(std::sqrt(.5)).epsilon(1e-3));
    CHECK(lit({PunctualLight::Kind::directional, {1, 0.5f, 0.25f}, 5, {}, {0, -1, 0}}) ==
          Catch::Approx(5 * 1.75 / 3).epsilon(1e-3));
    CHECK(lit({PunctualLight::Kind::directional, {1, 1, 1}, 5, {}, {0, 1, 0}}) == 0);
    // A lamp of 10 W, at 683 lm / W over the whole sphere, as exporters have it.
    const auto candela = static_cast<float>(10 * 683 / (4 * pi));
    CHECK(lit({PunctualLight::Kind::point, {1, 1, 1}, candela, {0, 4, 0}, {}}) ==
          Catch::Approx(10 * 683 / (4 * pi) / 16).epsilon(1e-3));
    // A spot: full within the inner angle, none beyond the outer one, squared between by the cosine.
    const auto spot = [&](double angle) {
        const auto sine = static_cast<float>(std::sin(angle)), cosine = static_cast<float>(std::cos(angle));
        return lit({PunctualLight::Kind::spot, {1, 1, 1}, 8, {0, 2, 0}, {sine, -cosine, 0}, 0.2f, 0.5f});
    };
    CHECK(spot(0.1) == Catch::Approx(2).epsilon(1e-3));
    CHECK(spot(0.6) == 0);
    const double between = (std::cos(0.35) - std::cos(0.5)) / (std::cos(0.2) - std::cos(0.5));
    CHECK(spot(0.35) == Catch::Approx(2 * between * between).epsilon(1e-3));
}

TEST_CASE("several lights together are their sum, and something in the way takes its own") {
    render::Scene scene = dark_floor(0.5f);
    scene.lights = {{PunctualLight::Kind::point, {1, 1, 1}, 8, {0, 2, 0}, {}},
                    {PunctualLight::Kind::point, {1, 1, 1}, 0.5f, {0, 1, 0}, {}},
                    {PunctualLight::Kind::directional, {1, 1, 1}, 1, {}, {0, -1, 0}}};
    add_lamp(scene, 0.25f, 3, {4, 4, 4});
    scene.sky = render::constant_sky(0.125f);
    // The lamp is in the way of the far light and of some of the sky.
    const double lamp = irradiance(0.25, 3, 0);
    const double expected = 2 + 0.5 + 0 + 4 * lamp + 0.125 * (pi - lamp);
    CHECK(seen(scene, 4096) * pi / 0.5 == Catch::Approx(expected).epsilon(5e-3));
}

TEST_CASE(
    "an environment of one brightness is a white sky, and one with a bright spot lights as its integral") {
    // 8 cells each way, of which each is as likely as another: right, if with more noise than by brightness.
    const auto environment = [](float base, float spot) {
        render::Environment e{8, std::vector<float>(300, base),
                              std::vector<float>(64, static_cast<float>(1 / (4 * pi))),
                              std::vector<float>(64, 1.0f), std::vector<std::uint32_t>(64)};
        for (int channel = 0; channel < 3; ++channel) e.radiance[100 * channel + 10 * 4 + 6] = spot;
        return e;
    };
    render::Scene white = dark_floor(0.5f);
    white.environment = environment(1, 1);
    CHECK(seen(white, 256) == Catch::Approx(0.5).epsilon(5e-3));
    render::Scene spotted = dark_floor(0.5f);
    spotted.environment = environment(0.5f, 40);
    // By chance alone, through the same map.
    Rendered r = rendered(spotted, 8, 8, 8192);
    r.settings.max_bounces = 1;
    const double both = mean(r.image());
    spotted.environment.pdf.assign(64, 0);
    r.scene = spotted;
    const double chance = mean(r.image());
    CHECK(both == Catch::Approx(chance).epsilon(0.02));
    CHECK(both > 0.3);
}

TEST_CASE(
    "with every kind of light at once, all effects and those called for have the same bits, here and in "
    "C++") {
    render::Scene scene = render::orbs("coat");
    scene.open = true;
    render::Material lamp = render::lambert({0.2f, 0.2f, 0.2f});
    lamp.emission = {3, 2, 1};
    scene.add_sphere({0, 3, 2}, 0.3f, 8, lamp);
    scene.lights = {
        {PunctualLight::Kind::point, {1, 0.5f, 0.5f}, 8, {2, 3, 2}, {}},
        {PunctualLight::Kind::spot, {0.5f, 1, 0.5f}, 20, {-2, 4, 2}, {0.3f, -0.9f, 0}, 0.2f, 0.5f},
        {PunctualLight::Kind::directional, {0.5f, 0.5f, 1}, 1, {}, {0, -0.8f, -0.6f}},
        {PunctualLight::Kind::spot, {1, 0.8f, 0.6f}, 9, {1, 3, 1}, {0, -1, 0}, 0.2f, 0.7f, 0.4f},
        {PunctualLight::Kind::point, {0.6f, 0.8f, 1}, 4, {-1, 2.5f, 3}, {}, 0, 0, 0.2f}};
    Rendered r = rendered(scene, 60, 25, 4);
    const render::Image called = r.image();
    CHECK(called.bad_pixels == 0);
    const auto cpp = render::cpp_stages("ggx", "schlick");
    CHECK(r.on(*cpp).pixels == called.pixels);
    r.effects = "all";
    CHECK(r.image().pixels == called.pixels);
}
