#include "render/tables.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "kernels/render/texture.h"

#include "render/alias.h"
#include "render/variants.h"

namespace vndf::render {
namespace {

// Plane after plane: row i's plane k at k * rows + i.
template <class T, class Rows, class Fill>
std::vector<T> planes_of(std::size_t planes, const Rows& rows, Fill fill) {
    std::vector<T> table(planes * rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const auto row = fill(rows[i]);
        for (std::size_t k = 0; k < planes; ++k) table[k * rows.size() + i] = row[k];
    }
    return table;
}

std::array<double, 3> way(const Vertex& a, const Vertex& b) {
    return {static_cast<double>(b.place[0]) - a.place[0], static_cast<double>(b.place[1]) - a.place[1],
            static_cast<double>(b.place[2]) - a.place[2]};
}

double area_of(const Scene& scene, const Triangle& t) {
    const auto u = way(scene.vertices[t.corners[0]], scene.vertices[t.corners[1]]),
               v = way(scene.vertices[t.corners[0]], scene.vertices[t.corners[2]]);
    return std::hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]) / 2;
}

// What a triangle shines with, in the mean over points of it.
class Shine {
  public:
    explicit Shine(const Scene& scene)
        : scene_(scene),
          vertices_(vertex_table(scene)),
          triangles_(triangle_table(scene)),
          dressings_(dressing_table(scene)),
          textures_(texture_table(scene)),
          texels_(texel_table(scene)),
          looks_(vndf_render_looks_of(sizes_of(scene), vertices_.data(), triangles_.data(), dressings_.data(),
                                      textures_.data(), texels_.data())) {}

    double of(std::uint32_t triangle) const {
        const Vec& own = scene_.materials[scene_.triangles[triangle].material].emission;
        if (scene_.dressings.empty()) return luminance(own[0], own[1], own[2]);
        constexpr int steps = 6;
        double sum = 0;
        int points = 0;
        for (int i = 0; i < steps; ++i)
            for (int j = 0; i + j < steps; ++j, ++points) {
                const auto spot = vndf_render_spot_of(looks_, triangle, (i + 1 / 3.0f) / steps,
                                                      (static_cast<float>(j) + 1 / 3.0f) / steps);
                const vndf_render_vector look = vndf_render_emission_look(looks_, spot, 1.0f);
                sum += luminance(own[0] * look.x, own[1] * look.y, own[2] * look.z);
            }
        return sum / points;
    }

  private:
    const Scene& scene_;
    std::vector<float> vertices_;
    std::vector<std::uint32_t> triangles_;
    std::vector<float> dressings_;
    std::vector<std::uint32_t> textures_, texels_;
    vndf_render_looks looks_;
};

float cutoff_of(const GltfMaterial& m) {
    if (m.alpha == Alpha::opaque) return VNDF_ALPHA_OPAQUE;
    return m.alpha == Alpha::blend ? VNDF_ALPHA_BLEND : m.alpha_cutoff;
}

bool shines(const Vec& rgb) {
    return rgb != Vec{};
}

std::vector<PunctualLight> lights_that(const Scene& scene, bool are_spheres) {
    std::vector<PunctualLight> lights;
    for (const PunctualLight& l : scene.lights)
        if (l.sphere() == are_spheres) lights.push_back(l);
    return lights;
}

std::vector<double> intensities(const std::vector<PunctualLight>& lights) {
    std::vector<double> all;
    for (const PunctualLight& l : lights)
        all.push_back(l.intensity * luminance(l.colour[0], l.colour[1], l.colour[2]));
    return all;
}

// Row i of points or spheres, which differ in one plane; the light is its candela times `scale`.
std::vector<float> light_row(const PunctualLight& l, const Alias& alias, std::size_t i, float own,
                             double scale) {
    const bool spot = l.kind == PunctualLight::Kind::spot;
    const double inner = std::cos(l.inner_angle), outer = std::cos(l.outer_angle);
    const double slope = spot ? 1 / std::max(1e-3, inner - outer) : 0, offset = spot ? -outer * slope : 1;
    std::vector<float> row{alias.keep[i], static_cast<float>(alias.other[i]), own};
    row.insert(row.end(), l.place.begin(), l.place.end());
    row.insert(row.end(), l.direction.begin(), l.direction.end());
    // No more than numbers hold of the smallest spheres.
    for (const float c : l.colour)
        row.push_back(static_cast<float>(std::min(static_cast<double>(c * l.intensity) * scale, 1e30)));
    row.insert(row.end(),
               {static_cast<float>(slope), static_cast<float>(offset), static_cast<float>(alias.chance[i])});
    return row;
}

}  // namespace

