// Surfaces in the world.
#pragma once

#include "gltf/surfaces.h"
#include "gltf/vectors.h"

namespace vndf::gltf {

// Triangles that are not in the scene.
struct Dropped {
    std::size_t without_area = 0, out_of_range = 0;
};
// Adds a surface where a node has it. One that is mirrored has its corners run the other way, and its bitangents.
void place(const Surface& surface, const Affine& to_world, std::uint32_t material, render::Scene& scene,
           Dropped& dropped);

}  // namespace vndf::gltf
