#include "effect_costs.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "bench/sources.h"
#include "effects.h"
#include "runtime/program.h"
#include "splitmix64.h"

namespace vndf::bench {
namespace {

using Clock = std::chrono::steady_clock;

// An odd number of groups: arrays that begin at one place of a page fall into one set of the cache.
constexpr std::size_t groups = 13, items = groups * runtime::group_size, launched = 1 << 18;
constexpr std::size_t outputs = 8;

// wo, wi or the random numbers, and the material.
std::size_t inputs() {
    return 6 + material_parameters().size();
}

EffectCost cost_of(const std::string& program, const std::string& list) {
    EffectCost cost;
    cost.program = program;
    cost.macros = parse_effects(list).macros();
    return cost;
}

EffectCounts counts_of(const nlohmann::json& entry) {
    return {entry.at("llvm"), entry.value("sm_80_slots", 0), entry.value("sm_80_registers", 0)};
}

nlohmann::ordered_json json_of(const EffectCounts& counts) {
    nlohmann::ordered_json json;
    if (counts.llvm != 0) json["llvm"] = counts.llvm;
    if (counts.sm_80_slots != 0)
        json["sm_80_slots"] = counts.sm_80_slots, json["sm_80_registers"] = counts.sm_80_registers;
    return json;
}

void add_counts(std::vector<EffectCost>& costs) {
    const auto& files = sources();
    const auto file = std::ranges::find(files, "bench/results/effects.json", &runtime::SourceFile::path);
    const nlohmann::json counted = nlohmann::json::parse(file->text);
    for (const nlohmann::json& entry : counted.at("entries"))
        for (EffectCost& cost : costs)
            if (cost.program == entry.at("program").get<std::string>()) {
                cost.sample = counts_of(entry.at("sample"));
                cost.eval_pdf = counts_of(entry.at("eval_pdf"));
            }
}

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

// Directions above the surface and materials as scenes have them.
void fill(const runtime::Program& program, std::vector<cl::Buffer>& buffers) {
    SplitMix64 draw(1);
    std::vector<std::vector<float>> columns(inputs(), std::vector<float>(items));
    const auto of = [&](const char* parameter) -> std::vector<float>& {
        return columns[6 + material_parameter(parameter)];
    };
    for (std::size_t i = 0; i < items; ++i) {
        for (std::vector<float>& column : columns) column[i] = static_cast<float>(draw.uniform());
        const double z = columns[2][i], phi = 6.2831853 * draw.uniform(), r = std::sqrt(1 - z * z);
        columns[0][i] = static_cast<float>(r * std::cos(phi)),
        columns[1][i] = static_cast<float>(r * std::sin(phi));
        of("alpha_x")[i] = of("alpha_y")[i] = static_cast<float>(std::exp(-7 * draw.uniform()));
        of("ior")[i] += 1;
        of("thin_walled")[i] = std::floor(1.25f * of("thin_walled")[i]);
        of("channel")[i] = std::floor(3 * of("channel")[i]);
        of("ng_x")[i] = of("ng_y")[i] = .1f, of("ng_z")[i] = .99f;
    }
    for (std::size_t c = 0; c < columns.size(); ++c)
        program.queue().enqueueWriteBuffer(buffers[c], CL_TRUE, 0, items * sizeof(float), columns[c].data());
}

struct Running {
    runtime::Program program;
    cl::Kernel sample, eval_pdf;
};

double nanoseconds(const Running& running, const cl::Kernel& kernel) {
    const auto start = Clock::now();
    running.program.launch(kernel, launched);
    running.program.queue().finish();
    return seconds_since(start) * 1e9 / static_cast<double>(launched);
}

}  // namespace

std::vector<EffectCost> effect_programs() {
    std::vector<EffectCost> all{cost_of("all", "all")};
    std::vector<std::string> names;
    for (const Effect& effect : effects()) names.push_back(effect.name);
    for (const std::string& off : names) {
        std::string list;
        for (const std::string& name : names)
            if (name != off) list += (list.empty() ? "" : ",") + name;
        all.push_back(cost_of("all without " + off, list));
    }
    all.push_back(cost_of("conductor alone", "conductor"));
    for (const std::string& name : names)
        if (name != "conductor") all.push_back(cost_of("conductor and " + name, "conductor," + name));
    all.push_back(cost_of("glass: dielectric and back_facing", "dielectric,back_facing"));
    all.push_back(cost_of("the same, sampling plain", "dielectric,back_facing,sampling=plain"));
    all.push_back(cost_of("the same, energy turquin", "dielectric,back_facing,energy=turquin"));
    for (const EffectChoice& choice : effect_choices())
        for (std::size_t i = 1; i < choice.values.size(); ++i) {
            // Without a geometric normal that is conic.
            const bool tilted = choice.values[i] == "tilted";
            all.push_back(cost_of(fmt::format("conductor {}, {} {}", tilted ? "and shading_normal" : "alone",
                                              choice.name, choice.values[i]),
                                  fmt::format("conductor,{}{}={}", tilted ? "shading_normal," : "",
                                              choice.name, choice.values[i])));
        }
    add_counts(all);
    return all;
}

std::vector<EffectCost> effect_costs(const runtime::Device& device, std::vector<EffectCost> costs,
                                     int repetitions, const std::function<void(double done)>& progress) {
    std::vector<Running> all;
    std::vector<cl::Buffer> buffers;
    for (EffectCost& cost : costs) {
        runtime::ProgramOptions options;
        options.root = "kernels/batch/bsdf.cl";
        options.build_options =
            fmt::format("-DVNDF_BSDF_GROUPS={} -D{}", groups, fmt::join(cost.macros, " -D"));
        const auto start = Clock::now();
        runtime::Program program =
            all.empty()
                ? runtime::Program(device, runtime::Math::strict, runtime::Real::f32, options)
                : runtime::Program(all[0].program, runtime::Math::strict, runtime::Real::f32, options);
        Running running{program, program.kernel("vndf_batch_bsdf_sample"),
                        program.kernel("vndf_batch_bsdf_eval_pdf")};
        program.guarded("measure a material", [&] {
            if (buffers.empty()) {
                for (std::size_t i = 0; i < inputs() + outputs; ++i)
                    buffers.push_back(program.buffer(items * sizeof(float)));
                fill(program, buffers);
            }
            for (cl_uint i = 0; i < inputs() + outputs; ++i) running.sample.setArg(i, buffers[i]);
            for (cl_uint i = 0; i < inputs() + 4; ++i) running.eval_pdf.setArg(i, buffers[i]);
            // Some drivers compile at the first launch.
            for (const cl::Kernel* kernel : {&running.sample, &running.eval_pdf})
                program.launch(*kernel, runtime::group_size);
            program.queue().finish();
        });
        cost.build_s = seconds_since(start);
        cost.sample_ns = cost.eval_pdf_ns = std::numeric_limits<double>::infinity();
        all.push_back(running);
        progress(.5 * static_cast<double>(all.size()) / static_cast<double>(costs.size()));
    }
    for (int repetition = 0; repetition < repetitions; ++repetition) {
        for (std::size_t i = 0; i < all.size(); ++i) {
            costs[i].sample_ns = std::min(costs[i].sample_ns, nanoseconds(all[i], all[i].sample));
            costs[i].eval_pdf_ns = std::min(costs[i].eval_pdf_ns, nanoseconds(all[i], all[i].eval_pdf));
        }
        progress(.5 + .5 * (repetition + 1) / repetitions);
    }
    return costs;
}

std::string effects_json(const std::vector<EffectCost>& costs,
                         const std::vector<std::pair<std::string, std::string>>& context) {
    nlohmann::ordered_json data;
    for (const auto& [name, value] : context) data["context"][name] = value;
    for (const EffectCost& cost : costs)
        data["effects"].push_back({{"program", cost.program},
                                   {"switches", cost.macros},
                                   {"sample_ns", cost.sample_ns},
                                   {"eval_pdf_ns", cost.eval_pdf_ns},
                                   {"build_s", cost.build_s},
                                   {"sample", json_of(cost.sample)},
                                   {"eval_pdf", json_of(cost.eval_pdf)}});
    return data.dump(1) + '\n';
}

}  // namespace vndf::bench
