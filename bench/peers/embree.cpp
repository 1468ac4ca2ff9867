// Our traversal beside Embree's rtcIntersect1, and our renderer beside a path tracer over it (embree_tracer.h), in turn in
// one run: embree OUT.json [ROUNDS]
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <array>
#include <fstream>
#include <functional>
#include <memory>
#include <random>
#include <stdexcept>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bench/peers/embree_tracer.h"

#include "parallel.h"
#include "render/effects.h"
#include "render/tables.h"
#include "render/tree.h"
#include "render/wavefront.h"
#include "runtime/devices.h"

namespace vndf::bench {
namespace {

// Five orbs of so many rows, and the ground.
render::Scene orbs_of(unsigned rows) {
    const render::Scene usual = render::orbs("roughness");
    render::Scene scene;
    scene.name = "five orbs and a square";
    scene.sky = usual.sky;
    scene.camera = usual.camera;
    for (int i = 0; i < 5; ++i)
        scene.add_sphere({2.3f * static_cast<float>(i - 2), 1.002f, 0}, 1, rows, usual.materials[i]);
    scene.add_square(-2000, -2000, 2000, 2000, scene.add_material(render::lambert({0.3f, 0.3f, 0.3f})));
    return scene;
}

// Ours over theirs for each of several rounds: medians of the ratio of wall and of processor time.
struct Ratio {
    double wall, processor, ours_s;  // the last: the fastest
};

struct Spent {
    double wall, processor;
};
Spent spent(const std::function<void()>& work) {
    const auto start = std::chrono::steady_clock::now();
    const std::clock_t before = std::clock();
    work();
    return {std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(),
            static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC};
}

double median(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
    return values[values.size() / 2];
}

Ratio compare(unsigned rounds, const std::function<void()>& ours, const std::function<void()>& theirs) {
    std::vector<double> wall, processor;
    double fastest = 1e30;
    ours();  // compiles
    theirs();
    for (unsigned round = 0; round < rounds; ++round) {
        const Spent a = spent(ours), b = spent(theirs);
        wall.push_back(b.wall / a.wall);
        processor.push_back(b.processor / a.processor);
        fastest = std::min(fastest, a.wall);
    }
    return {median(wall), median(processor), fastest};
}

// Rays in the order of the pixels: planes x, y, z, dx, dy, dz as queues have them.
struct Rays {
    std::size_t count = 0, stride = 0;
    std::vector<float> planes;
    RTCRay at(std::size_t i) const { return embree_ray(&planes[0], &planes[3 * stride], stride, i); }
};

class Comparison {
  public:
    Comparison(const render::Scene& scene, unsigned rounds)
        : scene_(scene),
          rounds_(rounds),
          tree_(render::build_tree(scene)),
          device_(rtcNewDevice(nullptr)),
          embree_(embree_scene(device_, scene)) {}
    Comparison(const Comparison&) = delete;
    ~Comparison() {
        rtcReleaseScene(embree_);
        rtcReleaseDevice(device_);
    }

    std::string json() {
        const Rays camera = camera_rays(), diffuse = diffuse_rays(camera);
        std::string text =
            fmt::format("{{\"scene\": \"{}\", \"triangles\": {}", scene_.name, scene_.triangles.size());
        text += ",\n " + traced("camera rays in packets", camera, 8);
        text += ",\n " + traced("camera rays", camera, 1);
        text += ",\n " + traced("diffuse rays", diffuse, 1);
        return text + ",\n " + rendered() + "}";
    }

  private:
    static Rays rays_of(std::size_t count) {
        Rays rays{count, runtime::whole_groups(count), {}};
        rays.planes.resize(VNDF_PATH_PLANES * rays.stride);
        // What carries nothing is not traced.
        std::fill_n(&rays.planes[VNDF_PATH_RED * rays.stride], rays.stride, 1.0f);
        return rays;
    }

