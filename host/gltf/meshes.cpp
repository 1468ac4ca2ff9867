#include "gltf/meshes.h"

#include <algorithm>
#include <numeric>

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
    if (!primitive.places && !primitive.lack) primitive.lack = "primitives without POSITION, left out";
    return primitive;
}

// Which vertex corner `i` is.
std::uint32_t vertex_at(const Primitive& primitive, std::size_t i) {
    if (!primitive.indices) return static_cast<std::uint32_t>(i);
    const std::uint32_t vertex = primitive.indices->whole(i);
    const Component component = primitive.indices->component();
    const std::uint32_t restart = component == u8 ? 0xFF : component == u16 ? 0xFFFF : 0xFFFFFFFF;
    if (vertex == restart || vertex >= primitive.places->count())
        primitive.item["indices"].fail(
            fmt::format("index {} at {}{}", vertex, i,
                        vertex == restart ? ": the restart value, which is not allowed"
                                          : fmt::format(": the vertices are {}", primitive.places->count())));
    return vertex;
}

std::vector<Corners> corners_of(const Primitive& primitive) {
    std::vector<Corners> triangles(primitive.triangle_count());
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        std::array<std::size_t, 3> at{3 * t, 3 * t + 1, 3 * t + 2};
        if (primitive.mode == Mode::strip) at = {t, t + 1 + t % 2, t + 2 - t % 2};
        if (primitive.mode == Mode::fan) at = {t + 1, t + 2, 0};
        for (int k = 0; k < 3; ++k) triangles[t][k] = vertex_at(primitive, at[k]);
    }
    return triangles;
}

// The vertices that triangles use, in order; the triangles then count among these.
std::vector<std::uint32_t> compacted(std::vector<Corners>& triangles) {
    std::vector<std::uint32_t> used;
    used.reserve(3 * triangles.size());
    for (const Corners& triangle : triangles) used.insert(used.end(), triangle.begin(), triangle.end());
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    for (Corners& triangle : triangles)
        for (std::uint32_t& corner : triangle)
            corner =
                static_cast<std::uint32_t>(std::lower_bound(used.begin(), used.end(), corner) - used.begin());
    return used;
}

// A vertex of its own for each corner.
std::vector<std::uint32_t> separated(std::vector<Corners>& triangles) {
    std::vector<std::uint32_t> used;
    used.reserve(3 * triangles.size());
    for (Corners& triangle : triangles)
        for (std::uint32_t& corner : triangle) {
            used.push_back(corner);
            corner = static_cast<std::uint32_t>(used.size() - 1);
        }
    return used;
}

Vec3 vector_at(const Accessor& accessor, std::size_t i) {
    return {accessor.number(i, 0), accessor.number(i, 1), accessor.number(i, 2)};
}

// Quantised ones are off by less than `tolerance`.
Vec3 unit_at(const Accessor& accessor, std::size_t i, Warnings& warnings) {
    constexpr double tolerance = 0.02;
    const Vec3 v = vector_at(accessor, i), result = unit(v);
    if (is_zero(result))
        warnings.add("normals and tangents without a direction, replaced", accessor.item().place());
    else if (std::abs(length(v) - 1) > tolerance)
        warnings.add("normals and tangents made unit vectors", accessor.item().place());
    return result;
}

std::array<float, 4> tangent_at(const Accessor& accessor, std::size_t i, Warnings& warnings) {
    const render::Vec t = narrow(unit_at(accessor, i, warnings));
    const double sign = accessor.number(i, 3);
    if (std::abs(sign) != 1)
        warnings.add("signs of tangents that are not 1 or -1, made so", accessor.item().place());
    if (t == render::Vec{}) return {};
    return {t[0], t[1], t[2], sign < 0 ? -1.0f : 1.0f};
}

std::array<float, 2> uv_at(const Accessor& accessor, std::size_t i, Warnings& warnings) {
    const double u = accessor.number(i, 0), v = accessor.number(i, 1);
    if (std::abs(u) <= largest_value && std::abs(v) <= largest_value)
        return {static_cast<float>(u), static_cast<float>(v)};
    warnings.add("texture coordinates that are no numbers or too large, made 0", accessor.item().place());
    return {};
}

