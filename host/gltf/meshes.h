// Meshes of the file.
#pragma once

#include <vector>

#include "gltf/accessors.h"
#include "gltf/materials.h"

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
    std::vector<std::pair<const Accessor*, const Accessor*>> joints{};  // and their weights, four each

    std::size_t corner_count() const { return indices ? indices->count() : places->count(); }
    std::size_t triangle_count() const;
};

// `quantized`: KHR_mesh_quantization is used, which allows more formats.
std::vector<std::vector<Primitive>> read_meshes(const Item& root, const Accessors& accessors,
                                                const Materials& materials, bool quantized);

}  // namespace vndf::gltf
