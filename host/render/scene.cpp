#include "render/scene.h"

#include <cmath>
#include <numbers>

#include "error.h"
#include "render/gltf.h"

namespace vndf::render {
namespace {

using Vec3 = std::array<double, 3>;

Vec3 cross(const Vec3& a, const Vec3& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Vec3 scaled(const Vec3& a, double k) {
    return {k * a[0], k * a[1], k * a[2]};
}

Vec3 unit(const Vec3& a) {
    return scaled(a, 1 / std::hypot(a[0], a[1], a[2]));
}

Vec narrow(const Vec3& a) {
    return {static_cast<float>(a[0]), static_cast<float>(a[1]), static_cast<float>(a[2])};
}

// Reflectances along the normal for 630, 550 and 465 nm, rounded.
constexpr Vec silver{0.97f, 0.96f, 0.91f}, gold{1.0f, 0.78f, 0.34f};

Material metal(Vec eta, Vec k, float alpha) {
    Material m = conductor(eta, alpha, alpha);
    m.second = k;
    return m;
}

std::array<Material, 5> materials_of(std::string_view kind) {
    if (kind == "anisotropy")
        return {conductor(silver, 0.02f, 0.3f), conductor(silver, 0.3f, 0.02f), conductor(silver, 0.1f, 0.4f),
                conductor(silver, 0.05f, 0.8f), conductor(silver, 0.8f, 0.05f)};
    if (kind == "metals")  // silver, gold, copper, iron, aluminium by their eta and k
        return {metal({0.155f, 0.117f, 0.138f}, {4.83f, 3.12f, 2.15f}, 0.03f),
                metal({0.143f, 0.375f, 1.442f}, {3.98f, 2.39f, 1.60f}, 0.1f),
                metal({0.200f, 0.924f, 1.102f}, {3.91f, 2.45f, 2.14f}, 0.2f),
                metal({2.870f, 2.950f, 2.650f}, {3.05f, 2.93f, 2.77f}, 0.3f),
                metal({1.345f, 0.965f, 0.617f}, {7.47f, 6.40f, 5.30f}, 0.4f)};
    if (kind == "glass")
        return {glass(1.5f, 0.001f), glass(1.5f, 0.1f), glass(1.5f, 0.3f), glass(1.33f, 0.001f),
                glass(2.42f, 0.001f)};
    if (kind == "tinted") {  // the last of diamond, with three times its dispersion
        Material diamond = glass(2.42f, 0.001f);
        diamond.dispersion = 3 * 20 / 55.3f;
        return {tinted(glass(1.5f, 0.001f), {0.9f, 0.3f, 0.2f}, 1),
                tinted(glass(1.5f, 0.1f), {0.9f, 0.6f, 0.1f}, 1),
                tinted(glass(1.5f, 0.3f), {0.2f, 0.7f, 0.3f}, 1),
                tinted(glass(1.33f, 0.001f), {0.3f, 0.6f, 0.9f}, 1), diamond};
    }
    if (kind == "plastic")
        return {plastic({0.7f, 0.2f, 0.15f}, 0.02f), plastic({0.7f, 0.5f, 0.2f}, 0.1f),
                plastic({0.7f, 0.7f, 0.7f}, 0.2f), plastic({0.3f, 0.55f, 0.25f}, 0.35f),
                plastic({0.2f, 0.3f, 0.6f}, 0.5f)};
    if (kind == "coat")
        return {coated(lambert({0.55f, 0.03f, 0.02f}), 1, 0.001f),
                coated(conductor(gold, 0.3f, 0.3f), 1, 0.01f),
                coated(conductor({0.05f, 0.09f, 0.3f}, 0.4f, 0.4f), 1, 0.03f),
                coated(rough(lambert({0.6f, 0.5f, 0.35f}), 0.8f), 0.5f, 0.1f),
                coated(lambert({0.03f, 0.03f, 0.03f}), 1, 0.3f)};
    if (kind == "gltf") {  // rough metal, brushed metal, lacquer, plastic, a lamp
        GltfMaterial metal, brushed, lacquer, plain, lamp;
        metal.base_colour = brushed.base_colour = gold;
        metal.roughness = 0.45f;
        brushed.roughness = 0.3f, brushed.anisotropy = 0.8f;
        lacquer.base_colour = {0.25f, 0.02f, 0.3f}, lacquer.metallic = 0.7f, lacquer.roughness = 0.6f;
        lacquer.clearcoat = 1, lacquer.clearcoat_roughness = 0.1f;
        plain.base_colour = {0.1f, 0.35f, 0.15f}, plain.metallic = 0, plain.roughness = 0.4f;
        lamp.base_colour = {0.8f, 0.8f, 0.8f}, lamp.metallic = 0, lamp.roughness = 0.5f;
        lamp.emissive = {1, 0.6f, 0.25f}, lamp.emissive_strength = 2;
        return {material_of(metal), material_of(brushed), material_of(lacquer), material_of(plain),
                material_of(lamp)};
    }
    if (kind == "clay")  // from smooth to rough
        return {lambert({0.75f, 0.42f, 0.3f}), rough(lambert({0.75f, 0.42f, 0.3f}), 0.25f),
                rough(lambert({0.75f, 0.42f, 0.3f}), 0.5f), rough(lambert({0.75f, 0.42f, 0.3f}), 0.75f),
                rough(lambert({0.75f, 0.42f, 0.3f}), 1)};
    if (kind == "diffuse")
        return {lambert({0.7f, 0.2f, 0.15f}), lambert({0.7f, 0.5f, 0.2f}), lambert({0.7f, 0.7f, 0.7f}),
                lambert({0.3f, 0.55f, 0.25f}), lambert({0.2f, 0.3f, 0.6f})};
    return {conductor(gold, 0.01f, 0.01f), conductor(gold, 0.1f, 0.1f), conductor(gold, 0.3f, 0.3f),
            conductor(gold, 0.6f, 0.6f), conductor(gold, 1.0f, 1.0f)};
}

void add_floor(Scene& scene) {
    const std::uint32_t light = scene.add_material(lambert({0.52f, 0.48f, 0.43f})),
                        dark = scene.add_material(lambert({0.16f, 0.155f, 0.15f}));
    constexpr int half = 56;
    constexpr float side = 1.25f, edge = half * side, far = 2000;
    for (int row = -half; row < half; ++row)
        for (int column = -half; column < half; ++column)
            scene.add_square(side * column, side * row, side * (column + 1), side * (row + 1),
                             (row + column) & 1 ? light : dark);
    // Around it, to the horizon, what the squares look like from afar.
    const std::uint32_t both = scene.add_material(lambert({0.34f, 0.3175f, 0.29f}));
    scene.add_square(-far, -far, far, -edge, both);
    scene.add_square(-far, edge, far, far, both);
    scene.add_square(-far, -edge, -edge, edge, both);
    scene.add_square(edge, -edge, far, edge, both);
}

}  // namespace

std::uint32_t Scene::add_material(const Material& material) {
    materials.push_back(material);
    return static_cast<std::uint32_t>(materials.size() - 1);
}

void Scene::add_sphere(Vec centre, float radius, unsigned rows, const Material& material) {
    const unsigned columns = 2 * rows;
    const auto first = static_cast<std::uint32_t>(vertices.size());
    const std::uint32_t number = add_material(material);
    for (unsigned row = 0; row <= rows; ++row)
        for (unsigned column = 0; column <= columns; ++column) {
            // The last column is the first to the bit, so that the mesh has no seam.
            const double theta = std::numbers::pi * row / rows,
                         phi = 2 * std::numbers::pi * (column % columns) / columns;
            const double sine = row % rows == 0 ? 0 : std::sin(theta);
            const Vec normal =
                narrow({sine * std::cos(phi), row % rows == 0 ? (row == 0 ? 1 : -1) : std::cos(theta),
                        sine * std::sin(phi)});
            vertices.push_back({{centre[0] + radius * normal[0], centre[1] + radius * normal[1],
                                 centre[2] + radius * normal[2]},
                                normal});
        }
    for (unsigned row = 0; row < rows; ++row)
        for (unsigned column = 0; column < columns; ++column) {
            const std::uint32_t a = first + row * (columns + 1) + column, b = a + 1, c = a + columns + 1,
                                d = c + 1;
            if (row != 0) triangles.push_back({{a, b, d}, number});
            if (row + 1 != rows) triangles.push_back({{a, d, c}, number});
        }
}

void Scene::add_square(float x0, float z0, float x1, float z1, std::uint32_t material) {
    const auto first = static_cast<std::uint32_t>(vertices.size());
    for (const auto& [x, z] : {std::pair{x0, z0}, {x1, z0}, {x1, z1}, {x0, z1}})
        vertices.push_back({{x, 0, z}, {0, 1, 0}});
    triangles.push_back({{first, first + 2, first + 1}, material});
    triangles.push_back({{first, first + 3, first + 2}, material});
}

Sky constant_sky(float radiance) {
    Sky sky;
    sky.zenith = sky.horizon = sky.ground = {radiance, radiance, radiance};
    sky.sun_share = 0;
    return sky;
}

Sky day_sky() {
    Sky sky;
    sky.zenith = {0.09f, 0.20f, 0.50f};
    sky.horizon = {0.82f, 0.86f, 0.92f};
    sky.ground = {0.5f, 0.52f, 0.55f};
    sky.to_sun = narrow(unit({-0.55, 0.62, 0.56}));
    sky.sun_radius = 0.045f;
    // An irradiance of three times the sky's or so.
    const double sine = std::sin(sky.sun_radius), irradiance = 3.6;
    const double radiance = irradiance / (std::numbers::pi * sine * sine);
    sky.sun = narrow(scaled({1.0, 0.93, 0.82}, radiance));
    return sky;
}

const std::vector<std::string>& orb_kinds() {
    static const std::vector<std::string> kinds{"roughness", "anisotropy", "metals",  "diffuse", "clay",
                                                "glass",     "tinted",     "plastic", "coat",    "gltf"};
    return kinds;
}

Scene orbs(std::string_view kind) {
    Scene scene;
    scene.name = "orbs of " + std::string(kind);
    const auto materials = materials_of(kind);
    // A hair above the floor, by more than rays keep from a surface: no path gets below it, or into an orb.
    constexpr float lifted = 1.002f;
    for (int i = 0; i < 5; ++i)
        scene.add_sphere({2.3f * static_cast<float>(i - 2), lifted, 0}, 1, 80, materials[i]);
    if (kind == "metals") scene.fresnel = "conductor";
    add_floor(scene);
    scene.sky = day_sky();
    scene.camera = {{-1.5f, 2.05f, 14.5f}, {0, 0.98f, 0}, 0.82f};
    return scene;
}

void add_lights_over_orbs(Scene& scene) {
    const std::array<Vec, 4> colours{
        {{1, 0.5f, 0.2f}, {1, 0.85f, 0.65f}, {0.65f, 0.85f, 1}, {0.3f, 0.5f, 1}}};
    for (int i = 0; i < 4; ++i) {
        PunctualLight light;
        light.colour = colours[i];
        light.intensity =
            static_cast<float>(4 / luminance(light.colour[0], light.colour[1], light.colour[2]));
        light.place = {2.3f * (static_cast<float>(i) - 1.5f), 2.7f, 1.4f};
        scene.lights.push_back(light);
    }
}

vndf_render_view view_of(const Camera& camera, unsigned width, unsigned height) {
    const auto wide = [](const Vec& v) { return Vec3{v[0], v[1], v[2]}; };
    const Vec3 eye = wide(camera.eye), target = wide(camera.target);
    const Vec3 forward = unit({target[0] - eye[0], target[1] - eye[1], target[2] - eye[2]});
    const Vec3 side = unit(cross(forward, wide(camera.up)));
    const double film =
        camera.height > 0 ? static_cast<double>(camera.height) * width / height : camera.width;
    const Vec right = narrow(scaled(side, film / 2)),
              up = narrow(scaled(cross(side, forward), film / 2 * height / width)), ahead = narrow(forward);
    const Vec none{};
    const Vec &spread = camera.parallel ? none : right, &spread_up = camera.parallel ? none : up;
    const Vec &shift = camera.parallel ? right : none, &shift_up = camera.parallel ? up : none;
    return {camera.eye[0], camera.eye[1], camera.eye[2], spread[0],   spread[1], spread[2], spread_up[0],
            spread_up[1],  spread_up[2],  ahead[0],      ahead[1],    ahead[2],  shift[0],  shift[1],
            shift[2],      shift_up[0],   shift_up[1],   shift_up[2], width,     height};
}

}  // namespace vndf::render
