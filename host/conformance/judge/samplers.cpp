#include "conformance/judge/samplers.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "parallel.h"
#include "conformance/inputs/rows.h"

namespace vndf::conformance {
namespace {

// The angle between two vectors, accurate when small.
template <class R>
R angle(const R* a, const R* b) {
    const R x = a[1] * b[2] - a[2] * b[1], y = a[2] * b[0] - a[0] * b[2], z = a[0] * b[1] - a[1] * b[0];
    return std::atan2(std::sqrt(x * x + y * y + z * z), a[0] * b[0] + a[1] * b[1] + a[2] * b[2]);
}

enum class Region { front, back, outside, undefined };

// Where a row lies: outside a map's documented domain the result is a documented vector; for wo = -n (no
// visible normal) it is any unit vector.
Region region(const Function& sampler, const RowReader& reader, const double* row) {
    if (!reader.has_wo()) return Region::front;
    const double cos_theta_o = reader.cos_theta_o(row);
    if (cos_theta_o >= 0) return Region::front;
    if (sampler.domain == Domain::upper) return Region::outside;
    return 1 + cos_theta_o < 1e-15 ? Region::undefined : Region::back;
}

// Errors of the plain form by region, and of its invariants (in epsilon, or counts).
struct MapErrors {
    Errors front, back, level, core, outside, length, below, behind, bad, kept;
    void merge(const MapErrors& other) {
        front.merge(other.front), back.merge(other.back), level.merge(other.level);
        core.merge(other.core), outside.merge(other.outside);
        length.merge(other.length), below.merge(other.below), behind.merge(other.behind),
            bad.merge(other.bad), kept.merge(other.kept);
    }
};

using Columns = std::vector<std::vector<double>>;

// `condition`: of the map at this row, infinite where it has no direction. Where rounding of the inputs leaves the
// direction undetermined, it is held to no side of wo. About a world-space n no component is that side: the height
// has the error of the map.
void add_invariants(const Function& sampler, const RowReader& reader, const double* row, const double* result,
                    double condition, double unit, std::size_t i, MapErrors& errors) {
    const Direction d{result[0], result[1], result[2]};
    const bool finite = std::isfinite(d[0]) && std::isfinite(d[1]) && std::isfinite(d[2]);
    errors.bad.add(finite ? 0 : 1, i);
    if (!finite) return;
    if (may_miss(sampler) && reference::is_lost(d)) return;
    errors.length.add(std::abs(length(d) - 1) / unit, i);
    if (!std::isfinite(condition) || sampler.result != "WM") return;
    const double depth = std::max(0.0, -dot(d, reader.n(row))) / unit;
    errors.below.add(reader.has_n() ? depth / (1 + condition) : depth, i);
    if (reader.has_wo() && is_settled(condition))
        errors.behind.add(std::max(0.0, -dot(d, reader.wo(row)) / length(reader.wo(row))) / unit, i);
}

// Whether a sample is lost where the exact one is, by more than 64 units of its error, and only there.
template <class R>
bool is_kept_alike(const Function& sampler, std::vector<double> row, const double* result, const R* exact,
                   double error) {
    const std::array<double, 3> d{static_cast<double>(exact[0]), static_cast<double>(exact[1]),
                                  static_cast<double>(exact[2])};
    const bool lost = reference::is_lost({result[0], result[1], result[2]});
    if (lost == reference::is_lost(d)) return true;
    const Direction ng = RowReader(sampler).ng(row.data());
    const double* kept = lost ? d.data() : result;
    const double over = dot({kept[0], kept[1], kept[2]}, ng) / length(ng);
    return std::min(std::abs(over), std::abs(kept[2])) < 64 * error;
}

template <class R>
MapErrors map_errors(const Function& sampler, const Table& table, const Columns& results, Real real) {
    const auto evaluation = reference::find_evaluation<R>(sampler.model);
    const auto conditioning = reference::find_condition(sampler.model);
    const RowReader reader(sampler);
    const double unit = epsilon(real);
    std::vector<MapErrors> parts(thread_count());
    parallel_for(table.rows(), 512, [&](unsigned thread, std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const std::vector<double> row = table.row(i);
            const Region where = region(sampler, reader, row.data());
            const bool defined = where == Region::front || where == Region::back;
            const double result[3] = {results[0][i], results[1][i], results[2][i]};
            MapErrors& errors = parts[thread];
            const double condition =
                defined ? conditioning(row.data(), precision(real)) : std::numeric_limits<double>::infinity();
            add_invariants(sampler, reader, row.data(), result, condition, unit, i, errors);
            if (where != Region::outside && !std::isfinite(condition))
                continue;  // no direction, or a true singularity of the map
            const std::vector<R> in(row.begin(), row.end());
            R exact[4];
            evaluation(in.data(), exact, precision(real));
            const R wide[3] = {result[0], result[1], result[2]};
            if (where == Region::outside) {
                errors.outside.add(std::equal(wide, wide + 3, exact) ? 0 : 1, i);
                continue;
            }
            if (may_miss(sampler))
                errors.kept.add(is_kept_alike(sampler, row, result, exact, unit * (1 + condition)) ? 0 : 1,
                                i);
            const auto error = static_cast<double>(angle(wide, exact) / (unit * (1 + condition)));
            (where == Region::front ? errors.front : errors.back).add(error, i);
            // Its rows are too few among those in front to count there, and maps are guarded at just this cosine.
            if (reader.has_wo() && reader.cos_theta_o(row.data()) == 0) errors.level.add(error, i);
            if (in_core(reader, row.data())) errors.core.add(error, i);
        }
    });
    for (std::size_t i = 1; i < parts.size(); ++i) parts[0].merge(parts[i]);
    return parts[0];
}

}  // namespace

