// What `clvndf render` shows: five orbs, or a file's scene, under a sky or an image of the environment.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "render/scene.h"

namespace vndf::cli {

struct SceneOptions {
    std::string file;                // glTF; empty: orbs
    std::string orbs = "roughness";  // of what they are
    std::string camera;              // of the file, a name or a number; empty: the first
    std::string sky = "auto";        // day, white, sunlit, none; auto: day where nothing else shines
    std::string environment;         // an image
    float rotation = 0;              // of it, degrees
    float light_radius = 0;          // of point and spot lights; > 0: they are spheres, and orbs have some
};

struct ShownScene {
    render::Scene scene;
    std::vector<std::pair<std::string, std::size_t>> warnings;  // and how often
};

// Throws InputError, naming the file.
ShownScene shown_scene(const SceneOptions& options);

}  // namespace vndf::cli
