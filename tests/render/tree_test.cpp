// Rays through the tree meet what they meet without one, to the bit.
#include <random>

#define VNDF_PACKET 16
#define VNDF_RENDER_ALPHA 0  // every surface is there for every ray
#include "kernels/render/packet.h"
#include "render/tree.h"
#include "support/catch.h"

using namespace vndf;

namespace {

render::Scene soup(unsigned triangles, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> place(-1, 1), edge(-0.2f, 0.2f);
    render::Scene scene;
    scene.name = "soup";
    scene.add_material(render::lambert({1, 1, 1}));
    for (unsigned i = 0; i < triangles; ++i) {
        const render::Vec a{place(random), place(random), place(random)};
        const auto first = static_cast<std::uint32_t>(scene.vertices.size());
        for (int corner = 0; corner < 3; ++corner) {
            render::Vec p = a;
            for (float& x : p) x += corner == 0 ? 0 : edge(random);
            scene.vertices.push_back({p, {0, 1, 0}});
        }
        scene.triangles.push_back({{first, first + 1, first + 2}, 0});
        // Some twice: of two hits at one distance that of the lower number counts.
        if (i % 7 == 0) scene.triangles.push_back(scene.triangles.back());
    }
    return scene;
}

// Every leaf in turn.
vndf_render_hit brute(const render::Tree& tree, const vndf_render_ray& ray) {
    vndf_render_hit hit{3.0e38f, 0, 0, VNDF_MISS};
    for (std::size_t i = 0; i < tree.leaves.size(); i += VNDF_LEAF_SIZE)
        hit = vndf_render_leaf(&tree.leaves[i], ray, hit, {});
    return hit;
}

bool same(const vndf_render_hit& a, const vndf_render_hit& b) {
    return a.triangle == b.triangle && a.t == b.t && a.b1 == b.b1 && a.b2 == b.b2;
}

}  // namespace

TEST_CASE("the tree finds the first hit of every ray, whatever its shape") {
    std::mt19937 random(5);
    std::normal_distribution<float> normal;
    for (const unsigned triangles : {0u, 1u, 9u, 2000u}) {
        CAPTURE(triangles);
        const render::Scene scene = soup(triangles, triangles);
        const render::Tree tree = render::build_tree(scene);
        unsigned hits = 0, wrong = 0, seconds = 0;
        for (int i = 0; i < 4000; ++i) {
            float d[3], o[3];
            for (int axis = 0; axis < 3; ++axis) {
                o[axis] = normal(random);
                d[axis] = i % 5 == axis ? 0.0f : normal(random);  // along a plane of the axes, too
            }
            const vndf_render_ray ray = vndf_render_ray_of(o[0], o[1], o[2], d[0], d[1], d[2]);
            const vndf_render_hit found = vndf_render_trace(tree.nodes.data(), tree.leaves.data(), ray,
                                                            VNDF_RENDER_ANYWHERE, 0, {}),
                                  any = vndf_render_trace(tree.nodes.data(), tree.leaves.data(), ray,
                                                          VNDF_RENDER_ANYWHERE, 1, {}),
                                  first = brute(tree, ray);
            hits += first.triangle != VNDF_MISS;
            // The second of two in one place is never the one that counts.
            seconds += found.triangle != VNDF_MISS && found.triangle > 0 &&
                       scene.triangles[found.triangle].corners == scene.triangles[found.triangle - 1].corners;
            wrong += !same(found, first) || (any.triangle == VNDF_MISS) != (first.triangle == VNDF_MISS);
        }
        CHECK(wrong == 0);
        CHECK(seconds == 0);
        if (triangles > 1000) CHECK(hits > 1000);
    }
}

TEST_CASE("rays in packets find what single ones find, however far apart they run") {
    std::mt19937 random(11);
    std::normal_distribution<float> normal;
    const render::Tree tree = render::build_tree(soup(2000, 3));
    const auto trace = [&](const vndf_render_ray& ray) {
        return vndf_render_trace(tree.nodes.data(), tree.leaves.data(), ray, VNDF_RENDER_ANYWHERE, 0, {});
    };
    unsigned hits = 0, wrong = 0, beams = 0;
    for (int i = 0; i < 2000; ++i) {
        const float spread = std::pow(10.0f, static_cast<float>(i % 5 - 4));
        float o[3], d[3];
        for (int axis = 0; axis < 3; ++axis)
            o[axis] = 2 * normal(random), d[axis] = 0.5f * normal(random) - o[axis];
        vndf_render_packet packet;
        for (int k = 0; k < VNDF_PACKET; ++k) {
            for (float& x : d) x += spread * normal(random);
            vndf_render_add(&packet, k, vndf_render_ray_of(o[0], o[1], o[2], d[0], d[1], d[2]), {});
        }
        if (!vndf_render_together(&packet)) continue;
        ++beams;
        vndf_render_trace_packet(tree.nodes.data(), tree.leaves.data(), &packet);
        for (int k = 0; k < VNDF_PACKET; ++k) {
            hits += packet.hit[k].triangle != VNDF_MISS;
            wrong += !same(packet.hit[k], trace(packet.ray[k]));
        }
    }
    CHECK(wrong == 0);
    CHECK(beams > 500);
    CHECK(hits > 2000);
}

TEST_CASE("no ray slips between the triangles of a closed mesh") {
    render::Scene scene;
    scene.add_sphere({0.1f, 0.2f, 0.3f}, 1, 40, render::lambert({1, 1, 1}));
    const render::Tree tree = render::build_tree(scene);
    std::mt19937 random(7);
    unsigned missed = 0;
    for (int i = 0; i < 20000; ++i) {
        // From inside, towards corners, along edges, and anywhere.
        const auto& triangle = scene.triangles[random() % scene.triangles.size()];
        const render::Vec &a = scene.vertices[triangle.corners[0]].place,
                          &b = scene.vertices[triangle.corners[1]].place;
        const float part = i % 3 == 0 ? 0.0f : static_cast<float>(random()) / 4294967296.0f;
        float d[3];
        for (int axis = 0; axis < 3; ++axis)
            d[axis] = a[axis] + part * (b[axis] - a[axis]) - 0.05f * (axis + 1);
        const vndf_render_ray ray = vndf_render_ray_of(0.05f, 0.1f, 0.15f, d[0], d[1], d[2]);
        missed += vndf_render_trace(tree.nodes.data(), tree.leaves.data(), ray, VNDF_RENDER_ANYWHERE, 0, {})
                      .triangle == VNDF_MISS;
    }
    CHECK(missed == 0);
}

TEST_CASE("a ray through a corner or along an edge meets a triangle, from either side") {
    render::Scene scene;
    const std::uint32_t material = scene.add_material(render::lambert({1, 1, 1}));
    for (int i = 0; i < 8; ++i)
        for (int j = 0; j < 8; ++j)
            scene.add_square(static_cast<float>(i), static_cast<float>(j), static_cast<float>(i + 1),
                             static_cast<float>(j + 1), material);
    const render::Tree tree = render::build_tree(scene);
    unsigned missed = 0;
    for (const float side : {1.0f, -1.0f})
        for (int i = 1; i < 16; ++i)
            for (int j = 1; j < 16; ++j) {
                const vndf_render_ray ray = vndf_render_ray_of(0.5f * static_cast<float>(i), side,
                                                               0.5f * static_cast<float>(j), 0, -side, 0);
                missed +=
                    vndf_render_trace(tree.nodes.data(), tree.leaves.data(), ray, VNDF_RENDER_ANYWHERE, 0, {})
                        .triangle == VNDF_MISS;
            }
    CHECK(missed == 0);
}