std::vector<float> vertex_table(const Scene& scene) {
    return planes_of<float>(VNDF_VERTEX_PLANES, scene.vertices, [](const Vertex& v) {
        return std::array{v.place[0],   v.place[1],   v.place[2],  v.normal[0], v.normal[1],  v.normal[2],
                          v.uv[0][0],   v.uv[0][1],   v.uv[1][0],  v.uv[1][1],  v.tangent[0], v.tangent[1],
                          v.tangent[2], v.tangent[3], v.colour[0], v.colour[1], v.colour[2],  v.colour[3]};
    });
}

std::vector<std::uint32_t> triangle_table(const Scene& scene) {
    return planes_of<std::uint32_t>(VNDF_TRIANGLE_PLANES, scene.triangles, [](const Triangle& t) {
        return std::array{t.corners[0], t.corners[1], t.corners[2], t.material};
    });
}

std::vector<float> material_table(const Scene& scene) {
    return planes_of<float>(VNDF_MATERIAL_PLANES, scene.materials, [](const Material& m) {
        std::vector<float> row{m.alpha_x, m.alpha_y, m.metal};
        for (const Vec& rgb : {m.first, m.second, m.tint, m.albedo})
            row.insert(row.end(), rgb.begin(), rgb.end());
        row.insert(row.end(), {m.ior, m.transmission});
        row.insert(row.end(), m.transmittance.begin(), m.transmittance.end());
        row.push_back(dielectric(m) ? m.dispersion : 0);
        row.insert(row.end(), m.absorption.begin(), m.absorption.end());
        row.insert(row.end(), {m.diffuse_roughness, m.coat, m.coat_alpha, m.specular});
        row.insert(row.end(), m.specular_colour.begin(), m.specular_colour.end());
        row.push_back(m.thin_walled ? 1.0f : 0.0f);
        row.insert(row.end(), m.emission.begin(), m.emission.end());
        return row;
    });
}

std::vector<float> dressing_table(const Scene& scene) {
    const std::vector<Dressing> plain(scene.dressings.empty() ? scene.materials.size() : 0);
    const TexelRanges ranges(scene);
    std::size_t i = 0;
    return planes_of<float>(
        VNDF_DRESSING_PLANES, scene.dressings.empty() ? plain : scene.dressings, [&](const Dressing& d) {
            const GltfMaterial& m = d.factors;
            std::vector<float> row;
            for (std::size_t slot = 0; slot < slot_count; ++slot) {
                // What is not lit has nothing but its colour.
                TextureUse use = d.textures[slot];
                if (m.unlit && slot == VNDF_SLOT_EMISSIVE) use = d.textures[VNDF_SLOT_BASE_COLOUR];
                row.insert(row.end(), {static_cast<float>(use.texture), static_cast<float>(use.set)});
                row.insert(row.end(), use.transform.begin(), use.transform.end());
            }
            // A direction only where it is seen.
            const std::vector<Material> all = variants(scene, ranges, i++);
            const float turned = std::any_of(all.begin(), all.end(), anisotropic) ? 1 : 0;
            row.insert(row.end(), {m.roughness, m.anisotropy, turned * std::cos(m.anisotropy_rotation),
                                   turned * std::sin(m.anisotropy_rotation), m.normal_scale, m.opacity,
                                   cutoff_of(m), m.clearcoat_roughness, m.unlit ? 1.0f : 0.0f});
            return row;
        });
}

std::vector<std::uint32_t> texture_table(const Scene& scene) {
    std::vector<std::uint32_t> offsets{0};
    for (const Bitmap& b : scene.bitmaps)
        offsets.push_back(offsets.back() + static_cast<std::uint32_t>(b.texels.size()));
    if (scene.textures.empty()) return {0, 1, 1, 0};
    return planes_of<std::uint32_t>(VNDF_TEXTURE_PLANES, scene.textures, [&](const Texture& t) {
        const Bitmap& bitmap = scene.bitmaps[t.bitmap];
        return std::array{offsets[t.bitmap], bitmap.width, bitmap.height,
                          static_cast<std::uint32_t>(t.wrap_s) | static_cast<std::uint32_t>(t.wrap_t) << 2 |
                              (t.nearest ? 16u : 0u)};
    });
}

std::vector<std::uint32_t> texel_table(const Scene& scene) {
    std::vector<std::uint32_t> all;
    for (const Bitmap& b : scene.bitmaps) all.insert(all.end(), b.texels.begin(), b.texels.end());
    if (all.empty()) all.push_back(0xffffffff);
    return all;
}