    Rays camera_rays() const {
        constexpr unsigned side = 1024;
        Rays rays = rays_of(std::size_t{side} * side);
        const vndf_render_view view = render::view_of(scene_.camera, side, side);
        const std::vector<std::uint32_t> words = render::Words(render::Random::sobol, 1, 1).next();
        std::vector<uint> slot(rays.stride);
        std::vector<float> light(3 * rays.stride);
        for (std::size_t i = 0; i < rays.count; ++i) {
            vndf_render_item = static_cast<uint>(i);
            vndf_render_generate(view, words.data(), 0, static_cast<uint>(rays.stride), rays.planes.data(),
                                 slot.data(), light.data());
        }
        return rays;
    }

    // By the cosine law from what those hit.
    Rays diffuse_rays(const Rays& camera) const {
        std::mt19937 random(1);
        std::normal_distribution<float> normal;
        std::vector<std::array<float, 6>> all;
        for (std::size_t i = 0; i < camera.count; ++i) {
            const RTCRayHit found = embree_hit(embree_, camera.at(i));
            if (found.hit.geomID == RTC_INVALID_GEOMETRY_ID) continue;
            const RTCRay& r = found.ray;
            const float n[] = {found.hit.Ng_x, found.hit.Ng_y, found.hit.Ng_z};
            const float v[] = {normal(random), normal(random), normal(random)};
            const float d[] = {r.dir_x, r.dir_y, r.dir_z}, o[] = {r.org_x, r.org_y, r.org_z};
            const float facing = n[0] * d[0] + n[1] * d[1] + n[2] * d[2] < 0 ? 1.0f : -1.0f;
            const float to_n = facing / std::hypot(n[0], n[1], n[2]), to_v = 1 / std::hypot(v[0], v[1], v[2]);
            std::array<float, 6> ray;
            for (int axis = 0; axis < 3; ++axis) {
                ray[axis] = o[axis] + r.tfar * d[axis] + 1e-4f * to_n * n[axis];
                ray[3 + axis] = to_n * n[axis] + to_v * v[axis];
            }
            all.push_back(ray);
        }
        Rays rays = rays_of(all.size());
        for (std::size_t i = 0; i < all.size(); ++i)
            for (int k = 0; k < 6; ++k) rays.planes[k * rays.stride + i] = all[i][k];
        return rays;
    }

    std::unique_ptr<render::Stages> stages(unsigned packet) const {
        render::Switches switches = render::switches(scene_, render::effects_for(scene_, "auto"), {});
        switches.packet = packet;
        return render::device_stages(runtime::choose_device().device, runtime::Math::strict, switches);
    }

    // First hits of rays: the stage of ours, rtcIntersect1 on as many threads.
    std::string traced(const std::string& name, const Rays& rays, unsigned packet) const {
        const auto ours = stages(packet);
        const auto count = static_cast<uint>(rays.count), stride = static_cast<uint>(rays.stride);
        const auto nodes = ours->upload(tree_.nodes), leaves = ours->upload(tree_.leaves),
                   path = ours->upload(rays.planes), hit = ours->buffer(8 * rays.stride),
                   triangle = ours->buffer(4 * rays.stride), slot = ours->buffer(4 * rays.stride),
                   vertices = ours->upload(render::vertex_table(scene_)),
                   triangles = ours->upload(render::triangle_table(scene_)), none = ours->buffer(4);
        const vndf_render_sizes sizes = render::sizes_of(scene_);
        const uint first = 0, salt = 0;
        std::vector<uint> found(count), theirs(count);
        const Ratio ratio = compare(
            rounds_,
            [&] {
                ours->launch(packet > 1 ? "packets" : "traverse", (count + packet - 1) / packet,
                             {nodes, leaves, &sizes, vertices, triangles, none, none, none, slot, first, salt,
                              path, count, stride, hit, triangle});
                ours->read(triangle, found.data(), 4 * rays.count);
            },
            [&] {
                parallel_for(rays.count, 4096, [&](unsigned, std::size_t begin, std::size_t end) {
                    for (std::size_t i = begin; i < end; ++i) {
                        const RTCHit h = embree_hit(embree_, rays.at(i)).hit;
                        theirs[i] = h.geomID == RTC_INVALID_GEOMETRY_ID ? VNDF_MISS : h.primID;
                    }
                });
            });
        std::size_t different = 0;
        for (std::size_t i = 0; i < rays.count; ++i) different += found[i] != theirs[i];
        // On edges either triangle may be the first.
        if (different > rays.count / 1000)
            throw std::runtime_error(
                fmt::format("{}: {} of {} meet another triangle than Embree's", name, different, rays.count));
        return row(name, ratio, static_cast<double>(rays.count)) +
               fmt::format(", \"other triangles\": {}}}", different);
    }

