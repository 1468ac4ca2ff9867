// Lights that are spheres bring what their points do, are seen, and hide nothing; and however they and the sun are sampled, the
// mean is the same.
#include "cli/render_scene.h"
#include "error.h"
#include "scenes.h"
#include "support/command.h"
#include "support/gltf_cases.h"

using namespace vndf;
using namespace vndf::test;

namespace {

using render::PunctualLight;

constexpr double pi = std::numbers::pi;

PunctualLight sphere(render::Vec place, float radius, float candela) {
    PunctualLight light;
    light.place = place;
    light.radius = radius;
    light.intensity = candela;
    return light;
}

// A matt floor in the dark, seen from above at a point.
render::Scene lit_floor(const PunctualLight& light) {
    render::Scene scene;
    scene.name = "floor under a sphere";
    scene.add_square(-50, -50, 50, 50, scene.add_material(render::lambert({0.5f, 0.5f, 0.5f})));
    scene.sky = render::constant_sky(0);
    scene.camera = {{0, 0.2f, 0}, {0, 0, 0}, 1e-4f, {0, 0, -1}};
    scene.lights.push_back(light);
    return scene;
}

Rendered by(const std::string& choice, render::Scene scene, unsigned size, unsigned samples) {
    Rendered r = rendered(std::move(scene), size, size, samples);
    r.choices.lights_by = choice;
    r.settings.samples_caps = choice != "bsdf";
    r.settings.max_bounces = 1;
    return r;
}

double irradiance(const render::Scene& scene, const std::string& choice) {
    const render::Image image = by(choice, scene, 8, choice == "bsdf" ? 1024 : 128).image();
    CHECK(image.bad_pixels == 0);
    return mean(image) * pi / 0.5;
}

}  // namespace

TEST_CASE(
    "a sphere above the horizon lights a surface as its point does, however large and however it is "
    "sampled") {
    const double slanting = std::sqrt(0.5);
    for (const std::string& choice : render::lights_by()) {
        CAPTURE(choice);
        const double noise = choice == "bsdf" ? 3e-2 : 4e-3;
        CHECK(irradiance(lit_floor(sphere({2, 2, 0}, 1.4f, 8)), choice) ==
              Catch::Approx(slanting).epsilon(noise));
        if (choice == "bsdf") continue;  // smaller ones are met too seldom
        CHECK(irradiance(lit_floor(sphere({2, 2, 0}, 0.5f, 8)), choice) ==
              Catch::Approx(slanting).epsilon(noise));
        CHECK(irradiance(lit_floor(sphere({0, 2, 0}, 1e-3f, 8)), choice) == Catch::Approx(2).epsilon(1e-3));
        CHECK(irradiance(lit_floor(sphere({0, 2e3f, 0}, 1, 8e6f)), choice) == Catch::Approx(2).epsilon(1e-3));
    }
}

TEST_CASE("a sphere keeps a spot's cone, and shines outwards alone") {
    const auto spot = [](double angle) {
        PunctualLight light = sphere({0, 2, 0}, 0.25f, 8);
        light.kind = PunctualLight::Kind::spot;
        light.direction = {static_cast<float>(std::sin(angle)), static_cast<float>(-std::cos(angle)), 0};
        light.inner_angle = 0.2f, light.outer_angle = 0.5f;
        return irradiance(lit_floor(light), "mis");
    };
    CHECK(spot(0.1) == Catch::Approx(2).epsilon(4e-3));
    CHECK(spot(0.6) == 0);
    const double between = (std::cos(0.35) - std::cos(0.5)) / (std::cos(0.2) - std::cos(0.5));
    CHECK(spot(0.35) == Catch::Approx(2 * between * between).epsilon(4e-3));
    for (const std::string& choice : render::lights_by())
        CHECK(irradiance(lit_floor(sphere({0, 2, 0}, 3, 8)), choice) == 0);
    // One without a place has no radius.
    PunctualLight far = sphere({}, 3, 2);
    far.kind = PunctualLight::Kind::directional;
    far.direction = {0, -1, 0};
    CHECK(irradiance(lit_floor(far), "mis") == Catch::Approx(2).epsilon(1e-3));
}

