// What is drawn on surfaces is where it belongs: textures, their transforms and edges, colours of vertices, normal maps, alpha,
// anisotropy turned; by pixel, on a square seen from straight above.
#include "scenes.h"

using namespace vndf;
using namespace vndf::test;

namespace {

constexpr unsigned side = 16;

std::uint32_t texel(unsigned r, unsigned g, unsigned b, unsigned a = 255) {
    return r | g << 8 | b << 16 | a << 24;
}

double srgb(unsigned byte) {
    const double x = byte / 255.0;
    return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
}

// A square of 2 x 2 at the height `height`, u along x and v along z from the corner where both are least.
void add_tile(render::Scene& scene, const render::GltfMaterial& factors, float height = 0) {
    const auto first = static_cast<std::uint32_t>(scene.vertices.size());
    for (const auto& [u, v] : {std::pair{0.0f, 0.0f}, {1.0f, 0.0f}, {1.0f, 1.0f}, {0.0f, 1.0f}}) {
        render::Vertex vertex{{2 * u - 1, height, 2 * v - 1}, {0, 1, 0}};
        // The bitangent, normal x tangent, is what is up in a picture: it runs against v.
        vertex.tangent = {1, 0, 0, 1};
        vertex.uv = {{{u, v}, {v, u}}};
        scene.vertices.push_back(vertex);
    }
    const std::uint32_t material = scene.add_material(render::material_of(factors));
    scene.dressings.push_back({factors, {}});
    scene.triangles.push_back({{first, first + 2, first + 1}, material});
    scene.triangles.push_back({{first, first + 3, first + 2}, material});
}

render::GltfMaterial matt() {
    render::GltfMaterial m;
    m.metallic = 0;
    m.ior = 1;
    return m;
}

// Seen so that column and row of the image go with u and v.
render::Scene seen_from_above() {
    render::Scene scene;
    scene.name = "tile";
    scene.sky = render::constant_sky(1);
    scene.camera = {{0, 10, 0}, {0, 0, 0}, 2, {0, 0, -1}, 0, true};
    return scene;
}

render::TextureUse& use(render::Scene& scene, render::Slot slot, std::size_t material = 0) {
    return scene.dressings[material].textures[static_cast<std::size_t>(slot)];
}

void add_texture(render::Scene& scene, render::Slot slot, unsigned width, unsigned height,
                 std::vector<std::uint32_t> texels, bool nearest = true) {
    scene.bitmaps.push_back({width, height, std::move(texels)});
    scene.textures.push_back({static_cast<std::uint32_t>(scene.bitmaps.size() - 1), render::Wrap::repeat,
                              render::Wrap::repeat, nearest});
    use(scene, slot).texture = static_cast<std::int32_t>(scene.textures.size() - 1);
}

// 4 x 4, all different.
std::vector<std::uint32_t> patches() {
    std::vector<std::uint32_t> texels;
    for (unsigned i = 0; i < 16; ++i) texels.push_back(texel(16 * i + 15, 255 - 9 * i, (i * 97) % 256));
    return texels;
}

Rendered of(const render::Scene& scene, unsigned samples = 4) {
    return rendered(scene, side, side, samples);
}

const float* at(const render::Image& image, unsigned column, unsigned row) {
    return &image.pixels[3 * (row * side + column)];
}

// The largest difference of a pixel from what expected(u, v) says of its middle.
template <class Expected>
double worst(const render::Image& image, Expected expected) {
    double most = 0;
    for (unsigned row = 0; row < side; ++row)
        for (unsigned column = 0; column < side; ++column) {
            const std::array<double, 3> rgb = expected((column + .5) / side, (row + .5) / side);
            for (int c = 0; c < 3; ++c) most = std::max(most, std::abs(at(image, column, row)[c] - rgb[c]));
        }
    CHECK(image.bad_pixels == 0);
    return most;
}

std::array<double, 3> patch(double u, double v) {
    const auto fold = [](double x) { return static_cast<unsigned>(4 * (x - std::floor(x))); };
    const std::uint32_t t = patches()[4 * fold(v) + fold(u)];
    return {srgb(t & 255), srgb(t >> 8 & 255), srgb(t >> 16 & 255)};
}

}  // namespace