std::array<float, 4> colour_at(const Accessor& accessor, std::size_t i, Warnings& warnings) {
    std::array<float, 4> colour{1, 1, 1, 1};
    for (std::size_t c = 0; c < (accessor.type() == "VEC4" ? 4 : 3); ++c) {
        const double x = accessor.number(i, c), inside = x > 0 ? std::min(x, 1.0) : 0;
        if (!(x == inside))
            warnings.add("colours of vertices out of range, clamped", accessor.item().place());
        colour[c] = static_cast<float>(inside);
    }
    return colour;
}

render::Vertex vertex_of(const Primitive& primitive, const std::array<bool, 2>& sets, bool tangents,
                         std::size_t i, Warnings& warnings) {
    render::Vertex vertex{narrow(vector_at(*primitive.places, i)), {}};
    if (primitive.normals) vertex.normal = narrow(unit_at(*primitive.normals, i, warnings));
    if (tangents) vertex.tangent = tangent_at(*primitive.tangents, i, warnings);
    for (int set = 0; set < 2; ++set)
        if (sets[set] && primitive.uv[set]) vertex.uv[set] = uv_at(*primitive.uv[set], i, warnings);
    if (primitive.colours) vertex.colour = colour_at(*primitive.colours, i, warnings);
    return vertex;
}

Vec3 face_normal(const Surface& surface, const Corners& triangle) {
    const auto at = [&](int k) { return wide(surface.vertices[triangle[k]].place); };
    return unit(cross(difference(at(1), at(0)), difference(at(2), at(0))));
}

// A vertex that has several tangents becomes as many.
void give_tangents(Surface& surface, const Tangents& tangents) {
    constexpr std::uint32_t none = Tangents::none;
    std::vector<std::uint32_t> first(surface.vertices.size(), none);
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> others;
    for (std::size_t t = 0; t < surface.triangles.size(); ++t)
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t group = tangents.group_of[t][k];
            std::uint32_t& corner = surface.triangles[t][k];
            if (group == none || first[corner] == group) continue;
            if (first[corner] == none) {
                first[corner] = group;
                surface.vertices[corner].tangent = tangents.groups[group];
                continue;
            }
            const auto [found, is_new] =
                others.try_emplace({corner, group}, static_cast<std::uint32_t>(surface.vertices.size()));
            if (is_new) {
                surface.vertices.push_back(surface.vertices[corner]);
                surface.vertices.back().tangent = tangents.groups[group];
            }
            corner = found->second;
        }
}

