// clvndf bench
#include <algorithm>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bench/accuracy.h"
#include "bench/advice.h"
#include "bench/effect_costs.h"
#include "bench/measure.h"
#include "bench/session.h"
#include "bench/sources.h"
#include "cli/bench_table.h"
#include "cli/commands.h"
#include "cli/leftovers.h"
#include "cli/options.h"
#include "cli/output_file.h"
#include "cli/progress.h"
#include "conformance/runs/check.h"
#include "cli/streams.h"
#include "error.h"

namespace vndf::cli {
namespace {

using runtime::Real;

struct Bench {
    std::string device, only, json, report, compare;
    int repetitions = 0;  // 0: what suits the run
    bool quick = false, advise = false, front = false, effects = false;
    double error = 0;
    bench::AlphaRange alpha;
    conformance::UserOptions user;  // of --kernel
};

// Empty compiler caches for the drivers that have one on disk, so that the first build of a program is a cold one.
// Drivers read these variables when they start, so it has to come before the first OpenCL call.
class FreshCaches {
  public:
    FreshCaches() {
        for (const char* variable :
             {"POCL_CACHE_DIR", "CUDA_CACHE_PATH", "MESA_SHADER_CACHE_DIR", "NEO_CACHE_DIR"})
            setenv(variable, folder_.path().c_str(), 1);
    }

  private:
    TemporaryFolder folder_{"clvndf-bench-"};
};

std::string read_file(const std::string& path) {
    const auto fail = [&] {
        throw InputError(fmt::format("{}: cannot read: {}", path, std::strerror(errno)));
    };
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), std::fclose);
    if (!file) fail();
    std::string text;
    char part[1 << 14];
    while (const std::size_t count = std::fread(part, 1, sizeof part, file.get())) text.append(part, count);
    if (std::ferror(file.get())) fail();
    return text;
}

// A file of the bench in this binary.
std::string_view embedded(const std::string& path) {
    const auto& files = bench::sources();
    return std::find_if(files.begin(), files.end(),
                        [&](const runtime::SourceFile& f) { return f.path == path; })
        ->text;
}

// The page out of the measurements, by the script in this binary.
void draw(const std::string& page, const std::string& measurements, const std::string& folder) {
    const std::string_view script = embedded("bench/report/report.py");
    // The paths go by the environment, so that no name has to be quoted.
    setenv("CLVNDF_REPORT", page.c_str(), 1);
    setenv("CLVNDF_BENCH", measurements.c_str(), 1);
    const auto before =
        std::signal(SIGPIPE, SIG_IGN);  // python3 may be missing, or end before it has read all
    std::FILE* python = popen("python3 - \"$CLVNDF_REPORT\" \"$CLVNDF_BENCH\"", "w");
    if (python) std::fwrite(script.data(), 1, script.size(), python);
    const bool drawn = python && pclose(python) == 0;
    std::signal(SIGPIPE, before);
    if (!drawn)
        throw DeviceError(
            fmt::format("--report {}: python3 with matplotlib (python3-matplotlib) could not draw it; the "
                        "measurements are in {}",
                        folder, measurements));
}

// FOLDER/bench.json and FOLDER/index.html.
class Report {
  public:
    explicit Report(const std::string& folder)
        : path_(folder),
          folder_(folder),
          measurements_(in_folder(folder, "bench.json")),
          page_(in_folder(folder, "index.html")) {}

    void write(const std::string& json) {
        measurements_.write(json);
        measurements_.commit();
        folder_.keep();
        draw(page_.temporary_path(), in_folder(path_, "bench.json"), path_);
        page_.commit();
    }

  private:
    std::string path_;
    NewFolder folder_;
    OutputFile measurements_, page_;
};

bool prints_table(const Bench& options) {
    return !is_standard_output(options.json);
}

// Where the measurements of one device go.
struct Outputs {
    std::unique_ptr<OutputFile> json;
    std::unique_ptr<Report> report;
};

// Of the devices' files the at-th one's: run.json, run-2.json, run-3.json; of their folders out, out-2, out-3.
std::string numbered(const std::string& path, std::size_t at) {
    if (path.empty() || at == 0) return path;
    std::filesystem::path name(path);
    if (!name.has_filename()) name = name.parent_path();
    const std::string extension = name.extension() == ".json" ? ".json" : "";
    if (!extension.empty()) name.replace_extension();
    return fmt::format("{}-{}{}", name.string(), at + 1, extension);
}

