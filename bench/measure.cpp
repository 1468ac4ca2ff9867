#include "measure.h"

#include <algorithm>
#include <optional>
#include <set>
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
        if (!context_) context_.emplace(context);
        return true;
    }
    void ReportRuns(const std::vector<Run>& runs) override {
        runs_.insert(runs_.end(), runs.begin(), runs.end());
    }

    void append(const Collector& other) {
        if (!context_) context_.emplace(*other.context_);
        runs_.insert(runs_.end(), other.runs_.begin(), other.runs_.end());
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
std::string name_of(const Run& run) {
    return run.run_name.function_name;
}

void set_name(Run& run) {
    // The loop's settings are the same for all entries and no part of their names.
    run.run_name.iterations.clear();
    run.run_name.repetitions.clear();
    run.run_name.time_type.clear();
}

// Google Benchmark's JSON with more members, which its tools pass over. `price` is null for what has no lean form.
std::string with_surroundings(const std::string& json, const Surroundings& surroundings,
                              const std::map<std::string, double>& spread) {
    auto data = nlohmann::ordered_json::parse(json);
    // Not by AddCustomContext, which keeps the first of several devices for all.
    for (const auto& [key, value] : surroundings.context) data["context"][key] = value;
    for (auto& entry : data["benchmarks"])
        if (entry["run_name"].get<std::string>().starts_with("vndf_") && !entry.contains("price"))
            entry["price"] = nullptr;
    data["spread"] = spread;
    data["lobes"] = nlohmann::ordered_json::array();
    for (const LobeNoise& l : surroundings.lobes)
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
    data["builds"] = nlohmann::ordered_json::array();
    for (const BuildTime& b : surroundings.builds)
        data["builds"].push_back({{"program", b.program},
                                  {"cold_s", b.cold_s},
                                  {"warm_s", b.warm_s},
                                  {"source_bytes", b.source_bytes},
                                  {"binary_bytes", b.binary_bytes}});
    data["instructions"] = nlohmann::ordered_json::parse(surroundings.instructions);
    data["caps"] = nlohmann::ordered_json::parse(surroundings.caps);
    return data.dump(1) + "\n";
}

// How far the ratios of the pairs A/A, .../strict_again/... over .../strict/..., are from 1.
std::map<std::string, double> spread_of(const std::map<std::string, double>& best_ns) {
    std::map<std::string, double> spread;
    for (const auto& [name, ns] : best_ns) {
        const std::size_t at = name.find("_again");
        if (at == name.npos) continue;
        const auto first = best_ns.find(name.substr(0, at) + name.substr(name.find('/', at)));
        if (first == best_ns.end()) continue;
        double& largest = spread[split(name).mode];
        largest = std::max(largest, std::max(ns, first->second) / std::min(ns, first->second) - 1);
    }
    return spread;
}

}  // namespace

class Measurer::State {
  public:
    Collector collector;
    std::vector<Entry> entries;  // without what launches them
    std::set<std::string> names;
};

Measurer::Measurer(int repetitions) : repetitions_(repetitions), state_(std::make_unique<State>()) {
    // The filter and the list, lest variables of the environment leave entries out. Google Benchmark keeps a pointer to the
    // first.
    static std::vector<std::string> arguments;
    arguments = {"clvndf", "--benchmark_enable_random_interleaving=true", "--benchmark_filter=all",
                 "--benchmark_list_tests=false"};
    std::vector<char*> argv;
    for (std::string& argument : arguments) argv.push_back(argument.data());
    int argc = static_cast<int>(argv.size());
    benchmark::Initialize(&argc, argv.data());
}

Measurer::~Measurer() = default;

