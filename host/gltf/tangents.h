// Tangents after Mikkelsen, "Simulation of Wrinkled Surfaces Revisited" (2008), as glTF asks for where a mesh has none: corners of
// triangles that share place, normal and coordinates, that hang together by edges and whose coordinates run the same way round
// have one tangent, the mean of the triangles' by their angles.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "gltf/vectors.h"

namespace vndf::gltf {

using Corners = std::array<std::uint32_t, 3>;

struct TangentMesh {
    std::vector<Vec3> places, normals;  // normals of length 1, or 0
    std::vector<std::array<double, 2>> uv;
    std::vector<Corners> triangles;
};

struct Tangents {
    static constexpr std::uint32_t none = 0xFFFFFFFF;
    // Orthogonal to the normal, and the sign of the bitangent as glTF has it, whose v runs down.
    std::vector<std::array<float, 4>> groups;
    std::vector<std::array<std::uint32_t, 3>> group_of;  // of each corner of each triangle, or none
};

Tangents tangents_of(const TangentMesh& mesh);

}  // namespace vndf::gltf
