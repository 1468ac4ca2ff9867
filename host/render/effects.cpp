#include "render/effects.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "../effects.h"
#include "error.h"
#include "render/variants.h"
#include "text.h"

namespace vndf::render {
namespace {

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
    for (int axis = 0; axis < 3; ++axis) {
        if (a.normal[axis] == 0) continue;
        if (a.place[axis] != b.place[axis] || a.place[axis] != c.place[axis]) return false;
        // The face's normal as the kernel forms it: to the bit, and on the same side.
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        const float bu = b.place[u] - a.place[u], bv = b.place[v] - a.place[v], cu = c.place[u] - a.place[u],
                    cv = c.place[v] - a.place[v];
        const float area = bu * cv - bv * cu;
        if (area * (1 / std::sqrt(area * area)) != a.normal[axis]) return false;
    }
    return true;
}

// A scene, and what its materials are at least and at most.
struct Surveyed {
    explicit Surveyed(const Scene& of) : scene(of), ranges(of) {
        for (std::size_t i = 0; i < of.materials.size(); ++i)
            if (scene.dressings.empty())
                materials.push_back({of.materials[i]});
            else
                materials.push_back(variants(of, ranges, i));
        used.resize(of.materials.size());
        faintest.resize(of.materials.size(), 1.0f);
        for (const Triangle& t : of.triangles) {
            used[t.material] = true;
            tangents = tangents || of.vertices[t.corners[0]].tangent[3] != 0;
            bent += !flat(of, t);
            for (const std::uint32_t corner : t.corners)
                faintest[t.material] = std::min(faintest[t.material], of.vertices[corner].colour[3]);
        }
    }

