// clvndf check
#include <charconv>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <memory>
#include <optional>
#include <fmt/ranges.h>

#include "cli/commands.h"
#include "cli/interrupt.h"
#include "cli/leftovers.h"
#include "cli/options.h"
#include "cli/output_file.h"
#include "cli/progress.h"
#include "conformance/runs/check.h"
#include "conformance/judge/answers.h"
#include "conformance/judge/digest.h"
#include "conformance/report/page.h"
#include "conformance/runs/exhaustive_checkpoint.h"
#include "conformance/runs/user_check.h"
#include "cli/streams.h"
#include "error.h"
#include "file.h"
#include "text.h"

namespace vndf::cli {
namespace {

struct Check {
    Target target;
    std::string only, json, junit, report;
    bool quick = false, all = false;
    std::size_t points = 0;
    bool digest = false, answers = false;
    std::string on = "device";  // whose digest
    bool exhaustive = false;
    double minutes = 0;  // 0: to the end
    std::string slice = "1/1", checkpoint;
    conformance::UserOptions user;  // of --kernel
};

// One hash a function, or its known answers, and nothing else on the standard output.
void run_digest(const Check& options, Common& common) {
    common.require_one_process("check --digest");
    const auto selected = selected_by(options.only);
    conformance::BitsOptions bits;
    bits.math = options.target.math();
    require_output();
    if (options.quick) bits.rows = conformance::quick_digest_rows;
    const Progress progress(common.quiet);
    bits.progress = [&](const std::string& what, double done) { progress(what, done); };

    std::unique_ptr<runtime::Evaluator> evaluator;
    if (options.on == "host") {
        if (!options.target.device.empty())
            throw InputError(fmt::format("--device '{}': --on host uses no device; only --on device does",
                                         options.target.device));
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
    if (options.answers) {
        progress.clear();
        return put(conformance::format_answers(*evaluator, bits.math, selected));
    }
    const auto digests = conformance::digests(*evaluator, selected, bits);
    progress.clear();
    if (bits.flushes && !common.quiet) {
        remark("clvndf: {} flushes subnormal numbers; exempt, with the host build's results instead:\n",
               evaluator->describe());
        for (const conformance::Digest& digest : digests)
            if (digest.exempt > 0) remark("  {} {} of {}\n", digest.function->name, digest.exempt, bits.rows);
    }
    put(conformance::format_digests(digests));
}

// "3/10": the third of ten equal parts of a walk that has `most` of them.
conformance::Slice parse_slice(const std::string& text, std::uint32_t most) {
    const char* const last = text.data() + text.size();
    std::uint32_t number = 0, count = 0;
    const auto [slash, error] = std::from_chars(text.data(), last, number);
    if (error == std::errc() && slash != last && *slash == '/') {
        const auto [end, none] = std::from_chars(slash + 1, last, count);
        if (none == std::errc() && end == last && number >= 1 && number <= count && count <= most)
            return {number - 1, count};
    }
    throw InputError(
        fmt::format("--slice '{}': expected a part I/N with 1 <= I <= N <= {}, as in 3/10", text, most));
}

// Where a walk that is not done goes on later; nothing without --checkpoint.
class WalkCheckpoint {
  public:
    WalkCheckpoint(const std::string& path, const std::string& run) : path_(path), run_(run) {}

    void resume(conformance::ExhaustiveWalk& walk) {
        std::error_code none;
        if (path_.empty() || !std::filesystem::exists(path_, none)) return;
        before_ = conformance::resume(walk, read_file(path_, most_bytes), run_, path_);
    }
    // Of this run and of those that it goes on from.
    double seconds() const { return before_ + std::chrono::duration<double>(Clock::now() - start_).count(); }
    void write(const conformance::ExhaustiveWalk& walk) {
        if (path_.empty()) return;
        OutputFile file(path_);
        file.write(conformance::checkpoint(walk, run_, seconds()));
        file.commit();
        written_ = Clock::now();
    }
    void write_sometimes(const conformance::ExhaustiveWalk& walk) {
        if (Clock::now() - written_ > std::chrono::seconds(10)) write(walk);
    }

  private:
    using Clock = std::chrono::steady_clock;
    static constexpr std::uint64_t most_bytes = 1 << 20;

    std::string path_, run_;
    Clock::time_point start_ = Clock::now(), written_ = start_;
    double before_ = 0;
};

// Ends at the first of: all walked, the time given, an interrupt; and reports in each case.
void run_exhaustive(const Check& options, Common& common) {
    const auto samplers = conformance::samplers_of(selected_by(options.only));
    if (samplers.empty())
        throw InputError(fmt::format("--only '{}': no sampler, which --exhaustive needs", options.only));
    if (options.target.real() != runtime::Real::f32)
        throw InputError("--exhaustive --real double: only the values of a float can be exhausted");
    const runtime::Math math = options.target.math();
    conformance::ExhaustiveWalk walk(samplers,
                                     parse_slice(options.slice, conformance::exhaustive_parts(samplers)));
    require_output();

    const std::vector<runtime::Device> devices = options.target.choose_all(common);
    const std::string what = fmt::format("check --exhaustive --only '{}' --slice {} --math {}", options.only,
                                         options.slice, to_string(math));
    WalkCheckpoint checkpoint(options.checkpoint, with_version(what) + ", on " + devices.front().kind());
    if (common.leads()) checkpoint.resume(walk);
    const std::uint32_t before = walk.taken();
    const Interrupt interrupt;
    const Progress progress(common.quiet);
    progress("building the program", 0);
    const auto hire = [&](const runtime::Device& device) -> runtime::Team::Work {
        const auto walker = std::make_shared<conformance::ExhaustiveWalker>(
            walk,
            runtime::Program(device, math, runtime::Real::f32, conformance::exhaustive_program(samplers)));
        return [walker](const std::string& piece) {
            return walker->walk(static_cast<std::uint32_t>(std::stoul(piece)));
        };
    };
    runtime::Team team(*common.ranks, devices, hire, team_options(what));
    if (!common.leads()) return team.serve();
    const auto start = std::chrono::steady_clock::now();
    runtime::Team::Plan plan;
    plan.tasks = walk.pieces() - before;
    plan.task = [&](std::size_t i) { return std::to_string(before + i); };
    plan.take = [&](std::size_t, const std::string& walked) {
        walk.take(walked);
        checkpoint.write_sometimes(walk);
    };
    plan.proceed = [&](std::size_t) {
        const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
        const double time = options.minutes > 0 ? spent.count() / (60 * options.minutes) : 0;
        progress(fmt::format("{:.3g} inputs", static_cast<double>(walk.report().inputs)),
                 std::max(walk.taken() / static_cast<double>(walk.pieces()), std::min(time, 1.0)));
        return !interrupt.asked() && time < 1;
    };
    team.run(plan);
    progress.clear();
    checkpoint.write(walk);
    conformance::ExhaustiveReport report = walk.report();
    report.seconds = checkpoint.seconds();
    put(conformance::format_table(report));
    common.exit_status = !report.passed() ? 1 : interrupt.asked() ? 128 + SIGINT : 0;
}

// The options that name this user's function, for clvndf eval...
std::string user_in_words(const conformance::UserOptions& user, const Function& function) {
    std::string words = " --kernel " + quoted_for_shell(user.file) + " --as ";
    if (user.as == "bsdf")
        words += function.name == user.function ? "bsdf_value"
                 : function.name == user.pdf    ? "bsdf_pdf"
                                                : "bsdf_sample";
    else
        words += function.name == user.function ? user.as : function.model;
    return words + (user.options.empty() ? "" : " --options " + quoted_for_shell(user.options));
}

// ... and all of them, for clvndf check.
std::string user_in_words(const conformance::UserOptions& user) {
    const conformance::UserOptions usual;
    std::string words = fmt::format(" --kernel {} --function {} --as {}", quoted_for_shell(user.file),
                                    user.function, user.as);
    if (!user.pdf.empty()) words += " --pdf " + user.pdf;
    if (!user.sample.empty()) words += " --sample " + user.sample;
    if (!user.options.empty()) words += " --options " + quoted_for_shell(user.options);
    if (user.scope.domain != usual.scope.domain) words += " --domain sphere";
    const auto &alpha = user.scope.alpha, &usual_alpha = usual.scope.alpha;
    if (alpha.low != usual_alpha.low || alpha.high != usual_alpha.high)
        words += fmt::format(" --alpha {}:{}", alpha.low, alpha.high);
    return words + (user.scope.isotropic ? " --isotropic" : "");
}

conformance::CommandOf command_of_eval(const Check& options) {
    return [&user = options.user, target = options.target.in_words()](const Function& f) {
        return "clvndf eval " + f.name + (user.file.empty() ? "" : user_in_words(user, f)) + target;
    };
}

// FOLDER/index.html.
class Page {
  public:
    Page(const Check& options, const Common& common)
        : options_(options),
          common_(common),
          folder_(options.report),
          file_(in_folder(options.report, "index.html")) {}

    void write(const conformance::Report& report) {
        conformance::PageOptions page;
        page.software = "clvndf " CLVNDF_VERSION;
        page.all = options_.all;
        page.evaluate = command_of_eval(options_);
        std::string run = options_.quick ? " --quick" : "";
        if (options_.points) run += fmt::format(" --points {}", options_.points);
        if (common_.seed != Common().seed) run += fmt::format(" --seed {}", common_.seed);
        page.check = [=, target = options_.target.in_words(), &user = options_.user](const Function& f) {
            return "clvndf check" + (user.file.empty() ? " --only " + f.name : user_in_words(user)) + run +
                   target;
        };
        file_.write(conformance::format_page(report, page));
        file_.commit();
        folder_.keep();
    }

  private:
    const Check& options_;
    const Common& common_;
    NewFolder folder_;
    OutputFile file_;
};

// The functions, by every device of every rank; of a rank that does not lead nothing.
std::optional<conformance::Report> check_together(const Check& options, const Common& common,
                                                  const std::vector<const Function*>& selected,
                                                  const conformance::CheckOptions& check) {
    const runtime::Math math = options.target.math();
    const runtime::Real real = options.target.real();
    runtime::ProgramOptions program;
    if (!options.only.empty()) program.functions = conformance::needed(selected);
    conformance::CheckRun run(math, real, selected, check);
    const auto hire = [&](const runtime::Device& device) -> runtime::Team::Work {
        const auto evaluator = std::make_shared<runtime::DeviceEvaluator>(device, math, real, program);
        return [&, evaluator](const std::string& piece) { return run.judge(*evaluator, std::stoull(piece)); };
    };
    runtime::Team team(*common.ranks, options.target.choose_all(common), hire,
                       team_options(fmt::format("check --only '{}' --seed {} --points {}{}{}{}", options.only,
                                                common.seed, options.points, options.quick ? " --quick" : "",
                                                options.all ? " --all" : "", options.target.in_words())));
    if (!common.leads()) {
        team.serve();
        return std::nullopt;
    }
    runtime::Team::Plan plan;
    plan.tasks = run.pieces();
    plan.take = [&](std::size_t, const std::string& judged) { run.take(judged); };
    team.run(plan);
    return run.finish();
}

conformance::Report check_user(const conformance::UserKernel& user, const Check& options,
                               const Common& common, const conformance::CheckOptions& check) {
    common.require_one_process("check --kernel");
    const runtime::Device device = options.target.choose(common);
    runtime::DeviceEvaluator evaluator = user.evaluator(device, options.target.real());
    return conformance::check_user_kernel(user, evaluator, check);
}

void run_check(Check options, Common& common) {
    if (options.exhaustive) return run_exhaustive(options, common);
    if (options.digest) return run_digest(options, common);
    const bool draws = !options.report.empty();
    if (!common.leads()) options.json.clear(), options.junit.clear(), options.report.clear();
    std::optional<conformance::UserKernel> user;
    if (!options.user.file.empty()) user.emplace(options.user);
    if (user && !user->is_bsdf() && !user->ours())
        throw InputError(fmt::format(
            "--as {}: of clvndf eval; check judges the three functions of a bsdf together: --as bsdf",
            options.user.as));
    const auto selected = user ? std::vector<const Function*>() : selected_by(options.only);
    std::vector<NamedFile> outputs = {{"--json", options.json}, {"--junit", options.junit}};
    if (!options.report.empty()) outputs.push_back({"--report", in_folder(options.report, "index.html")});
    require_distinct(outputs);
    const bool table = !is_standard_output(options.json) && !is_standard_output(options.junit);
    if (table) require_output();
    // Opened before the work, so that a path that cannot be written costs no time.
    std::optional<OutputFile> json, junit;
    if (!options.json.empty()) json.emplace(options.json);
    if (!options.junit.empty()) junit.emplace(options.junit);
    std::optional<Page> page;
    if (!options.report.empty()) page.emplace(options, common);

    const Progress progress(common.quiet);
    progress("building the program", 0);
    conformance::CheckOptions check;
    check.seed = common.seed;
    check.quick = options.quick;
    check.random_points = options.points;
    if (draws) check.pictures = options.all ? conformance::Pictures::all : conformance::Pictures::failed;
    check.progress = [&](const std::string& what, double done) { progress(what, done); };
    const std::optional<conformance::Report> report =
        user ? check_user(*user, options, common, check) : check_together(options, common, selected, check);
    progress.clear();
    if (!report) return;

    if (json) json->write(conformance::format_json(*report)), json->commit();
    if (junit) junit->write(conformance::format_junit(*report)), junit->commit();
    if (page) page->write(*report);
    if (table) put(conformance::format_table(*report, command_of_eval(options)));
    common.exit_status = report->passed() ? 0 : 1;
}

// What is judged in place of our functions.
void add_user(CLI::App& command, const std::shared_ptr<Check>& options) {
    conformance::UserOptions& user = options->user;
    CLI::Option* kernel = add_kernel(
        command, user, "judge a function of this file of OpenCL C instead: kernels/README.md, Adapters",
        fmt::format("what it is to be: {}, bsdf,\nor a function of clvndf list, whose map or value is "
                    "compared as well",
                    fmt::join(conformance::general_names(), ", ")),
        "its name there; of a bsdf that of its value");
    for (const char* other : {"--only", "--math", "--exhaustive", "--digest"})
        kernel->excludes(command.get_option(other));
    command.add_option("--pdf", user.pdf, "of a sampler or a bsdf, the name of its density, judged as well")
        ->needs(kernel);
    command.add_option("--sample", user.sample, "of a bsdf, the name of its sampler")->needs(kernel);
    command
        .add_option_function<std::string>(
            "--domain",
            [options](const std::string& domain) {
                options->user.scope.domain = domain == "front" ? Domain::upper : Domain::sphere;
            },
            "where wo lies: above the surface (default), or anywhere")
        ->check(CLI::IsMember({"front", "sphere"}))
        ->needs(kernel);
    add_alpha(command, user.scope.alpha, "range of roughness that is judged (default 0.001:1)")
        ->needs(kernel);
    command.add_flag("--isotropic", user.scope.isotropic, "judge it where both alphas are the same alone")
        ->needs(kernel);
}

}  // namespace

void add_check(CLI::App& app, Common& common) {
    const auto options = std::make_shared<Check>();
    CLI::App* command = app.add_subcommand(
        "check", "conformance of a device: every function against the reference; exit status 1 if one fails");
    options->target.add_to(*command, "share the work");
    add_only(*command, options->only);
    CLI::Option* quick =
        command->add_flag("--quick", options->quick, "12 lobes a sampler, fewer samples and points");
    CLI::Option* points = add_number(
        *command, "--points", options->points, std::size_t{1024}, std::size_t{1} << 24,
        "random inputs a function of the pointwise comparison, beside its hard grid (65536; --quick: 16384)");
    CLI::Option* json =
        command->add_option("--json", options->json, "write the findings as JSON (- for standard output)");
    CLI::Option* junit = command->add_option("--junit", options->junit,
                                             "write the findings as JUnit XML (- for standard output)");
    CLI::Option* page =
        command
            ->add_option("--report", options->report,
                         "make FOLDER/index.html, a page: a row a function, and pictures of what fails")
            ->type_name("FOLDER");
    CLI::Option* all = command->add_flag("--all", options->all, "pictures of what passes, too")->needs(page);
    CLI::Option* exhaustive =
        command
            ->add_flag("--exhaustive", options->exhaustive,
                       "instead: every u that is a multiple of 2^-24, at hard lobes, judged on the device; "
                       "hours\n(an interrupt ends it with a report)")
            ->excludes(quick)
            ->excludes(points)
            ->excludes(json)
            ->excludes(junit)
            ->excludes(page)
            ->excludes(all);
    CLI::Option* digest =
        command
            ->add_flag(
                "--digest", options->digest,
                "instead: a hash for each function of its results at 2^20 fixed inputs (--quick: 2^12);\n"
                "strict ones are the same on every device")
            ->excludes(points)
            ->excludes(json)
            ->excludes(junit)
            ->excludes(page)
            ->excludes(all)
            ->excludes(exhaustive);
    command
        ->add_flag("--answers", options->answers,
                   fmt::format("in place of hashes {} inputs of each function and the results, in hex",
                               conformance::answer_rows))
        ->needs(digest)
        ->excludes(quick);
    command->add_option("--on", options->on, "whose digests: device or host (the headers as C++)")
        ->needs(digest)
        ->check(CLI::IsMember({"device", "host"}))
        ->capture_default_str();
    add_number(*command, "--minutes", options->minutes, 0.001, 1e6, "end the exhaustion after this time")
        ->needs(exhaustive);
    command->add_option("--slice", options->slice, "this part of the exhaustion only: I/N, the I-th of N")
        ->needs(exhaustive);
    command
        ->add_option(
            "--checkpoint", options->checkpoint,
            "a file that holds how far the exhaustion has come: where there is one, it goes on from there")
        ->needs(exhaustive);
    add_user(*command, options);
    command->callback(
        [options, &common] { common.action = [options, &common] { run_check(*options, common); }; });
}

}  // namespace vndf::cli
