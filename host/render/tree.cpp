#include "render/tree.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <memory>

#include <fmt/format.h>

#include "error.h"

#if CLVNDF_EMBREE == 3
#include <embree3/rtcore.h>
#elif CLVNDF_EMBREE == 4
#include <embree4/rtcore.h>
#endif

namespace vndf::render {

#if CLVNDF_EMBREE

namespace {

constexpr unsigned width = 8;
constexpr float farthest = 1e15f;

struct Box {
    Vec low, high;
};

Box box_of(const RTCBounds& b) {
    return {{b.lower_x, b.lower_y, b.lower_z}, {b.upper_x, b.upper_y, b.upper_z}};
}

// What Embree's callbacks make: a leaf has triangles, another node children.
struct Node {
    unsigned children = 0, triangles = 0;
    const Node* child[width];
    RTCBounds bounds[width];
    std::uint32_t triangle[width];
};

void* create_node(RTCThreadLocalAllocator allocator, unsigned, void*) {
    return new (rtcThreadLocalAlloc(allocator, sizeof(Node), 16)) Node;
}

void* create_leaf(RTCThreadLocalAllocator allocator, const RTCBuildPrimitive* primitives, std::size_t count,
                  void*) {
    Node* const leaf = new (rtcThreadLocalAlloc(allocator, sizeof(Node), 16)) Node;
    leaf->triangles = static_cast<unsigned>(count);
    for (std::size_t i = 0; i < count; ++i) leaf->triangle[i] = primitives[i].primID;
    return leaf;
}

void set_children(void* node, void** children, unsigned count, void*) {
    static_cast<Node*>(node)->children = count;
    std::copy_n(reinterpret_cast<Node**>(children), count, static_cast<Node*>(node)->child);
}

void set_bounds(void* node, const RTCBounds** bounds, unsigned count, void*) {
    for (unsigned i = 0; i < count; ++i) static_cast<Node*>(node)->bounds[i] = *bounds[i];
}

class Flattener {
  public:
    Flattener(const Scene& scene, Tree& tree) : scene_(scene), tree_(tree) {}

    // The number of a child: of a node, or ~ of a leaf.
    int append(const Node& node, unsigned depth) {
        if (node.children == 0) return append_leaf(node);
        if (depth >= VNDF_TREE_DEPTH) throw DeviceError("the tree over the scene's triangles is too deep");
        const std::size_t own = tree_.nodes.size() / VNDF_NODE_SIZE;
        append_empty_node();
        for (unsigned i = 0; i < node.children; ++i)
            set_child(own, i, box_of(node.bounds[i]), append(*node.child[i], depth + 1));
        return static_cast<int>(own);
    }

    void append_empty_node() {
        const std::size_t begin = tree_.nodes.size();
        tree_.nodes.resize(begin + VNDF_NODE_SIZE, 0.0f);
        // A box that no ray enters.
        std::fill_n(tree_.nodes.begin() + begin + VNDF_NODE_LOW_X, 3 * width, 1e30f);
        std::fill_n(tree_.nodes.begin() + begin + VNDF_NODE_HIGH_X, 3 * width, -1e30f);
    }

    void set_child(std::size_t node, unsigned i, const Box& box, int child) {
        float* const at = &tree_.nodes[VNDF_NODE_SIZE * node] + i;
        for (int axis = 0; axis < 3; ++axis) {
            at[VNDF_NODE_LOW_X + 8 * axis] = box.low[axis];
            at[VNDF_NODE_HIGH_X + 8 * axis] = box.high[axis];
        }
        at[VNDF_NODE_CHILD] = std::bit_cast<float>(child);
        if (child >= 0) return;
        float* const leaf = &tree_.leaves[VNDF_LEAF_SIZE * static_cast<std::size_t>(~child)];
        std::copy_n(box.low.begin(), 3, leaf + VNDF_LEAF_LOW);
        std::copy_n(box.high.begin(), 3, leaf + VNDF_LEAF_HIGH);
    }

