// glTF 2.0, as .gltf or .glb, as the renderer's scene.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "gltf/files.h"
#include "gltf/limits.h"
#include "render/scene.h"

namespace vndf::gltf {

struct Loaded {
    render::Scene scene;
    // What is shown otherwise than the file says, and how often.
    std::vector<std::pair<std::string, std::size_t>> warnings;
    bool has_camera = false;    // or else the scene's is one that frames it from the front
    std::size_t triangles = 0;  // of the file, with those that were dropped
};

// The scene that the file says is to be shown, through the camera of that name or number, or through its first. Throws InputError
// of one line if the file is not what it has to be, or asks for more than the limits.
Loaded load(const std::filesystem::path& file, const std::string& camera, const Limits& limits = {});
// The same of bytes in memory.
Loaded load(const std::string& name, std::string_view bytes, const Beside& beside, const std::string& camera,
            const Limits& limits = {});

}  // namespace vndf::gltf