    const Scene& scene;
    TexelRanges ranges;
    std::vector<std::vector<Material>> materials;
    std::vector<bool> used;       // by a triangle
    std::vector<float> faintest;  // alpha of its vertices
    std::size_t bent = 0;         // triangles with normals of their own
    bool tangents = false;
};

std::string named(const Scene& scene, std::size_t material) {
    std::string name = material < scene.material_names.size() ? scene.material_names[material] : "";
    // In one line, whatever a file calls it.
    for (char& c : name)
        if (static_cast<unsigned char>(c) < 32 || c == 127) c = '?';
    return name.empty() ? fmt::format("material {}", material)
                        : fmt::format("material {} ({})", material, name);
}

// "material 0 and 4 more" for those that call; empty if there is none.
std::string materials_where(const Surveyed& s, const std::function<bool(std::size_t)>& calls) {
    std::size_t count = 0, first = 0;
    for (std::size_t i = s.materials.size(); i-- > 0;) {
        if (!s.used[i] || !calls(i)) continue;
        ++count;
        first = i;
    }
    if (count == 0) return {};
    return named(s.scene, first) + (count == 1 ? "" : fmt::format(" and {} more", count - 1));
}

// Those that are so somewhere.
std::string materials_that(const Surveyed& s, const std::function<bool(const Material&)>& calls) {
    return materials_where(
        s, [&](std::size_t i) { return std::any_of(s.materials[i].begin(), s.materials[i].end(), calls); });
}

// Those with a texture in a slot that changes something.
std::string materials_with(const Surveyed& s, Slot slot,
                           const std::function<bool(std::size_t, const TexelRange&)>& says) {
    return materials_where(s, [&](std::size_t i) {
        if (s.scene.dressings.empty()) return false;
        return s.scene.dressings[i].textures[static_cast<std::size_t>(slot)].texture >= 0 &&
               says(i, s.ranges.of(i, slot));
    });
}

bool some_below_white(const TexelRange& range, std::initializer_list<int> channels) {
    return std::any_of(channels.begin(), channels.end(), [&](int c) { return range.least[c] < 255; });
}

// The first that says something.
std::string first_of(std::initializer_list<std::string> callers) {
    const auto found = std::find_if(callers.begin(), callers.end(), [](const auto& c) { return !c.empty(); });
    return found == callers.end() ? std::string() : *found;
}

bool lets_light_pass(const Surveyed& s, std::size_t i) {
    if (s.scene.dressings.empty()) return false;
    const GltfMaterial& m = s.scene.dressings[i].factors;
    if (m.alpha == Alpha::opaque) return false;
    const float least =
        m.opacity * s.faintest[i] * static_cast<float>(s.ranges.of(i, Slot::base_colour).least[3]) / 255;
    return least < (m.alpha == Alpha::mask ? m.alpha_cutoff : 1.0f);
}

std::string normal_mapped(const Surveyed& s) {
    return materials_with(s, Slot::normal, [&](std::size_t i, const TexelRange& range) {
        const auto flat = [](std::uint32_t byte) { return byte == 127 || byte == 128; };
        const bool map =
            !flat(range.least[0]) || !flat(range.most[0]) || !flat(range.least[1]) || !flat(range.most[1]);
        return s.tangents && map && s.scene.dressings[i].factors.normal_scale != 0;
    });
}

std::string painted_vertices(const Surveyed& s) {
    std::size_t count = 0;
    const bool alpha = std::any_of(s.scene.dressings.begin(), s.scene.dressings.end(),
                                   [](const Dressing& d) { return d.factors.alpha != Alpha::opaque; });
    for (const Vertex& v : s.scene.vertices)
        count += v.colour[0] != 1 || v.colour[1] != 1 || v.colour[2] != 1 || (alpha && v.colour[3] != 1);
    return count == 0 ? std::string() : fmt::format("{} vertices with a colour", count);
}

// A texture of a layer that is there, or of what light does in it.
std::string layered(const Surveyed& s) {
    const auto in = [&](Slot slot, int channel, const std::function<bool(const GltfMaterial&)>& there) {
        return materials_with(s, slot, [&](std::size_t i, const TexelRange& range) {
            return there(s.scene.dressings[i].factors) && some_below_white(range, {channel});
        });
    };
    return first_of(
        {in(Slot::transmission, 0, [](const GltfMaterial& m) { return m.transmission > 0; }),
         in(Slot::coat, 0, [](const GltfMaterial& m) { return m.clearcoat > 0; }),
         in(Slot::coat_roughness, 1,
            [](const GltfMaterial& m) { return m.clearcoat > 0 && m.clearcoat_roughness > 0; }),
         in(Slot::specular, 3, [](const GltfMaterial& m) { return m.specular > 0; }),
         materials_with(
             s, Slot::specular_colour,
             [&](std::size_t i, const TexelRange& range) {
                 return s.scene.dressings[i].factors.specular > 0 && some_below_white(range, {0, 1, 2});
             }),
         // White stands for a direction, too.
         materials_with(s, Slot::anisotropy, [&](std::size_t i, const TexelRange& range) {
             return s.scene.dressings[i].factors.anisotropy > 0 && range.most[2] > 0;
         })});
}

std::string emission_textured(const Surveyed& s) {
    return materials_where(s, [&](std::size_t i) {
        if (s.scene.dressings.empty() || s.scene.materials[i].emission == Vec{}) return false;
        const bool unlit = s.scene.dressings[i].factors.unlit;
        return some_below_white(s.ranges.of(i, unlit ? Slot::base_colour : Slot::emissive), {0, 1, 2});
    });
}

std::string bent(const Surveyed& s) {
    const std::string own = fmt::format("{} triangles with normals of their own", s.bent);
    return first_of({normal_mapped(s), s.bent == 0 ? std::string() : own});
}

std::string shining(const Surveyed& s) {
    return materials_that(s, [](const Material& m) { return m.emission != Vec{}; });
}

std::string lights_that(const Surveyed& s, const std::function<bool(const PunctualLight&)>& call) {
    const auto count = std::count_if(s.scene.lights.begin(), s.scene.lights.end(), call);
    return count == 0 ? std::string() : fmt::format("{} lights", count);
}

// What calls for each effect. One that is not here is always called for.
const std::map<std::string, std::function<std::string(const Surveyed&)>>& callers() {
    static const std::map<std::string, std::function<std::string(const Surveyed&)>> all{
        {"conductor",
         [](const Surveyed& s) { return materials_that(s, [](const Material& m) { return m.metal > 0; }); }},
        {"dielectric", [](const Surveyed& s) { return materials_that(s, dielectric); }},
        {"lambert",
         [](const Surveyed& s) {
             return materials_that(s, [](const Material& m) { return m.metal < 1 && m.transmission < 1; });
         }},
        {"rough_diffuse",
         [](const Surveyed& s) {
             return materials_that(s, [](const Material& m) {
                 return m.metal < 1 && m.transmission < 1 && m.diffuse_roughness > 0;
             });
         }},
        {"coat",
         [](const Surveyed& s) { return materials_that(s, [](const Material& m) { return m.coat > 0; }); }},
        {"anisotropic", [](const Surveyed& s) { return materials_that(s, anisotropic); }},
        {"tint",
         [](const Surveyed& s) {
             return materials_that(s, [](const Material& m) {
                 return (m.metal > 0 && m.tint != Vec{1, 1, 1}) ||
                        (transmits(m) && m.transmittance != Vec{1, 1, 1});
             });
         }},
        {"specular",
         [](const Surveyed& s) {
             return materials_that(s, [](const Material& m) {
                 return dielectric(m) && (m.specular != 1 || m.specular_colour != Vec{1, 1, 1});
             });
         }},
        {"thin_walled",
         [](const Surveyed& s) {
             return materials_that(s, [](const Material& m) { return transmits(m) && m.thin_walled; });
         }},
        {"absorption",
         [](const Surveyed& s) {
             return materials_that(s, [](const Material& m) {
                 return transmits(m) && !m.thin_walled && m.absorption != Vec{};
             });
         }},
        {"dispersion",
         [](const Surveyed& s) {
             return materials_that(s, [](const Material& m) { return dielectric(m) && m.dispersion != 0; });
         }},
        {"back_facing",
         [](const Surveyed& s) {
             return s.scene.open ? std::string("surfaces that may be seen from behind")
                                 : materials_that(s, transmits);
         }},
        {"shading_normal", bent},
        {"terminator", bent},
        {"alpha",
         [](const Surveyed& s) {
             return materials_where(s, [&](std::size_t i) { return lets_light_pass(s, i); });
         }},
        {"tangent",
         [](const Surveyed& s) { return s.tangents ? materials_that(s, anisotropic) : std::string(); }},
        {"normal_map", normal_mapped},
        {"vertex_colour", painted_vertices},
        {"texture",
         [](const Surveyed& s) {
             return materials_with(s, Slot::base_colour, [&](std::size_t i, const TexelRange& range) {
                 return some_below_white(range, {0, 1, 2}) ||
                        (s.scene.dressings[i].factors.alpha != Alpha::opaque && some_below_white(range, {3}));
             });
         }},
        {"roughness_texture",
         [](const Surveyed& s) {
             return materials_with(s, Slot::metallic_roughness, [](std::size_t, const TexelRange& range) {
                 return some_below_white(range, {1, 2});
             });
         }},
        {"layer_texture", layered},
        {"emission", shining},
        {"emission_texture", emission_textured},
        {"lamp", shining},
        {"point_light",
         [](const Surveyed& s) {
             return lights_that(s, [](const PunctualLight& l) { return !l.sphere(); });
         }},
        {"sphere_light",
         [](const Surveyed& s) { return lights_that(s, [](const PunctualLight& l) { return l.sphere(); }); }},
        {"sun", [](const Surveyed& s) { return std::string(s.scene.sky.sun_share > 0 ? "the sun" : ""); }},
        {"sky",
         [](const Surveyed& s) {
             const Sky& sky = s.scene.sky;
             const bool black = sky.zenith == Vec{} && sky.horizon == Vec{} && sky.ground == Vec{};
             return std::string(black || s.scene.environment.side > 0 ? "" : "the sky");
         }},
        {"environment", [](const Surveyed& s) {
             return s.scene.environment.side > 0 ? std::string("an image of the environment") : std::string();
         }}};

    return all;
}

// The names of the renderer's own.
std::vector<std::string> own_effects() {
    return {
#define VNDF_RENDER_EFFECT(name, called_for, marks) lower(#name),
#include "../../kernels/render/effects.def"
    };
}

std::vector<Effect> called_effects(const Scene& scene) {
    const Surveyed surveyed(scene);
    std::vector<Effect> effects;
    const auto add = [&](const std::string& name, const std::string& macro) {
        const auto caller = callers().find(name);
        Effect effect{name, macro, caller == callers().end() ? "every scene" : caller->second(surveyed)};
        effect.on = !effect.called_by.empty();
        effects.push_back(effect);
    };
    for (const vndf::Effect& known : vndf::effects()) add(known.name, switch_of(known.name));
    for (const std::string& name : own_effects()) add(name, "VNDF_RENDER_" + upper(name));
    return effects;
}

// Whether the stages that know no materials have code of an effect: of paths a plane, of the bodies that they are in; rays that
// pass what is not opaque; lights that are near.
bool of_paths(const std::string& effect, bool alpha) {
    return effect == "absorption" || effect == "alpha" || effect == "lamp" || effect == "point_light" ||
           effect == "sphere_light" || (alpha && (effect == "texture" || effect == "vertex_colour"));
}

}  // namespace

