// Files: the scene's own, and those beside it, of which none outside of its folder is read.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "gltf/json.h"

namespace vndf::gltf {

// The bytes of the file `path`, as it stands at `place` of the JSON: at most `limit`, or it is refused.
using Beside = std::function<std::string(const Item& place, const std::string& path, std::uint64_t limit)>;

// Files of a folder and those below. Refused are absolute paths and those that leave it, by ".." or by links.
Beside beside(const std::filesystem::path& folder);

}  // namespace vndf::gltf
