#include "cli/render_report.h"

#include <nlohmann/json.hpp>

namespace vndf::cli {

std::string render_report(const Reported& r) {
    using Json = nlohmann::ordered_json;
    const render::Scene& scene = r.shown.scene;
    Json effects = Json::array(), warnings = Json::array();
    for (const render::Effect& e : r.effects)
        effects.push_back({{"name", e.name}, {"on", e.on}, {"called_by", e.called_by}, {"switch", e.macro}});
    for (const auto& [text, count] : r.shown.warnings) warnings.push_back({{"text", text}, {"count", count}});
    std::size_t texels = 0;
    for (const render::Bitmap& b : scene.bitmaps) texels += b.texels.size();
    const auto& memory = r.traced.memory;
    const render::Image& image = r.traced.image;
    const Json report{{"software", "clvndf " CLVNDF_VERSION},
                      {"scene", scene.name},
                      {"file", r.options.file},
                      {"environment", r.options.environment},
                      {"width", image.width},
                      {"height", image.height},
                      {"samples_per_pixel", image.samples},
                      {"error", image.error},
                      {"seconds", r.seconds},
                      {"seconds_to_first_sample", r.first},
                      {"samples_per_second", r.traced.samples_per_second},
                      {"bad_samples", image.bad_samples},
                      {"stops", r.stops},
                      {"triangles", scene.triangles.size()},
                      {"vertices", scene.vertices.size()},
                      {"materials", scene.materials.size()},
                      {"textures", scene.textures.size()},
                      {"texels", texels},
                      {"lights", scene.lights.size()},
                      {"lamps", r.traced.lamps},
                      {"memory",
                       {{"scene", memory.scene},
                        {"tree", memory.tree},
                        {"paths", memory.paths},
                        {"path", memory.path},
                        {"triangle", scene.triangles.empty()
                                         ? 0.0
                                         : static_cast<double>(memory.scene + memory.tree - 4 * texels) /
                                               static_cast<double>(scene.triangles.size())}}},
                      {"effects", effects},
                      {"choices",
                       {{"ndf", r.choices.ndf},
                        {"sampler", r.choices.sampler},
                        {"fresnel", scene.fresnel},
                        {"masking", r.choices.masking},
                        {"energy", r.choices.energy},
                        {"random", r.choices.random},
                        {"lights_by", r.choices.lights_by}}},
                      {"seed", r.settings.seed},
                      {"max_bounces", r.settings.max_bounces},
                      {"switches", r.switches.materials},
                      {"math", r.math},
                      {"device", r.traced.device},
                      {"warnings", warnings}};
    return report.dump(1) + '\n';
}

}  // namespace vndf::cli
