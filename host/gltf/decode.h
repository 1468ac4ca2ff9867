// Pixels of PNG and JPEG, by libpng and libjpeg.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "render/scene.h"

namespace vndf::gltf {

// Eight bits of red, green, blue and alpha, as the file has them: no gamma, no profile. What is wrong with it, or nothing; nothing
// is allocated for more than `most_pixels`.
std::string decode_png(std::string_view bytes, std::uint64_t most_pixels, render::Bitmap& bitmap);
// Damage that leaves something to see is only counted.
std::string decode_jpeg(std::string_view bytes, std::uint64_t most_pixels, render::Bitmap& bitmap,
                        long& damage);

}  // namespace vndf::gltf
