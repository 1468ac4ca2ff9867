#include "measure.h"

#include <algorithm>
#include <optional>
#include <sstream>

#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "error.h"

namespace vndf::bench {
namespace {

using Run = benchmark::BenchmarkReporter::Run;

double best(const std::vector<double>& values) {
    return *std::min_element(values.begin(), values.end());
}

// Keeps all runs, for the ratios between entries that only the end of the measurement knows.
class Collector final : public benchmark::BenchmarkReporter {
  public:
    bool ReportContext(const Context& context) override {
        context_.emplace(context);
        return true;
    }
    void ReportRuns(const std::vector<Run>& runs) override {
        runs_.insert(runs_.end(), runs.begin(), runs.end());
    }

    std::vector<Run>& runs() { return runs_; }
    std::string json() {
        std::ostringstream text;
        benchmark::JSONReporter reporter;
        reporter.SetOutputStream(&text);
        reporter.SetErrorStream(&text);
        reporter.ReportContext(*context_);
        reporter.ReportRuns(runs_);
        reporter.Finalize();
        return text.str();
    }

  private:
    std::optional<Context> context_;
    std::vector<Run> runs_;
};

void register_entry(const Entry& entry, int repetitions, const std::function<void()>& step) {
    benchmark::RegisterBenchmark(
        entry.name.c_str(),
        [&entry, step](benchmark::State& state) {
            // Others had their turns since the last one: code is to be loaded again, by PoCL too.
            entry.warm();
            double wall_s = 0, event_s = 0;
            for (auto _ : state) {
                const Timing timing = entry.launch();
                state.SetIterationTime(timing.wall_s);
                wall_s += timing.wall_s;
                event_s += timing.event_s;
            }
            const double ns_per_s = 1e9 / (entry.samples * static_cast<double>(state.iterations()));
            state.counters["ns_per_sample"] = wall_s * ns_per_s;
            state.counters["ns_per_useful_sample"] = wall_s * ns_per_s / entry.useful;
            if (event_s > 0) state.counters["event_ns_per_sample"] = event_s * ns_per_s;
            state.counters["samples"] = entry.samples;
            for (const auto& [name, value] : entry.figures) state.counters[name] = value;
            if (!entry.label.empty()) state.SetLabel(entry.label);
            step();
        })
        ->UseManualTime()
        ->MeasureProcessCPUTime()
        ->Iterations(1)
        ->Repetitions(repetitions)
        ->Unit(benchmark::kMillisecond)
        ->ComputeStatistics("best", best);
}

// "FUNCTION/strict/float/stream" out of the name that Google Benchmark makes of it.
std::string entry_name(const Run& run) {
    return run.run_name.function_name;
}

void set_name(Run& run) {
    // The loop's settings are the same for all entries and no part of their names.
    run.run_name.iterations.clear();
    run.run_name.repetitions.clear();
    run.run_name.time_type.clear();
}

// Google Benchmark's JSON with one more member, which its tools pass over.
std::string with_lobes(const std::string& json, const std::vector<LobeNoise>& lobes) {
    auto data = nlohmann::ordered_json::parse(json);
    data["lobes"] = nlohmann::ordered_json::array();
    for (const LobeNoise& l : lobes)
        data["lobes"].push_back({{"sampler", l.sampler},
                                 {"alpha_x", l.alpha_x},
                                 {"alpha_y", l.alpha_y},
                                 {"cos_theta", l.cos_theta},
                                 {"rejected", l.rejected},
                                 {"mean", l.mean},
                                 {"variance", l.variance},
                                 {"smooth_mean", l.smooth_mean},
                                 {"smooth_variance", l.smooth_variance},
                                 {"sobol_rmse", l.sobol_rmse},
                                 {"smooth_sobol_rmse", l.smooth_sobol_rmse}});
    return data.dump(1) + "\n";
}

}  // namespace

Measurement measure(const std::vector<Entry>& entries, int repetitions,
                    const std::vector<std::pair<std::string, std::string>>& context,
                    const std::vector<LobeNoise>& lobes, const std::function<void(double done)>& progress) {
    // The filter and the list, lest variables of the environment leave entries out.
    std::vector<std::string> arguments = {"clvndf", "--benchmark_enable_random_interleaving=true",
                                          "--benchmark_filter=all", "--benchmark_list_tests=false"};
    std::vector<char*> argv;
    for (std::string& argument : arguments) argv.push_back(argument.data());
    int argc = static_cast<int>(argv.size());
    benchmark::Initialize(&argc, argv.data());
    for (const auto& [key, value] : context) benchmark::AddCustomContext(key, value);

    double done = 0;
    const double total = static_cast<double>(entries.size()) * repetitions;
    for (const Entry& entry : entries)
        register_entry(entry, repetitions, [&] { progress(std::min(1.0, ++done / total)); });
    Collector collector;
    benchmark::RunSpecifiedBenchmarks(&collector);

    std::map<std::string, const Entry*> by_name;
    for (const Entry& entry : entries) by_name[entry.name] = &entry;
    std::map<std::string, double> best_ns, median_ns;
    for (const Run& run : collector.runs()) {
        const double ns = run.counters.at("ns_per_sample").value;
        if (run.aggregate_name == "best") best_ns[entry_name(run)] = ns;
        if (run.aggregate_name == "median") median_ns[entry_name(run)] = ns;
    }
    const auto ratio = [&](const std::string& of, const std::string& to) -> std::optional<double> {
        if (of.empty() || !best_ns.contains(of)) return std::nullopt;
        return best_ns[of] / best_ns[to];
    };
    Measurement measurement;
    for (const Entry& entry : entries) {
        Result& result = measurement.results.emplace_back();
        result.name = entry.name;
        result.best_ns = best_ns[entry.name];
        result.median_ns = median_ns[entry.name];
        result.counters = entry.figures;
        result.counters["ns_per_sample"] = result.best_ns;
        result.counters["ns_per_useful_sample"] = result.best_ns / entry.useful;
        if (const auto fraction = ratio(entry.copy, entry.name))
            result.counters["fraction_of_copy"] = *fraction;
        if (const auto peak = ratio(entry.arithmetic, entry.name))
            result.counters["fraction_of_arithmetic"] = *peak * entry.figures.at("operations");
        if (const auto speedup = ratio(entry.published, entry.name))
            result.counters["speedup_over_published"] = *speedup;
    }
    // The figures that do not vary are what they are in every aggregate, whose own name would make them its own.
    for (Run& run : collector.runs()) {
        const Entry& entry = *by_name.at(entry_name(run));
        const auto& result = measurement.results[static_cast<std::size_t>(&entry - entries.data())];
        set_name(run);
        for (const auto& [name, value] : result.counters)
            if (!name.starts_with("ns_per")) run.counters[name] = value;
        run.counters["samples"] = entry.samples;
    }
    measurement.json = with_lobes(collector.json(), lobes);
    return measurement;
}

std::vector<Result> read_results(const std::string& json, const std::string& path) {
    const auto fail = [&](const std::string& why) { throw InputError(fmt::format("{}: {}", path, why)); };
    std::vector<Result> results;
    try {
        const auto data = nlohmann::json::parse(json);
        for (const auto& entry : data.at("benchmarks")) {
            if (entry.value("aggregate_name", "") != "best") continue;
            Result& result = results.emplace_back();
            result.name = entry.at("run_name");
            result.best_ns = entry.at("ns_per_sample");
        }
    } catch (const nlohmann::json::exception& error) {
        fail(fmt::format("not the JSON of clvndf bench: {}", error.what()));
    }
    if (results.empty()) fail("not the JSON of clvndf bench: no aggregate 'best'");
    return results;
}

}  // namespace vndf::bench
