// Images as files.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "render/wavefront.h"

namespace vndf::render {

// What an image file says about itself, in this order.
using Metadata = std::vector<std::pair<std::string, std::string>>;

// Throws InputError if the path ends neither in .exr nor in .png; DeviceError where this build lacks what writes it.
void require_image_name(const std::string& path);

// The bytes of the file that the path names: OpenEXR with 32-bit floats as they are, or PNG: times 2^stops, a shoulder for what is
// brighter than white, sRGB.
std::string encoded(const Image& image, const std::string& path, const Metadata& metadata, double stops = 0);

// With which nine in ten pixels that are not black are below .8.
double fitting_stops(const Image& image);

}  // namespace vndf::render