// By the coordinates of the normal map, as it transforms them.
void make_tangents(Surface& surface, const render::TextureUse& use) {
    TangentMesh mesh;
    for (const render::Vertex& vertex : surface.vertices) {
        mesh.places.push_back(wide(vertex.place));
        mesh.normals.push_back(wide(vertex.normal));
        const double u = vertex.uv[use.set][0], v = vertex.uv[use.set][1];
        const std::array<float, 6>& m = use.transform;
        mesh.uv.push_back({m[0] * u + m[1] * v, m[3] * u + m[4] * v});
    }
    for (const Corners& triangle : surface.triangles)
        if (std::all_of(triangle.begin(), triangle.end(),
                        [&](std::uint32_t i) { return is_finite(mesh.places[i]); }))
            mesh.triangles.push_back(triangle);
    give_tangents(surface, tangents_of(mesh));
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

Surface surface_of(const Primitive& primitive, const render::Dressing& dressing, Warnings& warnings) {
    Surface surface;
    surface.triangles = corners_of(primitive);
    const bool flat = !primitive.normals, wanted = needs_tangents(dressing),
               given = wanted && !flat && primitive.tangents;
    const std::vector<std::uint32_t> used =
        flat ? separated(surface.triangles) : compacted(surface.triangles);
    const render::TextureUse& normal_map = dressing.textures[static_cast<std::size_t>(render::Slot::normal)];
    std::array<bool, 2> sets = sets_of(dressing);
    if (wanted) sets[normal_map.set] = true;
    for (int set = 0; set < 2; ++set)
        if (sets[set] && !primitive.uv[set] && !(given && set == 0))
            warnings.add("meshes without the coordinates that a material's textures ask for, which are 0",
                         primitive.item.place());
    surface.vertices.reserve(used.size());
    for (const std::uint32_t i : used)
        surface.vertices.push_back(vertex_of(primitive, sets, given, i, warnings));
    if (flat)
        for (const Corners& triangle : surface.triangles) {
            const render::Vec normal = narrow(face_normal(surface, triangle));
            for (const std::uint32_t corner : triangle) surface.vertices[corner].normal = normal;
        }
    if (wanted && !given && primitive.uv[normal_map.set]) make_tangents(surface, normal_map);
    return surface;
}

namespace {

// Of surfaces in the world; what is in float there is what the kernels compute with.
constexpr double farthest = 1e15;                             // of a place
constexpr double smallest_area = 1e-18, largest_area = 1e18;  // twice that; their squares are ordinary floats
constexpr double thinnest = 1e-7;                             // sine of an angle that floats tell from none

class Placer {
  public:
    Placer(const Surface& surface, const Affine& to_world, std::uint32_t material, render::Scene& scene)
        : surface_(surface),
          to_world_(to_world),
          mirrored_(to_world.determinant() < 0),
          material_(material),
          scene_(scene),
          number_of_(surface.vertices.size(), none) {
        // The inverse's transpose but for a positive factor.
        const double sign = mirrored_ ? -1 : 1;
        for (int axis = 0; axis < 3; ++axis)
            normals_.columns[axis] =
                sum({}, sign, cross(to_world.columns[(axis + 1) % 3], to_world.columns[(axis + 2) % 3]));
    }

    void place(Corners corners, Dropped& dropped) {
        if (mirrored_) std::swap(corners[1], corners[2]);
        std::array<render::Vec, 3> places;
        bool in_range = true;
        for (int k = 0; k < 3; ++k) {
            places[k] = narrow(to_world_.point(wide(surface_.vertices[corners[k]].place)));
            for (const float x : places[k]) in_range = in_range && std::abs(x) < farthest;
        }
        if (!in_range) {
            ++dropped.out_of_range;
            return;
        }
        const Vec3 ab = wide(narrow(difference(wide(places[1]), wide(places[0])))),
                   ac = wide(narrow(difference(wide(places[2]), wide(places[0])))), normal = cross(ab, ac);
        const double area = length(normal);
        if (!(area > std::max(smallest_area, thinnest * length(ab) * length(ac)) && area < largest_area)) {
            ++dropped.without_area;
            return;
        }
        render::Triangle triangle{{}, material_};
        for (int k = 0; k < 3; ++k) triangle.corners[k] = corner(corners[k], places[k], unit(normal));
        scene_.triangles.push_back(triangle);
    }

  private:
    static constexpr std::uint32_t none = 0xFFFFFFFF;

    std::uint32_t corner(std::uint32_t local, const render::Vec& place, const Vec3& face) {
        if (number_of_[local] != none) return number_of_[local];
        const Vec3 normal = unit(normals_.direction(wide(surface_.vertices[local].normal)));
        const auto number = static_cast<std::uint32_t>(scene_.vertices.size());
        if (!is_zero(normal)) number_of_[local] = number;
        scene_.vertices.push_back(vertex(surface_.vertices[local], place, is_zero(normal) ? face : normal));
        return number;
    }

    render::Vertex vertex(render::Vertex vertex, const render::Vec& place, const Vec3& normal) const {
        vertex.place = place;
        vertex.normal = narrow(normal);
        const auto [x, y, z, sign] = vertex.tangent;
        const Vec3 tangent = unit(across(unit(to_world_.direction({x, y, z})), normal));
        const render::Vec t = narrow(tangent);
        vertex.tangent = {t[0], t[1], t[2], is_zero(tangent) ? 0.0f : mirrored_ ? -sign : sign};
        return vertex;
    }

    const Surface& surface_;
    const Affine& to_world_;
    Affine normals_;
    bool mirrored_;
    std::uint32_t material_;
    render::Scene& scene_;
    std::vector<std::uint32_t> number_of_;
};

}  // namespace

void place(const Surface& surface, const Affine& to_world, std::uint32_t material, render::Scene& scene,
           Dropped& dropped) {
    Placer placer(surface, to_world, material, scene);
    for (const Corners& triangle : surface.triangles) placer.place(triangle, dropped);
}

}  // namespace vndf::gltf