void Measurer::run(const std::vector<Entry>& entries, const std::function<void(double done)>& progress) {
    double done = 0;
    const double total = static_cast<double>(entries.size()) * repetitions_;
    benchmark::ClearRegisteredBenchmarks();
    for (const Entry& entry : entries)
        register_entry(entry, repetitions_, [&] { progress(std::min(1.0, ++done / total)); });
    Collector batch;
    benchmark::RunSpecifiedBenchmarks(&batch);
    benchmark::ClearRegisteredBenchmarks();

    std::erase_if(batch.runs(), [&](const Run& run) { return state_->names.contains(name_of(run)); });
    state_->collector.append(batch);
    for (const Entry& entry : entries) {
        if (!state_->names.insert(entry.name).second) continue;
        Entry kept = entry;
        kept.launch = nullptr, kept.warm = nullptr;
        state_->entries.push_back(std::move(kept));
    }
}

Measurement Measurer::finish(const Surroundings& surroundings) {
    std::map<std::string, double> best_ns, median_ns;
    for (const Run& run : state_->collector.runs()) {
        const double ns = run.counters.at("ns_per_sample").value;
        if (run.aggregate_name == "best") best_ns[name_of(run)] = ns;
        if (run.aggregate_name == "median") median_ns[name_of(run)] = ns;
    }
    Measurement measurement;
    measurement.spread = spread_of(best_ns);
    std::map<std::string, const Entry*> by_name;
    std::map<std::string, const Result*> results;
    measurement.results.reserve(state_->entries.size());
    for (const Entry& entry : state_->entries) {
        Result& result = measurement.results.emplace_back();
        result.name = entry.name;
        result.best_ns = best_ns[entry.name];
        result.median_ns = median_ns[entry.name];
        result.counters = entry.figures;
        result.counters["ns_per_sample"] = result.best_ns;
        result.counters["ns_per_useful_sample"] = result.best_ns / entry.useful;
        // The time of another entry over this one's.
        const auto over = [&](const std::string& other) -> std::optional<double> {
            if (!best_ns.contains(other)) return std::nullopt;
            return best_ns[other] / result.best_ns;
        };
        if (const auto fraction = over(entry.copy)) result.counters["fraction_of_copy"] = *fraction;
        if (const auto peak = over(entry.arithmetic))
            result.counters["fraction_of_arithmetic"] = *peak * entry.figures.at("operations");
        if (const auto speedup = over(entry.published)) result.counters["speedup_over_published"] = *speedup;
        if (const auto lean = over(entry.lean)) result.counters["price"] = 1 / *lean;
        by_name[entry.name] = &entry;
        results[entry.name] = &result;
    }
    // The figures that do not vary are what they are in every aggregate, whose own name would make them its own.
    for (Run& run : state_->collector.runs()) {
        const std::string name = name_of(run);
        set_name(run);
        for (const auto& [counter, value] : results.at(name)->counters)
            if (!counter.starts_with("ns_per")) run.counters[counter] = value;
        run.counters["samples"] = by_name.at(name)->samples;
    }
    measurement.json = with_surroundings(state_->collector.json(), surroundings, measurement.spread);
    return measurement;
}

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Result, name, best_ns, median_ns, counters)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Measurement, results, spread, json)

std::string packed(const Measurement& measurement) {
    std::string bytes;
    nlohmann::json::to_cbor(measurement, bytes);
    return bytes;
}

Measurement unpacked(const std::string& bytes) {
    return nlohmann::json::from_cbor(bytes);
}

Measurement merged(const std::vector<Measurement>& parts, const Surroundings& surroundings) {
    Measurement whole;
    std::map<std::string, double> best_ns;
    nlohmann::ordered_json json = nlohmann::ordered_json::parse(parts.front().json);
    json["benchmarks"].clear();
    for (const Measurement& part : parts) {
        std::set<std::string> before;
        for (const auto& [name, _] : best_ns) before.insert(name);
        for (const Result& result : part.results)
            if (best_ns.emplace(result.name, result.best_ns).second) whole.results.push_back(result);
        const auto measured = nlohmann::ordered_json::parse(part.json);
        for (const auto& run : measured["benchmarks"])
            if (!before.contains(run["run_name"])) json["benchmarks"].push_back(run);
    }
    whole.spread = spread_of(best_ns);
    whole.json = with_surroundings(json.dump(), surroundings, whole.spread);
    return whole;
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
