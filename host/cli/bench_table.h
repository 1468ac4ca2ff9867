// What clvndf bench prints.
#pragma once

#include <string>
#include <vector>

#include "bench/advice.h"
#include "bench/measure.h"

namespace vndf::cli {

// A line for each form of each function, and the three sentences that a reader came for.
void print_measurement(const bench::Measurement& measurement);

// How the function of this name compares with the fastest of the others, in cache.
void print_beside(const bench::Measurement& measurement, const std::string& function);

// Times over those of an earlier run, of the entries that both have.
void print_comparison(const std::vector<bench::Result>& results, const std::vector<bench::Result>& baseline,
                      const std::map<std::string, double>& spread, const std::string& baseline_name);

// The cheapest forms within the demand, with what else was tried.
void print_advice(const std::vector<bench::Advice>& all, const bench::Demand& demand,
                  const std::map<std::string, double>& spread);

}  // namespace vndf::cli
