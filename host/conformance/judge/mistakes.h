// The mistakes that people make in samplers and densities, each as what it makes of them: the one that fits is named.
#pragma once

#include <cstdint>
#include <string>

#include "conformance/inputs/grids.h"
#include "runtime/device_evaluator.h"

namespace vndf::conformance {

struct Mistake {
    std::string what;      // "alpha.x and alpha.y are exchanged"; empty if none fits
    std::string evidence;  // how well it fits
    bool none =
        false;  // nothing is wrong where it was looked for: with moderate roughness, away from grazing views
    explicit operator bool() const { return !what.empty(); }
};

// What a user's sampler draws from, if not from its density.
Mistake mistake_of_sampler(runtime::DeviceEvaluator& evaluator, const Function& sampler, const Scope& scope,
                           std::uint64_t seed);

// What a user's density or term is, if not itself.
Mistake mistake_of_value(runtime::Evaluator& evaluator, const Function& function, const Scope& scope,
                         std::uint64_t seed);

}  // namespace vndf::conformance
