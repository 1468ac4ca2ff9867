// Meshes of the file, and their triangles in the world.
#pragma once

#include <vector>

#include "gltf/accessors.h"
#include "gltf/materials.h"
#include "gltf/tangents.h"
#include "gltf/vectors.h"
#include "gltf/warnings.h"
#include "render/scene.h"

namespace vndf::gltf {

enum class Mode { list = 4, strip = 5, fan = 6 };

// A part of a mesh with one material, its accessors checked against each other.
struct Primitive {
    Item item;
    const char* lack = nullptr;  // why there is nothing of it to be seen, if there is nothing
    Mode mode = Mode::list;
    const Accessor* indices = nullptr;
    const Accessor* places = nullptr;
    const Accessor* normals = nullptr;
    const Accessor* tangents = nullptr;
    std::array<const Accessor*, 2> uv{};
    const Accessor* colours = nullptr;

    std::size_t corner_count() const { return indices ? indices->count() : places->count(); }
    std::size_t triangle_count() const;
};

// `quantized`: KHR_mesh_quantization is used, which allows more formats.
std::vector<std::vector<Primitive>> read_meshes(const Item& root, const Accessors& accessors,
                                                const Materials& materials, bool quantized);

// A primitive in its own coordinates, with the normals and tangents that its material asks for. A normal of no length is that of
// whatever triangle it is met in.
struct Surface {
    std::vector<render::Vertex> vertices;
    std::vector<Corners> triangles;
};
Surface surface_of(const Primitive& primitive, const render::Dressing& dressing, Warnings& warnings);

// Triangles that are not in the scene.
struct Dropped {
    std::size_t without_area = 0, out_of_range = 0;
};
// Adds a surface where a node has it. One that is mirrored has its corners run the other way, and its bitangents.
void place(const Surface& surface, const Affine& to_world, std::uint32_t material, render::Scene& scene,
           Dropped& dropped);

}  // namespace vndf::gltf