vndf_render_sizes sizes_of(const Scene& scene) {
    const auto size = [](const auto& rows) { return static_cast<std::uint32_t>(rows.size()); };
    return {size(scene.vertices), size(scene.triangles), size(scene.materials), 1.0f,
            std::max(1u, size(scene.textures))};
}

Lamps lamps_of(const Scene& scene) {
    Lamps lamps{0, {}, {}, {0}};
    if (std::none_of(scene.materials.begin(), scene.materials.end(),
                     [](const Material& m) { return shines(m.emission); }))
        return lamps;
    const Shine shine(scene);
    std::vector<std::uint32_t> numbers;
    std::vector<double> powers, areas;
    for (std::uint32_t i = 0; i < scene.triangles.size(); ++i) {
        if (!shines(scene.materials[scene.triangles[i].material].emission)) continue;
        const double area = area_of(scene, scene.triangles[i]), power = area * shine.of(i);
        if (!(power > 0)) continue;
        numbers.push_back(i);
        areas.push_back(area);
        powers.push_back(power);
    }
    if (numbers.empty()) return lamps;
    const Alias alias = alias_of(powers);
    lamps.count = static_cast<std::uint32_t>(numbers.size());
    lamps.planes = alias.keep;
    lamps.numbers = alias.other;
    lamps.numbers.insert(lamps.numbers.end(), numbers.begin(), numbers.end());
    lamps.densities.assign(scene.triangles.size(), 0.0f);
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        lamps.planes.push_back(static_cast<float>(2 * alias.chance[i]));
        lamps.densities[numbers[i]] = static_cast<float>(alias.chance[i] / areas[i]);
    }
    return lamps;
}

std::vector<float> point_table(const Scene& scene) {
    const std::vector<PunctualLight> lights = lights_that(scene, false);
    if (lights.empty()) return {};
    const Alias alias = alias_of(intensities(lights));
    std::size_t i = 0;
    return planes_of<float>(VNDF_POINT_PLANES, lights, [&](const PunctualLight& l) {
        return light_row(l, alias, i++, l.kind == PunctualLight::Kind::directional ? 1.0f : 0.0f, 1);
    });
}

std::vector<float> sphere_table(const Scene& scene) {
    const std::vector<PunctualLight> lights = lights_that(scene, true);
    if (lights.empty()) return {};
    const Alias alias = alias_of(intensities(lights));
    std::size_t i = 0;
    return planes_of<float>(VNDF_SPHERE_PLANES, lights, [&](const PunctualLight& l) {
        const double radius = l.radius;
        return light_row(l, alias, i++, l.radius, 1 / (std::numbers::pi * radius * radius));
    });
}

vndf_render_sky sky_of(const Scene& scene, const Lamps& lamps, bool samples_caps) {
    const Sky& sky = scene.sky;
    // 1 - cos(radius) without cancellation.
    const double half = std::sin(sky.sun_radius / 2.0);
    const bool sun = sky.sun_share > 0, around = scene.environment.side > 0;
    const bool bright = sun || around || shines(sky.zenith) || shines(sky.horizon) || shines(sky.ground);
    const auto all = static_cast<std::uint32_t>(scene.lights.size()),
               spheres = static_cast<std::uint32_t>(lights_that(scene, true).size()), points = all - spheres;
    const bool to_spheres = samples_caps && spheres > 0;
    const float kinds = static_cast<float>(bright) + (lamps.count > 0) + (points > 0) + to_spheres;
    const float share = 1 / std::max(kinds, 1.0f), far = bright || kinds == 0 ? share : 0;
    const float sun_share = samples_caps ? sky.sun_share : 0;
    const Vec none{};
    const Vec& light = sun ? sky.sun : none;
    return {sky.zenith[0],
            sky.zenith[1],
            sky.zenith[2],
            sky.horizon[0],
            sky.horizon[1],
            sky.horizon[2],
            sky.ground[0],
            sky.ground[1],
            sky.ground[2],
            light[0],
            light[1],
            light[2],
            sky.to_sun[0],
            sky.to_sun[1],
            sky.to_sun[2],
            static_cast<float>(2 * half * half),
            far * sun_share,
            far * (1 - sun_share),
            lamps.count > 0 ? share : 0,
            points > 0 ? share : 0,
            to_spheres ? share : 0,
            scene.environment.side,
            lamps.count,
            points,
            spheres};
}

}  // namespace vndf::render
