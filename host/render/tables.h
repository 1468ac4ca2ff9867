// A scene as the stages read it: structures of arrays (kernels/render/queues.h).
#pragma once

#include <cstdint>
#include <vector>

#include "render/scene.h"

namespace vndf::render {

std::vector<float> vertex_table(const Scene& scene);
std::vector<std::uint32_t> triangle_table(const Scene& scene);
std::vector<float> material_table(const Scene& scene);
vndf_render_sizes sizes_of(const Scene& scene);

}  // namespace vndf::render