    // A sample of every pixel. The tracer's film is a sum as ours.
    std::string rendered() const {
        const render::Settings settings;
        const unsigned pixels = settings.width * settings.height;
        const auto ours = stages(0);
        render::Wavefront wavefront(*ours, scene_, tree_, settings);
        render::Words words(settings.random, settings.seed, 1 + VNDF_QUAD_BOUNCE * settings.max_bounces);
        const std::vector<float> vertices = render::vertex_table(scene_),
                                 materials = render::material_table(scene_);
        const std::vector<std::uint32_t> triangles = render::triangle_table(scene_);
        std::vector<float> film(std::size_t{3} * pixels);
        unsigned samples = 0;
        const Ratio ratio = compare(
            rounds_, [&] { wavefront.add_sample(); },
            [&] {
                const std::vector<std::uint32_t> sample = words.next();
                const Tables tables{render::view_of(scene_.camera, settings.width, settings.height),
                                    render::sky_of(scene_, {}),
                                    render::sizes_of(scene_),
                                    vertices.data(),
                                    materials.data(),
                                    triangles.data(),
                                    sample.data()};
                parallel_for(pixels, 4096, [&](unsigned, std::size_t begin, std::size_t end) {
                    for (std::size_t i = begin; i < end; ++i)
                        embree_path(embree_, tables, static_cast<uint>(i), settings.max_bounces,
                                    &film[3 * i]);
                });
                ++samples;
            });
        double mean = 0, other = 0;
        for (const float x : wavefront.image().pixels) mean += x;
        for (const float x : film) other += x / samples;
        return row("whole render", ratio, pixels) + fmt::format(", \"means\": {:.5f}}}", mean / other);
    }

    static std::string row(const std::string& name, const Ratio& ratio, double items) {
        fmt::print("{:24} {:.2f} of Embree's speed ({:.2f} by processor time), {:.1f} M/s\n", name,
                   ratio.wall, ratio.processor, items / ratio.ours_s / 1e6);
        return fmt::format(
            "\"{}\": {{\"speed\": {:.3f}, \"by processor time\": {:.3f}, \"ours, M/s\": {:.2f}", name,
            ratio.wall, ratio.processor, items / ratio.ours_s / 1e6);
    }

    render::Scene scene_;
    unsigned rounds_;
    render::Tree tree_;
    RTCDevice device_;
    RTCScene embree_;
};

}  // namespace
}  // namespace vndf::bench

int main(int argc, char** argv) {
    using namespace vndf;
    if (argc < 2) return fmt::print(stderr, "usage: embree OUT.json [ROUNDS]\n"), 2;
    const unsigned rounds = argc > 2 ? static_cast<unsigned>(std::atoi(argv[2])) : 15;
    std::vector<render::Scene> scenes;
    for (const unsigned rows : {22u, 71u, 224u}) scenes.push_back(bench::orbs_of(rows));
    scenes.push_back(render::orbs("roughness"));
    std::vector<std::string> parts;
    try {
        for (const render::Scene& scene : scenes) {
            fmt::print("{}, {} triangles\n", scene.name, scene.triangles.size());
            parts.push_back(bench::Comparison(scene, rounds).json());
        }
    } catch (const std::exception& error) {
        return fmt::print(stderr, "embree: {}\n", error.what()), 1;
    }
    const runtime::Device device = runtime::choose_device().device;
    double load = 0;
    getloadavg(&load, 1);
    std::ofstream(argv[1]) << fmt::format(
        "{{\"device\": \"{}\", \"platform\": \"{}\", \"threads\": {}, \"load\": {:.1f}, \"embree\": \"{}\", "
        "\"rounds\": {}, \"scenes\": [\n{}\n]}}\n",
        device.name, device.platform_version, thread_count(), load, RTC_VERSION_STRING, rounds,
        fmt::join(parts, ",\n"));
}
