#include "gltf/meshes.h"

#include <algorithm>

#include <fmt/format.h>

namespace vndf::gltf {
namespace {

// What the format allows of an attribute: types, and components with and without normalisation.
struct Format {
    const char* name;
    std::vector<const char*> types;
    std::vector<std::pair<Component, bool>> components, quantized;
};

using enum Component;
const Format positions{
    "POSITION",
    {"VEC3"},
    {{f32, false}},
    {{i8, false}, {i8, true}, {u8, false}, {u8, true}, {i16, false}, {i16, true}, {u16, false}, {u16, true}}};
const Format normal_format{"NORMAL", {"VEC3"}, {{f32, false}}, {{i8, true}, {i16, true}}};
const Format tangent_format{"TANGENT", {"VEC4"}, {{f32, false}}, {{i8, true}, {i16, true}}};
const Format coordinates{"TEXCOORD",
                         {"VEC2"},
                         {{f32, false}, {u8, true}, {u16, true}},
                         {{i8, false}, {i8, true}, {u8, false}, {i16, false}, {i16, true}, {u16, false}}};
const Format colour_format{"COLOR_0", {"VEC3", "VEC4"}, {{f32, false}, {u8, true}, {u16, true}}, {}};
const Format joint_format{"JOINTS", {"VEC4"}, {{u8, false}, {u16, false}}, {}};
const Format weight_format{"WEIGHTS", {"VEC4"}, {{f32, false}, {u8, true}, {u16, true}}, {}};
const Format index_format{"indices", {"SCALAR"}, {{u8, false}, {u16, false}, {u32, false}}, {}};

const Accessor* attribute(const Accessors& accessors, const Item& index, const Format& format,
                          bool quantized) {
    if (!index) return nullptr;
    const Accessor& accessor = accessors.of(index);
    const auto has = [&](const std::vector<std::pair<Component, bool>>& list) {
        return std::find(list.begin(), list.end(), std::pair{accessor.component(), accessor.normalized()}) !=
               list.end();
    };
    const bool type = std::any_of(format.types.begin(), format.types.end(),
                                  [&](const char* name) { return accessor.type() == name; });
    if (!type || !(has(format.components) || (quantized && has(format.quantized))))
        index.fail(fmt::format("{} of {}components {}, which {} cannot be", accessor.type(),
                               accessor.normalized() ? "normalised " : "",
                               static_cast<int>(accessor.component()), format.name));
    return &accessor;
}

void require_count(const Item& index, const Accessor* accessor, std::size_t count) {
    if (accessor && accessor->count() != count)
        index.fail(fmt::format("{} elements for {} vertices", accessor->count(), count));
}

Primitive read_primitive(const Item& item, const Accessors& accessors, const Materials& materials,
                         bool quantized) {
    Primitive primitive{item};
    if (const Item material = item["material"]) materials.require(material);
    const std::uint64_t mode = item["mode"].whole_or(4, 0, 6);
    const Item attributes = item["attributes"];
    if (mode < 4)
        primitive.lack = "points and lines, left out";
    else
        primitive.mode = static_cast<Mode>(mode);
    primitive.indices = attribute(accessors, item["indices"], index_format, false);
    const auto read = [&](const char* name, const Format& format) {
        const Accessor* const accessor = attribute(accessors, attributes[name], format, quantized);
        if (primitive.places) require_count(attributes[name], accessor, primitive.places->count());
        return accessor;
    };
    primitive.places = read("POSITION", positions);
    primitive.normals = read("NORMAL", normal_format);
    primitive.tangents = read("TANGENT", tangent_format);
    primitive.uv = {read("TEXCOORD_0", coordinates), read("TEXCOORD_1", coordinates)};
    primitive.colours = read("COLOR_0", colour_format);
    for (const auto& [joints, weights] : {std::pair{"JOINTS_0", "WEIGHTS_0"}, {"JOINTS_1", "WEIGHTS_1"}})
        if (attributes[joints] && attributes[weights])
            primitive.joints.emplace_back(read(joints, joint_format), read(weights, weight_format));
    if (!primitive.places && !primitive.lack) primitive.lack = "primitives without POSITION, left out";
    return primitive;
}

}  // namespace

std::size_t Primitive::triangle_count() const {
    if (lack) return 0;
    const std::size_t count = corner_count();
    if (mode == Mode::list) return count / 3;
    return count < 3 ? 0 : count - 2;
}

std::vector<std::vector<Primitive>> read_meshes(const Item& root, const Accessors& accessors,
                                                const Materials& materials, bool quantized) {
    const Item items = root["meshes"];
    std::vector<std::vector<Primitive>> meshes(items.size());
    for (std::size_t m = 0; m < meshes.size(); ++m) {
        const Item primitives = items.at(m)["primitives"];
        for (std::size_t p = 0; p < primitives.size(); ++p)
            meshes[m].push_back(read_primitive(primitives.at(p), accessors, materials, quantized));
    }
    return meshes;
}

}  // namespace vndf::gltf
