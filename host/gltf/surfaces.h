// Primitives as triangles in their own coordinates.
#pragma once

#include <vector>

#include "gltf/meshes.h"
#include "gltf/tangents.h"

namespace vndf::gltf {

// Triangles that are not in the scene.
struct Dropped {
    std::size_t without_area = 0, out_of_range = 0;
};

// A primitive in its own coordinates, with the normals and tangents that its material asks for. A normal of no length is that of
// whatever triangle it is met in.
struct Surface {
    std::vector<render::Vertex> vertices;
    std::vector<std::uint32_t> sources;  // of each vertex, its number in the primitive
    std::vector<Corners> triangles;
    Dropped dropped;
};
Surface surface_of(const Primitive& primitive, const render::Dressing& dressing, Warnings& warnings);

}  // namespace vndf::gltf
