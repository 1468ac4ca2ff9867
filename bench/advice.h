// The cheapest sampler within a stated error, out of a measurement.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "measure.h"
#include "registry.h"

namespace vndf::bench {

struct Demand {
    double error = 0;                // the largest angle on any input measured, in 2^-24
    Domain domain = Domain::sphere;  // upper: wo above the surface alone
};

// A form of a sampler that was measured, in caches and with a lobe of its own for each sample.
struct Candidate {
    const Function* function;
    std::string rung;  // "strict/float"
    double ns = 0, error = 0;
    bool sound = true;  // every result finite, no normal below the horizon
};

// What is sampled, "GGX normals", with its candidates, the cheapest first, and the first of them that meets the demand.
struct Advice {
    std::string what;
    std::vector<Candidate> candidates;
    std::optional<Candidate> best;
};

std::vector<Advice> advise(const std::vector<Result>& results, const Demand& demand);

}  // namespace vndf::bench
