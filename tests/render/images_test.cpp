// Images are right: scenes with a known answer, samplers that agree, errors that fall as they must. The script
// tests/render_images.sh runs the same with more samples.
#include <cstdlib>

#include "error.h"
#include "render/gltf.h"
#include "scenes.h"

using namespace vndf;
using namespace vndf::test;

namespace {

// As many times the samples as the quick form.
unsigned effort() {
    const char* const variable = std::getenv("CLVNDF_EFFORT");
    return variable ? static_cast<unsigned>(std::atoi(variable)) : 1;
}

render::Material mirror(float alpha_x, float alpha_y) {
    return render::conductor({1, 1, 1}, alpha_x, alpha_y);
}

// The slope of log(error) over log(samples) by least squares.
double slope(const Rendered& r, double value, std::initializer_list<unsigned> samples) {
    double n = 0, x = 0, y = 0, xx = 0, xy = 0;
    for (const unsigned count : samples) {
        Rendered part = r;
        part.samples = count;
        const double a = std::log(count), b = std::log(rms_from(part.image(), value));
        n += 1, x += a, y += b, xx += a * a, xy += a * b;
    }
    return (n * xy - x * y) / (n * xx - x * x);
}

constexpr double bend = 0.4;  // radians by which normals are turned towards the light

// A white ball seen from afar and lit from the right by a small sun, with normals as a normal map would bend them.
Rendered bent_ball(const std::string& effects) {
    render::Scene scene;
    scene.name = "bent ball";
    scene.add_sphere({0, 0, 0}, 1, 200, render::lambert({1, 1, 1}));
    for (render::Vertex& v : scene.vertices) {
        const double x = v.normal[0], z = v.normal[2];
        v.normal[0] = static_cast<float>(std::cos(bend) * x + std::sin(bend) * z);
        v.normal[2] = static_cast<float>(std::cos(bend) * z - std::sin(bend) * x);
    }
    scene.sky = render::constant_sky(0);
    scene.sky.sun_share = 1;
    scene.sky.sun_radius = 0.005f;
    const auto sun = static_cast<float>(1 / std::pow(std::sin(0.005), 2));
    scene.sky.sun = {sun, sun, sun};  // a surface that faces it has the radiance 1
    scene.sky.to_sun = {1, 0, 0};
    scene.camera = {{0, 0, 2000}, {0, 0, 0}, 1e-3f};
    Rendered r = rendered(scene, 64, 64, 16 * effort());
    r.effects = effects;
    r.settings.max_bounces = 1;
    return r;
}

// Of the pixels on the ball's middle: the largest step from one to the next, and the largest distance from what Chiang et al.
// have there (kernels/vndf/bsdf.h).
std::pair<double, double> terminator_of(const render::Image& image) {
    double step = 0, off = 0;
    for (unsigned row = 24; row < 40; ++row)
        for (unsigned column = 12; column < 52; ++column) {
            const float* const pixel = &image.pixels[3 * (row * 64 + column)];
            step = std::max(step, std::abs(static_cast<double>(pixel[3]) - pixel[0]));
            const double x = (column + 0.5) / 32 - 1, y = 1 - (row + 0.5) / 32,
                         z = std::sqrt(1 - x * x - y * y);
            const double normal = std::cos(bend) * x + std::sin(bend) * z,
                         both = std::cos(bend) * (1 - y * y) + y * y;
            const double g = std::clamp(x / (normal * both), 0.0, 1.0);
            off = std::max(off, std::abs(pixel[0] - std::max(normal, 0.0) * (g + g * g - g * g * g)));
        }
    return {step, off};
}

}  // namespace

TEST_CASE("the analytic albedo is what is known of it") {
    CHECK(ggx_albedo(1e-3, 1.0) == Catch::Approx(1).margin(1e-3));
    CHECK(ggx_albedo(0.6, 70 * std::numbers::pi / 180) == Catch::Approx(0.691).margin(5e-3));
}

