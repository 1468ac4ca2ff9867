// A rendering that goes on where another stopped, to the same bits.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "render/wavefront.h"

namespace vndf::render {

// Of everything that the image depends on: the scene as the stages read it, the settings, the program.
std::string fingerprint(const Scene& scene, const Settings& settings, std::string_view program);

// The bytes of a file.
std::string checkpoint(const State& state, const std::string& fingerprint);
// Throws InputError, naming the file, if the bytes are no checkpoint, or one of another rendering.
State state_of(std::string_view bytes, const std::string& fingerprint, const std::string& file);

}  // namespace vndf::render
