// Pointwise checks of the samplers: each map against the reference map, the invariants of its result, and the
// form that returns its density as well.
#pragma once

#include <array>
#include <vector>

#include "conformance/inputs/pointwise_table.h"
#include "conformance/judge/errors.h"

namespace vndf::conformance {

// The findings of a sampler in its plain form.
std::vector<Finding> check_sampler(runtime::Evaluator& evaluator, const Function& sampler,
                                   const PointwiseOptions& options);

// The findings of its _with_pdf form.
std::vector<Finding> check_with_pdf(runtime::Evaluator& evaluator, const Function& with_pdf,
                                    const PointwiseOptions& options);

// The exact map of a sampler at rows of its inputs, and what rounding them would make of it: infinite where there is no
// direction. Rows outside of the map's domain count as such.
struct ExactMap {
    std::vector<std::array<long double, 3>> directions;
    std::vector<double> conditions;
};
ExactMap exact_map(const Function& sampler, const Table& table, Real real);

// The angles of results, [component][row], to the exact map in epsilon, wherever it has a direction; and the same over 1 +
// condition number.
struct SamplerErrors {
    Errors angle, over_condition;
};
SamplerErrors sampler_errors(const ExactMap& exact, const std::vector<std::vector<double>>& results,
                             Real real);

}  // namespace vndf::conformance
