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
    } else {
        gltf::Loaded loaded = gltf::load(o.file, o.camera);
        shown.scene = std::move(loaded.scene);
        shown.warnings = std::move(loaded.warnings);
    }
    const bool dark = !o.environment.empty() || (!o.file.empty() && has_lights(shown.scene));
    shown.scene.sky = sky_of(o.sky != "auto" ? o.sky : dark ? "none" : "day");
    if (!o.environment.empty()) {
        std::vector<std::string> warnings;
        shown.scene.environment = render::read_environment(o.environment, warnings, o.rotation);
        for (const std::string& warning : warnings) shown.warnings.emplace_back(warning, 1);
    }
    return shown;
}

}  // namespace vndf::cli
