// Pointwise checks of the samplers: each map against the reference map, the invariants of its result, and the
// form that returns its density as well.
#pragma once

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

// The angles of either form to the exact map at the rows of `table`, in epsilon, and the same over 1 + condition number: what
// rounding the inputs alone would make of them.
struct SamplerErrors {
    Errors angle, over_condition;
};
SamplerErrors sampler_errors(runtime::Evaluator& evaluator, const Function& sampler, const Table& table);

}  // namespace vndf::conformance
