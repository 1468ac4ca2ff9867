// The measuring loop: Google Benchmark with manual time, repetitions of all entries in random order, so that a
// disturbance or a change of the clock meets all alike.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "session.h"
#include "variance.h"

namespace vndf::bench {

// What came out of one entry.
struct Result {
    std::string name;
    double best_ns = 0, median_ns = 0;  // a sample, by the wall clock
    std::map<std::string, double> counters;
};

struct Measurement {
    std::vector<Result> results;  // in the order of the entries
    std::string json;             // Google Benchmark's form
};

// `context` and `lobes` go to the JSON as they are. Entries whose names stand in another's `copy` or `published` are measured
// in the same run, and every entry carries the ratio to them.
Measurement measure(const std::vector<Entry>& entries, int repetitions,
                    const std::vector<std::pair<std::string, std::string>>& context,
                    const std::vector<LobeNoise>& lobes, const std::function<void(double done)>& progress);

// Results by name out of such a JSON text. Throws InputError, naming `path`.
std::vector<Result> read_results(const std::string& json, const std::string& path);

}  // namespace vndf::bench
