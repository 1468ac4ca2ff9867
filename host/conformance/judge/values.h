// Pointwise checks of everything that is no sampler: terms, densities, geometry; and the integral of
// densities.
#pragma once

#include <vector>

#include "conformance/inputs/pointwise_table.h"
#include "conformance/judge/errors.h"

namespace vndf::conformance {

// `function` against the reference at hard and random points, its arguments taken literally.
std::vector<Finding> check_values(runtime::Evaluator& evaluator, const Function& function,
                                  const PointwiseOptions& options);

// Its errors at the rows of `table` that are judged, in the unit of that check.
Errors value_errors(runtime::Evaluator& evaluator, const Function& function, const Table& table);

// The integral of a density over the sphere, lobe by lobe, by quadrature of the evaluator's values: 1.
std::vector<Finding> check_normalisation(runtime::Evaluator& evaluator, const Function& density,
                                         const PointwiseOptions& options);

}  // namespace vndf::conformance