// Whether files beside it can be named like it.
bool is_plain_file(const std::string& path) {
    const auto status = std::filesystem::symlink_status(path);
    return !is_standard_output(path) && (!std::filesystem::exists(status) || is_regular_file(status));
}

Outputs outputs_of(const Bench& options, std::size_t at) {
    const std::string json = numbered(options.json, at), report = numbered(options.report, at);
    std::vector<NamedFile> names = {{"--json", json}};
    if (!report.empty())
        for (const char* name : {"bench.json", "index.html"})
            names.push_back({"--report", in_folder(report, name)});
    require_distinct(names, {{"--compare", options.compare}});
    Outputs outputs;
    if (!json.empty()) outputs.json = std::make_unique<OutputFile>(json);
    if (!report.empty()) outputs.report = std::make_unique<Report>(report);
    return outputs;
}

// A device at a time, since side by side they would disturb each other: all of --device all, each with a table and files of its
// own, which are opened before anything is measured.
void on_each_device(const Bench& options, Common& common,
                    const std::function<void(const runtime::Device&, Outputs&)>& run) {
    if (prints_table(options)) require_output();
    std::vector<Outputs> outputs;
    outputs.push_back(outputs_of(options, 0));
    const FreshCaches caches;
    Target target;
    target.device = options.device;
    const std::vector<runtime::Device> devices = target.choose_all(common);
    const bool several = devices.size() > 1;
    if (several) common.require_one_process("bench --device all");
    if (several && !options.json.empty() && !is_plain_file(options.json))
        throw InputError(fmt::format("--json '{}': {} devices have a file each, and this is no plain file",
                                     options.json, devices.size()));
    for (std::size_t i = 1; i < devices.size(); ++i) outputs.push_back(outputs_of(options, i));
    for (std::size_t i = 0; i < devices.size(); ++i) {
        if (several) put("{}{}\n", i == 0 ? "" : "\n", devices[i].label());
        run(devices[i], outputs[i]);
    }
}

// What --only asks for: functions, and behind a slash part of the name of a form.
struct Selection {
    std::vector<const Function*> functions;
    std::string forms;
};

Selection parse_only(const std::string& only) {
    const std::size_t slash = only.find('/');
    if (slash == std::string::npos) return {selected_by(only), {}};
    const std::string forms = only.substr(slash + 1);
    if (forms.empty())
        throw InputError(
            fmt::format("--only '{}': nothing after the slash; part of POLICY/REAL is expected there, "
                        "as in dupuy2023/strict/float",
                        only));
    return {selected_by(only.substr(0, slash)), forms};
}

// One form of a function that is to be measured.
struct Form {
    const Function* function;
    bench::Rung rung;
};

// The modes of a rung that a run is about.
std::vector<bench::Mode> wanted_modes(const Bench& options, const bench::Rung& rung) {
    std::vector<bench::Mode> modes;
    for (const bench::Mode mode : rung.modes) {
        const bool cached = mode == bench::Mode::cached || mode == bench::Mode::cached_front;
        if (options.advise ? cached : !options.quick || cached || mode == bench::Mode::stream)
            modes.push_back(mode);
    }
    return modes;
}

bool is_wanted(const Bench& options, const Function& function, const bench::Rung& rung) {
    static const std::set<std::string> advised = {"builtin", "native", "published"};
    const bool sampler = is_plain_sampler(function);
    if (options.advise)
        return sampler && function.arguments == "WO_ALPHA_U" && rung.real == Real::f32 &&
               (bench::is_quick(rung) || advised.contains(rung.name));
    // What was asked for by name is measured, quick or not.
    return !options.quick || (bench::is_quick(rung) && (sampler || !options.only.empty()));
}

// "builtin/{double,float}, cpp/float".
std::string in_words(const std::map<std::string, std::set<std::string_view>>& types_by_form) {
    std::vector<std::string> words;
    for (const auto& [form, types] : types_by_form)
        words.push_back(types.size() == 1 ? fmt::format("{}/{}", form, *types.begin())
                                          : fmt::format("{}/{{{}}}", form, fmt::join(types, ",")));
    return fmt::format("{}", fmt::join(words, ", "));
}

