// What the reader takes. Nothing is allocated before it is held against these.
#pragma once

#include <cstdint>

namespace vndf::gltf {

struct Limits {
    std::uint64_t file_bytes = std::uint64_t{1} << 31;   // of one file
    std::uint64_t total_bytes = std::uint64_t{1} << 32;  // of all buffers and images
    std::uint64_t json_bytes = std::uint64_t{1} << 29;
    std::uint64_t json_values = std::uint64_t{1} << 23;
    unsigned json_depth = 128;
    std::uint64_t triangles =
        std::uint64_t{1} << 23;  // of all instances; at most 232 bytes each, and as many while they are made
    std::uint64_t sparse_elements = std::uint64_t{1} << 26;
    std::uint64_t image_pixels = std::uint64_t{1} << 26;  // of one image
    std::uint64_t total_pixels = std::uint64_t{1} << 27;
};

}  // namespace vndf::gltf
