// The measuring loop: Google Benchmark with manual time, repetitions of all entries in random order, so that a
// disturbance or a change of the clock meets all alike.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "builds.h"
#include "session.h"
#include "variance.h"

namespace vndf::bench {

// What came out of one entry.
struct Result {
    std::string name;
    double best_ns = 0, median_ns = 0;  // a sample, by the wall clock
    std::map<std::string, double> counters;
};

// What goes to the JSON beside the entries, as it is.
struct Surroundings {
    std::vector<std::pair<std::string, std::string>> context;
    std::vector<LobeNoise> lobes;
    std::vector<BuildTime> builds;
    std::string instructions = "{}";  // bench/results/instructions.json
    std::string caps = "{}";          // bench/results/caps.json
};

struct Measurement {
    std::vector<Result> results;  // in the order of the entries
    // By mode: the largest deviation from 1 of the ratio of two identical kernels, .02 for 2 %. No ratio within is a
    // difference. Empty if no kernel was measured twice.
    std::map<std::string, double> spread;
    std::string json;  // Google Benchmark's form
};

// Measures batches of entries, each interleaved in itself, and puts them together. Batches keep memory bounded; ratios between
// them hold as well as those between two builds of one kernel, of which every batch is to have one: see Measurement::spread.
class Measurer {
  public:
    explicit Measurer(int repetitions);
    ~Measurer();

    // Entries whose names were measured already, copies for instance, are measured again but not kept.
    void run(const std::vector<Entry>& entries, const std::function<void(double done)>& progress);

    // Entries whose names stand in another's `copy`, `published` or `lean` give it a ratio to them.
    Measurement finish(const Surroundings& surroundings);

  private:
    class State;
    int repetitions_;
    std::unique_ptr<State> state_;
};

// A measurement as bytes that another process reads.
std::string packed(const Measurement& measurement);
Measurement unpacked(const std::string& bytes);

// Measurements of batches that were made apart, as one Measurer would have put them together: in the order given, of entries of
// the same name the first.
Measurement merged(const std::vector<Measurement>& parts, const Surroundings& surroundings);

// Results by name out of such a JSON text. Throws InputError, naming `path`.
std::vector<Result> read_results(const std::string& json, const std::string& path);

}  // namespace vndf::bench
