// Errors of many evaluations, and the forms in which inputs and evaluations travel between table and device.
#pragma once

#include <string>
#include <vector>

#include "conformance/inputs/points.h"
#include "conformance/judge/finding.h"
#include "runtime/evaluator.h"

namespace vndf::conformance {

using runtime::Math;
using runtime::Real;

// The unit roundoff of the tested type, in which errors are given.
constexpr double epsilon(Real real) {
    return real == Real::f32 ? 0x1p-24 : 0x1p-53;
}

// What `strict` promises of the function.
inline const Bounds& bounds_of(const Function& function, Real real) {
    return real == Real::f32 ? function.float_bounds : function.double_bounds;
}

// How many times the bounds for strict a policy may err (rules of the registry; native: measured, never
// promised).
constexpr double slack(Math math) {
    return math == Math::strict ? 1 : math == Math::builtin ? 4 : 16;
}

// The same for length_bound and side_bound, which builtin meets as strict does.
constexpr double invariant_slack(Math math) {
    return math == Math::native ? 8 : 1;
}

// A collection of errors, each with the row that made it. NaN counts as infinite.
class Errors {
  public:
    void add(double error, std::size_t row);
    void merge(const Errors& other);
    std::size_t count() const { return errors_.size(); }
    double percentile(double p) const;  // 0 <= p <= 100; 0 if empty
    double max() const { return max_; }
    std::size_t worst_row() const { return worst_; }
    std::string summary() const;  // "p50 0.31, p99 1.2, max 7"

  private:
    mutable std::vector<double> errors_;
    double max_ = 0;
    std::size_t worst_ = 0;
};

// "wo_x=0x1.8p-1 wo_y=..." for a row of the function's inputs, or of those of them that are `wanted`.
std::string hex_row(const Function& function, const std::vector<double>& row,
                    bool wanted(const std::string& input) = nullptr);

// The finding that `figure`, of these errors, stays below `limit`.
Finding make_finding(std::string check, double figure, double limit, std::string unit, const Errors& errors,
                     const Function& function, const Table& table);

// The function at every row of the table, in the evaluator's own type: [output][row].
std::vector<std::vector<double>> evaluate(runtime::Evaluator& evaluator, const Function& function,
                                          const Table& table);

}  // namespace vndf::conformance
