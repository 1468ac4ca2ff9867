// Surfaces in the world.
#pragma once

#include "gltf/surfaces.h"
#include "gltf/vectors.h"

namespace vndf::gltf {

// Adds a surface where a node has it. One that is mirrored has its corners run the other way, and its bitangents.
void place(const Surface& surface, const Affine& to_world, std::uint32_t material, render::Scene& scene,
           Dropped& dropped);

}  // namespace vndf::gltf
