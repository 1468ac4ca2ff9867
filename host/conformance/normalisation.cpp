// The integral of a density over the sphere.
#include <algorithm>
#include <cmath>

#include "conformance/grids.h"
#include "conformance/rows.h"
#include "conformance/values.h"
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

}  // namespace

std::vector<Finding> check_normalisation(runtime::Evaluator& evaluator, const Function& density,
                                         const PointwiseOptions& options) {
    const Real real = evaluator.input_real();
    const Support support = support_of(density);
    const Rounding rounding = real == Real::f32 ? Rounding::to_float : Rounding::none;
    Errors errors;
    std::vector<std::vector<double>> lobe_rows;
    for (const Point& lobe : lobes(*support.sampler, options.quick)) {
        const Table table = tabulate(*support.sampler, {lobe}, rounding);
        const bool reflected = column(density, "wi_x") >= 0;
        // A density of rounded reflected directions means little where rounding moves them by more than this.
        const reference::Distribution distribution(support.sampler->name, table.row(0).data(),
                                                   precision(real));
        (void)distribution;
        const Nodes at = nodes(density, support, table, real);
        const auto values = evaluate(evaluator, density, at.inputs);
        double sum = 0;
        for (std::size_t i = 0; i < at.weight.size(); ++i) sum += at.weight[i] * values[0][i];
        (void)reflected;
        errors.add(std::abs(sum - 1), lobe_rows.size());
        lobe_rows.push_back(table.row(0));
    }
    Finding finding;
    finding.check = "integral";
    finding.figure = errors.max();
    finding.limit = 1e-5;
    finding.unit = "off 1";
    finding.count = errors.count();
    finding.detail = errors.summary();
    finding.worst = hex_row(*support.sampler, lobe_rows.at(errors.worst_row()));
    return {finding};
}

}  // namespace vndf::conformance
