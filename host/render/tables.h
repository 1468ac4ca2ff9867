// A scene as the stages read it: structures of arrays (kernels/render/queues.h).
#pragma once

#include <cstdint>
#include <vector>

#include "render/scene.h"

namespace vndf::render {

std::vector<float> vertex_table(const Scene& scene);
std::vector<std::uint32_t> triangle_table(const Scene& scene);
std::vector<float> material_table(const Scene& scene);
std::vector<float> dressing_table(const Scene& scene);
// One texture and one texel at least, which programs read where a material has none.
std::vector<std::uint32_t> texture_table(const Scene& scene);
std::vector<std::uint32_t> texel_table(const Scene& scene);
vndf_render_sizes sizes_of(const Scene& scene);

// The triangles that shine, and each triangle's chance as a light per unit of area.
struct Lamps {
    std::uint32_t count = 0;
    std::vector<float> planes;
    std::vector<std::uint32_t> numbers;
    std::vector<float> densities;
};
Lamps lamps_of(const Scene& scene);
// Of lights without a radius, and of those that are spheres.
std::vector<float> point_table(const Scene& scene);
std::vector<float> sphere_table(const Scene& scene);

// Each kind of light that there is gets as many samples as every other; spheres and the sun none if they are left to be met by chance.
vndf_render_sky sky_of(const Scene& scene, const Lamps& lamps, bool samples_caps = true);

}  // namespace vndf::render
