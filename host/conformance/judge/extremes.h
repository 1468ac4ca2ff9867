// The ends of every promise of vndf.h: directions of any length, numbers of any size, and views that see nothing.
#pragma once

#include <vector>

#include "conformance/inputs/pointwise_table.h"
#include "conformance/judge/errors.h"

namespace vndf::conformance {

// Rows of finite arguments of any size and sign; every second argument is one of the domain.
Table extreme_table(const Function& function, Real real, std::size_t rows);

// Finite results for finite arguments, and of samplers: unit vectors for |wo| from 1e-3 to 1e3, and what is documented at
// wo = -n.
std::vector<Finding> check_extremes(runtime::Evaluator& evaluator, const Function& function,
                                    const PointwiseOptions& options);

}  // namespace vndf::conformance
