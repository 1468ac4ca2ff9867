#include "conformance/judge/errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "text.h"

namespace vndf::conformance {

void Errors::add(double error, std::size_t row) {
    if (std::isnan(error)) error = std::numeric_limits<double>::infinity();
    if (errors_.empty() || error > max_) {
        max_ = error;
        worst_ = row;
    }
    errors_.push_back(error);
}

void Errors::merge(const Errors& other) {
    if (other.errors_.empty()) return;
    // By row on a tie, so that the report does not depend on the threads.
    if (errors_.empty() || other.max_ > max_ || (other.max_ == max_ && other.worst_ < worst_)) {
        max_ = other.max_;
        worst_ = other.worst_;
    }
    errors_.insert(errors_.end(), other.errors_.begin(), other.errors_.end());
}

double Errors::percentile(double p) const {
    if (errors_.empty()) return 0;
    const auto rank = static_cast<std::size_t>(std::ceil(p / 100 * static_cast<double>(errors_.size())));
    const auto nth = errors_.begin() + static_cast<std::ptrdiff_t>(std::max<std::size_t>(rank, 1) - 1);
    std::nth_element(errors_.begin(), nth, errors_.end());
    return *nth;
}

std::string Errors::summary() const {
    return fmt::format("p50 {:.3g}, p99 {:.3g}, p99.9 {:.3g}, max {:.3g}", percentile(50), percentile(99),
                       percentile(99.9), max());
}

std::string hex_row(const Function& function, const std::vector<double>& row,
                    bool wanted(const std::string& input)) {
    std::string text;
    for (std::size_t i = 0; i < row.size(); ++i)
        if (!wanted || wanted(function.inputs[i]))
            text += fmt::format("{}{}={}", text.empty() ? "" : " ", function.inputs[i], hex_number(row[i]));
    return text;
}

Finding make_finding(std::string check, double figure, double limit, std::string unit, const Errors& errors,
                     const Function& function, const Table& table) {
    Finding finding;
    finding.check = std::move(check);
    finding.figure = figure;
    finding.limit = limit;
    finding.unit = std::move(unit);
    finding.count = errors.count();
    if (errors.count() == 0) return finding;
    finding.detail = errors.summary();
    finding.p50 = errors.percentile(50), finding.p99 = errors.percentile(99), finding.max = errors.max();
    finding.row = table.row(errors.worst_row());
    finding.worst = hex_row(function, finding.row);
    return finding;
}

namespace {

template <class T>
std::vector<std::vector<double>> evaluate_as(runtime::Evaluator& evaluator, const Function& function,
                                             const Table& table) {
    const std::size_t n = table.rows();
    std::vector<std::vector<T>> in, out(function.outputs.size(), std::vector<T>(n));
    std::vector<const void*> inputs;
    std::vector<void*> outputs;
    for (const auto& column : table.columns) in.emplace_back(column.begin(), column.end());
    for (const auto& column : in) inputs.push_back(column.data());
    for (auto& column : out) outputs.push_back(column.data());
    evaluator.run(function, n, inputs, outputs);
    std::vector<std::vector<double>> results;
    for (const auto& column : out) results.emplace_back(column.begin(), column.end());
    return results;
}

}  // namespace

std::vector<std::vector<double>> evaluate(runtime::Evaluator& evaluator, const Function& function,
                                          const Table& table) {
    return evaluator.input_real() == Real::f32 ? evaluate_as<float>(evaluator, function, table)
                                               : evaluate_as<double>(evaluator, function, table);
}

}  // namespace vndf::conformance
