#include "render/effects.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include <fmt/format.h>

#include "../effects.h"
#include "error.h"
#include "text.h"

namespace vndf::render {
namespace {

// "material 0 and 4 others" for the materials that `calls`; empty if there is none.
std::string materials_that(const Scene& scene, const std::function<bool(const Material&)>& calls) {
    std::size_t count = 0, first = 0;
    for (std::size_t i = scene.materials.size(); i-- > 0;) {
        if (!calls(scene.materials[i])) continue;
        ++count;
        first = i;
    }
    if (count == 0) return {};
    return count == 1 ? fmt::format("material {}", first)
                      : fmt::format("material {} and {} more", first, count - 1);
}

// Whether the corners' normals are the face's, as the kernel forms it (kernels/render/surface.h): then all products are exact.
bool flat(const Scene& scene, const Triangle& triangle) {
    const Vertex& a = scene.vertices[triangle.corners[0]];
    const Vertex& b = scene.vertices[triangle.corners[1]];
    const Vertex& c = scene.vertices[triangle.corners[2]];
    if (a.normal != b.normal || a.normal != c.normal) return false;
    // One axis alone: others are not unit vectors to the bit.
    const auto ones =
        std::count_if(a.normal.begin(), a.normal.end(), [](float x) { return std::abs(x) == 1; });
    const auto zeros = std::count(a.normal.begin(), a.normal.end(), 0.0f);
    if (ones != 1 || zeros != 2) return false;
    for (int axis = 0; axis < 3; ++axis)
        if (a.normal[axis] != 0 && (a.place[axis] != b.place[axis] || a.place[axis] != c.place[axis]))
            return false;
    return true;
}

std::string bent_triangles(const Scene& scene) {
    const auto bent = std::count_if(scene.triangles.begin(), scene.triangles.end(),
                                    [&](const Triangle& t) { return !flat(scene, t); });
    return bent == 0 ? std::string() : fmt::format("{} triangles with normals of their own", bent);
}

// What calls for each effect. One that is not here is always called for.
const std::map<std::string, std::function<std::string(const Scene&)>>& callers() {
    static const std::map<std::string, std::function<std::string(const Scene&)>> all{
        {"conductor",
         [](const Scene& s) { return materials_that(s, [](const Material& m) { return m.metal > 0; }); }},
        {"dielectric", [](const Scene& s) { return materials_that(s, dielectric); }},
        {"lambert",
         [](const Scene& s) {
             return materials_that(s, [](const Material& m) { return m.metal < 1 && m.transmission < 1; });
         }},
        {"rough_diffuse",
         [](const Scene& s) {
             return materials_that(s, [](const Material& m) {
                 return m.metal < 1 && m.transmission < 1 && m.diffuse_roughness > 0;
             });
         }},
        {"coat",
         [](const Scene& s) { return materials_that(s, [](const Material& m) { return m.coat > 0; }); }},
        {"anisotropic",
         [](const Scene& s) {
             return materials_that(s, [](const Material& m) {
                 return (m.metal > 0 || dielectric(m)) && m.alpha_x != m.alpha_y;
             });
         }},
        {"tint",
         [](const Scene& s) {
             return materials_that(s, [](const Material& m) {
                 return m.tint != Vec{1, 1, 1} || m.transmittance != Vec{1, 1, 1};
             });
         }},
        {"specular",
         [](const Scene& s) {
             return materials_that(s, [](const Material& m) {
                 return dielectric(m) && (m.specular != 1 || m.specular_colour != Vec{1, 1, 1});
             });
         }},
        {"thin_walled",
         [](const Scene& s) {
             return materials_that(s, [](const Material& m) { return transmits(m) && m.thin_walled; });
         }},
        {"absorption",
         [](const Scene& s) {
             return materials_that(s, [](const Material& m) {
                 return transmits(m) && !m.thin_walled && m.absorption != Vec{};
             });
         }},
        {"dispersion",
         [](const Scene& s) {
             return materials_that(s, [](const Material& m) { return dielectric(m) && m.dispersion != 0; });
         }},
        {"back_facing",
         [](const Scene& s) {
             return s.open ? std::string("surfaces that may be seen from behind")
                           : materials_that(s, transmits);
         }},
        {"shading_normal", bent_triangles},
        {"terminator", bent_triangles}};
    return all;
}

std::vector<Effect> called_effects(const Scene& scene) {
    std::vector<Effect> effects;
    for (const vndf::Effect& known : vndf::effects()) {
        const auto caller = callers().find(known.name);
        Effect effect{known.name, caller == callers().end() ? "every scene" : caller->second(scene)};
        effect.on = !effect.called_by.empty();
        effects.push_back(effect);
    }
    return effects;
}

}  // namespace

const std::vector<std::string>& samplers() {
    static const std::vector<std::string> all{"bounded", "plain", "conic", "ndf", "cosine"};
    return all;
}

std::vector<Effect> effects_for(const Scene& scene, std::string_view asked) {
    std::vector<Effect> effects = called_effects(scene);
    if (asked == "auto") return effects;
    for (Effect& effect : effects) effect.on = asked == "all";
    if (asked == "all") return effects;
    std::vector<std::string> names;
    for (const Effect& effect : effects) names.push_back(effect.name);
    for (const std::string& word : split(asked, ',')) {
        const auto found = std::find(names.begin(), names.end(), word);
        if (found == names.end())
            throw InputError(fmt::format("--effects '{}': '{}' is none; auto, all or some of {} are allowed",
                                         asked, word, fmt::join(names, ",")));
        effects[found - names.begin()].on = true;
    }
    const auto on = [&](std::string_view name) {
        return std::any_of(effects.begin(), effects.end(),
                           [&](const Effect& e) { return e.name == name && e.on; });
    };
    if (!on("conductor") && !on("dielectric") && !on("lambert"))
        throw InputError(fmt::format(
            "--effects '{}': nothing is left of the materials without conductor, dielectric and lambert",
            asked));
    return effects;
}

Switches switches(const Scene& scene, const std::vector<Effect>& effects, const Choices& choices) {
    const bool compared = choices.sampler == "ndf" || choices.sampler == "cosine";
    if (choices.ndf == "beckmann" && !compared && choices.sampler != "plain")
        throw InputError(
            fmt::format("--sampler {}: --ndf beckmann has plain, ndf and cosine alone", choices.sampler));
    if (compared && std::any_of(scene.materials.begin(), scene.materials.end(), transmits))
        throw InputError(fmt::format(
            "--sampler {}: draws no light through a surface, and a material transmits it", choices.sampler));
    std::string text = fmt::format("-DVNDF_NDF={} -DVNDF_FRESNEL={} -DVNDF_MASKING={}", choices.ndf,
                                   scene.fresnel, choices.masking);
    if (choices.energy != "none") text += " -DVNDF_ENERGY=" + choices.energy;
    text += compared ? " -DVNDF_SAMPLING=plain -DVNDF_DRAW=" + choices.sampler
                     : " -DVNDF_SAMPLING=" + choices.sampler;
    std::string paths = "-DVNDF_RANDOM=" + choices.random;
    for (const Effect& effect : effects) {
        const std::string macro = fmt::format(" -D{}={:d}", switch_of(effect.name), effect.on);
        text += macro;
        // Of paths a plane, of the bodies that they are in.
        if (effect.name == "absorption") paths += macro;
    }
    return {paths, text};
}

}  // namespace vndf::render
