#include "render/explain.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace vndf::render {
namespace {

constexpr unsigned width = 240, samples = 8;

// A small rendering with some of the effects.
struct Rendering {
    Image image;
    double shading = 0;  // seconds of the fastest sample
};

Rendering rendering(const Explained& what, const std::vector<Effect>& effects) {
    Settings settings = what.settings;
    settings.height = std::max(1u, settings.height * width / settings.width);
    settings.width = width;
    const auto stages =
        device_stages(what.device, what.math, switches(what.scene, effects, what.choices), true);
    Wavefront wavefront(*stages, what.scene, what.tree, settings);
    Rendering result;
    double before = 0, fastest = 1e9;
    for (unsigned i = 0; i < samples; ++i) {
        wavefront.add_sample();
        const double now =
            stages->seconds("surface") + stages->seconds("connect") + stages->seconds("scatter");
        if (i > 0) fastest = std::min(fastest, now - before);  // the first compiles
        before = now;
    }
    result.image = wavefront.image();
    result.shading = fastest;
    return result;
}

// Root mean square over mean.
double difference(const Image& a, const Image& b) {
    double square = 0, sum = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        square += std::pow(static_cast<double>(a.pixels[i]) - b.pixels[i], 2);
        sum += b.pixels[i];
    }
    const double n = static_cast<double>(a.pixels.size());
    return sum == 0 ? 0 : std::sqrt(square / n) / (sum / n);
}

// The materials' lobes: without the last of them nothing is left.
bool may_turn_off(const std::vector<Effect>& effects, const Effect& effect) {
    const auto lobe = [](const Effect& e) {
        return e.name == "conductor" || e.name == "dielectric" || e.name == "lambert";
    };
    return !lobe(effect) || std::any_of(effects.begin(), effects.end(), [&](const Effect& other) {
        return other.on && other.name != effect.name && lobe(other);
    });
}

std::string cost(const Explained& what, std::size_t i, double usual) {
    std::vector<Effect> other = what.effects;
    if (other[i].on && !may_turn_off(other, other[i])) return "all of it";
    other[i].on = !other[i].on;
    const double changed = rendering(what, other).shading;
    const double with = what.effects[i].on ? usual : changed, without = what.effects[i].on ? changed : usual;
    return fmt::format("{:+.1f} %", 100 * (with / without - 1));
}

}  // namespace

std::string explanation(Explained what) {
    const Rendering usual = rendering(what, what.effects);
    std::string text =
        fmt::format("{:<16}{:<46}{:<26}{}\n", "effect", "called for by", "switch", "cost of shading");
    std::string simplifications;
    for (std::size_t i = 0; i < what.effects.size(); ++i) {
        const Effect& effect = what.effects[i];
        text += fmt::format("{:<16}{:<46}{:<26}{}\n", effect.name,
                            effect.called_by.empty() ? "nothing" : effect.called_by,
                            fmt::format("{}={:d}", effect.macro, effect.on), cost(what, i, usual.shading));
        if (effect.on || effect.called_by.empty()) continue;
        std::vector<Effect> whole = what.effects;
        whole[i].on = true;
        simplifications += fmt::format(
            "{} is off although {} calls for it: a deliberate simplification, which changes the "
            "image by {:.2g} of its mean (root mean square)\n",
            effect.name, effect.called_by, difference(usual.image, rendering(what, whole).image));
    }
    text += fmt::format("choices: ndf {}, sampler {}, fresnel {}, masking {}\n", what.choices.ndf,
                        what.choices.sampler, what.scene.fresnel, what.choices.masking);
    return text + simplifications;
}

}  // namespace vndf::render
