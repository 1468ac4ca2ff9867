#include "variance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <span>

#include <fmt/format.h>

#include "conformance/inputs/points.h"
#include "runtime/evaluator.h"
#include "splitmix64.h"

namespace vndf::bench {
namespace {

using Columns = std::vector<std::vector<double>>;

constexpr std::size_t samples = std::size_t{1} << 16;
constexpr std::size_t block = 1024;  // points of one scramble
constexpr std::size_t most_tries = 4;
constexpr std::array<std::array<double, 2>, 13> alphas{{{0.05, 0.05},
                                                        {0.1, 0.1},
                                                        {0.2, 0.2},
                                                        {0.5, 0.5},
                                                        {0.8, 0.8},
                                                        {1, 1},
                                                        {2, 2},
                                                        {0.3, 0.9},
                                                        {0.2, 0.8},
                                                        {0.1, 1},
                                                        {0.05, 1},
                                                        {0.01, 0.5},
                                                        {1.5, 3}}};
constexpr double cosines[] = {0.9, 0.5, 0.2};
constexpr const char* bounded = "vndf_ggx_sample_wi_eto2023";
constexpr const char* samplers[] = {"vndf_ggx_sample_wm_walter2007", "vndf_ggx_sample_wm_dupuy2023",
                                    "vndf_ggx_sample_wi_eto2023_polygon", "vndf_ggx_sample_wi_conic2026"};

// --- Points: u1 and u2 of each try ---

Columns random_points() {
    std::mt19937_64 engine(1);
    Columns u(2 * most_tries, std::vector<double>(samples));
    for (auto& column : u)
        for (double& value : column) value = static_cast<double>(engine() >> 11) * 0x1p-53;
    return u;
}

// The first two dimensions of Sobol's sequence, without tables: Kollig & Keller, Efficient Multidimensional Sampling,
// 2002.
std::uint32_t sobol(std::size_t index, bool second) {
    std::uint32_t bits = 0;
    for (std::uint32_t v = 1U << 31; index; index >>= 1, v = second ? v ^ (v >> 1) : v >> 1)
        if (index & 1) bits ^= v;
    return bits;
}

// Nested uniform scramble: Owen, Randomly Permuted (t,m,s)-Nets and (t,s)-Sequences, 1995. Each bit is flipped or not by
// a hash of those above it, with a 1 in front that tells their number.
std::uint32_t owen(std::uint32_t bits, std::uint64_t seed) {
    std::uint32_t flips = 0;
    for (int bit = 0; bit < 32; ++bit) {
        const std::uint64_t above = (std::uint64_t{1} << 32 | bits) >> (bit + 1);
        flips |= static_cast<std::uint32_t>(splitmix64(seed ^ above) & 1) << bit;
    }
    return bits ^ flips;
}

// Further tries take further scrambles of the same two dimensions, each in its own random order.
Columns sobol_points() {
    std::mt19937_64 engine(2);
    Columns u(2 * most_tries, std::vector<double>(samples));
    std::array<std::size_t, block> order;
    for (std::size_t i = 0; i < block; ++i) order[i] = i;
    for (std::size_t k = 0; k < most_tries; ++k)
        for (std::size_t first = 0; first < samples; first += block) {
            std::shuffle(order.begin(), order.end(), engine);
            for (const bool second : {false, true}) {
                const std::uint64_t seed = engine();
                for (std::size_t i = 0; i < block; ++i)
                    u[2 * k + second][first + i] = (owen(sobol(order[i], second), seed) + 0.5) * 0x1p-32;
            }
        }
    return u;
}

// --- Samples ---

// Columns of `function`'s inputs, taken by name out of one lobe and the samples' own columns.
Columns call(const std::string& name, const conformance::Point& lobe,
             const std::vector<std::pair<std::string, const std::vector<double>*>>& own) {
    const Function& function = *find_function(name);
    const std::size_t rows = own.front().second->size();
    Columns inputs, outputs(function.outputs.size(), std::vector<double>(rows));
    for (const std::string& scalar : function.inputs) {
        const std::vector<double>* column = nullptr;
        for (const auto& [key, values] : own)
            if (key == scalar) column = values;
        inputs.push_back(column ? *column : std::vector<double>(rows, lobe.scalar(scalar)));
    }
    std::vector<const void*> in;
    std::vector<void*> out;
    for (const auto& column : inputs) in.push_back(column.data());
    for (auto& column : outputs) out.push_back(column.data());
    runtime::HostEvaluator(runtime::Math::strict, runtime::Real::f64).run(function, rows, in, out);
    return outputs;
}

// wi_x, wi_y, wi_z and its density per steradian, which is 0 where the sample is rejected.
Columns reflections(const std::string& sampler, const conformance::Point& lobe, const Columns& u,
                    std::size_t attempt = 0) {
    Columns s = call(sampler + "_with_pdf", lobe, {{"u1", &u[2 * attempt]}, {"u2", &u[2 * attempt + 1]}});
    const bool normals = find_function(sampler)->result == "WM";
    const conformance::Direction& wo = lobe.wo;
    for (std::size_t i = 0; i < samples; ++i) {
        if (normals) {
            const double cosine = s[0][i] * wo[0] + s[1][i] * wo[1] + s[2][i] * wo[2];
            for (std::size_t k = 0; k < 3; ++k) s[k][i] = 2 * cosine * s[k][i] - wo[k];
            s[3][i] /= 4 * std::abs(cosine);
        }
        if (!(s[2][i] > 0)) s[3][i] = 0;
    }
    return s;
}

// The first of several samples that is above the surface. All are D over a constant there, so that what K samples of a
// cap that loses the part w reach has the density of one times 1 + w + ... + w^(K - 1).
Columns first_of(std::span<const Columns> tries, const conformance::Point& lobe) {
    Columns result = tries[0];
    const auto at = static_cast<std::size_t>(
        std::find_if(result[3].begin(), result[3].end(), [](double p) { return p > 0; }) - result[3].begin());
    const Columns one{{result[0][at]}, {result[1][at]}, {result[2][at]}};
    const double visible = call("vndf_ggx_pdf_wi_conic2026", lobe,
                                {{"wi_x", &one[0]}, {"wi_y", &one[1]}, {"wi_z", &one[2]}})[0][0];
    const double w = 1 - result[3][at] / visible;
    double reached = 0;
    for (std::size_t k = 0; k < tries.size(); ++k) reached += std::pow(w, static_cast<double>(k));
    for (std::size_t i = 0; i < samples; ++i) {
        for (std::size_t k = 1; k < tries.size() && result[3][i] == 0; ++k)
            for (std::size_t j = 0; j < 4; ++j) result[j][i] = tries[k][j][i];
        result[3][i] *= reached;
    }
    return result;
}

// --- Noise ---

// brdf cos(theta_i) / density of each sample.
std::vector<double> weights(const Columns& wi, const conformance::Point& lobe) {
    const conformance::Direction& wo = lobe.wo;
    Columns wm(3, std::vector<double>(samples));
    for (std::size_t i = 0; i < samples; ++i) {
        const double cosine = wi[0][i] * wo[0] + wi[1][i] * wo[1] + wi[2][i] * wo[2];
        const double half = std::sqrt(2 + 2 * cosine);  // |wo + wi|
        for (std::size_t k = 0; k < 3; ++k) wm[k][i] = (wi[k][i] + wo[k]) / half;
    }
    const auto d = call("vndf_ggx_ndf", lobe, {{"wm_x", &wm[0]}, {"wm_y", &wm[1]}, {"wm_z", &wm[2]}})[0];
    const auto g2 = call("vndf_ggx_g2", lobe, {{"wi_x", &wi[0]}, {"wi_y", &wi[1]}, {"wi_z", &wi[2]}})[0];
    std::vector<double> result(samples);
    for (std::size_t i = 0; i < samples; ++i)
        result[i] = wi[3][i] > 0 ? d[i] * g2[i] / (4 * wo[2] * wi[3][i]) : 0;
    return result;
}

struct Moments {
    double mean = 0, variance = 0;
};

Moments moments(std::span<const double> values) {
    Moments m;
    for (const double value : values) m.mean += value / static_cast<double>(values.size());
    for (const double value : values)
        m.variance += (value - m.mean) * (value - m.mean) / static_cast<double>(values.size() - 1);
    return m;
}

double deviation_of_blocks(std::span<const double> values) {
    std::vector<double> means;
    for (std::size_t first = 0; first < samples; first += block)
        means.push_back(moments(values.subspan(first, block)).mean);
    return std::sqrt(moments(means).variance);
}

LobeNoise noise(const std::string& name, const conformance::Point& lobe, const Columns& random,
                const Columns& sobol) {
    LobeNoise result{
        .sampler = name, .alpha_x = lobe.alpha[0], .alpha_y = lobe.alpha[1], .cos_theta = lobe.wo[2]};
    result.rejected = static_cast<double>(std::count(random[3].begin(), random[3].end(), 0.0)) / samples;
    auto plain = weights(random, lobe), stratified = weights(sobol, lobe);
    const Moments white = moments(plain);
    result.mean = white.mean;
    result.variance = white.variance;
    result.sobol_rmse = deviation_of_blocks(stratified);
    for (std::size_t i = 0; i < samples; ++i) {
        plain[i] *= (1 + random[0][i]) / 2;
        stratified[i] *= (1 + sobol[0][i]) / 2;
    }
    const Moments smooth = moments(plain);
    result.smooth_mean = smooth.mean;
    result.smooth_variance = smooth.variance;
    result.smooth_sobol_rmse = deviation_of_blocks(stratified);
    return result;
}

}  // namespace

bool has_noise(const std::string& sampler) {
    return sampler == bounded || std::count(std::begin(samplers), std::end(samplers), sampler) > 0;
}

std::vector<LobeNoise> lobe_noise() {
    const Columns random = random_points(), sobol = sobol_points();
    std::vector<LobeNoise> all;
    for (const auto& alpha : alphas)
        for (const double cosine : cosines) {
            const conformance::Point lobe = conformance::make_point(
                conformance::direction(cosine, 0.7), alpha, {0.9, 0}, {0, 0, 1}, {0.5, 0.5}, 1.5);
            for (const char* sampler : samplers)
                all.push_back(noise(sampler, lobe, reflections(sampler, lobe, random),
                                    reflections(sampler, lobe, sobol)));
            std::vector<Columns> of_random, of_sobol;
            for (std::size_t k = 0; k < most_tries; ++k) {
                of_random.push_back(reflections(bounded, lobe, random, k));
                of_sobol.push_back(reflections(bounded, lobe, sobol, k));
            }
            all.push_back(noise(bounded, lobe, of_random[0], of_sobol[0]));
            for (const std::size_t tries : {std::size_t{2}, most_tries})
                all.push_back(noise(fmt::format("{}/tries{}", bounded, tries), lobe,
                                    first_of(std::span(of_random).first(tries), lobe),
                                    first_of(std::span(of_sobol).first(tries), lobe)));
        }
    return all;
}

}  // namespace vndf::bench