TEST_CASE("a white furnace reflects the analytic albedo within 1e-3") {
    for (const auto& [alpha, degrees] : {std::pair{0.1f, 70.0}, {0.6f, 45.0}, {1.0f, 60.0}}) {
        CAPTURE(alpha, degrees);
        const double theta = degrees * std::numbers::pi / 180;
        const Rendered r = rendered(floor_of(mirror(alpha, alpha), theta), 32, 32, 64 * effort());
        CHECK(mean(r.image()) == Catch::Approx(ggx_albedo(alpha, theta)).epsilon(0).margin(1e-3));
    }
    const Rendered matt = rendered(floor_of(render::lambert({0.5f, 0.5f, 0.5f}), 0.5), 16, 16, 16 * effort());
    CHECK(mean(matt.image()) == Catch::Approx(0.5).epsilon(0).margin(1e-3));
}

// Of a smooth dielectric, by Fresnel's amplitudes.
double fresnel(double cosine, double eta) {
    const double behind = std::sqrt(1 - (1 - cosine * cosine) / (eta * eta));
    const double s = (cosine - eta * behind) / (cosine + eta * behind),
                 p = (eta * cosine - behind) / (eta * cosine + behind);
    return (s * s + p * p) / 2;
}

TEST_CASE("smooth glass in a white furnace is Fresnel's, and a ball of it is not to be seen") {
    const double theta = 1.1, eta = 1.5, f = fresnel(std::cos(theta), eta);
    for (const std::string sampler : {"plain", "bounded", "conic"}) {
        CAPTURE(sampler);
        Rendered r = rendered(floor_of(render::glass(1.5f, 1e-3f), theta), 16, 16, 64 * effort());
        r.choices.sampler = sampler;
        // Light from the denser medium is spread over more directions.
        CHECK(mean(r.image()) == Catch::Approx(f + (1 - f) / (eta * eta)).epsilon(0).margin(2e-3));

        render::Scene scene;
        scene.name = "ball";
        scene.sky = render::constant_sky(1);
        scene.add_sphere({0, 0, 0}, 1, 128, render::glass(1.5f, 1e-3f));
        scene.camera = {{0, 0.3f, 20}, {0, 0, 0}, 0.08f};
        Rendered ball = rendered(scene, 24, 24, 16 * effort());
        ball.choices.sampler = sampler;
        ball.settings.max_bounces = 32;
        CHECK(mean(ball.image()) == Catch::Approx(1).epsilon(0).margin(5e-3));
    }
}

// A slab of 2 units between two planes, seen from above.
render::Scene slab_of(const render::Material& material) {
    render::Scene scene;
    scene.name = "slab";
    const std::uint32_t number = scene.add_material(material);
    scene.add_square(-500, -500, 500, 500, number);
    scene.add_square(-500, -500, 500, 500, number);
    for (std::size_t i = 4; i < 8; ++i) scene.vertices[i].place[1] = -2, scene.vertices[i].normal[1] = -1;
    for (std::size_t i = 2; i < 4; ++i)
        std::swap(scene.triangles[i].corners[1], scene.triangles[i].corners[2]);
    scene.sky = render::constant_sky(1);
    return scene;
}