namespace {

template <class R>
void add_exact(const Function& plain, const Table& table, Real real, ExactMap& exact) {
    const auto evaluation = reference::find_evaluation<R>(plain.model);
    const auto conditioning = reference::find_condition(plain.model);
    const RowReader reader(plain);
    parallel_for(table.rows(), 512, [&](unsigned, std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const std::vector<double> row = table.row(i);
            const Region where = region(plain, reader, row.data());
            if (where != Region::front && where != Region::back) continue;
            exact.conditions[i] = conditioning(row.data(), precision(real));
            if (!std::isfinite(exact.conditions[i])) continue;
            const std::vector<R> in(row.begin(), row.end());
            R direction[4];
            evaluation(in.data(), direction, precision(real));
            exact.directions[i] = {direction[0], direction[1], direction[2]};
        }
    });
}

}  // namespace

ExactMap exact_map(const Function& sampler, const Table& table, Real real) {
    ExactMap exact{std::vector<std::array<long double, 3>>(table.rows()),
                   std::vector<double>(table.rows(), std::numeric_limits<double>::infinity())};
    // A _with_pdf form returns the plain form's direction first.
    const Function& plain = *find_function(sampler.plain);
    real == Real::f32 ? add_exact<double>(plain, table, real, exact)
                      : add_exact<long double>(plain, table, real, exact);
    return exact;
}

SamplerErrors sampler_errors(const ExactMap& exact, const std::vector<std::vector<double>>& results,
                             Real real) {
    SamplerErrors errors;
    for (std::size_t i = 0; i < exact.conditions.size(); ++i) {
        if (!std::isfinite(exact.conditions[i])) continue;
        const long double d[3] = {results[0][i], results[1][i], results[2][i]};
        const auto in_epsilon = static_cast<double>(angle(d, exact.directions[i].data())) / epsilon(real);
        errors.angle.add(in_epsilon, i);
        errors.over_condition.add(in_epsilon / (1 + exact.conditions[i]), i);
    }
    return errors;
}

std::vector<Finding> check_sampler(runtime::Evaluator& evaluator, const Function& sampler,
                                   const PointwiseOptions& options) {
    const Real real = evaluator.input_real();
    const Table table = pointwise_table(sampler, real, options);
    const Columns results = evaluate(evaluator, sampler, table);
    const MapErrors errors = real == Real::f32 ? map_errors<double>(sampler, table, results, real)
                                               : map_errors<long double>(sampler, table, results, real);
    const double factor = slack(options.math), loose = invariant_slack(options.math);
    const bool world = column(sampler, "n_x") >= 0;
    const SamplerBounds& bounds = bounds_of(sampler, real).sampler;

    std::vector<Finding> findings;
    const auto add = [&](const char* check, double figure, double limit, const char* unit, const Errors& e) {
        findings.push_back(make_finding(check, figure, limit, unit, e, sampler, table));
    };
    const char* const unit = "eps (1 + cond)";
    add("pointwise, front, p99", errors.front.percentile(99), bounds.front * factor, unit, errors.front);
    if (errors.back.count())
        add("pointwise, back, p99", errors.back.percentile(99), bounds.back * factor, unit, errors.back);
    if (errors.level.count())
        add("pointwise, at the horizon, p99", errors.level.percentile(99), bounds.front * factor, unit,
            errors.level);
    add("pointwise, core, p99.9", errors.core.percentile(99.9), bounds.core * factor, unit, errors.core);
    add("pointwise, core, maximum", errors.core.max(), bounds.core_max * factor, unit, errors.core);
    if (errors.outside.count())
        add("documented direction outside the domain", errors.outside.max(), 0, "rows", errors.outside);
    add("finite", errors.bad.max(), 0, "non-finite", errors.bad);
    add("unit length", errors.length.max(), length_bound(sampler.result) * loose, "eps", errors.length);
    if (errors.kept.count())
        add("lost where the exact sample is", errors.kept.percentile(99.9), 0, "rows", errors.kept);
    if (errors.below.count())
        add("normal above the surface", errors.below.max(), world ? side_bound() * loose : 0,
            world ? unit : "eps", errors.below);
    if (errors.behind.count())
        add("normal faces wo", errors.behind.max(), side_bound() * loose, "eps", errors.behind);
    return findings;
}

}  // namespace vndf::conformance
