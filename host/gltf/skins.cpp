#include "gltf/skins.h"

#include <algorithm>

#include <fmt/format.h>

namespace vndf::gltf {
namespace {

Affine matrix_at(const Accessor& accessor, std::size_t i) {
    Affine affine;
    for (std::size_t column = 0; column < 4; ++column)
        for (std::size_t row = 0; row < 3; ++row)
            affine.columns[column][row] = accessor.number(i, 4 * column + row);
    return affine;
}

// The sum of a vertex's joints by its weights, whose sum is made 1.
Affine blended(const Primitive& primitive, std::uint32_t vertex, const Joints& joints, Warnings& warnings) {
    Affine blend{};
    blend.columns = {};
    double total = 0;
    for (const auto& [numbers, weights] : primitive.joints)
        for (std::size_t k = 0; k < 4; ++k) {
            const double weight = weights->number(vertex, k);
            if (!(weight > 0 && std::isfinite(weight))) continue;
            const double number = numbers->number(vertex, k);
            if (!(number < static_cast<double>(joints.size())))
                primitive.item.fail(
                    fmt::format("joint {} of vertex {}: its skin has {}", number, vertex, joints.size()));
            const Affine& joint = joints[static_cast<std::size_t>(number)];
            for (std::size_t c = 0; c < 4; ++c)
                blend.columns[c] = sum(blend.columns[c], weight, joint.columns[c]);
            total += weight;
        }
    if (total == 0) {
        warnings.add("vertices of a skin without weights, moved by its first joint", primitive.item.place());
        return joints.front();
    }
    for (Vec3& column : blend.columns) column = sum({}, 1 / total, column);
    return blend;
}

}  // namespace

Skins::Skins(const Item& root, const Accessors& accessors, const std::vector<Placed>& nodes)
    : skins_(root["skins"]), nodes_(root["nodes"]), accessors_(accessors) {
    for (const Placed& placed : nodes) world_of_.emplace(placed.number, placed.to_world);
}

const Joints& Skins::joints(const Item& index) {
    const std::size_t number = index.index(skins_.size(), "skin");
    const auto [found, is_new] = joints_of_.try_emplace(number);
    if (is_new) found->second = read(skins_.at(number));
    return found->second;
}

Joints Skins::read(const Item& skin) const {
    const Item nodes = skin["joints"], inverses = skin["inverseBindMatrices"];
    if (nodes.size() == 0) nodes.fail("a skin without joints");
    const Accessor* const inverse = inverses ? &accessors_.of(inverses) : nullptr;
    if (inverse && (inverse->type() != "MAT4" || inverse->component() != Component::f32 ||
                    inverse->count() < nodes.size()))
        inverses.fail(fmt::format("not a MAT4 of floats for each of {} joints", nodes.size()));
    Joints joints;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const auto world = world_of_.find(nodes.at(i).index(nodes_.size(), "node"));
        if (world == world_of_.end()) nodes.at(i).fail("a joint that is not in the scene");
        joints.push_back(inverse ? world->second * matrix_at(*inverse, i) : world->second);
    }
    return joints;
}

Surface posed(Surface surface, const Primitive& primitive, const Joints& joints, Warnings& warnings) {
    for (std::size_t i = 0; i < surface.vertices.size(); ++i) {
        render::Vertex& vertex = surface.vertices[i];
        const Affine to_world = blended(primitive, surface.sources[i], joints, warnings);
        vertex.place = narrow(to_world.point(wide(vertex.place)));
        vertex.normal = narrow(unit(to_world.of_normals().direction(wide(vertex.normal))));
        const auto [x, y, z, sign] = vertex.tangent;
        const render::Vec tangent = narrow(unit(to_world.direction({x, y, z})));
        vertex.tangent = {tangent[0], tangent[1], tangent[2], to_world.determinant() < 0 ? -sign : sign};
    }
    if (joints.front().determinant() < 0)
        for (Corners& triangle : surface.triangles) std::swap(triangle[1], triangle[2]);
    return surface;
}

}  // namespace vndf::gltf