// What is to be measured. What others are compared with is always there.
std::vector<Form> selected_forms(const runtime::Device& device, const Selection& selection,
                                 const Bench& options) {
    std::vector<Form> selected;
    std::map<std::string, std::set<std::string_view>> all;  // types by form
    for (const Function* function : selection.functions) {
        std::vector<Form> forms;
        for (bench::Rung rung : bench::rungs(*function, device)) {
            if (!is_wanted(options, *function, rung)) continue;
            rung.modes = wanted_modes(options, rung);
            if (!rung.modes.empty()) forms.push_back({function, std::move(rung)});
        }
        const auto asked_for = [&](const Form& form) {
            return form.rung.key().find(selection.forms) != std::string::npos;
        };
        for (const Form& form : forms) all[form.rung.name].insert(to_string(form.rung.real));
        if (std::none_of(forms.begin(), forms.end(), asked_for)) continue;
        for (const Form& form : forms)
            if (asked_for(form) || form.rung.name == "published" || form.rung.name == "lean")
                selected.push_back(form);
    }
    if (selected.empty())
        throw InputError(all.empty() ? fmt::format("--only '{}': nothing that is measured here", options.only)
                                     : fmt::format("--only '{}': '{}' is part of none of {}", options.only,
                                                   selection.forms, in_words(all)));
    return selected;
}

// The modes of a rung that another function has as well: wo in front of the surface where it makes a difference.
std::vector<bench::Mode> shared_modes(const bench::Rung& rung) {
    std::vector<bench::Mode> modes = rung.modes;
    if (std::find(modes.begin(), modes.end(), bench::Mode::cached_front) != modes.end())
        std::erase(modes, bench::Mode::cached);
    return modes;
}

// A user's function beside the library's samplers of its density, or the function that it is to be.
std::vector<Form> forms_beside(const conformance::UserKernel& user, const runtime::ProgramOptions& program,
                               const runtime::Device& device) {
    static const std::set<std::string> shown = {"strict", "builtin", "native", "published", "lean"};
    const Function& own = user.function();
    std::vector<Form> forms;
    for (const Function& function : functions()) {
        const bool same = is_plain_sampler(own) && is_plain_sampler(function) && function.lobe.empty() &&
                          function.density == own.density && function.inputs == own.inputs;
        if (!same && &function != user.ours()) continue;
        for (bench::Rung rung : bench::rungs(function, device)) {
            if (rung.real != Real::f32 || !shown.contains(rung.name)) continue;
            rung.modes = shared_modes(rung);
            forms.push_back({&function, std::move(rung)});
        }
    }
    bench::Rung rung = forms.front().rung;
    rung.name = "user", rung.callee = own.name, rung.program = &program;
    rung.same_map = !own.model.empty();
    forms.insert(forms.begin(), {&own, rung});
    return forms;
}

using Batch = std::vector<Form>;

// What is measured together, so many programs or a few more: a driver may keep some megabytes of each. Each batch after the first
// has the same kernel once more, for the noise of ratios between them.
constexpr std::size_t usual_batch = 60;
std::vector<Batch> in_batches(std::vector<Form> forms, std::size_t most) {
    std::stable_sort(forms.begin(), forms.end(), [](const Form& a, const Form& b) {
        return bench::batch_of(a.rung) < bench::batch_of(b.rung);
    });
    const auto strict = std::find_if(forms.begin(), forms.end(),
                                     [](const Form& form) { return form.rung.key() == "strict/float"; });
    std::vector<Batch> batches(1);
    for (const Form& form : forms) {
        const bool other = !batches.back().empty() &&
                           bench::batch_of(form.rung) != bench::batch_of(batches.back().back().rung);
        // What is derived from a function's strict form stays beside it.
        const bool full =
            batches.back().size() >= most && form.function->plain != batches.back().back().function->plain;
        if (full || (other && forms.size() > most)) {
            batches.emplace_back();
            if (strict != forms.end())
                batches.back().push_back({strict->function, bench::again(*strict->function, batches.size())});
        }
        batches.back().push_back(form);
    }
    return batches;
}

// Of several ranks so small that each has some.
std::size_t most_of_batch(std::size_t forms, const Common& common) {
    constexpr std::size_t least = 8, batches_of_rank = 4;
    const auto ranks = static_cast<std::size_t>(common.ranks->size());
    return ranks == 1 ? usual_batch : std::clamp(forms / (batches_of_rank * ranks), least, usual_batch);
}

