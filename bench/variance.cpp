#include "variance.h"

#include <array>
#include <cmath>
#include <random>

#include "conformance/points.h"
#include "runtime/evaluator.h"

namespace vndf::bench {
namespace {

using Columns = std::vector<std::vector<double>>;

constexpr std::size_t samples = std::size_t{1} << 16;
constexpr std::array<std::array<double, 2>, 11> alphas{{{0.05, 0.05},
                                                        {0.1, 0.1},
                                                        {0.2, 0.2},
                                                        {0.5, 0.5},
                                                        {0.8, 0.8},
                                                        {1, 1},
                                                        {0.3, 0.9},
                                                        {0.2, 0.8},
                                                        {0.1, 1},
                                                        {0.05, 1},
                                                        {0.01, 0.5}}};
constexpr double cosines[] = {0.9, 0.5, 0.2};
constexpr const char* samplers[] = {"vndf_ggx_sample_wm_walter2007", "vndf_ggx_sample_wm_dupuy2023",
                                    "vndf_ggx_sample_wi_eto2023", "vndf_ggx_sample_wi_eto2023_polygon",
                                    "vndf_ggx_sample_wi_conic2026"};

// Columns of `function`'s inputs, taken by name out of one lobe and the samples' own columns.
Columns call(const std::string& name, const conformance::Point& lobe,
             const std::vector<std::pair<std::string, const std::vector<double>*>>& own) {
    const Function& function = *find_function(name);
    Columns inputs, outputs(function.outputs.size(), std::vector<double>(samples));
    for (const std::string& scalar : function.inputs) {
        const std::vector<double>* column = nullptr;
        for (const auto& [key, values] : own)
            if (key == scalar) column = values;
        inputs.push_back(column ? *column : std::vector<double>(samples, lobe.scalar(scalar)));
    }
    std::vector<const void*> in;
    std::vector<void*> out;
    for (const auto& column : inputs) in.push_back(column.data());
    for (auto& column : outputs) out.push_back(column.data());
    runtime::HostEvaluator(runtime::Math::strict, runtime::Real::f64).run(function, samples, in, out);
    return outputs;
}

LobeNoise noise(const std::string& sampler, const conformance::Point& lobe, const Columns& u) {
    Columns sampled = call(sampler + "_with_pdf", lobe, {{"u1", &u[0]}, {"u2", &u[1]}});
    const bool reflections = find_function(sampler)->result == "WI";
    const conformance::Direction& wo = lobe.wo;
    Columns wm(3, std::vector<double>(samples)), wi = wm;
    std::vector<double> density = sampled[3];  // per steradian of wi
    for (std::size_t i = 0; i < samples; ++i) {
        const conformance::Direction d{sampled[0][i], sampled[1][i], sampled[2][i]};
        const double cosine = d[0] * wo[0] + d[1] * wo[1] + d[2] * wo[2];
        const double half = std::sqrt(2 + 2 * cosine);  // |wo + wi|
        for (std::size_t k = 0; k < 3; ++k) {
            wm[k][i] = reflections ? (d[k] + wo[k]) / half : d[k];
            wi[k][i] = reflections ? d[k] : 2 * cosine * d[k] - wo[k];
        }
        if (!reflections) density[i] /= 4 * std::abs(cosine);
    }
    const auto d = call("vndf_ggx_ndf", lobe, {{"wm_x", &wm[0]}, {"wm_y", &wm[1]}, {"wm_z", &wm[2]}});
    const auto g2 = call("vndf_ggx_g2", lobe, {{"wi_x", &wi[0]}, {"wi_y", &wi[1]}, {"wi_z", &wi[2]}});

    LobeNoise result{sampler, lobe.alpha[0], lobe.alpha[1], wo[2], 0, 0, 0};
    double sum = 0, squares = 0;
    std::size_t rejected = 0;
    for (std::size_t i = 0; i < samples; ++i) {
        const bool up = wi[2][i] > 0 && density[i] > 0;
        const double weight = up ? d[0][i] * g2[0][i] / (4 * wo[2] * density[i]) : 0;
        rejected += !up;
        sum += weight;
        squares += weight * weight;
    }
    result.rejected = static_cast<double>(rejected) / samples;
    result.mean = sum / samples;
    result.variance = squares / samples - result.mean * result.mean;
    return result;
}

}  // namespace

std::vector<LobeNoise> lobe_noise() {
    std::mt19937_64 engine(1);
    Columns u(2, std::vector<double>(samples));
    for (auto& column : u)
        for (double& value : column) value = static_cast<double>(engine() >> 11) * 0x1p-53;
    std::vector<LobeNoise> all;
    for (const auto& alpha : alphas)
        for (const double cosine : cosines) {
            const conformance::Point lobe = conformance::make_point(
                conformance::direction(cosine, 0.7), alpha, {0.9, 0}, {0, 0, 1}, {0.5, 0.5}, 1.5);
            for (const char* sampler : samplers)
                if (find_function(sampler)) all.push_back(noise(sampler, lobe, u));
        }
    return all;
}

}  // namespace vndf::bench
