// clvndf bench
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <memory>
#include <optional>

#include <fmt/format.h>

#include "bench/measure.h"
#include "bench/session.h"
#include "cli/commands.h"
#include "cli/output_file.h"
#include "cli/progress.h"
#include "conformance/runs/check.h"
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
        std::string name = (std::filesystem::temp_directory_path() / "clvndf-bench-XXXXXX").string();
        if (!mkdtemp(name.data()))
            throw InputError(fmt::format("{}: cannot create a temporary folder", name));
        folder_ = name;
        for (const char* variable :
             {"POCL_CACHE_DIR", "CUDA_CACHE_PATH", "MESA_SHADER_CACHE_DIR", "NEO_CACHE_DIR"})
            setenv(variable, folder_.c_str(), 1);
    }
    ~FreshCaches() {
        std::error_code ignored;
        std::filesystem::remove_all(folder_, ignored);
    }
    FreshCaches(const FreshCaches&) = delete;
    FreshCaches& operator=(const FreshCaches&) = delete;

  private:
    std::filesystem::path folder_;
};

std::string read_file(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(file), {}};
    if (!file) throw InputError(fmt::format("{}: cannot read", path));
    return text;
}

// FOLDER/index.html out of FOLDER/bench.json, by the script in this binary.
void make_report(const std::string& folder) {
    const auto& files = bench::sources();
    const auto script = std::find_if(
        files.begin(), files.end(), [](const runtime::SourceFile& f) { return f.path == "bench/report/report.py"; });
    const std::filesystem::path work(folder);
    const auto path = [&](const char* name) { return (work / name).string(); };
    // The paths go by the environment, so that no name has to be quoted.
    setenv("CLVNDF_REPORT", path("index.html").c_str(), 1);
    setenv("CLVNDF_BENCH", path("bench.json").c_str(), 1);
    std::FILE* python = popen("python3 - \"$CLVNDF_REPORT\" \"$CLVNDF_BENCH\"", "w");
    if (python) std::fwrite(script->text.data(), 1, script->text.size(), python);
    if (!python || pclose(python) != 0)
        throw DeviceError(
            fmt::format("--report {}: python3 with matplotlib (python3-matplotlib) could not draw it; the "
                        "measurements are in {}",
                        folder, path("bench.json")));
}

// `forms`: part of POLICY/REAL that an entry must contain. What others are compared with is always there.
void add_entries(bench::Session& session, const runtime::Device& device, const Function& function,
                 const std::string& forms) {
    const auto wanted = [&](const std::string& form) { return form.find(forms) != std::string::npos; };
    for (const Real real : {Real::f32, Real::f64}) {
        if (real == Real::f64 && !device.fp64) continue;
        for (const Math math : {Math::strict, Math::builtin, Math::native}) {
            if (real == Real::f64 && math == Math::native) continue;  // native means float
            if (wanted(fmt::format("{}/{}", to_string(math), to_string(real))))
                session.add(function, math, real);
        }
    }
    if (wanted("steps/float")) session.add_steps(function);
    session.add_published(function);
    if (wanted("basis/float")) session.add_basis(function);
    if (wanted("cpp/float")) session.add_cpp(function);
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
    fmt::print("{:{}} {:>9} {:>9} {:>9} {:>7} {:>9} {:>8} {:>8} {:>8}{}\n", "entry", width, "best ns",
               "median", "useful", "of copy", "published", "err p50", "err p99", "err max",
               before.empty() ? "" : "  baseline");
    for (const bench::Result& r : results) {
        fmt::print("{:{}} {:9.3f} {:9.3f} {:>9} {:>7} {:>9} {:>8} {:>8} {:>8}", r.name, width, r.best_ns,
                   r.median_ns, cell(r.counters, "ns_per_useful_sample", "{:.3f}"),
                   cell(r.counters, "fraction_of_copy", "{:.2f}"),
                   cell(r.counters, "speedup_over_published", "{:.1f} x"),
                   cell(r.counters, "err_p50", "{:.2g}"), cell(r.counters, "err_p99", "{:.2g}"),
                   cell(r.counters, "err_max", "{:.2g}"));
        if (before.contains(r.name)) fmt::print("  {:.2f} x", r.best_ns / before[r.name]);
        fmt::print("\n");
    }
    fmt::print(
        "Nanoseconds a sample, wall clock, best and median of the repetitions, all entries interleaved. of "
        "copy: time of "
        "the fastest plain copy of as many bytes over this time; published: time of the published listing "
        "ported line by "
        "line over this time; err: in 2^-24 (double: 2^-53) times 1 + condition number.\n");
    if (!before.empty()) fmt::print("baseline: this time over the baseline's.\n");
}

void run_bench(const Bench& options, Common& common) {
    const std::size_t slash = std::min(options.only.find('/'), options.only.size());
    const auto selected = conformance::select(options.only.substr(0, slash));
    const std::string forms = options.only.substr(std::min(slash + 1, options.only.size()));
    if (selected.empty())
        throw InputError(
            fmt::format("--only '{}': no function of that name; the nearest are {} (see clvndf list)",
                        options.only, fmt::join(nearest_names(options.only), ", ")));
    std::vector<bench::Result> baseline;
    if (!options.compare.empty()) baseline = bench::read_results(read_file(options.compare), options.compare);
    std::optional<OutputFile> json;
    if (!options.json.empty()) json.emplace(options.json);
    std::optional<OutputFile> report;
    if (!options.report.empty()) {
        std::error_code failure;
        std::filesystem::create_directories(options.report, failure);
        if (failure) throw InputError(fmt::format("--report {}: {}", options.report, failure.message()));
        report.emplace(options.report + "/bench.json");
    }

    const FreshCaches caches;
    Target target;
    target.device = options.device;
    const runtime::Device device = target.choose(common);
    const Progress progress(common.quiet);
    bench::Session session(device);
    for (std::size_t i = 0; i < selected.size(); ++i) {
        progress("building " + selected[i]->name,
                 static_cast<double>(i) / static_cast<double>(selected.size()));
        add_entries(session, device, *selected[i], forms);
    }
    // Only the JSON holds the noise, which takes seconds.
    const bool written = json || report;
    const bench::Measurement measurement =
        bench::measure(session.entries(), options.repetitions, context(device, session, options),
                       written ? bench::lobe_noise() : std::vector<bench::LobeNoise>(),
                       [&](double done) { progress("measuring", done); });
    progress.clear();
    if (json) json->write(measurement.json), json->commit();
    if (options.json != "-") print_table(measurement.results, baseline);
    if (report) report->write(measurement.json), report->commit(), make_report(options.report);
}

}  // namespace

void add_bench(CLI::App& app, Common& common) {
    const auto options = std::make_shared<Bench>();
    CLI::App* command = app.add_subcommand(
        "bench",
        "time of every function in every policy, beside the published listings, C++ and plain copies");
    command->add_option("--device", options->device,
                        "first device whose platform or device name contains this");
    command->add_option(
        "--only", options->only,
        "only functions whose name contains this, or matches it with * and ?; after a slash, only "
        "policies\nand types that contain what follows: dupuy2023/strict/float");
    command->add_option("--repetitions", options->repetitions, "how often each entry is measured")
        ->check(CLI::Range(3, 1000))
        ->capture_default_str();
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