  private:
    int append_leaf(const Node& leaf) {
        const std::size_t own = tree_.leaves.size() / VNDF_LEAF_SIZE;
        // Lanes without a triangle have one without an area, which no ray meets.
        tree_.leaves.resize(tree_.leaves.size() + VNDF_LEAF_SIZE, 0.0f);
        float* const at = &tree_.leaves[VNDF_LEAF_SIZE * own];
        for (unsigned i = 0; i < leaf.triangles; ++i) {
            const Triangle& triangle = scene_.triangles[leaf.triangle[i]];
            for (int corner = 0; corner < 3; ++corner)
                for (int axis = 0; axis < 3; ++axis)
                    at[VNDF_LEAF_CORNER(corner) + 8 * axis + i] =
                        scene_.vertices[triangle.corners[corner]].place[axis];
            at[VNDF_LEAF_TRIANGLE + i] = std::bit_cast<float>(leaf.triangle[i]);
        }
        return ~static_cast<int>(own);
    }

    const Scene& scene_;
    Tree& tree_;
};

// Each triangle's box, widened by what rounding may move a hit on it.
std::vector<RTCBuildPrimitive> primitives_of(const Scene& scene) {
    std::vector<RTCBuildPrimitive> primitives(scene.triangles.size());
    for (std::size_t i = 0; i < primitives.size(); ++i) {
        Vec low{farthest, farthest, farthest}, high{-farthest, -farthest, -farthest};
        for (const std::uint32_t corner : scene.triangles[i].corners)
            for (int axis = 0; axis < 3; ++axis) {
                const float place = scene.vertices.at(corner).place[axis];
                if (!(std::abs(place) < farthest))
                    throw InputError(
                        fmt::format("{}: triangle {} has a corner at {}; finite numbers below {} are allowed",
                                    scene.name, i, place, farthest));
                low[axis] = std::min(low[axis], place);
                high[axis] = std::max(high[axis], place);
            }
        for (int axis = 0; axis < 3; ++axis) {
            const float margin = 1e-6f * std::max({std::abs(low[axis]), std::abs(high[axis]), 1e-6f});
            low[axis] -= margin;
            high[axis] += margin;
        }
        primitives[i] = {low[0], low[1], low[2], 0, high[0], high[1], high[2], static_cast<unsigned>(i)};
    }
    return primitives;
}

struct Release {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
    void operator()(RTCBVH bvh) const { rtcReleaseBVH(bvh); }
};

}  // namespace

Tree build_tree(const Scene& scene) {
    std::vector<RTCBuildPrimitive> primitives = primitives_of(scene);
    Tree tree;
    Flattener flattener(scene, tree);
    if (primitives.empty()) {
        flattener.append_empty_node();
        tree.leaves.resize(VNDF_LEAF_SIZE, 0.0f);
        return tree;
    }
    const std::unique_ptr<std::remove_pointer_t<RTCDevice>, Release> device(rtcNewDevice(nullptr));
    const std::unique_ptr<std::remove_pointer_t<RTCBVH>, Release> bvh(device ? rtcNewBVH(device.get())
                                                                             : nullptr);
    if (!bvh) throw DeviceError("Embree cannot be started");
    RTCBuildArguments arguments = rtcDefaultBuildArguments();
    arguments.bvh = bvh.get();
    arguments.maxBranchingFactor = width;
    arguments.maxDepth = VNDF_TREE_DEPTH - 2;
    arguments.sahBlockSize = width;
    arguments.minLeafSize = width;
    arguments.maxLeafSize = width;
    arguments.primitives = primitives.data();
    arguments.primitiveCount = primitives.size();
    arguments.primitiveArrayCapacity = primitives.size();
    arguments.createNode = create_node;
    arguments.setNodeChildren = set_children;
    arguments.setNodeBounds = set_bounds;
    arguments.createLeaf = create_leaf;
    const Node* const root = static_cast<const Node*>(rtcBuildBVH(&arguments));
    if (!root)
        throw DeviceError(fmt::format("Embree built no tree over the scene's triangles (error {})",
                                      static_cast<int>(rtcGetDeviceError(device.get()))));
    if (root->children != 0) {
        flattener.append(*root, 0);
    } else {  // the root of the kernels is a node
        flattener.append_empty_node();
        const Box everything{{-farthest, -farthest, -farthest}, {farthest, farthest, farthest}};
        flattener.set_child(0, 0, everything, flattener.append(*root, 1));
    }
    return tree;
}

#else

Tree build_tree(const Scene&) {
    throw DeviceError(
        "this build has no Embree, which builds the tree over the triangles; install libembree-dev, then "
        "configure and build again");
}

#endif

}  // namespace vndf::render