TEST_CASE("a sphere is seen where nothing is before it, with its radiance, and hides nothing") {
    const auto seen = [](float place, const std::string& choice, float second = 0) {
        render::Scene scene = lit_floor(sphere({0, place, 0}, 0.05f, 8));
        if (second > 0) scene.lights.push_back(sphere({0, place, 0}, second, 4));
        scene.materials[0].albedo = {};
        scene.camera.width = 1e-3f;
        return mean(by(choice, scene, 4, 4).image());
    };
    const double radiance = 8 / (pi * 0.05 * 0.05);
    for (const std::string& choice : render::lights_by()) {
        CAPTURE(choice);
        CHECK(seen(0.1f, choice) == Catch::Approx(radiance).epsilon(1e-5));
        CHECK(seen(-1, choice) == 0);     // below the floor
        CHECK(seen(0.2f, choice) == 0);   // around the eye
        CHECK(seen(0.35f, choice) == 0);  // behind it
        // One in another: both.
        CHECK(seen(0.1f, choice, 0.02f) == Catch::Approx(radiance + 4 / (pi * 0.02 * 0.02)).epsilon(1e-5));
    }
}

namespace {

// Strips of materials under two spheres, one of them a spot near the horizon, a sun and a sky, and a bar in the way of some of it.
const std::vector<render::Material>& strips() {
    static const std::vector<render::Material> all{
        render::conductor({0.9f, 0.7f, 0.4f}, 0.1f, 0.1f),
        render::conductor({0.9f, 0.9f, 0.9f}, 0.15f, 0.6f),
        render::conductor({0.9f, 0.9f, 0.9f}, 0.015f, 0.015f),
        render::plastic({0.5f, 0.2f, 0.1f}, 0.15f),
        render::rough(render::lambert({0.5f, 0.5f, 0.5f}), 0.5f),
        render::coated(render::lambert({0.4f, 0.1f, 0.1f}), 1, 0.1f),
        render::glass(1.5f, 0.2f)};
    return all;
}

render::Scene strips_scene() {
    render::Scene scene;
    scene.name = "strips under caps";
    for (std::size_t i = 0; i < strips().size(); ++i)
        scene.add_square(static_cast<float>(i), -0.5f, static_cast<float>(i) + 1, 0.5f,
                         scene.add_material(strips()[i]));
    const auto bar = static_cast<std::uint32_t>(scene.vertices.size());
    scene.add_square(-20, -6, 20, -5, scene.add_material(render::lambert({})));
    for (std::size_t k = bar; k < scene.vertices.size(); ++k) scene.vertices[k].place[1] = 5;
    scene.open = true;
    PunctualLight spot = sphere({3, 1.5f, -9}, 2, 400);
    spot.kind = PunctualLight::Kind::spot;
    spot.direction = {0, -0.16f, 0.987f};
    spot.outer_angle = 0.8f;
    scene.lights = {sphere({3, 9, -9}, 2.5f, 300), spot};
    scene.sky = render::day_sky();
    scene.sky.zenith = scene.sky.horizon = scene.sky.ground = {0.05f, 0.05f, 0.05f};
    scene.sky.to_sun = {0.2f, 0.6f, -0.7746f};
    scene.sky.sun_radius = 0.15f;
    scene.sky.sun = {40, 40, 30};
    const auto count = static_cast<float>(strips().size());
    scene.camera = {{count / 2, 6, 6}, {count / 2, 0, 0}, 1, {0, 1, 0}, 0.1f * count, true};
    return scene;
}

// Of the pixels of a strip, the mean of one image less another over that of the first, and its standard error.
struct Difference {
    double mean, error;
};
Difference difference(const render::Image& a, const render::Image& b, std::size_t strip) {
    const unsigned columns = a.width / static_cast<unsigned>(strips().size());
    double sum = 0, square = 0, of_a = 0, pixels = 0;
    for (unsigned y = 0; y < a.height; ++y)
        for (unsigned x = 1; x + 1 < columns; ++x) {
            const std::size_t at = 3 * (y * a.width + strip * columns + x) + 1;
            const double d = static_cast<double>(a.pixels[at]) - b.pixels[at];
            sum += d, square += d * d, of_a += a.pixels[at], ++pixels;
        }
    const double mean = sum / pixels;
    return {sum / of_a, std::sqrt((square / pixels - mean * mean) / pixels) / (of_a / pixels)};
}

// error: that every standard error is below, so that mistakes of some times as much are noticed.
void check_means(unsigned samples, double error) {
    const auto image = [&](const std::string& choice, std::uint64_t seed) {
        const auto count = static_cast<unsigned>(strips().size());
        Rendered r = by(choice, strips_scene(), 20 * count, samples);
        r.settings.height = 2 * count;
        r.settings.max_bounces = 2;
        r.settings.seed = seed;
        return r.image();
    };
    const render::Image mis = image("mis", 1);
    std::uint64_t seed = 1;
    for (const std::string choice : {"cap", "bsdf", "cones"}) {
        const render::Image other = image(choice, ++seed);
        CHECK(other.bad_pixels == 0);
        for (std::size_t strip = 0; strip < strips().size(); ++strip) {
            const Difference d = difference(mis, other, strip);
            CAPTURE(choice, strip, d.mean, d.error);
            CHECK(std::abs(d.mean) < 4.5 * d.error);
            CHECK(d.error < error);
        }
    }
}

}  // namespace

