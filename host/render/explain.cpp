#include "render/explain.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>

#include <fmt/format.h>

namespace vndf::render {
namespace {

constexpr unsigned width = 240, samples = 16;

// A small rendering with some of the effects.
struct Rendering {
    Image image;
    double shading = 0, seconds = 0;  // of the fastest sample: in the stages that know materials, in all
};

Rendering rendering(const Explained& what, const std::vector<Effect>& effects) {
    Settings settings = what.settings;
    settings.height = std::max(1u, settings.height * width / settings.width);
    settings.width = width;
    const auto stages =
        device_stages(what.device, what.math, switches(what.scene, effects, what.choices), true);
    Wavefront wavefront(*stages, what.scene, what.tree, settings);
    Rendering result;
    double before = 0, fastest = 1e9, whole = 1e9;
    for (unsigned i = 0; i < samples; ++i) {
        const auto start = std::chrono::steady_clock::now();
        wavefront.add_sample();
        const double seconds =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        if (i > 0) whole = std::min(whole, seconds);
        const double now = stages->seconds("surface") + stages->seconds("dress") + stages->seconds("lights") +
                           stages->seconds("connect") + stages->seconds("scatter");
        if (i > 0) fastest = std::min(fastest, now - before);  // the first compiles
        before = now;
    }
    result.image = wavefront.image();
    result.shading = fastest;
    result.seconds = whole;
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

double noise_of(const Image& image) {
    double sum = 0;
    for (std::size_t i = 0; i < image.pixels.size(); i += 3)
        sum += 0.2126 * image.pixels[i] + 0.7152 * image.pixels[i + 1] + 0.0722 * image.pixels[i + 2];
    return image.error * sum;
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

// The same without an effect that is on, or with one that is off; nothing where no program would be left.
std::optional<Rendering> turned(const Explained& what, std::size_t i) {
    std::vector<Effect> other = what.effects;
    if (other[i].on && !may_turn_off(other, other[i])) return std::nullopt;
    other[i].on = !other[i].on;
    return rendering(what, other);
}

// Of those that the scene calls for or that are on nevertheless.
template <class Row>
std::string table(const Explained& what, const std::string& head, const Row& row) {
    std::string text = head, others;
    for (std::size_t i = 0; i < what.effects.size(); ++i) {
        const Effect& effect = what.effects[i];
        if (effect.on || !effect.called_by.empty())
            text += row(i);
        else
            others += (others.empty() ? "" : ", ") + effect.name;
    }
    return others.empty() ? text : text + fmt::format("off, since nothing calls for them: {}\n", others);
}

}  // namespace

std::string explanation(const Explained& what) {
    const Rendering usual = rendering(what, what.effects);
    std::string simplifications;
    const auto row = [&](std::size_t i) {
        const Effect& effect = what.effects[i];
        const std::optional<Rendering> other = turned(what, i);
        std::string cost = "all of it";
        if (other)
            cost = fmt::format("{:+.1f} %", 100 * (effect.on ? usual.shading / other->shading - 1
                                                             : other->shading / usual.shading - 1));
        if (!effect.on)
            simplifications += fmt::format(
                "{} is off although {} calls for it: a deliberate simplification, which changes the "
                "image by {:.2g} of its mean (root mean square)\n",
                effect.name, effect.called_by, difference(usual.image, other->image));
        return fmt::format("{:<18}{:<46}{:<34}{}\n", effect.name,
                           effect.called_by.empty() ? "nothing" : effect.called_by,
                           fmt::format("{}={:d}", effect.macro, effect.on), cost);
    };
    const std::string text = table(
        what, fmt::format("{:<18}{:<46}{:<34}{}\n", "effect", "called for by", "switch", "cost of shading"),
        row);
    return text +
           fmt::format("choices: ndf {}, sampler {}, fresnel {}, masking {}, energy {}\n", what.choices.ndf,
                       what.choices.sampler, what.scene.fresnel, what.choices.masking, what.choices.energy) +
           simplifications;
}

std::string effect_costs(const Explained& what) {
    const Rendering usual = rendering(what, what.effects);
    const auto row = [&](std::size_t i) {
        const Effect& effect = what.effects[i];
        const std::optional<Rendering> other = turned(what, i);
        if (!other) return fmt::format("{:<18}{:>14}\n", effect.name, "all of it");
        const Rendering &with = effect.on ? usual : *other, &without = effect.on ? *other : usual;
        const double noise = noise_of(with.image), rest = noise_of(without.image);
        return fmt::format("{:<18}{:>+12.1f} %{:>+12.1f} %{:>14.2g}\n", effect.name,
                           100 * (1 - without.seconds / with.seconds),
                           noise > 0 ? 100 * (1 - rest * rest / (noise * noise)) : 0,
                           difference(without.image, with.image));
    };
    return table(what,
                 fmt::format("{:<18}{:>14}{:>14}{:>14}\n", "effect", "of the time", "of the error",
                             "without it"),
                 row) +
           "of the time, of the squared error: what would be saved without the effect, with as many samples; "
           "without it: by how much the image would be another, root mean square over its mean\n";
}

}  // namespace vndf::render