std::vector<std::pair<std::string, std::string>> context(const runtime::Device& d,
                                                         const std::string& build_options,
                                                         const Bench& options) {
    const auto yes_no = [](bool b) { return std::string(b ? "yes" : "no"); };
    return {{"device", d.label()},
            {"platform_version", d.platform_version},
            {"driver_version", d.driver},
            {"opencl_c_version", d.c_version},
            {"build_options", build_options},
            {"fp64", yes_no(d.fp64)},
            {"fma", yes_no(d.fma)},
            {"denormals", yes_no(d.denormals)},
            {"correctly_rounded_divide_sqrt", yes_no(d.correct_divide_sqrt)},
            {"compute_units", std::to_string(d.compute_units)},
            {"clock_mhz", std::to_string(d.clock_mhz)},
            {"memory_bytes", std::to_string(d.memory_bytes)},
            {"repetitions", std::to_string(options.repetitions)},
            {"inputs", bench::describe_inputs(options.alpha)},
            {"clvndf_version", CLVNDF_VERSION}};
}

// "940, 1189, 79"
std::string in_words(const bench::EffectCounts& counts) {
    const auto number = [](int n) { return n == 0 ? std::string("-") : std::to_string(n); };
    return fmt::format("{:>5}, {:>5}, {:>3}", number(counts.llvm), number(counts.sm_80_slots),
                       number(counts.sm_80_registers));
}

void print_effects(const std::vector<bench::EffectCost>& costs) {
    put("{:40}{:>8}{:>19}{:>10}{:>19}{:>9}\n", "", "sample,", "LLVM, sm_80 slots,", "eval_pdf,",
        "LLVM, slots,", "build,");
    put("{:40}{:>8}{:>19}{:>10}{:>19}{:>9}\n", "program", "ns", "registers", "ns", "registers", "s");
    for (const bench::EffectCost& cost : costs)
        put("{:40}{:8.2f}{:>19}{:10.2f}{:>19}{:9.2f}\n", cost.program, cost.sample_ns, in_words(cost.sample),
            cost.eval_pdf_ns, in_words(cost.eval_pdf), cost.build_s);
}

// The programs of --effects, or those with a text in their names.
std::vector<bench::EffectCost> selected_programs(const std::string& only) {
    std::vector<bench::EffectCost> programs = bench::effect_programs();
    std::erase_if(programs, [&](const bench::EffectCost& cost) {
        return cost.program.find(only) == std::string::npos;
    });
    if (programs.empty())
        throw InputError(fmt::format(
            "--only '{}': no program of --effects has it in its name; all, 'all without tint', 'conductor "
            "alone' and 'conductor and tint' are some",
            only));
    return programs;
}

// What each effect of a material costs, as a table.
void run_effects(const Bench& options, Common& common) {
    common.require_one_process("bench --effects");
    const std::vector<bench::EffectCost> programs = selected_programs(options.only);
    on_each_device(options, common, [&](const runtime::Device& device, Outputs& outputs) {
        const Progress progress(common.quiet);
        const std::vector<bench::EffectCost> costs =
            bench::effect_costs(device, programs, options.repetitions == 0 ? 15 : options.repetitions,
                                [&](double done) { progress("building and measuring", done); });
        progress.clear();
        if (prints_table(options)) print_effects(costs);
        if (!outputs.json) return;
        outputs.json->write(bench::effects_json(costs, {{"device", device.label()},
                                                        {"platform_version", device.platform_version},
                                                        {"driver_version", device.driver},
                                                        {"clvndf_version", CLVNDF_VERSION}}));
        outputs.json->commit();
    });
}

// Only the JSON holds the noise of lobes and the times of builds, which are of samplers and take a minute: where one is measured
// whose noise is known.
void add_costly(bench::Surroundings& surroundings, const std::vector<Batch>& batches,
                const runtime::Program& beside) {
    const bool noisy = std::any_of(batches.begin(), batches.end(), [](const Batch& batch) {
        return std::any_of(batch.begin(), batch.end(),
                           [](const Form& form) { return bench::has_noise(form.function->name); });
    });
    if (noisy) {
        surroundings.lobes = bench::lobe_noise();
        surroundings.builds = bench::build_times(beside);
    }
    surroundings.instructions = embedded("bench/results/instructions.json");
    surroundings.caps = embedded("bench/results/caps.json");
}

void add(bench::Session& session, const Batch& batch, const std::string& part, const Progress& progress) {
    std::size_t built = 0;
    for (const auto& [function, rung] : batch) {
        progress(fmt::format("{}building {} {}", part, function->name, rung.key()),
                 static_cast<double>(built++) / static_cast<double>(batch.size()));
        session.add(*function, rung);
    }
}

