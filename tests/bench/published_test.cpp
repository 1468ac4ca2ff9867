// The published listings under bench/published, and their lean forms under bench/lean, are what clvndf bench compares with: a
// time only means something if the listing draws from the distribution it was published for.
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "bench/sources.h"
#include "conformance/inputs/grids.h"
#include "conformance/judge/known_bias.h"
#include "conformance/judge/lobes.h"
#include "runtime/device_evaluator.h"
#include "support/catch.h"

namespace {

using namespace vndf;
using namespace vndf::conformance;

constexpr std::size_t samples = std::size_t{1} << 17;

runtime::DeviceEvaluator evaluator_of(const std::string& root, runtime::Math math) {
    runtime::ProgramOptions options;
    options.root = root;
    options.more_files = bench::sources();
    return {runtime::choose_device().device, math, runtime::Real::f32, options};
}

runtime::DeviceEvaluator published() {
    return evaluator_of("bench/published/batch.cl", runtime::Math::builtin);
}

std::vector<const Function*> listings(const runtime::DeviceEvaluator& evaluator) {
    std::vector<const Function*> all;
    for (const Function& f : functions())
        if (evaluator.program().has_kernel("vndf_batch_" + f.name)) all.push_back(&f);
    return all;
}

// The listings are meant for wo above the surface.
std::vector<Point> front_lobes(const Function& sampler) {
    std::vector<Point> all = lobes(sampler, true);
    std::erase_if(all, [](const Point& lobe) { return lobe.cos_theta <= 0; });
    return all;
}

// The tests of one lobe that say that the directions `sampler` drew are not those of `density_of`.
std::string failures(runtime::DeviceEvaluator& evaluator, const Function& sampler, const Function& density_of,
                     const Point& lobe, std::uint64_t stream, double level) {
    const Table table = tabulate(sampler, {lobe}, runtime::Real::f32);
    std::vector<std::vector<float>> columns;
    std::vector<const void*> inputs;
    for (const double value : table.row(0)) columns.emplace_back(samples, static_cast<float>(value));
    evaluator.uniforms(1, stream, samples, columns.at(column(sampler, "u1")).data(),
                       columns.at(column(sampler, "u2")).data());
    for (const auto& values : columns) inputs.push_back(values.data());
    std::vector<float> x(samples), y(samples), z(samples);
    evaluator.run(sampler, samples, inputs, {x.data(), y.data(), z.data()});
    std::string failed;
    for (const LobeTest& test : test_lobe(density_of, table.row(0), samples, x.data(), y.data(), z.data(),
                                          level, known_bias(sampler)))
        if (test.is_p ? test.figure < level : test.figure > 1)
            failed += std::string(test.name) + " " + std::to_string(test.figure) + "; ";
    return failed;
}

}  // namespace

TEST_CASE(
    "the published listings and their lean forms draw from their densities, the fit with its known bias") {
    const struct {
        std::string root;
        runtime::Math math;
        std::size_t listings;
    } all_forms[] = {{"bench/published/batch.cl", runtime::Math::builtin, 7},
                     {"bench/lean/batch.cl", runtime::Math::strict, 7},
                     {"bench/lean/factored.cl", runtime::Math::strict, 3}};
    for (const auto& form : all_forms) {
        runtime::DeviceEvaluator evaluator = evaluator_of(form.root, form.math);
        const auto all = listings(evaluator);
        REQUIRE(all.size() == form.listings);
        std::size_t tests = 0;
        for (const Function* f : all) tests += front_lobes(*f).size() * tests_per_lobe(*f);
        for (const Function* f : all) {
            std::uint64_t stream = 0;
            for (const Point& lobe : front_lobes(*f)) {
                CAPTURE(form.root, f->name, lobe.cos_theta, lobe.alpha[0], lobe.alpha[1]);
                CHECK(failures(evaluator, *f, *f, lobe, ++stream, sidak(1e-6, tests)) == "");
            }
        }
    }
}

TEST_CASE("the cap in a basis draws from the density of the isotropic sampler in world space") {
    const Function& world = *find_function("vndf_ggx_sample_wm_benyoub2024");
    for (const runtime::Math math : {runtime::Math::strict, runtime::Math::builtin}) {
        runtime::DeviceEvaluator evaluator = evaluator_of("bench/cap_with_basis.cl", math);
        std::uint64_t stream = 0;
        for (const Point& lobe : front_lobes(world)) {
            CAPTURE(runtime::to_string(math), lobe.cos_theta, lobe.alpha[0], lobe.n[2]);
            CHECK(failures(evaluator, world, world, lobe, ++stream, 1e-9) == "");
        }
    }
}

TEST_CASE("even samples of a cap, and those with reflections beside them, have the density they report") {
    const Function& f = *find_function("vndf_ggx_sample_wi_cone2026_with_pdf");
    const std::map<std::string, float> lobe{{"wo_x", 0.6f},          {"wo_y", 0},       {"wo_z", 0.8f},
                                            {"l_x", -0.28f},         {"l_y", 0},        {"l_z", 0.96f},
                                            {"one_minus_cos", 0.1f}, {"alpha_x", 0.3f}, {"alpha_y", 0.5f}};
    for (const char* root : {"bench/cap_evenly.cl", "bench/cap_both.cl"}) {
        runtime::DeviceEvaluator evaluator = evaluator_of(root, runtime::Math::strict);
        std::vector<std::vector<float>> columns;
        for (const std::string& input : f.inputs)
            columns.emplace_back(samples, lobe.contains(input) ? lobe.at(input) : 0.0f);
        evaluator.uniforms(1, 1, samples, columns.at(column(f, "u1")).data(),
                           columns.at(column(f, "u2")).data());
        std::vector<const void*> inputs;
        for (const auto& values : columns) inputs.push_back(values.data());
        std::vector<float> x(samples), y(samples), z(samples), pdf(samples);
        evaluator.run(f, samples, inputs, {x.data(), y.data(), z.data(), pdf.data()});
        // The solid angle of the cap, and the mean of z in it, times that, by samples over their density.
        double angle = 0, height = 0, square = 0;
        std::size_t outside = 0;
        for (std::size_t i = 0; i < samples; ++i) {
            if (!(pdf[i] > 0)) continue;
            outside += -0.28 * x[i] + 0.96 * z[i] < 0.9 - 1e-5;
            angle += 1.0 / pdf[i] / samples, height += z[i] / pdf[i] / samples;
            square += 1.0 / pdf[i] / pdf[i] / samples;
        }
        CAPTURE(root);
        CHECK(outside == 0);
        const double cap = 2 * std::numbers::pi * 0.1,
                     error = std::sqrt(std::max(square - angle * angle, 0.0) / samples) + 1e-6;
        CHECK(std::abs(angle - cap) < 5 * error);
        CHECK(std::abs(height - cap * 0.96 * 0.95) < 5 * error + 1e-3 * cap);
    }
}

TEST_CASE("a listing that draws from another density is found out") {
    runtime::DeviceEvaluator evaluator = published();
    const Function& beckmann = *find_function("vndf_beckmann_sample_wm_heitz_deon2014");
    const Function& ggx = *find_function("vndf_ggx_sample_wm_heitz2018");
    CHECK(failures(evaluator, beckmann, ggx, front_lobes(ggx).front(), 1, 1e-9) != "");
}