TEST_CASE("a texture's texels are where its coordinates say, decoded from sRGB") {
    render::Scene scene = seen_from_above();
    render::GltfMaterial factors = matt();
    factors.base_colour = {1, 0.5f, 1};
    add_tile(scene, factors);
    add_texture(scene, render::Slot::base_colour, 4, 4, patches());
    const auto halved = [](std::array<double, 3> rgb) {
        rgb[1] /= 2;
        return rgb;
    };
    CHECK(worst(of(scene).image(), [&](double u, double v) { return halved(patch(u, v)); }) < 1e-5);
    SECTION("with the other set of coordinates") {
        use(scene, render::Slot::base_colour).set = 1;
        CHECK(worst(of(scene).image(), [&](double u, double v) { return halved(patch(v, u)); }) < 1e-5);
    }
    SECTION("with a transform, which repeats it") {
        // By a quarter turn, twice as often, moved.
        use(scene, render::Slot::base_colour).transform = {0, 2, 0.25f, -2, 0, 0.5f};
        CHECK(worst(of(scene).image(),
                    [&](double u, double v) { return halved(patch(2 * v + .25, -2 * u + .5)); }) < 1e-5);
    }
    SECTION("held at the edges, or mirrored") {
        use(scene, render::Slot::base_colour).transform = {3, 0, -1, 0, 3, -1};
        scene.textures[0].wrap_s = render::Wrap::clamp;
        scene.textures[0].wrap_t = render::Wrap::mirror;
        const auto image = of(scene, 64).image();
        // A pixel is three quarters of a texel here: those that lie in one count.
        for (const auto& [column, row, u, v] : {std::tuple{0u, 0u, 0.0, 1 - 0.09},
                                                {15u, 8u, 0.999, 0.6},
                                                {2u, 15u, 0.0, 0.09},
                                                {8u, 5u, 0.6, 0.03}})
            for (int c = 0; c < 3; ++c) {
                CAPTURE(column, row, c);
                CHECK(at(image, column, row)[c] == Catch::Approx(halved(patch(u, v))[c]).margin(2e-3));
            }
    }
}

TEST_CASE("between texels a texture is interpolated after decoding") {
    render::Scene scene = seen_from_above();
    add_tile(scene, matt());
    add_texture(scene, render::Slot::base_colour, 2, 2,
                {texel(0, 0, 0), texel(255, 128, 0), texel(0, 0, 0), texel(255, 128, 0)}, false);
    use(scene, render::Slot::base_colour).transform = {0.5f, 0, 0.25f, 0, 1, 0};
    CHECK(worst(of(scene, 64).image(), [](double u, double) {
              return std::array<double, 3>{u, srgb(128) * u, 0};
          }) < 2e-3);
}

TEST_CASE("colours of vertices multiply the texture") {
    render::Scene scene = seen_from_above();
    add_tile(scene, matt());
    add_texture(scene, render::Slot::base_colour, 4, 4, patches());
    for (render::Vertex& v : scene.vertices) v.colour = {v.uv[0][0], 1 - v.uv[0][1], 0.5f, 1};
    CHECK(worst(of(scene, 64).image(), [](double u, double v) {
              auto rgb = patch(u, v);
              rgb[0] *= u, rgb[1] *= 1 - v, rgb[2] *= 0.5;
              return rgb;
          }) < 3e-3);
}

TEST_CASE("what is masked out is not there, and what blends is there in part, for every ray") {
    render::Scene scene = seen_from_above();
    render::GltfMaterial above = matt(), below = matt();
    above.base_colour = {0, 0, 0};
    above.opacity = 0.8f;
    below.base_colour = {0, 0, 0};
    below.emissive = {1, 0.5f, 0.25f};
    add_tile(scene, above, 1);
    add_tile(scene, below, 0);
    add_texture(scene, render::Slot::base_colour, 4, 1,
                {texel(255, 255, 255, 0), texel(255, 255, 255, 120), texel(255, 255, 255, 200),
                 texel(255, 255, 255)});
    const auto shows = [&](auto share) {
        return [=](double u, double) {
            const double x = share(static_cast<unsigned>(4 * u));
            return std::array<double, 3>{x, x / 2, x / 4};
        };
    };
    SECTION("mask") {
        scene.dressings[0].factors.alpha = render::Alpha::mask;
        scene.dressings[0].factors.alpha_cutoff = 0.5f;  // 120 / 255 * .8 lies below, 200 / 255 * .8 above
        CHECK(worst(of(scene).image(), shows([](unsigned i) { return i < 2 ? 1.0 : 0.0; })) < 1e-5);
    }
    SECTION("blend") {
        scene.dressings[0].factors.alpha = render::Alpha::blend;
        const double alphas[] = {0, 120 / 255.0, 200 / 255.0, 1};
        const auto through = [&](unsigned i) { return 1 - 0.8 * alphas[i]; };
        const auto expected = shows(through);
        const render::Image image = of(scene, 1024).image();
        // 16 rows of 1024 each: .004 is one standard deviation of a mean of coins.
        for (unsigned i = 0; i < 4; ++i) {
            double sum = 0;
            for (unsigned row = 0; row < side; ++row) sum += at(image, 4 * i + 1, row)[0];
            CAPTURE(i);
            CHECK(sum / side == Catch::Approx(expected((i + .5) / 4, 0)[0]).margin(0.02));
        }
    }
    SECTION("opaque") {
        CHECK(worst(of(scene).image(), shows([](unsigned) { return 0.0; })) < 1e-6);
    }
}

