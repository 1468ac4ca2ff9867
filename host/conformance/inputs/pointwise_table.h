// The inputs of the pointwise comparison.
#pragma once

#include <cstdint>

#include "conformance/inputs/grids.h"
#include "runtime/evaluator.h"

namespace vndf::conformance {

using runtime::Math;
using runtime::Real;

struct PointwiseOptions {
    Math math = Math::strict;
    std::uint64_t seed = 1;
    std::size_t random_points = std::size_t{1} << 16;
    std::size_t hard_stride = 1;   // each hard_stride-th of the hard points
    std::size_t guard_stride = 1;  // and of the guards, which a percentile bears among many other points only
    bool quick = false;            // the lobes of a quick run
    const Scope* scope =
        nullptr;  // of a user's function: random points in it and its corners, and its lobes, instead
};

// The lobes of a run with these options.
std::vector<Point> lobes(const Function& function, const PointwiseOptions& options);

// Random, hard and guard points as a table.
Table pointwise_table(const Function& function, Real real, const PointwiseOptions& options);

}  // namespace vndf::conformance
