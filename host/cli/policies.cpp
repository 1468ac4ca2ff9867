// clvndf policies
#include <memory>
#include <optional>

#include <fmt/format.h>

#include "cli/commands.h"
#include "cli/output_file.h"
#include "cli/progress.h"
#include "conformance/runs/policies.h"
#include "error.h"

namespace vndf::cli {
namespace {

struct Policies {
    std::string device, real = "float", only, json;
    bool quick = false;
};

void run_policies(const Policies& options, Common& common) {
    const auto selected = conformance::select(options.only);
    if (selected.empty())
        throw InputError(
            fmt::format("--only '{}': no function of that name; the nearest are {} (see clvndf list)",
                        options.only, fmt::join(nearest_names(options.only), ", ")));
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
    const auto report = conformance::measure_policies(device, target.real(), selected, check);
    progress.clear();

    if (json) json->write(conformance::format_json(report)), json->commit();
    if (options.json != "-") fmt::print("{}", conformance::format_table(report));
    common.exit_status = report.passed() ? 0 : 1;
}

}  // namespace

void add_policies(CLI::App& app, Common& common) {
    const auto options = std::make_shared<Policies>();
    CLI::App* command = app.add_subcommand(
        "policies",
        "errors of every function in every policy, and in strict with the build options that loosen it;\n"
        "exit status 1 if strict or builtin breaks a promise");
    command->add_option("--device", options->device,
                        "first device whose platform or device name contains this");
    command->add_option("--real", options->real, "real type: float or double")
        ->check(CLI::IsMember({"float", "double"}))
        ->capture_default_str();
    command->add_option("--only", options->only,
                        "only functions whose name contains this, or matches it with * and ?");
    command->add_flag("--quick", options->quick, "fewer points");
    command->add_option("--json", options->json, "write the figures as JSON (- for standard output)");
    command->callback(
        [options, &common] { common.action = [options, &common] { run_policies(*options, common); }; });
}

}  // namespace vndf::cli
