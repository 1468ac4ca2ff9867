// clvndf bench
#include <algorithm>
#include <cerrno>
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

#include "bench/measure.h"
#include "bench/session.h"
#include "cli/commands.h"
#include "cli/leftovers.h"
#include "cli/options.h"
#include "cli/output_file.h"
#include "cli/progress.h"
#include "conformance/runs/check.h"
#include "cli/streams.h"
#include "error.h"
#include "bench/sources.h"

namespace vndf::cli {
namespace {

using runtime::Math, runtime::Real;

struct Bench {
    std::string device, only, json, report, compare;
    int repetitions = 15;
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

std::string in_folder(const std::string& folder, const char* name) {
    return (std::filesystem::path(folder) / name).string();
}

// The page out of the measurements, by the script in this binary.
void draw(const std::string& page, const std::string& measurements, const std::string& folder) {
    const auto& files = bench::sources();
    const auto script = std::find_if(files.begin(), files.end(), [](const runtime::SourceFile& f) {
        return f.path == "bench/report/report.py";
    });
    // The paths go by the environment, so that no name has to be quoted.
    setenv("CLVNDF_REPORT", page.c_str(), 1);
    setenv("CLVNDF_BENCH", measurements.c_str(), 1);
    const auto before =
        std::signal(SIGPIPE, SIG_IGN);  // python3 may be missing, or end before it has read all
    std::FILE* python = popen("python3 - \"$CLVNDF_REPORT\" \"$CLVNDF_BENCH\"", "w");
    if (python) std::fwrite(script->text.data(), 1, script->text.size(), python);
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

// One way to compute a function, with what adds its entries to the session.
struct Form {
    std::string name;  // POLICY/REAL
    std::function<void()> add;
};

std::vector<Form> forms_of(bench::Session& session, const runtime::Device& device, const Function& function) {
    std::vector<Form> forms;
    for (const Real real : {Real::f32, Real::f64}) {
        if (real == Real::f64 && !device.fp64) continue;
        for (const Math math : {Math::strict, Math::builtin, Math::native}) {
            if (real == Real::f64 && math == Math::native) continue;  // native means float
            forms.push_back({fmt::format("{}/{}", to_string(math), to_string(real)),
                             [&session, &function, math, real] { session.add(function, math, real); }});
        }
    }
    if (bench::has_steps(function)) forms.push_back({"steps/float", [&] { session.add_steps(function); }});
    if (bench::is_published(function))
        forms.push_back({"published/float", [&] { session.add_published(function); }});
    if (bench::has_basis(function)) forms.push_back({"basis/float", [&] { session.add_basis(function); }});
    forms.push_back({"cpp/float", [&] { session.add_cpp(function); }});
    return forms;
}

// What is to be measured. The published form, with which others are compared, is always there.
std::vector<Form> selected_forms(bench::Session& session, const runtime::Device& device,
                                 const Selection& selection, const std::string& only) {
    std::vector<Form> selected;
    std::set<std::string> all;
    for (const Function* function : selection.functions) {
        const std::vector<Form> forms = forms_of(session, device, *function);
        const auto wanted = [&](const Form& form) {
            return form.name.find(selection.forms) != std::string::npos;
        };
        for (const Form& form : forms) all.insert(form.name);
        if (std::none_of(forms.begin(), forms.end(), wanted)) continue;
        for (const Form& form : forms)
            if (wanted(form) || form.name == "published/float")
                selected.push_back({function->name + " " + form.name, form.add});
    }
    if (selected.empty())
        throw InputError(fmt::format("--only '{}': '{}' is part of none of {}", only, selection.forms,
                                     fmt::join(all, ", ")));
    return selected;
}

std::vector<std::pair<std::string, std::string>> context(const runtime::Device& d,
                                                         const bench::Session& session,
                                                         const Bench& options) {
    const auto yes_no = [](bool b) { return std::string(b ? "yes" : "no"); };
    return {{"device", d.label()},
            {"platform_version", d.platform_version},
            {"driver_version", d.driver},
            {"opencl_c_version", d.c_version},
            {"build_options", session.build_options()},
            {"fp64", yes_no(d.fp64)},
            {"fma", yes_no(d.fma)},
            {"denormals", yes_no(d.denormals)},
            {"correctly_rounded_divide_sqrt", yes_no(d.correct_divide_sqrt)},
            {"compute_units", std::to_string(d.compute_units)},
            {"clock_mhz", std::to_string(d.clock_mhz)},
            {"memory_bytes", std::to_string(d.memory_bytes)},
            {"repetitions", std::to_string(options.repetitions)},
            {"clvndf_version", CLVNDF_VERSION}};
}

std::string cell(const std::map<std::string, double>& counters, const std::string& name, const char* form) {
    const auto found = counters.find(name);
    return found == counters.end() ? "" : fmt::format(fmt::runtime(form), found->second);
}

void print_table(const std::vector<bench::Result>& results, const std::vector<bench::Result>& baseline) {
    std::size_t width = 5;
    for (const bench::Result& r : results) width = std::max(width, r.name.size());
    std::map<std::string, double> before;
    for (const bench::Result& r : baseline) before[r.name] = r.best_ns;
    put("{:{}} {:>9} {:>9} {:>9} {:>7} {:>9} {:>8} {:>8} {:>8}{}\n", "entry", width, "best ns", "median",
        "useful", "of copy", "published", "err p50", "err p99", "err max",
        before.empty() ? "" : "  baseline");
    for (const bench::Result& r : results) {
        put("{:{}} {:9.3f} {:9.3f} {:>9} {:>7} {:>9} {:>8} {:>8} {:>8}", r.name, width, r.best_ns,
            r.median_ns, cell(r.counters, "ns_per_useful_sample", "{:.3f}"),
            cell(r.counters, "fraction_of_copy", "{:.2f}"),
            cell(r.counters, "speedup_over_published", "{:.1f} x"), cell(r.counters, "err_p50", "{:.2g}"),
            cell(r.counters, "err_p99", "{:.2g}"), cell(r.counters, "err_max", "{:.2g}"));
        if (before.contains(r.name)) put("  {:.2f} x", r.best_ns / before[r.name]);
        put("\n");
    }
    put("Nanoseconds a sample, wall clock, best and median of the repetitions, all entries interleaved. of "
        "copy: time of "
        "the fastest plain copy of as many bytes over this time; published: time of the published listing "
        "ported line by "
        "line over this time; err: in 2^-24 (double: 2^-53) times 1 + condition number.\n");
    if (!before.empty()) put("baseline: this time over the baseline's.\n");
}

void run_bench(const Bench& options, Common& common) {
    const Selection selection = parse_only(options.only);
    std::vector<NamedFile> outputs = {{"--json", options.json}};
    if (!options.report.empty())
        for (const char* name : {"bench.json", "index.html"})
            outputs.push_back({"--report", in_folder(options.report, name)});
    require_distinct(outputs, {{"--compare", options.compare}});
    std::vector<bench::Result> baseline;
    if (!options.compare.empty()) baseline = bench::read_results(read_file(options.compare), options.compare);
    const bool table = !is_standard_output(options.json);
    if (table) require_output();
    std::optional<OutputFile> json;
    if (!options.json.empty()) json.emplace(options.json);
    std::optional<Report> report;
    if (!options.report.empty()) report.emplace(options.report);

    const FreshCaches caches;
    Target target;
    target.device = options.device;
    const runtime::Device device = target.choose(common);
    const Progress progress(common.quiet);
    bench::Session session(device);
    const std::vector<Form> forms = selected_forms(session, device, selection, options.only);
    for (std::size_t i = 0; i < forms.size(); ++i) {
        progress("building " + forms[i].name, static_cast<double>(i) / static_cast<double>(forms.size()));
        forms[i].add();
    }
    // Only the JSON holds the noise, which takes seconds.
    const bool written = json || report;
    const bench::Measurement measurement =
        bench::measure(session.entries(), options.repetitions, context(device, session, options),
                       written ? bench::lobe_noise() : std::vector<bench::LobeNoise>(),
                       [&](double done) { progress("measuring", done); });
    progress.clear();
    if (json) json->write(measurement.json), json->commit();
    if (table) print_table(measurement.results, baseline);
    if (report) report->write(measurement.json);
}

}  // namespace

void add_bench(CLI::App& app, Common& common) {
    const auto options = std::make_shared<Bench>();
    CLI::App* command = app.add_subcommand(
        "bench",
        "time of every function in every policy, beside the published listings, C++ and plain copies");
    add_device(*command, options->device);
    command->add_option(
        "--only", options->only,
        "only functions whose name contains this, or matches it with * and ?; after a slash, only "
        "policies\nand types that contain what follows: dupuy2023/strict/float");
    add_number(*command, "--repetitions", options->repetitions, 3, 1000, "how often each entry is measured")
        ->default_str("15");
    command->add_option("--json", options->json, "write Google Benchmark's JSON (- for standard output)");
    command
        ->add_option("--report", options->report,
                     "make FOLDER/index.html, a page with plots, beside FOLDER/bench.json")
        ->type_name("FOLDER");
    command->add_option("--compare", options->compare, "show times relative to those of this JSON file");
    command->callback(
        [options, &common] { common.action = [options, &common] { run_bench(*options, common); }; });
}

}  // namespace vndf::cli
