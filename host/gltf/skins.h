// Skins at rest: where their joints hang in the scene.
#pragma once

#include <map>
#include <unordered_map>
#include <vector>

#include "gltf/nodes.h"
#include "gltf/surfaces.h"

namespace vndf::gltf {

// The way of a joint from the mesh's coordinates to the world.
using Joints = std::vector<Affine>;

class Skins {
  public:
    Skins(const Item& root, const Accessors& accessors, const std::vector<Placed>& nodes);
    // Those of the skin that an index in the file names.
    const Joints& joints(const Item& index);

  private:
    Joints read(const Item& skin) const;

    Item skins_, nodes_;
    const Accessors& accessors_;
    std::unordered_map<std::size_t, Affine> world_of_;  // of nodes in the scene
    std::map<std::size_t, Joints> joints_of_;
};

// A surface in the world, each vertex moved by its joints.
Surface posed(Surface surface, const Primitive& primitive, const Joints& joints, Warnings& warnings);

}  // namespace vndf::gltf
