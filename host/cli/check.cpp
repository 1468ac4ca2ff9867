// clvndf check
#include <unistd.h>

#include <cstdio>
#include <memory>
#include <optional>

#include <fmt/format.h>

#include "cli/commands.h"
#include "cli/output_file.h"
#include "conformance/check.h"
#include "error.h"

namespace vndf::cli {
namespace {

struct Check {
    Target target;
    std::string only, json, junit;
    bool quick = false;
};

// A line on the terminal that is written over, and gone at the end.
class Progress {
  public:
    explicit Progress(bool quiet) : shown_(!quiet && isatty(STDERR_FILENO)) {}
    ~Progress() { clear(); }
    void operator()(const std::string& what, double done) const {
        if (shown_) fmt::print(stderr, "\r\033[K{:3.0f}%  {}", 100 * done, what), std::fflush(stderr);
    }
    void clear() const {
        if (shown_) fmt::print(stderr, "\r\033[K"), std::fflush(stderr);
    }

  private:
    bool shown_;
};

void run_check(const Check& options, Common& common) {
    const auto selected = conformance::select(options.only);
    if (selected.empty())
        throw InputError(
            fmt::format("--only '{}': no function of that name; the nearest are {} (see clvndf list)",
                        options.only, fmt::join(nearest_names(options.only), ", ")));
    if (options.json == "-" && options.junit == "-")
        throw InputError("--json - and --junit -: only one of them can have the standard output");
    // Opened before the work, so that a path that cannot be written costs no time.
    std::optional<OutputFile> json, junit;
    if (!options.json.empty()) json.emplace(options.json);
    if (!options.junit.empty()) junit.emplace(options.junit);

    const runtime::Device device = options.target.choose(common);
    runtime::ProgramOptions program;
    if (!options.only.empty()) program.functions = conformance::needed(selected);
    const Progress progress(common.quiet);
    progress("building the program", 0);
    runtime::DeviceEvaluator evaluator(device, options.target.math(), options.target.real(), program);
    conformance::CheckOptions check;
    check.seed = common.seed;
    check.quick = options.quick;
    check.progress = [&](const std::string& what, double done) { progress(what, done); };
    const conformance::Report report = conformance::check(evaluator, options.target.math(), selected, check);
    progress.clear();

    if (json) json->write(conformance::format_json(report)), json->commit();
    if (junit) junit->write(conformance::format_junit(report)), junit->commit();
    if (options.json != "-" && options.junit != "-") fmt::print("{}", conformance::format_table(report));
    common.exit_status = report.passed() ? 0 : 1;
}

}  // namespace

void add_check(CLI::App& app, Common& common) {
    const auto options = std::make_shared<Check>();
    CLI::App* command = app.add_subcommand(
        "check", "conformance of a device: every function against the reference; exit status 1 if one fails");
    options->target.add_to(*command);
    command->add_option("--only", options->only,
                        "only functions whose name contains this, or matches it with * and ?");
    command->add_flag("--quick", options->quick, "12 lobes a sampler, fewer samples and points");
    command->add_option("--json", options->json, "write the findings as JSON (- for standard output)");
    command->add_option("--junit", options->junit, "write the findings as JUnit XML (- for standard output)");
    command->callback(
        [options, &common] { common.action = [options, &common] { run_check(*options, common); }; });
}

}  // namespace vndf::cli
