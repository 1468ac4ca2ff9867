// Light from all around, from an image.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "render/lat_long.h"
#include "render/material.h"

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

// The file, .hdr or .exr by what is in it, turned about +y by so many degrees, counterclockwise seen from above. What is no
// finite number, or is below 0, becomes 0, and is counted in a warning: one line each. Throws InputError with one line
// that names the file; DeviceError where it is an .exr and this build has no OpenEXR.
Environment read_environment(const std::filesystem::path& file, std::vector<std::string>& warnings,
                             float rotation_degrees = 0);

// Of finite numbers that are not below 0. The mean over each cell, to 1e-3 of the whole's; in as many cells as there are pixels to
// two, 32 x 32 to 1024 x 1024.
Environment environment_of(const LatLong& image, float rotation_degrees = 0);

// The mean over all directions.
Vec mean_radiance(const Environment& environment);

}  // namespace vndf::render
