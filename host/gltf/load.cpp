#include "gltf/load.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "file.h"
#include "gltf/accessors.h"
#include "gltf/cameras.h"
#include "gltf/container.h"
#include "gltf/images.h"
#include "gltf/lights.h"
#include "gltf/materials.h"
#include "gltf/meshes.h"
#include "gltf/nodes.h"
#include "gltf/placing.h"
#include "gltf/skins.h"
#include "gltf/surfaces.h"

namespace vndf::gltf {
namespace {

constexpr std::array<std::string_view, 12> supported{
    "KHR_lights_punctual",      "KHR_materials_anisotropy",        "KHR_materials_clearcoat",
    "KHR_materials_dispersion", "KHR_materials_emissive_strength", "KHR_materials_ior",
    "KHR_materials_specular",   "KHR_materials_transmission",      "KHR_materials_unlit",
    "KHR_materials_volume",     "KHR_mesh_quantization",           "KHR_texture_transform"};

bool is_supported(const std::string& extension) {
    return std::find(supported.begin(), supported.end(), extension) != supported.end();
}

void require_version(const Item& asset) {
    const auto require = [](const Item& item) {
        const std::string version = item.text();
        if (version != "2" && !version.starts_with("2."))
            item.fail(in_quotes(version) + " is not read; glTF of version 2.0 is");
    };
    require(asset["version"]);
    if (const Item least = asset["minVersion"]) {
        require(least);
        if (least.text() != "2.0") least.fail(in_quotes(least.text()) + " is not read; 2.0 is");
    }
}

void require_extensions(const Item& required) {
    std::string unknown;
    for (std::size_t i = 0; i < required.size() && unknown.size() < 300; ++i) {
        const std::string name = required.at(i).text();
        if (!is_supported(name)) unknown += fmt::format("{}{}", unknown.empty() ? "" : ", ", in_quotes(name));
    }
    if (!unknown.empty()) required.fail("not supported: " + unknown);
}

bool uses(const Item& root, const char* extension) {
    for (const char* list : {"extensionsUsed", "extensionsRequired"})
        for (std::size_t i = 0; i < root[list].size(); ++i)
            if (root[list].at(i).text() == extension) return true;
    return false;
}

void warn_of(const Json& json, const std::vector<Placed>& nodes, Warnings& warnings) {
    std::size_t named = 0;
    for (const auto& [name, count] : json.extensions()) {
        constexpr std::size_t most_named = 16;
        if (is_supported(name)) continue;
        warnings.add(named < most_named ? fmt::format("extension {}, left out", in_quotes(name))
                                        : "other extensions, left out",
                     "", count);
        ++named;
    }
    const Item animations = json.root()["animations"];
    warnings.add("animations, shown at rest", "", animations.size());
    for (const Placed& placed : nodes)
        if (placed.node["skin"]) warnings.add("skins, shown at rest", placed.node["skin"].place());
}

void warn_of(const Primitive& primitive, Warnings& warnings) {
    if (primitive.lack) warnings.add(primitive.lack, primitive.item.place());
    if (primitive.item["targets"].size() > 0)
        warnings.add("morph targets, shown at rest", primitive.item.place(),
                     primitive.item["targets"].size());
    if (!primitive.lack && primitive.mode == Mode::list && primitive.corner_count() % 3 != 0)
        warnings.add("corners that make no whole triangle, left out", primitive.item.place(),
                     primitive.corner_count() % 3);
    if (!primitive.lack && primitive.triangle_count() == 0)
        warnings.add("primitives without a triangle", primitive.item.place());
}

[[noreturn]] void refuse_to_render_nothing(const Item& root, const Warnings& warnings) {
    std::string why = "the scene has no triangle";
    for (const auto& [what, count] : warnings.list()) why += fmt::format("; {} ({})", what, count);
    root.fail("nothing to render: " + why);
}

struct Instance {
    Affine to_world;
    Item skin;  // which alone says where it is, if it is there
};

// Where each mesh is.
std::vector<std::vector<Instance>> instances_of(std::size_t meshes, const std::vector<Placed>& nodes) {
    std::vector<std::vector<Instance>> instances(meshes);
    for (const auto& [node, to_world, number] : nodes)
        if (const Item mesh = node["mesh"])
            instances[mesh.index(meshes, "mesh")].push_back({to_world, node["skin"]});
    return instances;
}

std::size_t count_triangles(const Item& root, const std::vector<std::vector<Primitive>>& meshes,
                            const std::vector<std::vector<Instance>>& instances, const Limits& limits) {
    std::uint64_t count = 0;
    for (std::size_t m = 0; m < meshes.size(); ++m)
        for (const Primitive& primitive : meshes[m]) {
            count += std::uint64_t{primitive.triangle_count()} * instances[m].size();
            if (count > limits.triangles)
                root.fail(fmt::format("more than {} triangles, instances counted", limits.triangles));
        }
    return count;
}

void place_everywhere(const Primitive& primitive, const Surface& surface,
                      const std::vector<Instance>& instances, Skins& skins, std::uint32_t material,
                      render::Scene& scene, Dropped& dropped, Warnings& warnings) {
    for (const auto& [to_world, skin] : instances) {
        dropped.without_area += surface.dropped.without_area;
        dropped.out_of_range += surface.dropped.out_of_range;
        if (skin && !primitive.joints.empty())
            place(posed(surface, primitive, skins.joints(skin), warnings), {}, material, scene, dropped);
        else
            place(surface, to_world, material, scene, dropped);
    }
}

}  // namespace

Loaded load(const std::filesystem::path& file, const std::string& camera, const Limits& limits) {
    const std::string bytes = read_file(file, limits.file_bytes);
    return load(file.string(), bytes, beside(file.parent_path()), camera, limits);
}

Loaded load(const std::string& name, std::string_view bytes, const Beside& beside, const std::string& camera,
            const Limits& limits) {
    const Chunks chunks = chunks_of(name, bytes);
    const Json json(name, chunks.json, limits);
    const Item root = json.root();
    require_version(root["asset"]);
    require_extensions(root["extensionsRequired"]);
    Loaded loaded;
    render::Scene& scene = loaded.scene;
    Warnings warnings;
    Resources resources(beside, limits);
    const Accessors accessors(root, chunks.bin, resources, limits);
    Images images(root, accessors, resources, limits, scene, warnings);
    Materials materials(root, images, scene, warnings);
    const auto meshes = read_meshes(root, accessors, materials, uses(root, "KHR_mesh_quantization"));
    const std::vector<Placed> nodes = placed_nodes(root, warnings);
    const auto instances = instances_of(meshes.size(), nodes);
    Skins skins(root, accessors, nodes);
    loaded.triangles = count_triangles(root, meshes, instances, limits);
    const std::optional<render::Camera> found = camera_of(root, nodes, camera);
    scene.lights = lights_of(root, nodes, warnings);
    warn_of(json, nodes, warnings);

    scene.name = std::filesystem::path(name).stem().string();
    scene.open = true;
    scene.triangles.reserve(loaded.triangles);
    Dropped dropped;
    for (std::size_t m = 0; m < meshes.size(); ++m) {
        if (instances[m].empty()) continue;
        for (const Primitive& primitive : meshes[m]) {
            warn_of(primitive, warnings);
            if (primitive.triangle_count() == 0) continue;
            const std::uint32_t material = materials.use(primitive.item["material"]);
            const Surface surface = surface_of(primitive, scene.dressings[material], warnings);
            place_everywhere(primitive, surface, instances[m], skins, material, scene, dropped, warnings);
        }
    }
    warnings.add("triangles without an area that floats can square, dropped", "", dropped.without_area);
    warnings.add("triangles at places that are no numbers or too far, dropped", "", dropped.out_of_range);
    if (scene.triangles.empty()) refuse_to_render_nothing(root, warnings);
    loaded.has_camera = found.has_value();
    scene.camera = found ? *found : framing(scene.vertices);
    loaded.warnings = warnings.list();
    return loaded;
}

}  // namespace vndf::gltf
