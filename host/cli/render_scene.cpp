#include "cli/render_scene.h"

#include <algorithm>

#include "gltf/load.h"

namespace vndf::cli {
namespace {

// Lights, or surfaces brighter than a white one in daylight.
bool has_lights(const render::Scene& scene) {
    return !scene.lights.empty() ||
           std::any_of(scene.materials.begin(), scene.materials.end(), [](const render::Material& m) {
               return *std::max_element(m.emission.begin(), m.emission.end()) > 1;
           });
}

// Whether there is a light that can have one.
bool give_radius(render::Scene& scene, float radius) {
    for (render::PunctualLight& light : scene.lights) light.radius = radius;
    return std::any_of(scene.lights.begin(), scene.lights.end(),
                       [](const render::PunctualLight& light) { return light.sphere(); });
}

render::Sky sky_of(const std::string& name) {
    if (name == "none") return render::constant_sky(0);
    if (name == "white") return render::constant_sky(1);
    render::Sky sky = render::day_sky();
    if (name == "sunlit") sky.zenith = sky.horizon = sky.ground = {1, 1, 1};
    return sky;
}

}  // namespace

ShownScene shown_scene(const SceneOptions& o) {
    ShownScene shown;
    if (o.file.empty()) {
        shown.scene = render::orbs(o.orbs);
        if (o.light_radius > 0) render::add_lights_over_orbs(shown.scene);
    } else {
        gltf::Loaded loaded = gltf::load(o.file, o.camera);
        shown.scene = std::move(loaded.scene);
        shown.warnings = std::move(loaded.warnings);
    }
    if (o.light_radius > 0 && !give_radius(shown.scene, o.light_radius))
        shown.warnings.emplace_back("--light-radius: no point or spot light", 1);
    const bool dark =
        !o.environment.empty() || (o.file.empty() ? o.light_radius > 0 : has_lights(shown.scene));
    shown.scene.sky = sky_of(o.sky != "auto" ? o.sky : dark ? "none" : "day");
    if (!o.environment.empty()) {
        std::vector<std::string> warnings;
        shown.scene.environment = render::read_environment(o.environment, warnings, o.rotation);
        for (const std::string& warning : warnings) shown.warnings.emplace_back(warning, 1);
    }
    return shown;
}

}  // namespace vndf::cli
