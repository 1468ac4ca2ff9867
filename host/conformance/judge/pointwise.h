// The pointwise comparison of a function of any kind with the reference.
#pragma once

#include <vector>

#include "conformance/inputs/pointwise_table.h"
#include "conformance/judge/errors.h"

namespace vndf::conformance {

// The findings of the checks for the function's kind.
std::vector<Finding> check_pointwise(runtime::Evaluator& evaluator, const Function& function,
                                     const PointwiseOptions& options);

// Its errors at the rows of `table`, wherever they are judged, in the unit of those checks: the angle of a direction
// (front or back), the relative error of anything else.
Errors pointwise_errors(runtime::Evaluator& evaluator, const Function& function, const Table& table);

}  // namespace vndf::conformance
