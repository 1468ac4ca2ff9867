// Pointwise checks of somebody else's function, which promised nobody our bounds: what is beyond them is inexact, what rounding
// does not explain is wrong.
#pragma once

#include <vector>

#include "conformance/inputs/pointwise_table.h"
#include "conformance/judge/errors.h"

namespace vndf::conformance {

// Rounding moves no direction of unit length, and no normal to the other side, by so much.
inline constexpr double beyond_rounding = 1e-3;

// The findings of a function of any kind in options.scope: of a sampler its invariants, and its map if it has a model; of others
// the errors against the reference.
std::vector<Finding> check_user(runtime::Evaluator& evaluator, const Function& function,
                                const PointwiseOptions& options);

}  // namespace vndf::conformance
