// The tree of boxes over a scene's triangles, as the kernels walk it (kernels/render/tree.h), built by Embree.
#pragma once

#include <vector>

#include "render/scene.h"

namespace vndf::render {

struct Tree {
    std::vector<float> nodes;   // VNDF_NODE_SIZE each, the root first
    std::vector<float> leaves;  // VNDF_LEAF_SIZE each
};

// Throws InputError if a place is no finite number below 1e15, which Embree would end the process for; DeviceError where this
// build has no Embree.
Tree build_tree(const Scene& scene);

}  // namespace vndf::render