TEST_CASE(
    "by caps, by materials, by both and by cones: the same mean on every material, within standard errors") {
    check_means(64, 0.15);
}

// By hand, some minutes.
TEST_CASE("the same with many samples", "[.spheres-full]") {
    check_means(2048, 0.03);
}

TEST_CASE("--light-radius makes spheres of lights that have a place, and hangs some over the orbs") {
    const auto on = [](const render::Scene& scene, const std::string& name) {
        const auto effects = render::effects_for(scene, "auto");
        return std::any_of(effects.begin(), effects.end(),
                           [&](const render::Effect& e) { return e.name == name && e.on; });
    };
    cli::SceneOptions options;
    CHECK(cli::shown_scene(options).scene.lights.empty());
    options.light_radius = 0.25f;
    const render::Scene orbs = cli::shown_scene(options).scene;
    CHECK(orbs.lights.size() == 4);
    CHECK((on(orbs, "sphere_light") && !on(orbs, "point_light") && !on(orbs, "sun")));
    const Folder folder;
    GltfFile file = triangle_file();
    folder.write("dark.gltf", file.gltf());
    file.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}},
                                                                {{"type", "directional"}}};
    for (const int light : {0, 1}) {
        file.json["scenes"][0]["nodes"].push_back(file.json["nodes"].size());
        file.json["nodes"].push_back({{"extensions", {{"KHR_lights_punctual", {{"light", light}}}}}});
    }
    folder.write("lit.gltf", file.gltf());
    options.file = (folder / "lit.gltf").string();
    options.light_radius = 0;
    CHECK_FALSE(on(cli::shown_scene(options).scene, "sphere_light"));
    options.light_radius = 0.25f;
    const render::Scene lit = cli::shown_scene(options).scene;
    CHECK((on(lit, "sphere_light") && on(lit, "point_light") && lit.lights.size() == 2));
    options.file = (folder / "dark.gltf").string();
    CHECK(cli::shown_scene(options).warnings.back().first == "--light-radius: no point or spot light");
}

TEST_CASE("cones are GGX's alone") {
    Rendered r = by("cones", lit_floor(sphere({0, 2, 0}, 1, 1)), 4, 1);
    r.choices.ndf = "beckmann", r.choices.sampler = "plain";
    CHECK_THROWS_AS(r.switches(), InputError);
}
