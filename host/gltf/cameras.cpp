#include "gltf/cameras.h"

#include <algorithm>
#include <numbers>

#include <fmt/format.h>

namespace vndf::gltf {
namespace {

constexpr double farthest = 1e15, smallest = 1e-15, widest = 3.1;  // radians, of the angle of view

struct Hung {
    std::size_t number;
    const Placed* node;
};

std::vector<Hung> hung_cameras(const Item& cameras, const std::vector<Placed>& nodes) {
    std::vector<Hung> hung;
    for (const Placed& placed : nodes)
        if (const Item index = placed.node["camera"])
            hung.push_back({index.index(cameras.size(), "camera"), &placed});
    std::stable_sort(hung.begin(), hung.end(),
                     [](const Hung& a, const Hung& b) { return a.number < b.number; });
    return hung;
}

std::string listed(const Item& cameras, const std::vector<Hung>& hung) {
    std::string list;
    for (const Hung& one : hung) {
        const std::string name = cameras.at(one.number)["name"].text_or(one.node->node["name"].text_or(""));
        list += fmt::format("{}{}", list.empty() ? "" : ", ", one.number);
        if (!name.empty()) list += fmt::format(" {}", in_quotes(name));
    }
    return list.empty() ? "none" : list;
}

const Hung* chosen(const Item& cameras, const std::vector<Hung>& hung, const std::string& choice) {
    if (choice.empty()) return hung.empty() ? nullptr : &hung.front();
    const auto called = [&](const Hung& one) {
        return cameras.at(one.number)["name"].text_or("") == choice ||
               one.node->node["name"].text_or("") == choice;
    };
    const auto numbered = [&](const Hung& one) { return std::to_string(one.number) == choice; };
    auto found = std::find_if(hung.begin(), hung.end(), called);
    if (found == hung.end()) found = std::find_if(hung.begin(), hung.end(), numbered);
    if (found == hung.end())
        cameras.fail(fmt::format("the scene has no camera {}; its cameras are {}", in_quotes(choice),
                                 listed(cameras, hung)));
    return &*found;
}

void read_film(const Item& item, render::Camera& camera) {
    const std::string type = item["type"].text();
    if (type == "perspective") {
        const Item perspective = item["perspective"];
        const double height = 2 * std::tan(perspective["yfov"].number(1e-3, widest) / 2),
                     aspect = perspective["aspectRatio"].number_or(1, 1e-3, 1e3);
        camera.height = static_cast<float>(height);
        camera.width = static_cast<float>(height * aspect);
    } else if (type == "orthographic") {
        const Item orthographic = item["orthographic"];
        camera.parallel = true;
        camera.width = static_cast<float>(2 * orthographic["xmag"].number(smallest, farthest));
        camera.height = static_cast<float>(2 * orthographic["ymag"].number(smallest, farthest));
    } else {
        item["type"].fail(in_quotes(type) + " is no type of camera; perspective and orthographic are");
    }
}

// A camera at `eye` that looks along a unit vector: its target is as far as the eye is from the origin, so that rounding turns it
// no more than that of the eye's place.
void aim(render::Camera& camera, const Vec3& eye, const Vec3& direction, const Vec3& up) {
    camera.eye = narrow(eye);
    camera.target = narrow(sum(wide(camera.eye), std::max(length(eye), 1.0), direction));
    camera.up = narrow(up);
}

}  // namespace

std::optional<render::Camera> camera_of(const Item& root, const std::vector<Placed>& nodes,
                                        const std::string& choice) {
    const Item cameras = root["cameras"];
    const std::vector<Hung> hung = hung_cameras(cameras, nodes);
    const Hung* const one = chosen(cameras, hung, choice);
    if (!one) return {};
    render::Camera camera;
    read_film(cameras.at(one->number), camera);
    const Affine& to_world = one->node->to_world;
    const Vec3 eye = to_world.columns[3], direction = unit(sum({}, -1, to_world.columns[2])),
               up = unit(across(to_world.columns[1], direction));
    if (!is_finite(eye) || length(eye) > farthest || is_zero(direction) || is_zero(up))
        one->node->node.fail("the camera here looks nowhere");
    aim(camera, eye, direction, up);
    return camera;
}

render::Camera framing(const std::vector<render::Vertex>& vertices) {
    Vec3 low{farthest, farthest, farthest}, high{-farthest, -farthest, -farthest};
    for (const render::Vertex& vertex : vertices)
        for (int c = 0; c < 3; ++c) {
            low[c] = std::min(low[c], double{vertex.place[c]});
            high[c] = std::max(high[c], double{vertex.place[c]});
        }
    const Vec3 centre = sum(sum({}, 0.5, low), 0.5, high);
    // Not so small that rounding moves the eye into what it looks at.
    const double radius = std::max({length(difference(high, low)) / 2, 1e-5 * length(centre), smallest});
    constexpr double angle = std::numbers::pi / 4, above = std::numbers::pi / 12;
    const Vec3 back{0, std::sin(above), std::cos(above)};
    render::Camera camera;
    camera.height = camera.width = static_cast<float>(2 * std::tan(angle / 2));
    camera.eye = narrow(sum(centre, radius / std::sin(angle / 2), back));
    camera.target = narrow(centre);
    camera.up = {0, 1, 0};
    return camera;
}

}  // namespace vndf::gltf
