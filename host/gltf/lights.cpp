#include "gltf/lights.h"

#include <numbers>

#include "gltf/values.h"

namespace vndf::gltf {
namespace {

using Kind = render::PunctualLight::Kind;

constexpr double brightest = 1e30, farthest = 1e15;
// Of the outer cone, and how far the inner one keeps from it.
constexpr double narrowest = 0.01, closest = 0.99;

Kind kind_of(const Item& type) {
    const std::string name = type.text();
    if (name == "point") return Kind::point;
    if (name == "spot") return Kind::spot;
    if (name == "directional") return Kind::directional;
    type.fail(in_quotes(name) + " is no type of light; point, spot and directional are");
}

render::PunctualLight light_of(const Item& item, Warnings& warnings) {
    const Values values(warnings);
    render::PunctualLight light;
    light.kind = kind_of(item["type"]);
    light.colour = values.numbers<3>(item["color"], {1, 1, 1}, 0, 1);
    light.intensity = values.number(item["intensity"], 1, 0, brightest);
    if (light.kind != Kind::spot) return light;
    const Item spot = item["spot"];
    light.outer_angle =
        values.number(spot["outerConeAngle"], std::numbers::pi / 4, narrowest, std::numbers::pi / 2);
    light.inner_angle = values.number(spot["innerConeAngle"], 0, 0, closest * light.outer_angle);
    return light;
}

}  // namespace

std::vector<render::PunctualLight> lights_of(const Item& root, const std::vector<Placed>& nodes,
                                             Warnings& warnings) {
    const Item items = root["extensions"]["KHR_lights_punctual"]["lights"];
    std::vector<render::PunctualLight> lights;
    for (const auto& [node, to_world, number] : nodes) {
        const Item extension = node["extensions"]["KHR_lights_punctual"];
        if (!extension) continue;
        render::PunctualLight light =
            light_of(items.at(extension["light"].index(items.size(), "light")), warnings);
        const Vec3 place = to_world.columns[3], direction = unit(sum({}, -1, to_world.columns[2]));
        const bool somewhere = is_finite(place) && length(place) < farthest;
        if (!somewhere || (is_zero(direction) && light.kind != Kind::point)) {
            warnings.add("lights without a place or a direction, left out", node.place());
            continue;
        }
        light.place = narrow(place);
        if (!is_zero(direction)) light.direction = narrow(direction);
        lights.push_back(light);
    }
    return lights;
}

}  // namespace vndf::gltf
