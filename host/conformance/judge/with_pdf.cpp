// The form of a sampler that returns its density as well.
#include <algorithm>
#include <cmath>

#include "parallel.h"
#include "conformance/inputs/rows.h"
#include "conformance/judge/samplers.h"

namespace vndf::conformance {
namespace {

using Columns = std::vector<std::vector<double>>;

struct PdfErrors {
    Errors core, all, sign, outside, direction, lost, agreement;
    void merge(const PdfErrors& other) {
        core.merge(other.core), all.merge(other.all), sign.merge(other.sign), outside.merge(other.outside);
        direction.merge(other.direction), lost.merge(other.lost), agreement.merge(other.agreement);
    }
};

// The inputs of the registered density at a sampler's own results, by the names of the columns.
Table density_inputs(const Function& sampler, const Function& density, const Table& table,
                     const Columns& results) {
    Table inputs;
    for (const std::string& name : density.inputs) {
        // alpha_x and alpha_y of a density at the results of a sampler of one alpha.
        const int in = column(sampler, name) < 0 && name.starts_with("alpha_") ? column(sampler, "alpha")
                                                                               : column(sampler, name);
        const auto out =
            std::find(sampler.outputs.begin(), sampler.outputs.end(), name) - sampler.outputs.begin();
        inputs.columns.push_back(in >= 0 ? table.columns[in] : results.at(out));
    }
    return inputs;
}

// 1 + 2q for the exponent q of a Beckmann density at the exact direction; 1 for GGX.
double exponent_factor(const Function& sampler, const RowReader& reader, const double* row, const double* d) {
    if (!has_exponent(sampler.ndf)) return 1;
    Direction m{d[0], d[1], d[2]};
    const Direction wo = reader.wo(row);
    if (sampler.result == "WI") m = {d[0] + wo[0], d[1] + wo[1], d[2] + wo[2]};
    return 1 + 2 * beckmann_exponent(m, reader.alpha(row));
}

struct Inputs {
    const Function& sampler;
    const Function& density;
    const Table& table;
    const Columns& plain;     // results of the plain form
    const Columns& fused;     // results of this form
    const Table& at_samples;  // inputs of the density at those results
    const Columns& separate;  // the density there
    Real real;
};

template <class R>
void add_row(const Inputs& s, const RowReader& reader, std::size_t i, PdfErrors& errors) {
    const double unit = epsilon(s.real), smallest = s.real == Real::f32 ? 0x1p-126 : 0x1p-1022;
    const double largest = s.real == Real::f32 ? 0x1.fffffep127 : 0x1.fffffffffffffp1023;
    const std::vector<double> row = s.table.row(i);
    const double pdf = s.fused[3][i];
    bool same = true;
    for (int k = 0; k < 3; ++k) same = same && s.fused[k][i] == s.plain[k][i];
    errors.direction.add(same ? 0 : 1, i);
    const double cos_theta_o = reader.cos_theta_o(row.data());
    if (s.sampler.domain == Domain::upper && cos_theta_o < 0) {
        errors.outside.add(pdf == 0 ? 0 : 1, i);
        return;
    }
    errors.sign.add(std::isfinite(pdf) && pdf >= 0 ? 0 : 1, i);
    if (1 + cos_theta_o < 1e-15) return;  // wo = -n: no distribution
    // The separate density takes wo literally, which is no unit vector here.
    const bool unit_wo = std::abs(length(reader.wo(row.data())) - 1) < 0x1p-12;
    // A reflection does not leave the support of its density, whatever the rounding of its direction. Its half vector may
    // leave the upper side, within rounding; and above alpha = 2 the stretch makes more of that.
    const auto [x, y] = reader.alpha(row.data());
    if (unit_wo && s.sampler.result == "WI" && pdf > 0 && reader.wo(row.data())[2] + s.fused[2][i] > 0 &&
        std::max(x, y) <= 2)
        errors.lost.add(s.separate[0][i] > 0 ? 0 : 1, i);

    // Lost, or by either of two cones.
    if (may_miss(s.sampler) &&
        (!(pdf > 0) || !std::isfinite(reference::condition(s.sampler.name, row.data(), precision(s.real)))))
        return;
    R exact[4];
    const std::vector<R> in(row.begin(), row.end());
    reference::find_evaluation<R>(s.sampler.name)(in.data(), exact, precision(s.real));
    const auto expected = static_cast<double>(exact[3]);
    // Neither judged where the true density leaves the range of the type.
    if (!(expected > smallest) || !(expected < largest)) return;
    // The density moves with the inputs of the map, for instance with the distance to a silhouette, as the
    // direction does: its own condition number is its due, and (1 + 2q) that of a Beckmann density.
    const auto evaluation = reference::find_evaluation<double>(s.sampler.name);
    const double condition = relative_condition(s.sampler, evaluation, row.data(), precision(s.real), 3);
    if (!is_settled(condition)) return;
    const double d[3] = {static_cast<double>(exact[0]), static_cast<double>(exact[1]),
                         static_cast<double>(exact[2])};
    const double allowance = std::max(1 + condition, exponent_factor(s.sampler, reader, row.data(), d));
    const double error = static_cast<double>(std::abs(pdf - exact[3]) / exact[3]) / (unit * allowance);
    errors.all.add(error, i);
    if (in_core(reader, row.data())) errors.core.add(error, i);

    // An approximate sampler returns the density of its map, not the registered one; at small alpha a rounded
    // direction has no density worth comparing.
    const auto [alpha_x, alpha_y] = reader.alpha(row.data());
    if (!unit_wo || s.sampler.method == Method::approximate || std::min(alpha_x, alpha_y) < 1e-3) return;
    // The density at the rounded direction differs by what the rounding of the map and of the direction moves it.
    const std::vector<double> at = s.at_samples.row(i);
    if (at_edge(s.density, at.data(), s.real)) return;
    // The rounded direction may lie in the flat tail of a lobe narrower than rounding: the exact one tells.
    const auto density = reference::find_evaluation<double>(s.density.name);
    std::vector<double> at_exact = at;
    for (std::size_t k = 0; k < at.size(); ++k)
        for (int c = 0; c < 3; ++c)
            if (s.density.inputs[k] == s.sampler.outputs[c]) at_exact[k] = d[c];
    const double movement =
        std::max(relative_condition(s.density, density, at.data(), precision(s.real)),
                 relative_condition(s.density, density, at_exact.data(), precision(s.real)));
    const double map_condition = reference::condition(s.sampler.name, row.data(), precision(s.real));
    if (!is_settled(movement) || !is_settled(map_condition)) return;
    errors.agreement.add(
        std::abs((s.separate[0][i] - pdf) / pdf) / unit / ((1 + movement) * (1 + map_condition)), i);
}

template <class R>
PdfErrors pdf_errors(const Inputs& s) {
    const RowReader reader(s.sampler);
    std::vector<PdfErrors> parts(thread_count());
    parallel_for(s.table.rows(), 256, [&](unsigned thread, std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) add_row<R>(s, reader, i, parts[thread]);
    });
    for (std::size_t i = 1; i < parts.size(); ++i) parts[0].merge(parts[i]);
    return parts[0];
}

}  // namespace