TEST_CASE("a slab absorbs what Beer's law says, pixel by pixel") {
    render::Material clear = render::glass(1, 0.3f);
    clear.absorption = {0.1f, 0.5f, 0};
    render::Scene scene = slab_of(clear);
    scene.camera = {{0, 10, 0.01f}, {0, 0, 0}, 3};
    const Rendered r = rendered(scene, 32, 32, 16 * effort());
    const render::Image image = r.image();
    double worst = 0;
    for (unsigned row = 0; row < 32; ++row)
        for (unsigned column = 0; column < 32; ++column) {
            // The mean over the pixel, of the way at its 4 x 4 parts.
            double expected[3] = {};
            for (int part = 0; part < 16; ++part) {
                const double x = 1.5 * (2 * (column + (part % 4 + .5) / 4) / 32 - 1),
                             y = 1.5 * (1 - 2 * (row + (part / 4 + .5) / 4) / 32);
                for (int c = 0; c < 3; ++c)
                    expected[c] += std::exp(-2 * clear.absorption[c] * std::sqrt(1 + x * x + y * y)) / 16;
            }
            for (int c = 0; c < 3; ++c)
                worst = std::max(worst, std::abs(image.pixels[3 * (32 * row + column) + c] - expected[c]));
        }
    CHECK(worst < 2e-3);

    // Smooth glass: F, and what goes in and out, with any number of reflections between.
    const double theta = 1, eta = 1.5, f = fresnel(std::cos(theta), eta),
                 way = 2 / std::sqrt(1 - std::pow(std::sin(theta) / eta, 2));
    render::Material glass = render::glass(1.5f, 1e-3f);
    glass.absorption = clear.absorption;
    Rendered seen = rendered(slab_of(glass), 16, 16, 64 * effort());
    seen.scene.camera = {
        {20 * static_cast<float>(std::sin(theta)), 20 * static_cast<float>(std::cos(theta)), 0.013f},
        {0, 0, 0.013f},
        1e-3f};
    seen.settings.max_bounces = 32;
    const std::array<double, 3> found = means(seen.image());
    for (int c = 0; c < 3; ++c) {
        const double left = std::exp(-clear.absorption[c] * way);
        CHECK(found[c] ==
              Catch::Approx(f + (1 - f) * (1 - f) * left / (1 - f * left)).epsilon(0).margin(4e-3));
    }
}

TEST_CASE("glass with a dispersion is Fresnel's for each channel, and takes no light") {
    const double theta = 1.1;
    render::Material glass = render::glass(1.5f, 1e-3f);
    glass.dispersion = 2;  // Abbe's number 10
    for (const std::string random : {"sobol", "philox"}) {
        Rendered r = rendered(floor_of(glass, theta), 32, 32, 256 * effort());
        r.choices.random = random;
        r.settings.random = random == "sobol" ? render::Random::sobol : render::Random::philox;
        const std::array<double, 3> found = means(r.image());
        // Over the difference of the indices at Fraunhofer's lines C, d, F that is 1 / 10 of eta - 1.
        const double f2 = std::pow(486.13, -2), c2 = std::pow(656.27, -2), d2 = std::pow(587.56, -2);
        const double lines[3] = {c2, d2, f2};
        for (int c = 0; c < 3; ++c) {
            const double eta = 1.5 + .05 * (lines[c] - d2) / (f2 - c2), f = fresnel(std::cos(theta), eta);
            CAPTURE(random, c);
            CHECK(found[c] == Catch::Approx(f + (1 - f) / (eta * eta)).epsilon(0).margin(3e-3));
        }
    }
    render::Scene scene;
    scene.name = "ball";
    scene.sky = render::constant_sky(1);
    scene.add_sphere({0, 0, 0}, 1, 128, glass);
    scene.camera = {{0, 0.3f, 20}, {0, 0, 0}, 0.08f};
    Rendered ball = rendered(scene, 24, 24, 64 * effort());
    ball.settings.max_bounces = 32;
    for (const double x : means(ball.image())) CHECK(x == Catch::Approx(1).epsilon(0).margin(1e-2));
}

TEST_CASE("a white ball under smooth plastic reflects what there is") {
    Rendered r = rendered(floor_of(render::plastic({1, 1, 1}, 1e-3f), 0.7), 32, 32, 64 * effort());
    CHECK(mean(r.image()) == Catch::Approx(1).epsilon(0).margin(3e-3));
}

