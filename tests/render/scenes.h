// Scenes with known answers, and their images.
#pragma once

#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>

#include "render/effects.h"
#include "render/wavefront.h"
#include "runtime/devices.h"
#include "support/catch.h"

namespace vndf::test {

struct Rendered {
    render::Scene scene;
    render::Settings settings;
    render::Choices choices;
    std::string effects = "auto";
    unsigned samples = 64;

    render::Switches switches() const {
        return render::switches(scene, render::effects_for(scene, effects), choices);
    }
    render::Image on(render::Stages& stages) const {
        const render::Tree tree = render::build_tree(scene);
        render::Wavefront wavefront(stages, scene, tree, settings);
        for (unsigned i = 0; i < samples; ++i) wavefront.add_sample();
        return wavefront.image();
    }
    render::Image image() const {
        const auto stages =
            render::device_stages(runtime::choose_device().device, runtime::Math::strict, switches());
        return on(*stages);
    }
};

inline Rendered rendered(render::Scene scene, unsigned width, unsigned height, unsigned samples) {
    Rendered r;
    r.scene = std::move(scene);
    r.settings.width = width;
    r.settings.height = height;
    r.samples = samples;
    return r;
}

// A floor seen from far away under the angle theta to its normal, so that all pixels see nearly the same point.
inline render::Scene floor_of(const render::Material& material, double theta) {
    render::Scene scene;
    scene.name = "floor";
    scene.add_square(-50, -50, 50, 50, scene.add_material(material));
    const auto sine = static_cast<float>(std::sin(theta)), cosine = static_cast<float>(std::cos(theta));
    scene.camera = {{20 * sine, 20 * cosine, 0.013f}, {0, 0, 0.013f}, 1e-3f};
    scene.sky = render::constant_sky(1);
    return scene;
}

inline double mean(const render::Image& image) {
    double sum = 0;
    for (const float x : image.pixels) sum += x;
    return sum / static_cast<double>(image.pixels.size());
}

inline std::array<double, 3> means(const render::Image& image) {
    std::array<double, 3> sums{};
    for (std::size_t i = 0; i < image.pixels.size(); ++i) sums[i % 3] += image.pixels[i];
    for (double& x : sums) x *= 3 / static_cast<double>(image.pixels.size());
    return sums;
}

inline double rms_from(const render::Image& image, double value) {
    double sum = 0;
    for (const float x : image.pixels) sum += (x - value) * (x - value);
    return std::sqrt(sum / static_cast<double>(image.pixels.size()));
}

// What a GGX mirror of one alpha reflects of a white sky: the mean of G2 (wo . m) / (wo.z m.z) over normals drawn from the
// distribution, by the midpoint rule over both random numbers. Derived here, in double; shares nothing with the kernels.
inline double ggx_albedo(double alpha, double theta) {
    constexpr int steps = 1500;
    const double ox = std::sin(theta), oz = std::cos(theta);
    const auto lambda = [&](double z) {
        const double tan2 = (1 - z * z) / (z * z);
        return 0.5 * (std::sqrt(1 + alpha * alpha * tan2) - 1);
    };
    double sum = 0;
    for (int i = 0; i < steps; ++i)
        for (int j = 0; j < steps; ++j) {
            const double u = (i + 0.5) / steps, phi = 2 * std::numbers::pi * (j + 0.5) / steps;
            const double tan2 = alpha * alpha * u / (1 - u), mz = 1 / std::sqrt(1 + tan2),
                         mr = std::sqrt(1 - mz * mz);
            const double om = ox * mr * std::cos(phi) + oz * mz, iz = 2 * om * mz - oz;
            if (om <= 0 || iz <= 0) continue;
            sum += om / (oz * mz) / (1 + lambda(oz) + lambda(iz));
        }
    return sum / steps / steps;
}

}  // namespace vndf::test
