#include "gltf/nodes.h"

#include <limits>

#include <fmt/format.h>

namespace vndf::gltf {
namespace {

constexpr double any = std::numeric_limits<float>::max();

double in_range(const Item& item, double x) {
    if (!(std::abs(x) <= any)) item.fail(fmt::format("{} is no number of floats", x));
    return x;
}

template <std::size_t N>
std::array<double, N> finite_numbers(const Item& item) {
    const std::array<double, N> numbers = item.numbers<N>();
    for (const double x : numbers) in_range(item, x);
    return numbers;
}

Affine matrix_of(const Item& item) {
    const std::array<double, 16> m = finite_numbers<16>(item);
    for (int column = 0; column < 4; ++column)
        if (std::abs(m[4 * column + 3] - (column == 3)) > 1e-5) item.fail("its last row is not 0, 0, 0, 1");
    Affine affine;
    for (int column = 0; column < 4; ++column)
        affine.columns[column] = {m[4 * column], m[4 * column + 1], m[4 * column + 2]};
    return affine;
}

Affine rotation_of(const Item& item, Warnings& warnings) {
    std::array<double, 4> q = finite_numbers<4>(item);
    const double size = std::hypot(std::hypot(q[0], q[1]), std::hypot(q[2], q[3]));
    if (!(size > 0)) item.fail("a quaternion of length 0");
    if (std::abs(size - 1) > 0.01)
        warnings.add("rotations made unit quaternions",
                     fmt::format("{} of length {:.6g}", item.place(), size));
    for (double& x : q) x /= size;
    const auto [x, y, z, w] = q;
    return {{{{1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)},
              {2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)},
              {2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)},
              {0, 0, 0}}}};
}

Affine local_of(const Item& node, Warnings& warnings) {
    if (const Item matrix = node["matrix"]) return matrix_of(matrix);
    Affine local;
    if (const Item rotation = node["rotation"]) local = rotation_of(rotation, warnings);
    if (const Item scale = node["scale"]) {
        const Vec3 factors = finite_numbers<3>(scale);
        for (int axis = 0; axis < 3; ++axis)
            local.columns[axis] = sum({}, factors[axis], local.columns[axis]);
    }
    if (const Item translation = node["translation"]) local.columns[3] = finite_numbers<3>(translation);
    return local;
}

struct Tree {
    std::vector<std::vector<std::size_t>> children;
    std::vector<bool> has_parent;
};

Tree tree_of(const Item& nodes) {
    const std::size_t count = nodes.size();
    Tree tree{std::vector<std::vector<std::size_t>>(count), std::vector<bool>(count)};
    for (std::size_t i = 0; i < count; ++i) {
        const Item children = nodes.at(i)["children"];
        for (std::size_t k = 0; k < children.size(); ++k) {
            const std::size_t child = children.at(k).index(count, "node");
            if (tree.has_parent[child]) children.at(k).fail(fmt::format("node {} has two parents", child));
            tree.has_parent[child] = true;
            tree.children[i].push_back(child);
        }
    }
    return tree;
}

// With no more than one parent each, what no root leads to goes round.
void require_no_circle(const Item& nodes, const Tree& tree) {
    std::vector<std::size_t> open;
    std::vector<bool> seen(tree.children.size());
    for (std::size_t i = 0; i < seen.size(); ++i)
        if (!tree.has_parent[i]) open.push_back(i);
    while (!open.empty()) {
        const std::size_t node = open.back();
        open.pop_back();
        seen[node] = true;
        open.insert(open.end(), tree.children[node].begin(), tree.children[node].end());
    }
    for (std::size_t i = 0; i < seen.size(); ++i)
        if (!seen[i]) nodes.at(i).fail("is below itself");
}

}  // namespace

std::vector<Placed> placed_nodes(const Item& root, Warnings& warnings) {
    const Item nodes = root["nodes"], scenes = root["scenes"];
    const Tree tree = tree_of(nodes);
    require_no_circle(nodes, tree);
    const Item choice = root["scene"];
    if (choice) choice.index(scenes.size(), "scene");
    if (scenes.size() == 0) root.fail("there is no scene: nothing to render");
    const Item roots = scenes.at(choice ? choice.index(scenes.size(), "scene") : 0)["nodes"];

    struct Open {
        std::size_t node;
        Affine parent;
    };
    std::vector<Open> open;
    std::vector<bool> listed(tree.children.size());
    for (std::size_t k = roots.size(); k-- > 0;) {
        const std::size_t node = roots.at(k).index(nodes.size(), "node");
        if (tree.has_parent[node] || listed[node])
            roots.at(k).fail(fmt::format("node {} is below another, or listed twice", node));
        listed[node] = true;
        open.push_back({node, {}});
    }
    std::vector<Placed> placed;
    while (!open.empty()) {
        const auto [node, parent] = open.back();
        open.pop_back();
        const Item item = nodes.at(node);
        const Affine to_world = parent * local_of(item, warnings);
        placed.push_back({item, to_world, node});
        const std::vector<std::size_t>& children = tree.children[node];
        for (auto child = children.rbegin(); child != children.rend(); ++child)
            open.push_back({*child, to_world});
    }
    return placed;
}

}  // namespace vndf::gltf
