#include "conformance/judge/pointwise.h"

#include "conformance/judge/samplers.h"
#include "conformance/judge/values.h"

namespace vndf::conformance {

std::vector<Finding> check_pointwise(runtime::Evaluator& evaluator, const Function& function,
                                     const PointwiseOptions& options) {
    if (function.kind != Kind::sampler) return check_values(evaluator, function, options);
    return function.with_pdf ? check_with_pdf(evaluator, function, options)
                             : check_sampler(evaluator, function, options);
}

Errors pointwise_errors(runtime::Evaluator& evaluator, const Function& function, const Table& table) {
    if (function.kind != Kind::sampler) return value_errors(evaluator, function, table);
    const runtime::Real real = evaluator.input_real();
    return sampler_errors(exact_map(function, table, real), evaluate(evaluator, function, table), real)
        .over_condition;
}

}  // namespace vndf::conformance
