#include "render/tables.h"

namespace vndf::render {
namespace {

// Plane after plane: row i's plane k at k * rows + i.
template <class T, class Rows, class Fill>
std::vector<T> planes_of(std::size_t planes, const Rows& rows, Fill fill) {
    std::vector<T> table;
    for (std::size_t k = 0; k < planes; ++k)
        for (const auto& row : rows) table.push_back(fill(row)[k]);
    return table;
}

}  // namespace

std::vector<float> vertex_table(const Scene& scene) {
    return planes_of<float>(VNDF_VERTEX_PLANES, scene.vertices, [](const Vertex& v) {
        return std::array{v.place[0], v.place[1], v.place[2], v.normal[0], v.normal[1], v.normal[2]};
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

vndf_render_sizes sizes_of(const Scene& scene) {
    const auto size = [](const auto& rows) { return static_cast<std::uint32_t>(rows.size()); };
    return {size(scene.vertices), size(scene.triangles), size(scene.materials), 1.0f};
}

}  // namespace vndf::render