// all: with what costs seconds.
bench::Measurement measure(const Bench& options, const runtime::Device& device,
                           const bench::SessionOptions& session_options, const std::vector<Batch>& batches,
                           const std::optional<conformance::UserKernel>& user, bool all,
                           const Progress& progress) {
    bench::Measurer measurer(options.repetitions);
    bench::Surroundings surroundings;
    for (std::size_t i = 0; i < batches.size(); ++i) {
        const std::string part = batches.size() == 1 ? "" : fmt::format("{}/{}: ", i + 1, batches.size());
        bench::Session session(device, session_options);
        add(session, batches[i], part, progress);
        measurer.run(session.entries(), [&](double done) { progress(part + "measuring", done); });
        if (i > 0) continue;
        surroundings.context = context(device, session.build_options(), options);
        if (user) {
            // Beside a user's function what costs seconds says nothing.
            surroundings.context.push_back({"kernel", options.user.file});
            surroundings.context.push_back({"kernel_options", options.user.options});
        } else if (all) {
            progress("noise and builds", 0);
            add_costly(surroundings, batches, session.program());
        }
    }
    return measurer.finish(surroundings);
}

// Batch by batch, each on one rank. Throws InputError where ranks share a host, whose processor all of them measure or use.
bench::Measurement measure_by_ranks(const Bench& options, Common& common, const runtime::Device& device,
                                    const bench::SessionOptions& session_options,
                                    const std::vector<Batch>& batches, bool all) {
    if (common.ranks->neighbours() > 1)
        throw InputError(fmt::format(
            "clvndf bench on {} ranks of one host: they would disturb each other; one a host is allowed, as "
            "by mpirun --map-by ppr:1:node",
            common.ranks->neighbours()));
    const Progress quiet(true);
    const auto hire = [&](const runtime::Device& mine) -> runtime::Team::Work {
        return [&](const std::string& task) {
            bench::Session session(mine, session_options);
            add(session, batches.at(std::stoull(task)), "", quiet);
            bench::Measurer measurer(options.repetitions);
            measurer.run(session.entries(), [](double) {});
            return session.build_options() + '\0' + bench::packed(measurer.finish({}));
        };
    };
    runtime::Team team(
        *common.ranks, {device}, hire,
        team_options(fmt::format("bench --only '{}' --repetitions {}{}{} of {} batches", options.only,
                                 options.repetitions, options.quick ? " --quick" : "",
                                 options.advise ? " --advise" : "", batches.size())));
    if (!common.leads()) {
        team.serve();
        return {};
    }
    const Progress progress(common.quiet);
    std::vector<bench::Measurement> parts;
    bench::Surroundings surroundings;
    runtime::Team::Plan plan;
    plan.tasks = batches.size();
    plan.take = [&](std::size_t i, const std::string& measured) {
        const std::size_t end = measured.find('\0');
        if (i == 0) surroundings.context = context(device, measured.substr(0, end), options);
        parts.push_back(bench::unpacked(measured.substr(end + 1)));
    };
    plan.proceed = [&](std::size_t taken) {
        progress(team.describe(), static_cast<double>(taken) / static_cast<double>(batches.size()));
        return true;
    };
    team.run(plan);
    if (all) add_costly(surroundings, batches, bench::Session(device, session_options).program());
    return bench::merged(parts, surroundings);
}

void bench_device(const Bench& options, Common& common, const Selection& selection,
                  const std::optional<conformance::UserKernel>& user,
                  const std::vector<bench::Result>& baseline, const runtime::Device& device,
                  Outputs& outputs) {
    const Progress progress(common.quiet);
    const bool whole = !options.quick && !options.advise;
    bench::SessionOptions session_options;
    session_options.alpha = options.alpha;
    session_options.warm_builds = whole;
    if (!whole) session_options.judged_rows /= 4;
    runtime::ProgramOptions program;
    if (user) {
        user->evaluator(device);  // says what does not compile, and where
        program = user->program();
    }
    const std::vector<Form> forms =
        user ? forms_beside(*user, program, device) : selected_forms(device, selection, options);
    const std::vector<Batch> batches = in_batches(forms, most_of_batch(forms.size(), common));
    const bool all = outputs.json || outputs.report;
    const bench::Measurement measurement =
        common.ranks->size() > 1 ? measure_by_ranks(options, common, device, session_options, batches, all)
                                 : measure(options, device, session_options, batches, user, all, progress);
    progress.clear();
    if (!common.leads()) return;
    if (outputs.json) outputs.json->write(measurement.json), outputs.json->commit();
    const bench::Demand demand{options.error, options.front ? Domain::upper : Domain::sphere};
    const bool table = prints_table(options);
    if (table && options.advise)
        print_advice(bench::advise(measurement.results, demand), demand, measurement.spread);
    if (table && !options.advise) print_measurement(measurement);
    if (table && user) print_beside(measurement, user->function().name);
    if (table && !baseline.empty())
        print_comparison(measurement.results, baseline, measurement.spread, options.compare);
    if (outputs.report) outputs.report->write(measurement.json);
}