TEST_CASE("what shines by itself is as bright as it is said to be, and lights what is beside it") {
    render::Material lamp = render::lambert({0, 0, 0});
    lamp.emission = {2, 0.5f, 0.25f};
    Rendered r = rendered(floor_of(lamp, 0.4), 8, 8, 4);
    r.scene.sky = render::constant_sky(0);
    const render::Image image = r.image();
    for (int c = 0; c < 3; ++c) CHECK(image.pixels[c] == lamp.emission[c]);
    // Of a floor in the middle of a great lamp that is all the sky it sees.
    render::Scene scene = floor_of(render::lambert({0.5f, 0.5f, 0.5f}), 0.4);
    scene.sky = render::constant_sky(0);
    render::Material shell = render::lambert({0, 0, 0});
    shell.emission = {1, 1, 1};
    scene.add_sphere({0, 0, 0}, 300, 64, shell);
    CHECK(mean(rendered(scene, 16, 16, 64 * effort()).image()) == Catch::Approx(0.5).epsilon(0).margin(2e-3));
}

TEST_CASE("a material of glTF is the renderer's by the formulas of its extensions") {
    render::GltfMaterial gltf;
    gltf.base_colour = {0.2f, 0.4f, 0.6f};
    gltf.metallic = 0.25f, gltf.roughness = 0.5f, gltf.anisotropy = 0.6f;
    gltf.clearcoat = 0.75f, gltf.clearcoat_roughness = 0.2f;
    gltf.emissive = {1, 0.5f, 0}, gltf.emissive_strength = 4;
    const render::Material m = render::material_of(gltf);
    CHECK(m.alpha_y == 0.25f);
    CHECK(m.alpha_x == Catch::Approx(0.25 + 0.75 * 0.36));
    CHECK(m.metal == 0.25f);
    CHECK(m.ior == 1.5f);
    CHECK((m.first == gltf.base_colour && m.albedo == gltf.base_colour));
    CHECK(m.coat == 0.75f);
    CHECK(m.coat_alpha == Catch::Approx(0.04));
    CHECK(m.emission == render::Vec{4, 2, 0});
    gltf.dispersion = .2f;
    CHECK(render::material_of(gltf).absorption == render::Vec{0, 0, 0});
    gltf.attenuation_colour = {.5f, 1, .25f};
    gltf.attenuation_distance = 2;
    const render::Material body = render::material_of(gltf);
    CHECK(body.dispersion == .2f);
    CHECK(body.absorption[0] == Catch::Approx(std::log(2) / 2));
    CHECK(body.absorption[1] == 0);
    CHECK(body.absorption[2] == Catch::Approx(std::log(2)));
    gltf.specular = 0.5f, gltf.specular_colour = {3, 1, 0}, gltf.transmission = 1, gltf.thin_walled = true;
    const render::Material pane = render::material_of(gltf);
    CHECK((pane.specular == 0.5f && pane.specular_colour == gltf.specular_colour));
    CHECK((pane.thin_walled && pane.transmission == 1 && pane.ior == 1.5f));
    CHECK(pane.transmittance == gltf.base_colour);
    gltf.ior = 0;
    CHECK(render::material_of(gltf).ior == 1000);
}

TEST_CASE(
    "a smooth interface reflects what glTF's specular and its colour say, and what gets in comes back from "
    "white") {
    const double theta = 0.7, rise = std::pow((1.5 - 1) / (1.5 + 1), 2.0), f = fresnel(std::cos(theta), 1.5);
    render::Material paint = render::plastic({0, 0, 0}, 1e-3f);
    paint.specular = 0.8f, paint.specular_colour = {0, 1, 12};
    const auto found = means(rendered(floor_of(paint, theta), 32, 32, 64 * effort()).image());
    for (int c = 0; c < 3; ++c) {
        const double f0 = std::min(rise * paint.specular_colour[c], 1.0);
        CAPTURE(c);
        CHECK(found[c] ==
              Catch::Approx(0.8 * (f0 + (1 - f0) * (f - rise) / (1 - rise))).epsilon(0).margin(2e-3));
    }
    paint.albedo = {1, 1, 1};
    // All of the brightest channel.
    const auto white = means(rendered(floor_of(paint, theta), 32, 32, 64 * effort()).image());
    CHECK(white[2] == Catch::Approx(1).epsilon(0).margin(4e-3));
}

