// Cameras of the file, and one for a file that has none.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gltf/nodes.h"
#include "render/scene.h"

namespace vndf::gltf {

// That with this name (its own or its node's) or number, or the first in the scene; nothing if the scene has none and `choice` is
// empty. A perspective camera's width is its aspect ratio's, if it says one.
std::optional<render::Camera> camera_of(const Item& root, const std::vector<Placed>& nodes,
                                        const std::string& choice);

// From the front (+z), a little above, all of the vertices in view of square images.
render::Camera framing(const std::vector<render::Vertex>& vertices);

}  // namespace vndf::gltf
