// Primitives as triangles in their own coordinates.
#pragma once

#include <vector>

#include "gltf/meshes.h"
#include "gltf/tangents.h"

namespace vndf::gltf {

// A primitive in its own coordinates, with the normals and tangents that its material asks for. A normal of no length is that of
// whatever triangle it is met in.
struct Surface {
    std::vector<render::Vertex> vertices;
    std::vector<Corners> triangles;
    std::size_t dropped = 0;  // triangles with two corners at one place
};
Surface surface_of(const Primitive& primitive, const render::Dressing& dressing, Warnings& warnings);

}  // namespace vndf::gltf