TEST_CASE("through a thin wall light goes straight, and it is in no body behind") {
    render::Material pane = render::glass(1.5f, 1e-3f);
    pane.thin_walled = true, pane.absorption = {1, 1, 1}, pane.transmittance = {0.5f, 1, 0.25f};
    const double theta = 0.6, f = fresnel(std::cos(theta), 1.5);
    Rendered r = rendered(floor_of(pane, theta), 16, 16, 64 * effort());
    const render::Image lean = r.image();
    const auto found = means(lean);
    for (int c = 0; c < 3; ++c) {
        CAPTURE(c);
        CHECK(found[c] == Catch::Approx(f + (1 - f) * pane.transmittance[c]).epsilon(0).margin(3e-3));
    }
    // With bodies counted, too: of what is behind a body of this absorption nothing is left.
    r.effects = "all";
    CHECK(r.image().pixels == lean.pixels);
    r.scene.materials[0].thin_walled = false;
    CHECK(means(r.image())[1] == Catch::Approx(f).epsilon(0).margin(3e-3));
}

TEST_CASE("a white rough diffuse floor reflects everything") {
    const render::Material white = render::rough(render::lambert({1, 1, 1}), 1);
    CHECK(mean(rendered(floor_of(white, 1.2), 32, 32, 64 * effort()).image()) ==
          Catch::Approx(1).epsilon(0).margin(3e-3));
}

TEST_CASE(
    "a coat in a furnace reflects by itself what Fresnel says, and over white hardly more than there is") {
    const double theta = 1.1, f = fresnel(std::cos(theta), 1.5);
    const auto reflected = [&](const render::Material& base) {
        return mean(rendered(floor_of(render::coated(base, 1, 1e-3f), theta), 32, 32, 64 * effort()).image());
    };
    CHECK(reflected(render::lambert({0, 0, 0})) == Catch::Approx(f).epsilon(0).margin(2e-3));
    CHECK(reflected(mirror(1e-3f, 1e-3f)) == Catch::Approx(1).epsilon(0).margin(3e-3));
    const double white = reflected(render::lambert({1, 1, 1}));
    CHECK(white <= 1.002);
    CHECK(white >= 0.94);
}

TEST_CASE("without a coat and roughness a picture is the same to the bit, with their effects or without") {
    Rendered r = rendered(render::orbs("coat"), 48, 20, 4);
    for (render::Material& m : r.scene.materials) m.coat = m.diffuse_roughness = 0;
    const render::Image lean = r.image();
    r.effects = "all";
    CHECK(r.image().pixels == lean.pixels);
    r.scene.materials[0].coat = 1;
    CHECK(r.image().pixels != lean.pixels);
}

TEST_CASE("a furnace never gives more than it gets") {
    Rendered r = rendered(render::orbs("roughness"), 64, 32, 16 * effort());
    r.scene.sky = render::constant_sky(1);
    for (render::Material& m : r.scene.materials) m.first = m.albedo = {1, 1, 1};
    r.settings.max_bounces = 32;
    const render::Image image = r.image();
    CHECK(image.bad_pixels == 0);
    CHECK(mean(image) < 1.001);
    CHECK(mean(image) > 0.9);  // white throughout, but for what microfacets lose
}

