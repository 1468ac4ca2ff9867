// Light from all around, from an image.
#pragma once

#include <cstdint>
#include <vector>

namespace vndf::render {

// A square map of the sphere by areas (kernels/render/octahedral.h), for sampling by its brightness.
struct Environment {
    std::uint32_t side = 0;  // cells each way; 0: there is none
    // Red, then green, then blue, of (side + 2)^2 texels each: one row and column around the map, of what is beyond its edge.
    std::vector<float> radiance;
    std::vector<float> pdf;  // of each cell, per steradian
    // Walker's alias method: a cell is kept with this probability, or else is that one.
    std::vector<float> keep;
    std::vector<std::uint32_t> other;
};

}  // namespace vndf::render
