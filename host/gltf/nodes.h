// The tree of nodes: what hangs in the scene, and where.
#pragma once

#include <vector>

#include "gltf/json.h"
#include "gltf/vectors.h"
#include "gltf/warnings.h"

namespace vndf::gltf {

// A node of the scene, and the way from it to the world.
struct Placed {
    Item node;
    Affine to_world;
    std::size_t number;
};

// The nodes of the scene that the file says is to be shown, or else of the first. Every node of the file is in one place of one
// tree, or InputError is thrown.
std::vector<Placed> placed_nodes(const Item& root, Warnings& warnings);

}  // namespace vndf::gltf