TEST_CASE("direct light has its closed form") {
    const float albedo = 0.8f;
    render::Scene scene = floor_of(render::lambert({albedo, albedo, albedo}), 0.3);
    scene.sky = render::constant_sky(0);
    scene.sky.sun_share = 1;
    scene.sky.sun = {100, 100, 100};
    scene.sky.sun_radius = 0.1f;
    scene.sky.to_sun = {0.6f, 0.8f, 0};
    // The sun, all of it above the horizon: an irradiance of pi L sin^2(radius) cos(theta).
    const double sun = albedo * 100 * std::pow(std::sin(0.1), 2) * 0.8;
    CHECK(mean(rendered(scene, 16, 16, 64 * effort()).image()) == Catch::Approx(sun).epsilon(1e-3));

    // A white sky and a black ball before it, whole above the horizon: the ball's form factor is (radius / distance)^2 cos.
    render::Scene shaded = floor_of(render::lambert({albedo, albedo, albedo}), 0.3);
    shaded.add_sphere({0, 3, 4.013f}, 1.5f, 128, render::lambert({0, 0, 0}));
    const double ball = 1.5 * 1.5 / 25 * 0.6;
    CHECK(mean(rendered(shaded, 32, 32, 64 * effort()).image()) ==
          Catch::Approx(albedo * (1 - ball)).epsilon(1e-3));
}

TEST_CASE("the shadow terminator is an edge without its effect, and fades as published with it") {
    const auto [edge, without] = terminator_of(bent_ball("lambert,shading_normal").image());
    CHECK(edge > 0.9 * std::sin(bend));
    CHECK(without > 0.9 * std::sin(bend));
    const auto [step, off] = terminator_of(bent_ball("lambert,shading_normal,terminator").image());
    CHECK(step < 0.06);
    CHECK(off < 0.01);
}

namespace {

// The mean of a picture over seeds, and its standard error.
struct Mean {
    double value, error;
};
Mean mean_of(Rendered r, const std::string& ndf, const std::string& sampler, int seeds) {
    r.scene.sky.zenith = {0.1f, 0.2f, 0.6f};
    r.scene.sky.horizon = {0.9f, 0.8f, 0.7f};
    r.scene.sky.sun_share = 0.3f;
    r.scene.sky.sun = {40, 40, 40};
    r.scene.sky.sun_radius = 0.15f;
    r.scene.sky.to_sun = {-0.6f, 0.64f, 0.48f};
    r.choices.ndf = ndf;
    r.choices.sampler = sampler;
    r.choices.random = "philox";
    r.settings.random = render::Random::philox;
    double sum = 0, square = 0;
    const auto stages =
        render::device_stages(runtime::choose_device().device, runtime::Math::strict, r.switches());
    for (int seed = 1; seed <= seeds; ++seed) {
        r.settings.seed = static_cast<std::uint64_t>(seed);
        const double value = mean(r.on(*stages));
        sum += value;
        square += value * value;
    }
    const double average = sum / seeds;
    return {average, std::sqrt(std::max(0.0, square / seeds - average * average) / (seeds - 1))};
}

}  // namespace

TEST_CASE("every sampler draws the same image") {
    constexpr int seeds = 8;
    for (const std::string ndf : {"ggx", "beckmann"}) {
        const Rendered r = rendered(floor_of(mirror(0.3f, 0.6f), 0.9), 24, 24, 16 * effort());
        const Mean first = mean_of(r, ndf, "plain", seeds);
        for (const std::string sampler : {"bounded", "conic", "ndf", "cosine"}) {
            if (ndf == "beckmann" && (sampler == "bounded" || sampler == "conic")) continue;
            CAPTURE(ndf, sampler);
            const Mean other = mean_of(r, ndf, sampler, seeds);
            // Student's t with 14 degrees of freedom: 1e-6 for five comparisons.
            CHECK(std::abs(other.value - first.value) < 8.5 * std::hypot(other.error, first.error));
            // And the comparison is a sharp one.
            CHECK(other.error < 0.02 * other.value);
        }
    }
}