TEST_CASE("shadows pass what is not there") {
    // Light of a distant sun from straight above through a grid onto a matt floor, seen from below the grid.
    render::Scene scene = seen_from_above();
    render::GltfMaterial grid = matt();
    grid.alpha = render::Alpha::mask;
    add_tile(scene, grid, 1);
    add_tile(scene, matt(), 0);
    add_texture(scene, render::Slot::base_colour, 2, 1, {texel(255, 255, 255, 0), texel(255, 255, 255)});
    scene.sky = render::constant_sky(0);
    scene.lights.push_back({render::PunctualLight::Kind::directional, {1, 1, 1}, 3, {}, {0, -1, 0}});
    scene.camera.eye = {0, 0.5f, 0};
    Rendered r = of(scene);
    r.settings.max_bounces = 1;
    CHECK(worst(r.image(), [](double u, double) {
              const double x = u < .5 ? 3 / std::numbers::pi : 0;
              return std::array<double, 3>{x, x, x};
          }) < 1e-5);
}

TEST_CASE("a normal map bends the normal along its tangents") {
    render::Scene scene = seen_from_above();
    add_tile(scene, matt());
    // Towards +x (u), -x, and what is up in the map (-v, so -z here), flat.
    add_texture(scene, render::Slot::normal, 4, 1,
                {texel(218, 128, 218), texel(37, 128, 218), texel(128, 218, 218), texel(128, 128, 255)});
    scene.sky = render::constant_sky(0);
    const double tilt = std::numbers::pi / 4;
    const auto lit_from = [&](render::Vec from) {
        render::Scene lit = scene;
        const auto root = static_cast<float>(std::sqrt(0.5));
        lit.lights.push_back({render::PunctualLight::Kind::directional,
                              {1, 1, 1},
                              static_cast<float>(std::numbers::pi),
                              {},
                              {-root * from[0], -root, -root * from[2]}});
        Rendered r = of(lit);
        r.settings.max_bounces = 1;
        // Without the softened edge, which a second normal has.
        r.effects = "lambert,shading_normal,normal_map,point_light,back_facing";
        return r.image();
    };
    const auto expect = [&](const render::Image& image, std::array<double, 4> cosines) {
        for (unsigned i = 0; i < 4; ++i) {
            CAPTURE(i);
            CHECK(at(image, 4 * i + 1, 8)[0] == Catch::Approx(cosines[i]).margin(4e-3));
        }
    };
    expect(lit_from({1, 0, 0}), {1, 0, std::cos(tilt) * std::cos(tilt), std::cos(tilt)});
    expect(lit_from({-1, 0, 0}), {0, 1, std::cos(tilt) * std::cos(tilt), std::cos(tilt)});
    expect(lit_from({0, 0, -1}), {.5, .5, 1, std::cos(tilt)});
    scene.dressings[0].factors.normal_scale = 0;
    expect(lit_from({1, 0, 0}), {std::cos(tilt), std::cos(tilt), std::cos(tilt), std::cos(tilt)});
}

TEST_CASE("anisotropy turned by its rotation or by its texture is the other way round") {
    // A brushed metal under a sky that is bright on one side.
    const auto image = [](float rotation, bool by_texture) {
        render::Scene scene = seen_from_above();
        render::GltfMaterial m;
        m.roughness = 0.3f;
        m.anisotropy = 0.9f;
        m.anisotropy_rotation = by_texture ? 0 : rotation;
        add_tile(scene, m);
        if (by_texture)
            add_texture(scene, render::Slot::anisotropy, 1, 1,
                        {texel(static_cast<unsigned>(std::lround(127.5 + 127.5 * std::cos(rotation))),
                               static_cast<unsigned>(std::lround(127.5 + 127.5 * std::sin(rotation))), 255)});
        scene.sky = render::constant_sky(0);
        // From over +x, far enough from the mirror's direction that only what is brushed across x has it.
        scene.lights.push_back(
            {render::PunctualLight::Kind::directional, {1, 1, 1}, 1, {}, {-0.8f, -0.6f, 0}});
        Rendered r = of(scene);
        r.settings.max_bounces = 1;
        return mean(r.image());
    };
    const double along = image(0, false), across = image(static_cast<float>(std::numbers::pi / 2), false);
    CHECK(along > 3 * across);  // alpha is large along the tangent, which is x
    CHECK(image(static_cast<float>(std::numbers::pi), false) == Catch::Approx(along).epsilon(1e-4));
    CHECK(image(static_cast<float>(std::numbers::pi / 2), true) == Catch::Approx(across).epsilon(0.02));
    CHECK(image(0, true) == Catch::Approx(along).epsilon(0.02));
}