void run_bench(Bench options, Common& common) {
    if (!common.leads()) options.json.clear(), options.report.clear(), options.compare.clear();
    if (options.repetitions == 0) options.repetitions = options.quick || options.advise ? 9 : 15;
    const Selection selection = parse_only(options.only);
    std::optional<conformance::UserKernel> user;
    if (!options.user.file.empty()) common.require_one_process("bench --kernel"), user.emplace(options.user);
    if (user && !user->ours())
        throw InputError(
            fmt::format("--as {}: clvndf bench times a sampler, a density or a term; name what it is to be",
                        options.user.as));
    std::vector<bench::Result> baseline;
    if (!options.compare.empty()) baseline = bench::read_results(read_file(options.compare), options.compare);
    on_each_device(options, common, [&](const runtime::Device& device, Outputs& outputs) {
        bench_device(options, common, selection, user, baseline, device, outputs);
    });
}

}  // namespace

void add_bench(CLI::App& app, Common& common) {
    const auto options = std::make_shared<Bench>();
    CLI::App* command = app.add_subcommand(
        "bench",
        "time of every function in every policy, beside the published listings, C++ and plain copies");
    add_device(*command, options->device, "are measured one after another");
    command->add_option(
        "--only", options->only,
        "only functions whose name contains this, or matches it with * and ?; after a slash, only "
        "forms\nand types that contain what follows: dupuy2023/strict/float; of --effects only programs "
        "whose "
        "name\ncontains this");
    add_number(*command, "--repetitions", options->repetitions, 3, 1000, "how often each entry is measured")
        ->default_str("15, quick 9");
    CLI::Option* quick = command->add_flag("--quick", options->quick,
                                           "a minute: samplers in strict float beside their lean forms");
    CLI::Option* advise =
        command->add_flag("--advise", options->advise, "name the cheapest sampler and form within --error");
    CLI::Option* error = add_number(*command, "--error", options->error, 0.1, 1e9,
                                    "largest error allowed: an angle in units of 2^-24");
    advise->needs(error)->excludes(quick);
    error->needs(advise);
    command
        ->add_option_function<std::string>(
            "--domain", [options](const std::string& domain) { options->front = domain == "front"; },
            "where wo lies: above the surface, or anywhere (default)")
        ->check(CLI::IsMember({"front", "sphere"}))
        ->needs(advise);
    add_alpha(*command, options->alpha, "range of roughness that is measured (default 0.001:1)");
    CLI::Option* effects = command
                               ->add_flag("--effects", options->effects,
                                          "what each effect of a material costs, and nothing else: "
                                          "nanoseconds, and what was counted of\n"
                                          "LLVM's instructions and of slots and registers on sm_80")
                               ->excludes(quick)
                               ->excludes(advise);
    command->add_option("--json", options->json,
                        "write Google Benchmark's JSON, of --effects its table (- for standard output)");
    command
        ->add_option("--report", options->report,
                     "make FOLDER/index.html, a page with plots, beside FOLDER/bench.json")
        ->type_name("FOLDER")
        ->excludes(effects);
    add_kernel(*command, options->user,
               "time a function of this file of OpenCL C beside the library's, as clvndf check judges it",
               "what it is to be, as for clvndf check", "its name there")
        ->excludes(quick)
        ->excludes(advise)
        ->excludes(effects)
        ->excludes(command->get_option("--only"))
        ->excludes(command->get_option("--report"));
    command->add_option("--compare", options->compare, "show times relative to those of this JSON file")
        ->excludes(effects);
    command->callback([options, &common] {
        common.action = [options, &common] {
            options->effects ? run_effects(*options, common) : run_bench(*options, common);
        };
    });
}

}  // namespace vndf::cli