const std::vector<std::string>& samplers() {
    static const std::vector<std::string> all{"bounded", "plain", "conic", "tilted", "ndf", "cosine"};
    return all;
}

const std::vector<std::string>& lights_by() {
    static const std::vector<std::string> all{"mis", "cap", "bsdf", "cones"};
    return all;
}

std::vector<Effect> effects_for(const Scene& scene, std::string_view asked) {
    std::vector<Effect> effects = called_effects(scene);
    if (asked == "auto") return effects;
    // What comes from all around stays, named or not: without it most scenes are dark.
    const auto around = [](const std::string& name) {
        return name == "sun" || name == "sky" || name == "environment";
    };
    for (Effect& effect : effects) effect.on = asked == "all" || (effect.on && around(effect.name));
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

unsigned useful_bounces(const Scene& scene, unsigned asked) {
    const auto black = [](const Material& m) {
        return m.coat == 0 && (m.metal == 0 || m.first == Vec{}) &&
               (m.metal == 1 || (m.albedo == Vec{} && !dielectric(m)));
    };
    // A conductor's first numbers are an index where Fresnel's equations are asked for: none of it is black.
    if (scene.fresnel != "schlick") return asked;
    return std::all_of(scene.materials.begin(), scene.materials.end(), black) ? 0 : asked;
}

Switches switches(const Scene& scene, const std::vector<Effect>& effects, const Choices& choices) {
    const bool compared = choices.sampler == "ndf" || choices.sampler == "cosine";
    if (choices.ndf == "beckmann" && !compared && choices.sampler != "plain")
        throw InputError(
            fmt::format("--sampler {}: --ndf beckmann has plain, ndf and cosine alone", choices.sampler));
    if (compared && std::any_of(scene.materials.begin(), scene.materials.end(), transmits))
        throw InputError(fmt::format(
            "--sampler {}: draws no light through a surface, and a material transmits it", choices.sampler));
    if (choices.lights_by == "cones" && choices.ndf != "ggx")
        throw InputError(fmt::format("--lights-by cones: --ndf {} has none, ggx alone has", choices.ndf));
    std::string text = fmt::format("-DVNDF_NDF={} -DVNDF_FRESNEL={} -DVNDF_MASKING={}", choices.ndf,
                                   scene.fresnel, choices.masking);
    text += " -DVNDF_RANDOM=" + choices.random;
    if (choices.energy != "none") text += " -DVNDF_ENERGY=" + choices.energy;
    if (choices.lights_by != "mis") text += " -DVNDF_LIGHTS_BY=" + choices.lights_by;
    text += compared ? " -DVNDF_SAMPLING=plain -DVNDF_DRAW=" + choices.sampler
                     : " -DVNDF_SAMPLING=" + choices.sampler;
    std::string paths = "-DVNDF_RANDOM=" + choices.random;
    const bool alpha = std::any_of(effects.begin(), effects.end(),
                                   [](const Effect& e) { return e.name == "alpha" && e.on; });
    for (const Effect& effect : effects) {
        text += fmt::format(" -D{}={:d}", effect.macro, effect.on);
        if (effect.macro.starts_with("VNDF_RENDER_") || of_paths(effect.name, alpha))
            paths += fmt::format(" -D{}={:d}", effect.macro, effect.on && of_paths(effect.name, alpha));
    }
    return {paths, text};
}

}  // namespace vndf::render
