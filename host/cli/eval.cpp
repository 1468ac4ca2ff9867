// clvndf eval
#include <functional>
#include <memory>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/commands.h"
#include "cli/csv.h"
#include "cli/output_file.h"
#include "cli/options.h"
#include "error.h"
#include "runtime/device_evaluator.h"

namespace vndf::cli {
namespace {

using runtime::Evaluator;
using runtime::Real;

constexpr std::size_t chunk_rows = 1 << 16;

struct Eval {
    Target target;
    conformance::UserOptions user;  // of --kernel
    std::string name, on = "device", input = "-", output = "-";
    bool hex = false;
};

const Function& named_function(const std::string& name) {
    if (const Function* function = find_function(name)) return *function;
    for (const LobeFunction& lobe : lobe_functions())
        if (lobe.name == name)
            throw InputError(fmt::format(
                "'{}' returns a {}, not numbers: evaluate a function that takes it (see clvndf list)", name,
                lobe.type));
    for (const BsdfFunction& bsdf : bsdf_functions())
        if (bsdf.name == name)
            throw InputError(fmt::format(
                "'{}' takes a material, not numbers: have clvndf emit write it for the effects of yours",
                name));
    throw InputError(fmt::format("unknown function '{}'; the nearest names are {} (see clvndf list)", name,
                                 fmt::join(nearest_names(name), ", ")));
}

// What evaluates, once the options are found good; made late, because a program takes its time to build.
std::function<std::unique_ptr<Evaluator>()> evaluator_maker(const Eval& eval,
                                                            const conformance::UserKernel* user,
                                                            const Common& common) {
    const runtime::Math math = eval.target.math();
    const Real real = eval.target.real();
    if (eval.on == "device") {
        const runtime::Device device = eval.target.choose(common);
        runtime::require_real(device, real);
        if (user)
            return [=] { return std::make_unique<runtime::DeviceEvaluator>(user->evaluator(device, real)); };
        runtime::ProgramOptions options;
        options.functions = {eval.name};
        return [=] { return std::make_unique<runtime::DeviceEvaluator>(device, math, real, options); };
    }
    if (!eval.target.device.empty()) {
        throw InputError(fmt::format("--device '{}': --on {} uses no device; only --on device does",
                                     eval.target.device, eval.on));
    }
    if (eval.on == "reference") return [=] { return std::make_unique<runtime::ReferenceEvaluator>(real); };
    runtime::require_host_policy(math);
    return [=] { return std::make_unique<runtime::HostEvaluator>(math, real); };
}

template <class Out>
void append_rows(std::string& text, const std::vector<std::vector<Out>>& columns, std::size_t rows,
                 bool hex) {
    for (std::size_t row = 0; row < rows; ++row) {
        for (std::size_t c = 0; c < columns.size(); ++c) {
            if (c != 0) text += ',';
            append_number(text, columns[c][row], hex);
        }
        text += '\n';
    }
}

// In and Out: the evaluator's real types.
template <class In, class Out>
void stream(const Eval& eval, const Common& common) {
    if (eval.user.as == "bsdf")
        throw InputError(fmt::format("--as bsdf: eval takes one function at a time: --as {}",
                                     fmt::join(conformance::bsdf_parts(), ", ")));
    std::optional<conformance::UserKernel> user;
    if (!eval.user.file.empty()) user.emplace(eval.user);
    const Function& function = user ? user->function() : named_function(eval.name);
    require_distinct({{"--output", eval.output}}, {{"--input", eval.input}, {"--kernel", eval.user.file}});
    const auto make_evaluator = evaluator_maker(eval, user ? &*user : nullptr, common);
    OutputFile output(eval.output);
    TableReader<In> reader(eval.input, function.inputs, function.name + " takes");
    const std::unique_ptr<Evaluator> evaluator = make_evaluator();

    std::vector<std::vector<In>> inputs;
    std::vector<std::vector<Out>> outputs(function.outputs.size());
    std::string text = fmt::format("{}\n", fmt::join(function.outputs, ","));
    while (const std::size_t rows = reader.read(chunk_rows, inputs)) {
        std::vector<const void*> in;
        std::vector<void*> out;
        for (const auto& column : inputs) in.push_back(column.data());
        for (auto& column : outputs) {
            column.resize(rows);
            out.push_back(column.data());
        }
        evaluator->run(function, rows, in, out);
        append_rows(text, outputs, rows, eval.hex);
        output.write(text);
        text.clear();
    }
    output.write(text);
    output.commit();
}

void run(const Eval& eval, const Common& common) {
    if (eval.target.real() == Real::f64) return stream<double, double>(eval, common);
    if (eval.on == "reference") return stream<float, double>(eval, common);
    stream<float, float>(eval, common);
}

}  // namespace

void add_eval(CLI::App& app, Common& common) {
    CLI::App* command = app.add_subcommand("eval", "evaluate one function on rows of CSV");
    const auto eval = std::make_shared<Eval>();
    command->add_option("name", eval->name, "function, as clvndf list names it")->required();
    command
        ->add_option("--on", eval->on,
                     "what evaluates: device, host (the headers as C++) or reference (double)")
        ->check(CLI::IsMember({"device", "host", "reference"}))
        ->capture_default_str();
    eval->target.add_to(*command);
    command->add_option("--input", eval->input, "CSV whose header names every argument, or -")
        ->capture_default_str();
    command->add_option("--output", eval->output, "CSV to write, or -")->capture_default_str();
    command->add_flag("--hex", eval->hex, "C99 hex numbers in the output");
    add_kernel(*command, eval->user, "evaluate a function of this file of OpenCL C, as clvndf check does",
               fmt::format("the function of clvndf list whose arguments it has, or {}",
                           fmt::join(conformance::bsdf_parts(), ", ")))
        ->excludes(command->get_option("--on"))
        ->excludes(command->get_option("--math"));
    command->callback([eval, &common] {
        eval->user.function = eval->name;
        common.action = [eval, &common] { run(*eval, common); };
    });
}

}  // namespace vndf::cli
