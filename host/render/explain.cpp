#include "render/explain.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include <fmt/format.h>

namespace vndf::render {
namespace {

constexpr unsigned width = 240, samples = 16;

// A small rendering with some of the effects.
class Rendering {
  public:
    Rendering(const Explained& what, const std::vector<Effect>& effects)
        : stages_(device_stages(what.device, what.math, switches(what.scene, effects, what.choices), true)),
          wavefront_(*stages_, what.scene, what.tree, small(what.settings)) {
        wavefront_.add_sample();  // which compiles
    }

    // The fastest of samples in seconds: in the stages that know what the scene holds, and in all.
    struct Time {
        double shading = 1e9, all = 1e9;
    };
    void sample(Time& time) {
        const double before = shading();
        const auto start = std::chrono::steady_clock::now();
        wavefront_.add_sample();
        const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
        time.shading = std::min(time.shading, shading() - before);
        time.all = std::min(time.all, passed.count());
    }
    Image image() { return wavefront_.image(); }

  private:
    static Settings small(Settings settings) {
        settings.height = std::max(1u, settings.height * width / settings.width);
        settings.width = width;
        return settings;
    }
    double shading() const {
        double sum = 0;
        for (const char* stage : {"surface", "dress", "lights", "cones", "connect", "scatter"})
            sum += stages_->seconds(stage);
        return sum;
    }

    std::unique_ptr<Stages> stages_;
    Wavefront wavefront_;
};

// An effect on, and off: timed in turn, so that both meet the same moods of the machine.
struct Compared {
    Rendering::Time with, without;
    Image image_with, image_without;
};

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
        sum += luminance(image.pixels[i], image.pixels[i + 1], image.pixels[i + 2]);
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

// Nothing where no program would be left. usual: with the scene's effects, its image as it is after as many samples.
std::optional<Compared> compared(const Explained& what, std::size_t i, Rendering& usual, const Image& image) {
    std::vector<Effect> turned = what.effects;
    if (turned[i].on && !may_turn_off(turned, turned[i])) return std::nullopt;
    turned[i].on = !turned[i].on;
    Rendering other(what, turned);
    Rendering::Time own, its;
    for (unsigned k = 1; k < samples; ++k) {
        usual.sample(own);
        other.sample(its);
    }
    Compared both{own, its, image, other.image()};
    if (!what.effects[i].on) {
        std::swap(both.with, both.without);
        std::swap(both.image_with, both.image_without);
    }
    return both;
}

Image image_of(Rendering& usual) {
    Rendering::Time unused;
    for (unsigned k = 1; k < samples; ++k) usual.sample(unused);
    return usual.image();
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
    Rendering usual(what, what.effects);
    const Image image = image_of(usual);
    std::string simplifications;
    const auto row = [&](std::size_t i) {
        const Effect& effect = what.effects[i];
        const std::optional<Compared> both = compared(what, i, usual, image);
        std::string cost = "all of it";
        if (both) cost = fmt::format("{:+.1f} %", 100 * (both->with.shading / both->without.shading - 1));
        if (!effect.on)
            simplifications += fmt::format(
                "{} is off although {} calls for it: a deliberate simplification, which changes the "
                "image by {:.2g} of its mean (root mean square)\n",
                effect.name, effect.called_by, difference(both->image_without, both->image_with));
        return fmt::format("{:<18}{:<46}{:<34}{}\n", effect.name,
                           effect.called_by.empty() ? "nothing" : effect.called_by,
                           fmt::format("{}={:d}", effect.macro, effect.on), cost);
    };
    const std::string text = table(
        what, fmt::format("{:<18}{:<46}{:<34}{}\n", "effect", "called for by", "switch", "cost of shading"),
        row);
    return text +
           fmt::format("choices: ndf {}, sampler {}, fresnel {}, masking {}, energy {}, lights by {}\n",
                       what.choices.ndf, what.choices.sampler, what.scene.fresnel, what.choices.masking,
                       what.choices.energy, what.choices.lights_by) +
           simplifications;
}

std::string effect_costs(const Explained& what) {
    Rendering usual(what, what.effects);
    const Image image = image_of(usual);
    const auto row = [&](std::size_t i) {
        const Effect& effect = what.effects[i];
        const std::optional<Compared> both = compared(what, i, usual, image);
        if (!both) return fmt::format("{:<18}{:>14}\n", effect.name, "all of it");
        const double noise = noise_of(both->image_with), rest = noise_of(both->image_without);
        return fmt::format("{:<18}{:>+12.1f} %{:>+12.1f} %{:>14.2g}\n", effect.name,
                           100 * (1 - both->without.all / both->with.all),
                           noise > 0 ? 100 * (1 - rest * rest / (noise * noise)) : 0,
                           difference(both->image_without, both->image_with));
    };
    return table(what,
                 fmt::format("{:<18}{:>14}{:>14}{:>14}\n", "effect", "of the time", "of the error",
                             "without it"),
                 row) +
           "of the time, of the squared error: what would be saved without the effect, with as many samples; "
           "without it: by how much the image would be another, root mean square over its mean\n";
}

}  // namespace vndf::render
