// Pointwise checks of the samplers: each map against the reference map, the invariants of its result, and the
// form that returns its density as well.
#pragma once

#include <cstdint>
#include <vector>

#include "conformance/judge/errors.h"

namespace vndf::conformance {

struct PointwiseOptions {
    Math math = Math::strict;
    std::uint64_t seed = 1;
    std::size_t random_points = std::size_t{1} << 16;
    std::size_t hard_stride = 1;  // every how manieth of the hard points
    bool quick = false;           // the lobes of a quick run
};

// The findings of a sampler in its plain form.
std::vector<Finding> check_sampler(runtime::Evaluator& evaluator, const Function& sampler,
                                   const PointwiseOptions& options);

// The findings of its _with_pdf form.
std::vector<Finding> check_with_pdf(runtime::Evaluator& evaluator, const Function& with_pdf,
                                    const PointwiseOptions& options);

// The errors of a function of any kind at the rows of `table`, wherever it is judged, in the unit of its checks: the
// angle of a direction (front or back), the relative error of anything else.
Errors pointwise_errors(runtime::Evaluator& evaluator, const Function& function, const Table& table);

// Random, hard and guard points as a table.
Table pointwise_table(const Function& function, Real real, const PointwiseOptions& options);

}  // namespace vndf::conformance
