// The integral of a density over the sphere.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "conformance/inputs/grids.h"
#include "conformance/inputs/rows.h"
#include "conformance/judge/values.h"
#include "reference/distribution.h"

namespace vndf::conformance {
namespace {

// Where and with which weights a density is integrated.
struct Support {
    const Function* sampler = nullptr;  // whose quadrature rule is taken
    bool reflect = false;               // the rule is one of normals, the density one of reflected directions
};

// A sampler of this density; else, for reflected directions, one of visible normals of the same distribution.
Support support_of(const Function& density) {
    const auto find = [&](auto matches) -> const Function* {
        const auto found = std::find_if(functions().begin(), functions().end(), [&](const Function& f) {
            return f.kind == Kind::sampler && !f.with_pdf && f.method == Method::exact && matches(f);
        });
        return found == functions().end() ? nullptr : &*found;
    };
    // One that is defined on the whole sphere, if there is one.
    for (const Domain domain : {Domain::sphere, Domain::upper})
        if (const auto* f =
                find([&](const Function& f) { return f.density == density.name && f.domain == domain; }))
            return {f, false};
    return {find([&](const Function& f) {
                return f.ndf == density.ndf && f.result == "WM" && f.domain == Domain::sphere &&
                       f.arguments == "WO_ALPHA_U";
            }),
            true};
}

// The rule's nodes as directions of the density's variable, and their weights.
struct Nodes {
    Table inputs;
    std::vector<double> weight;
};

Nodes nodes(const Function& density, const Support& support, const Table& lobe, Real real) {
    const std::vector<double> row = lobe.row(0);
    const reference::QuadratureRule rule =
        reference::Distribution(support.sampler->name, row.data(), precision(real)).rule();
    const RowReader reader(*support.sampler);
    Direction wo = reader.wo(row.data());
    for (double& component : wo) component /= length(reader.wo(row.data()));
    Nodes result;
    result.weight = rule.weight;
    std::vector<double> direction[3] = {rule.x, rule.y, rule.z};
    if (support.reflect)
        for (std::size_t i = 0; i < rule.size(); ++i) {
            const double cosine = wo[0] * rule.x[i] + wo[1] * rule.y[i] + wo[2] * rule.z[i];
            for (int k = 0; k < 3; ++k) direction[k][i] = 2 * cosine * direction[k][i] - wo[k];
            result.weight[i] *= 4 * std::max(0.0, cosine);  // |d wi / d wm|
        }
    for (const std::string& name : density.inputs) {
        const int in = column(*support.sampler, name);
        std::vector<double>& values = result.inputs.columns.emplace_back();
        values = in >= 0 ? std::vector<double>(rule.size(), row[in]) : direction[name.back() - 'x'];
        if (real == Real::f32)
            for (double& value : values) value = static_cast<float>(value);
    }
    return result;
}

// How much of the integral the rounding of the nodes can move: the density's relative condition, averaged over
// some of them.
double rounding_share(const Function& density, const Nodes& at, const std::vector<double>& values,
                      Real real) {
    const auto evaluation = reference::find_evaluation<double>(density.name);
    const std::size_t step = std::max<std::size_t>(1, at.weight.size() / 256);
    double share = 0, total = 0;
    for (std::size_t i = 0; i < at.weight.size(); i += step) {
        const double mass = at.weight[i] * values[i];
        const double condition =
            relative_condition(density, evaluation, at.inputs.row(i).data(), precision(real));
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
    const Support support = support_of(density);
    const Rounding rounding = real == Real::f32 ? Rounding::to_float : Rounding::none;
    Finding finding;
    finding.check = "integral";
    finding.limit = 1;
    finding.unit = "tolerances";
    for (const Point& lobe : lobes(*support.sampler, options.quick)) {
        const Table table = tabulate(*support.sampler, {lobe}, rounding);
        const Nodes at = nodes(density, support, table, real);
        const std::vector<double> values = evaluate(evaluator, density, at.inputs).front();
        // Where rounding a direction decides about the density, only the pointwise comparison has a meaning.
        const double share = rounding_share(density, at, values, real);
        if (share > 1e-3) continue;
        double sum = 0;
        for (std::size_t i = 0; i < values.size(); ++i) sum += at.weight[i] * values[i];
        ++finding.count;
        const double error = std::abs(sum - 1) / (2e-6 + share);
        if (error <= finding.figure) continue;
        finding.figure = error;
        finding.detail = fmt::format("{:.9g}, tolerance {:.2g}", sum, 2e-6 + share);
        finding.worst = hex_row(*support.sampler, table.row(0));
    }
    return {finding};
}

}  // namespace vndf::conformance