// The floor's shading normals lean away from the camera by 30 degrees, which turns half of a narrow lobe below the floor.
TEST_CASE("with shading normals that lean tilted sampling draws the same image") {
    constexpr int seeds = 8;
    Rendered r = rendered(floor_of(mirror(0.1f, 0.1f), 1.2), 24, 24, 16 * effort());
    for (render::Vertex& v : r.scene.vertices) v.normal = {-0.5f, std::sqrt(0.75f), 0};
    const Mean first = mean_of(r, "ggx", "plain", seeds), tilted = mean_of(r, "ggx", "tilted", seeds);
    CAPTURE(first.value, first.error, tilted.value, tilted.error);
    CHECK(std::abs(tilted.value - first.value) < 8.5 * std::hypot(tilted.error, first.error));
    CHECK(first.error < 0.02 * first.value);
    CHECK(tilted.error < 0.02 * tilted.value);

    // Under an even sky, where what is lost is most of the noise: the same after half of the samples.
    r.scene.sky = render::constant_sky(1);
    r.choices.random = "philox";
    r.settings.random = render::Random::philox;
    r.samples = 64 * effort();
    const auto noise = [&](const char* sampler) {
        r.choices.sampler = sampler;
        return r.image().error;
    };
    CHECK(noise("tilted") < 0.75 * noise("conic"));
}

TEST_CASE("errors fall with the root of the number of samples, and faster with Sobol's") {
    const double theta = 0.8;
    Rendered r = rendered(floor_of(mirror(0.6f, 0.6f), theta), 32, 32, 0);
    const double value = ggx_albedo(0.6, theta);
    r.choices.random = "philox";
    r.settings.random = render::Random::philox;
    CHECK(slope(r, value, {4, 16, 64, 256}) == Catch::Approx(-0.5).margin(0.05));
    r.choices.random = "sobol";
    r.settings.random = render::Random::sobol;
    CHECK(slope(r, value, {4, 16, 64, 256}) < -0.6);
}

TEST_CASE("the estimated error is near the error") {
    Rendered r = rendered(floor_of(mirror(0.6f, 0.6f), 0.8), 32, 32, 64);
    r.choices.random = "philox";
    r.settings.random = render::Random::philox;
    const render::Image image = r.image();
    const double value = ggx_albedo(0.6, 0.8), error = rms_from(image, value) / value;
    CHECK(image.error > error / 1.2);
    CHECK(image.error < error * 1.2);
}

TEST_CASE("what is no number is counted, and left out of the image") {
    Rendered r = rendered(floor_of(render::lambert({NAN, 0.5f, 0.5f}), 0.3), 8, 8, 4);
    const render::Image image = r.image();
    CHECK(image.bad_pixels == 64);
    CHECK(image.bad_samples == 256);
    for (const float x : image.pixels) CHECK(std::isfinite(x));
    r.scene.materials[0].albedo[0] = 0.5f;
    CHECK(r.image().bad_pixels == 0);
}

TEST_CASE("hard materials make no pixel that is no number") {
    Rendered r = rendered(render::orbs("roughness"), 48, 20, 8 * effort());
    const float alphas[] = {1e-8f, 1e-4f, 1e-2f, 3.0f, 1e3f};
    for (int i = 0; i < 5; ++i) {
        r.scene.materials[i].alpha_x = alphas[i];
        r.scene.materials[i].alpha_y = alphas[4 - i];
    }
    for (const std::string sampler : {"bounded", "conic", "tilted"}) {
        CAPTURE(sampler);
        r.choices.sampler = sampler;
        CHECK(r.image().bad_pixels == 0);
    }
}

TEST_CASE("a mesh that Embree would end the process for is refused") {
    for (const float bad : {NAN, INFINITY, 1e20f}) {
        render::Scene scene = floor_of(render::lambert({1, 1, 1}), 0.1);
        scene.vertices[1].place[2] = bad;
        CHECK_THROWS_AS(render::build_tree(scene), InputError);
    }
    // Nothing at all is a scene, too: the sky.
    Rendered empty;
    empty.scene.sky = render::constant_sky(0.25f);
    empty.scene.materials.push_back(render::lambert({1, 1, 1}));
    empty.scene.vertices.resize(1);
    empty.scene.triangles.resize(1);
    empty.settings.width = empty.settings.height = 4;
    empty.samples = 1;
    CHECK(mean(empty.image()) == 0.25);
}
