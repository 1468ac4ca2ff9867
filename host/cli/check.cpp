// clvndf check
#include <atomic>
#include <csignal>
#include <memory>
#include <optional>

#include <fmt/format.h>

#include "cli/commands.h"
#include "cli/output_file.h"
#include "cli/progress.h"
#include "conformance/check.h"
#include "conformance/digest.h"
#include "conformance/exhaustive.h"
#include "error.h"

namespace vndf::cli {
namespace {

struct Check {
    Target target;
    std::string only, json, junit;
    bool quick = false;
    std::size_t points = 0;
    bool digest = false;
    std::string on = "device";  // whose digest
    bool exhaustive = false;
    double minutes = 0;  // 0: to the end
    std::string slice = "1/1";
};

std::vector<const Function*> selected_by(const Check& options) {
    auto selected = conformance::select(options.only);
    if (!selected.empty()) return selected;
    throw InputError(
        fmt::format("--only '{}': no function of that name; the nearest are {} (see clvndf list)",
                    options.only, fmt::join(nearest_names(options.only), ", ")));
}

// One hash a function, and nothing else on the standard output.
void run_digest(const Check& options, Common& common) {
    const auto selected = selected_by(options);
    conformance::BitsOptions bits;
    bits.math = options.target.math();
    if (options.quick) bits.rows = conformance::quick_digest_rows;
    const Progress progress(common.quiet);
    bits.progress = [&](const std::string& what, double done) { progress(what, done); };

    std::unique_ptr<runtime::Evaluator> evaluator;
    if (options.on == "host") {
        evaluator = std::make_unique<runtime::HostEvaluator>(bits.math, options.target.real());
    } else {
        const runtime::Device device = options.target.choose(common);
        bits.flushes = bits.math == runtime::Math::strict && !device.denormals;
        runtime::ProgramOptions program;
        if (!options.only.empty()) program.functions = conformance::needed(selected);
        progress("building the program", 0);
        evaluator =
            std::make_unique<runtime::DeviceEvaluator>(device, bits.math, options.target.real(), program);
    }
    const auto digests = conformance::digests(*evaluator, selected, bits);
    progress.clear();
    if (bits.flushes && !common.quiet) {
        fmt::print(stderr,
                   "clvndf: {} flushes subnormal numbers; exempt, with the host build's results instead:\n",
                   evaluator->describe());
        for (const conformance::Digest& digest : digests)
            if (digest.exempt > 0)
                fmt::print(stderr, "  {} {} of {}\n", digest.function->name, digest.exempt, bits.rows);
    }
    fmt::print("{}", conformance::format_digests(digests));
}

std::atomic<bool> interrupted{false};

// "3/10": the third of ten equal parts.
conformance::Slice parse_slice(const std::string& text) {
    unsigned number = 0, count = 0;
    int end = 0;
    if (std::sscanf(text.c_str(), "%9u/%9u%n", &number, &count, &end) == 2 &&
        static_cast<std::size_t>(end) == text.size() && number >= 1 && number <= count)
        return {number - 1, count};
    throw InputError(fmt::format("--slice '{}': expected a part I/N with 1 <= I <= N, as in 3/10", text));
}

// Ends at the first of: all walked, the time given, an interrupt; and reports in each case.
void run_exhaustive(const Check& options, Common& common) {
    const auto samplers = conformance::samplers_of(selected_by(options));
    if (samplers.empty()) throw InputError(fmt::format("--only '{}': no sampler", options.only));
    if (options.target.real() != runtime::Real::f32)
        throw InputError("--exhaustive --real double: only the values of a float can be exhausted");
    conformance::ExhaustiveOptions walk;
    walk.slice = parse_slice(options.slice);
    if (options.minutes > 0) walk.seconds = 60 * options.minutes;

    const runtime::Device device = options.target.choose(common);
    const Progress progress(common.quiet);
    progress("building the program", 0);
    runtime::DeviceEvaluator evaluator(device, options.target.math(), runtime::Real::f32,
                                       conformance::exhaustive_program(samplers));
    walk.proceed = [&](const std::string& what, double done) {
        progress(what, done);
        return !interrupted;
    };
    const auto before = std::signal(SIGINT, [](int) { interrupted = true; });
    const auto report = conformance::exhaust(evaluator, options.target.math(), samplers, walk);
    std::signal(SIGINT, before);
    progress.clear();
    fmt::print("{}", conformance::format_table(report));
    common.exit_status = !report.passed() ? 1 : interrupted ? 128 + SIGINT : 0;
}

void run_check(const Check& options, Common& common) {
    if (options.exhaustive) return run_exhaustive(options, common);
    if (options.digest) return run_digest(options, common);
    const auto selected = selected_by(options);
    if (options.json == "-" && options.junit == "-")
        throw InputError("--json - and --junit -: only one of them can have the standard output");
    const runtime::Math math = options.target.math();
    // Opened before the work, so that a path that cannot be written costs no time.
    std::optional<OutputFile> json, junit;
    if (!options.json.empty()) json.emplace(options.json);
    if (!options.junit.empty()) junit.emplace(options.junit);

    const runtime::Device device = options.target.choose(common);
    runtime::ProgramOptions program;
    if (!options.only.empty()) program.functions = conformance::needed(selected);
    const Progress progress(common.quiet);
    progress("building the program", 0);
    runtime::DeviceEvaluator evaluator(device, math, options.target.real(), program);
    conformance::CheckOptions check;
    check.seed = common.seed;
    check.quick = options.quick;
    check.random_points = options.points;
    check.progress = [&](const std::string& what, double done) { progress(what, done); };
    const conformance::Report report = conformance::check(evaluator, math, selected, check);
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
    CLI::Option* quick =
        command->add_flag("--quick", options->quick, "12 lobes a sampler, fewer samples and points");
    command
        ->add_option("--points", options->points,
                     "random inputs a function of the pointwise comparison, beside its hard grid (65536; "
                     "--quick: 16384)")
        ->check(CLI::Range(std::size_t{1024}, std::size_t{1} << 24));
    CLI::Option* json =
        command->add_option("--json", options->json, "write the findings as JSON (- for standard output)");
    CLI::Option* junit = command->add_option("--junit", options->junit,
                                             "write the findings as JUnit XML (- for standard output)");
    CLI::Option* exhaustive =
        command
            ->add_flag("--exhaustive", options->exhaustive,
                       "instead: every u that is a multiple of 2^-24, at hard lobes, judged on the device; "
                       "hours\n(an interrupt ends it with a report)")
            ->excludes(quick)
            ->excludes(json)
            ->excludes(junit);
    CLI::Option* digest =
        command
            ->add_flag(
                "--digest", options->digest,
                "instead: a hash for each function of its results at 2^20 fixed inputs (--quick: 2^12);\n"
                "strict ones are the same on every device")
            ->excludes(json)
            ->excludes(junit)
            ->excludes(exhaustive);
    command->add_option("--on", options->on, "whose digests: device or host (the headers as C++)")
        ->needs(digest)
        ->check(CLI::IsMember({"device", "host"}))
        ->capture_default_str();
    command->add_option("--minutes", options->minutes, "end the exhaustion after this time")
        ->needs(exhaustive)
        ->check(CLI::PositiveNumber);
    command->add_option("--slice", options->slice, "this part of the exhaustion only: I/N, the I-th of N")
        ->needs(exhaustive);
    command->callback(
        [options, &common] { common.action = [options, &common] { run_check(*options, common); }; });
}

}  // namespace vndf::cli
