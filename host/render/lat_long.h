// Images of all directions by longitude and latitude, from files.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace vndf::render {

// Columns are even in longitude, rows in latitude from the top, as OpenEXR's ImfEnvmap.h says: the middle of the image is +z, +x a
// quarter of the width from the left, +y up. Unlike there, pixels are areas: the middles of the outer ones are half a pixel
// inside.
struct LatLong {
    std::uint32_t width = 0, height = 0;
    std::vector<float> pixels;  // red, green, blue of each
};

// Of the bytes of a Radiance picture (.hdr) and of an OpenEXR file; `name` is for messages. The pixels are as the file has them:
// infinite or below 0, too. Memory follows what is read. Throw
// InputError with one line; read_exr DeviceError where this build has no OpenEXR.
LatLong read_hdr(std::string_view bytes, const std::string& name);
LatLong read_exr(std::string_view bytes, const std::string& name);

constexpr std::uint64_t longest_side = 32768, most_pixels = std::uint64_t{1} << 27;  // 16384 x 8192
// Throws InputError for more, and for none.
void require_size(std::uint64_t width, std::uint64_t height, const std::string& name);

}  // namespace vndf::render
