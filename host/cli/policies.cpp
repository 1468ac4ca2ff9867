// clvndf policies
#include <memory>
#include <optional>

#include "cli/commands.h"
#include "cli/options.h"
#include "cli/output_file.h"
#include "cli/progress.h"
#include "conformance/runs/fast_math.h"
#include "conformance/runs/policies.h"
#include "cli/streams.h"

namespace vndf::cli {
namespace {

struct Policies {
    std::string device, real = "float", only, json;
    std::vector<runtime::FlagSet> flags;  // empty: the policies
    bool quick = false;
};

void run_policies(const Policies& options, Common& common) {
    const auto selected = selected_by(options.only);
    if (!options.flags.empty() && options.real != "float")
        throw InputError("--flags --real double: fast math is promised and measured in float");
    const bool table = !is_standard_output(options.json);
    if (table) require_output();
    std::optional<OutputFile> json;
    if (!options.json.empty()) json.emplace(options.json);

    Target target;
    target.device = options.device, target.real_name = options.real;
    const runtime::Device device = target.choose(common);
    const Progress progress(common.quiet);
    conformance::CheckOptions check;
    check.seed = common.seed;
    check.quick = options.quick;
    check.progress = [&](const std::string& what, double done) { progress(what, done); };
    const auto show = [&](const auto& report) {
        progress.clear();
        if (json) json->write(conformance::format_json(report)), json->commit();
        if (table) put(conformance::format_table(report));
        common.exit_status = report.passed() ? 0 : 1;
    };
    if (options.flags.empty())
        show(conformance::measure_policies(device, target.real(), selected, check));
    else
        show(conformance::measure_fast_math(device, options.flags, selected, check));
}

}  // namespace

void add_policies(CLI::App& app, Common& common) {
    const auto options = std::make_shared<Policies>();
    CLI::App* command = app.add_subcommand(
        "policies",
        "errors of every function in every policy, and in strict with the build options that loosen it;\n"
        "exit status 1 if strict or builtin breaks a promise");
    add_device(*command, options->device);
    command->add_option("--real", options->real, "real type: float or double")
        ->check(CLI::IsMember({"float", "double"}))
        ->capture_default_str();
    add_only(*command, options->only);
    command->add_option_function<std::string>(
        "--flags", [options](const std::string& text) { options->flags = runtime::parse_flag_sets(text); },
        "the promise of fast math instead, in these builds: renderers' names (luxcore, baikal, fluctus,\n"
        "cycles, hydracore), OpenCL's flags, several with spaces between them, further sets after\n"
        "commas; renderers: all of these; pairs: each flag and each two. Exit status 1 if one breaks it");
    command->add_flag("--quick", options->quick, "fewer points");
    command->add_option("--json", options->json, "write the figures as JSON (- for standard output)");
    command->callback(
        [options, &common] { common.action = [options, &common] { run_policies(*options, common); }; });
}

}  // namespace vndf::cli
