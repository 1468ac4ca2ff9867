#include "gltf/surfaces.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

namespace vndf::gltf {
namespace {

// Which vertex corner `i` is.
std::uint32_t vertex_at(const Primitive& primitive, std::size_t i) {
    if (!primitive.indices) return static_cast<std::uint32_t>(i);
    const std::uint32_t vertex = primitive.indices->whole(i);
    const Component component = primitive.indices->component();
    const std::uint32_t restart = component == Component::u8    ? 0xFF
                                  : component == Component::u16 ? 0xFFFF
                                                                : 0xFFFFFFFF;
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

Vec3 vector_at(const Accessor& accessor, std::size_t i) {
    return {accessor.number(i, 0), accessor.number(i, 1), accessor.number(i, 2)};
}

// Those without places that are numbers, or with two corners at one: before vertices are made for them, since an accessor without
// bytes has any number.
Dropped drop_unseen(const Accessor& places, std::vector<Corners>& triangles) {
    Dropped dropped;
    std::erase_if(triangles, [&](const Corners& triangle) {
        const Vec3 a = vector_at(places, triangle[0]), b = vector_at(places, triangle[1]),
                   c = vector_at(places, triangle[2]);
        const bool out_of_range = !is_finite(a) || !is_finite(b) || !is_finite(c),
                   without_area = !out_of_range && (a == b || b == c || c == a);
        dropped.out_of_range += out_of_range;
        dropped.without_area += without_area;
        return out_of_range || without_area;
    });
    return dropped;
}

// The vertices that triangles use; the triangles then count among these. A file can say that it has any number of vertices: the
// work is that of the corners.
std::vector<std::uint32_t> compacted(std::vector<Corners>& triangles, std::size_t vertex_count) {
    constexpr std::uint32_t none = 0xFFFFFFFF;
    std::vector<std::uint32_t> used;
    if (vertex_count <= 4 * triangles.size()) {
        std::vector<std::uint32_t> number_of(vertex_count, none);
        for (Corners& triangle : triangles)
            for (std::uint32_t& corner : triangle) {
                std::uint32_t& number = number_of[corner];
                if (number == none) {
                    number = static_cast<std::uint32_t>(used.size());
                    used.push_back(corner);
                }
                corner = number;
            }
        return used;
    }
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
                surface.sources.push_back(surface.sources[corner]);
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
    mesh.triangles = surface.triangles;
    give_tangents(surface, tangents_of(mesh));
}

}  // namespace

Surface surface_of(const Primitive& primitive, const render::Dressing& dressing, Warnings& warnings) {
    Surface surface;
    surface.triangles = corners_of(primitive);
    surface.dropped = drop_unseen(*primitive.places, surface.triangles);
    const bool flat = !primitive.normals, wanted = needs_tangents(dressing),
               given = wanted && !flat && primitive.tangents;
    surface.sources =
        flat ? separated(surface.triangles) : compacted(surface.triangles, primitive.places->count());
    const render::TextureUse& normal_map = dressing.textures[static_cast<std::size_t>(render::Slot::normal)];
    std::array<bool, 2> sets = sets_of(dressing);
    if (wanted && !given) sets[normal_map.set] = true;
    for (int set = 0; set < 2; ++set)
        if (sets[set] && !primitive.uv[set])
            warnings.add("meshes without the texture coordinates that their material asks for, which are 0",
                         primitive.item.place());
    surface.vertices.reserve(surface.sources.size());
    for (const std::uint32_t i : surface.sources)
        surface.vertices.push_back(vertex_of(primitive, sets, given, i, warnings));
    if (flat)
        for (const Corners& triangle : surface.triangles) {
            const render::Vec normal = narrow(face_normal(surface, triangle));
            for (const std::uint32_t corner : triangle) surface.vertices[corner].normal = normal;
        }
    if (wanted && !given && primitive.uv[normal_map.set]) make_tangents(surface, normal_map);
    return surface;
}

}  // namespace vndf::gltf
