// The integral of a density over the sphere.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "conformance/inputs/grids.h"
#include "conformance/inputs/rows.h"
#include "conformance/judge/values.h"
#include "reference/distribution.h"

namespace vndf::conformance {
namespace {

// The rule's nodes as inputs of the density, and their weights; and the integral that is expected of these nodes.
struct Nodes {
    Table inputs;
    std::vector<double> weight;
    double expected = 1;
};

// Of a density that takes cosines: those of the rule's normals. A density of reflections is integrated over their normals, too.
void add_cosines(const Function& density, const std::vector<double>& row,
                 const reference::QuadratureRule& rule, Nodes& result) {
    const Direction wo = RowReader(density).local(row.data()).wo;
    const int wo_dot_wm = column(density, "wo_dot_wm");
    result.inputs.columns[column(density, "cos_theta_m")] = rule.z;
    for (std::size_t i = 0; i < rule.size(); ++i) {
        const double cosine = dot(wo, {rule.x[i], rule.y[i], rule.z[i]});
        if (wo_dot_wm >= 0) result.inputs.columns[wo_dot_wm][i] = cosine;
        if (density.support == Support::mirrored) result.weight[i] *= 4 * std::max(0.0, cosine);
    }
}

// Without what is below the horizon, where a user's density of reflections may be 0.
void drop_below(const Function& density, const reference::QuadratureRule& rule, Nodes& result) {
    if (density.support != Support::mirrored || column(density, "n_x") >= 0 || column(density, "wi_z") < 0)
        return;
    for (std::size_t i = 0; i < rule.size(); ++i) {
        if (rule.z[i] > 0) continue;
        result.weight[i] = 0;
        result.expected -= rule.probability[i];
    }
}

// The density's own direction is the last of its vectors: wm or wi.
Nodes nodes(const Function& density, const std::vector<double>& row, Real real, bool of_user) {
    const reference::Distribution distribution(density.model, RowReader(density).lobe(row.data()),
                                               precision(real));
    const reference::QuadratureRule rule = distribution.rule();
    const int variable = std::max(column(density, "wm_x"), column(density, "wi_x"));
    Nodes result;
    result.weight = rule.weight;
    result.expected = distribution.kept();
    for (const double value : row) result.inputs.columns.emplace_back(rule.size(), value);
    if (variable >= 0) {
        result.inputs.columns[variable] = rule.x;
        result.inputs.columns[variable + 1] = rule.y;
        result.inputs.columns[variable + 2] = rule.z;
    } else {
        add_cosines(density, row, rule, result);
    }
    if (of_user) drop_below(density, rule, result);
    for (std::vector<double>& column : result.inputs.columns)
        for (double& value : column) value = rounded(value, real);
    return result;
}

// How much of the integral the rounding of the nodes can move: the density's relative condition, averaged over
// some of them.
double rounding_share(const Function& density, const Nodes& at, const std::vector<double>& values,
                      Real real) {
    const auto evaluation = reference::find_evaluation<double>(density.model);
    const std::size_t step = std::max<std::size_t>(1, at.weight.size() / 256);
    double share = 0, total = 0;
    for (std::size_t i = 0; i < at.weight.size(); i += step) {
        const double mass = at.weight[i] * values[i];
        const std::vector<double> row = at.inputs.row(i);
        double condition = relative_condition(density, evaluation, row.data(), precision(real));
        // In double a lobe may be narrower than a rounding error of float: what one of double changes.
        if (real == Real::f64)
            condition = std::max(condition, absolute_condition(density, evaluation, row.data(),
                                                               precision(real), -1, 2 * epsilon(real)) /
                                                values[i]);
        if (!(mass > 0)) continue;
        share += mass * std::min(1.0, epsilon(real) * condition);
        total += mass;
    }
    return total > 0 ? share / total : 1;
}

}  // namespace

std::vector<Finding> check_normalisation(runtime::Evaluator& evaluator, const Function& density,
                                         const PointwiseOptions& options) {
    const Real real = evaluator.input_real();
    // Of a user's density the pointwise comparison says how precise it is.
    const double tolerance = options.scope ? 1e-2 : 2e-6;
    Finding finding;
    finding.check = "integral";
    finding.limit = 1;
    finding.unit = "tolerances";
    for (const Point& lobe : lobes(density, options)) {
        const std::vector<double> row = tabulate(density, {lobe}, real).row(0);
        const Nodes at = nodes(density, row, real, options.scope);
        const std::vector<double> values = evaluate(evaluator, density, at.inputs).front();
        // Where rounding a direction decides about the density, only the pointwise comparison has a meaning.
        const double share = rounding_share(density, at, values, real);
        if (share > 1e-3) continue;
        double sum = 0;
        for (std::size_t i = 0; i < values.size(); ++i)
            if (at.weight[i] > 0) sum += at.weight[i] * values[i];
        ++finding.count;
        double error = std::abs(sum - at.expected) / (tolerance + share);
        if (std::isnan(error)) error = std::numeric_limits<double>::infinity();
        if (error <= finding.figure) continue;
        finding.figure = error;
        finding.detail =
            fmt::format("{:.9g} instead of {:.9g}, tolerance {:.2g}", sum, at.expected, tolerance + share);
        finding.worst = hex_row(density, row);
    }
    return {finding};
}

}  // namespace vndf::conformance
