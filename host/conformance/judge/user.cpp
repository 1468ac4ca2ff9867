#include "conformance/judge/user.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "conformance/inputs/rows.h"
#include "conformance/judge/samplers.h"
#include "conformance/judge/values.h"

namespace vndf::conformance {
namespace {

// Of a density: the median and the 99th percentile of the relative error that are no longer rounding.
constexpr double typical_error = 1e-3, rare_error = 0.1;

Finding graded(Finding finding, double figure) {
    finding.concern = figure > beyond_rounding ? Concern::wrong : Concern::inexact;
    return finding;
}

// The invariants of directions, each the worst of all rows.
std::vector<Finding> check_directions(const Function& sampler, const Table& table,
                                      const std::vector<std::vector<double>>& results, Real real) {
    const double unit = epsilon(real);
    const RowReader reader(sampler);
    Errors bad, size, below, behind;
    for (std::size_t i = 0; i < table.rows(); ++i) {
        const std::vector<double> row = table.row(i);
        const Direction d{results[0][i], results[1][i], results[2][i]};
        const bool finite = std::isfinite(d[0]) && std::isfinite(d[1]) && std::isfinite(d[2]);
        bad.add(finite ? 0 : 1, i);
        if (!finite) continue;
        size.add(std::abs(length(d) - 1) / unit, i);
        if (sampler.result != "WM") continue;
        below.add(std::max(0.0, -dot(d, reader.n(row.data()))) / unit, i);
        if (reader.has_wo()) behind.add(std::max(0.0, -dot(d, reader.wo(row.data()))) / unit, i);
    }
    std::vector<Finding> findings;
    const auto add = [&](const char* check, double limit, const char* unit_name, const Errors& errors) {
        findings.push_back(make_finding(check, errors.max(), limit, unit_name, errors, sampler, table));
    };
    add("finite", 0, "non-finite", bad);
    const auto add_graded = [&](const char* check, double limit, const Errors& errors, double figure) {
        if (!errors.count()) return;
        add(check, limit, "eps", errors);
        findings.back() = graded(findings.back(), figure * unit);
    };
    // Next to the silhouette few normals of a narrow lobe lose more.
    add_graded("unit length", length_bound(sampler.result), size, size.max());
    add_graded("normal above the surface", side_bound(), below, below.percentile(99));
    add_graded("normal faces wo", side_bound(), behind, behind.percentile(99));
    return findings;
}

// The map against the exact one. Another map of the same distribution is as good: it is the distribution that is wrong or not.
void compare_maps(const Function& sampler, const Table& table,
                  const std::vector<std::vector<double>>& results, const PointwiseOptions& options, Real real,
                  std::vector<Finding>& findings) {
    const SamplerErrors errors = sampler_errors(exact_map(sampler, table, real), results, real);
    const SamplerBounds& bounds = bounds_of(sampler, real).sampler;
    const double factor = slack(options.math);
    Finding finding = make_finding("map, p99", errors.over_condition.percentile(99), bounds.front * factor,
                                   "eps (1 + cond)", errors.over_condition, sampler, table);
    finding.concern = Concern::inexact;
    if (errors.angle.percentile(50) * epsilon(real) > 1e-2)
        finding.detail += fmt::format("; another map than that of {}", sampler.model);
    findings.push_back(finding);
}

std::vector<Finding> check_values_of_user(runtime::Evaluator& evaluator, const Function& function,
                                          const PointwiseOptions& options) {
    const double unit = epsilon(evaluator.input_real());
    std::vector<Finding> findings = check_values(evaluator, function, options);
    Finding precise = findings.front();
    precise.check = "rounding, " + precise.check.substr(precise.check.find(',') + 2),
    precise.concern = Concern::inexact;
    Finding typical = findings.front();
    typical.check = "typical error", typical.figure = precise.p50 * unit, typical.limit = typical_error,
    typical.unit = "relative";
    Finding rare = typical;
    rare.check = "error, p99", rare.figure = precise.p99 * unit, rare.limit = rare_error;
    findings.front() = typical;
    findings.insert(findings.begin() + 1, rare);
    if (typical.passed() && rare.passed()) findings.insert(findings.begin() + 2, precise);
    return findings;
}

}  // namespace

std::vector<Finding> check_user(runtime::Evaluator& evaluator, const Function& function,
                                const PointwiseOptions& options) {
    if (function.kind != Kind::sampler) return check_values_of_user(evaluator, function, options);
    const Real real = evaluator.input_real();
    const Table table = pointwise_table(function, real, options);
    const auto results = evaluate(evaluator, function, table);
    std::vector<Finding> findings = check_directions(function, table, results, real);
    if (!function.model.empty()) compare_maps(function, table, results, options, real, findings);
    return findings;
}

}  // namespace vndf::conformance