std::vector<Finding> check_with_pdf(runtime::Evaluator& evaluator, const Function& with_pdf,
                                    const PointwiseOptions& options) {
    const Real real = evaluator.input_real();
    const Function& plain = *find_function(with_pdf.plain);
    const Function& density = *find_function(with_pdf.density);
    // Fewer points than for the plain form: each takes some thirty evaluations of the reference.
    PointwiseOptions fewer = options;
    fewer.random_points /= 4, fewer.hard_stride *= 3;
    const Table table = pointwise_table(with_pdf, real, fewer);
    const Columns directions = evaluate(evaluator, plain, table);
    const Columns fused = evaluate(evaluator, with_pdf, table);
    const Table at_samples = density_inputs(with_pdf, density, table, fused);
    const Columns separate = evaluate(evaluator, density, at_samples);
    const Inputs inputs{with_pdf, density, table, directions, fused, at_samples, separate, real};
    const PdfErrors errors = real == Real::f32 ? pdf_errors<double>(inputs) : pdf_errors<long double>(inputs);

    const double factor = slack(options.math);
    const char* const unit = has_exponent(with_pdf.ndf) ? "eps max(1 + cond, 1 + 2q)" : "eps (1 + cond)";
    const SamplerBounds& bounds = bounds_of(with_pdf, real).sampler;
    std::vector<Finding> findings;
    const auto add = [&](const char* check, double figure, double limit, const char* unit, const Errors& e) {
        findings.push_back(make_finding(check, figure, limit, unit, e, with_pdf, table));
    };
    add("same direction as the plain form", errors.direction.max(), 0, "different", errors.direction);
    add("density of the exact sample, p99", errors.all.percentile(99), bounds.pdf * factor, unit, errors.all);
    add("density of the exact sample, core, maximum", errors.core.max(), bounds.pdf_core_max * factor, unit,
        errors.core);
    add("density finite and not negative", errors.sign.max(), 0, "rows", errors.sign);
    if (errors.outside.count())
        add("density 0 outside the domain", errors.outside.max(), 0, "rows", errors.outside);
    if (errors.lost.count())
        add("separate density positive at the samples", errors.lost.max(), 0, "rows", errors.lost);
    if (errors.agreement.count())
        add("agrees with the separate density, p99", errors.agreement.percentile(99),
            bounds.agreement * factor, "eps (1 + cond)(1 + cond of the map)", errors.agreement);
    return findings;
}

}  // namespace vndf::conformance
