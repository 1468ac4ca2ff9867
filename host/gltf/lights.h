// KHR_lights_punctual.
#pragma once

#include <vector>

#include "gltf/nodes.h"
#include "render/scene.h"

namespace vndf::gltf {

// Those of the scene's nodes. One that is nowhere, or shines nowhere, is left out with a warning.
std::vector<render::PunctualLight> lights_of(const Item& root, const std::vector<Placed>& nodes,
                                             Warnings& warnings);

}  // namespace vndf::gltf
