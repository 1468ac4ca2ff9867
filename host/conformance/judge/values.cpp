#include "conformance/judge/values.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "parallel.h"
#include "conformance/inputs/rows.h"

namespace vndf::conformance {
namespace {

// The exponent of the Beckmann function: of its normal or slope, or of the angle of its direction.
double exponent(const Function& function, const RowReader& reader, const double* row) {
    const auto alpha = reader.alpha(row);
    if (const int slope = column(function, "slope_x"); slope >= 0)
        return beckmann_exponent({row[slope], row[slope + 1], 1}, alpha);
    const RowReader::Local local = reader.local(row);
    if (local.has_wm) return beckmann_exponent(local.wm, alpha);
    const Direction &wo = local.wo, &wi = local.wi;
    if (function.kind == Kind::density || function.kind == Kind::pair)
        return beckmann_exponent({wo[0] + wi[0], wo[1] + wi[1], wo[2] + wi[2]}, alpha);
    const auto angle = [&](const Direction& w) {  // cot^2 of the stretched angle
        const double x = alpha[0] * w[0], y = alpha[1] * w[1];
        return w[2] * w[2] / (x * x + y * y);
    };
    // Seen from above sigma and the shadowing terms are sums of 1 and what the exponential leaves: its error is theirs no
    // more.
    const bool from_above = wo[2] >= 0 && (!local.has_wi || wi[2] >= 0);
    if (from_above && !function.model.starts_with("vndf_beckmann_lambda")) return 0;
    return local.has_wi ? std::max(angle(wo), angle(wi)) : angle(wo);
}

// How much wo . wm loses to cancellation, which literal arguments do not help.
double cancellation(const RowReader& reader, const double* row) {
    if (!reader.has_wo() || !reader.has_wm()) return 1;
    const Direction o = reader.wo(row), m = reader.wm(row);
    const double terms = std::abs(o[0] * m[0]) + std::abs(o[1] * m[1]) + std::abs(o[2] * m[2]);
    return std::max(1.0, terms / std::abs(dot(o, m)));
}

// What n . w, in twice the precision, has lost where it is all but 0: 1 as long as more than a unit is left.
double grazing(const RowReader& reader, const double* row, double unit) {
    if (!reader.has_n()) return 1;
    const Direction n = reader.n(row);
    double lost = 1;
    for (const auto& [has, w] : {std::pair{true, reader.wo(row)},
                                 {reader.has_wm(), reader.wm(row)},
                                 {reader.has_wi(), reader.wi(row)}})
        if (has && dot(n, w) != 0) lost = std::max(lost, unit / std::abs(dot(n, w)));
    return lost;
}

// Whether so little is left of the cosine between wi and the facet along h = wo + eta wi, in the Jacobian of their
// refraction, that the rounding of wi decides: less than a unit.
bool grazes(const Function& function, const RowReader& reader, const double* row, double jacobian,
            double unit) {
    const int column_of_eta = column(function, "eta");
    if (column_of_eta < 0 || function.result != "VALUE") return false;
    const Direction o = reader.wo(row), i = reader.wi(row);
    const double eta = row[column_of_eta];
    double square = 0;
    for (int k = 0; k < 3; ++k) square += std::pow(std::fma(eta, i[k], o[k]), 2);
    return jacobian * square / (eta * eta) < unit;
}

// Whether the reference's map takes its u back to the direction of this row, and that is the mirror image of wo. It is not
// where wi is below the horizon, or where rounding has left so little of the half vector h that wo . h is not |h|^2 / 2.
bool is_inverse(const Function& function, const RowReader& reader, const double* row, const double* u,
                reference::Precision precision) {
    const Direction o = reader.wo(row), d = reader.wi(row);
    const Direction h{o[0] + d[0], o[1] + d[1], o[2] + d[2]};
    if (!(std::abs(2 * dot(o, h) - dot(h, h)) < 0x1p-10 * dot(h, h))) return false;
    std::vector<double> in;
    for (const std::string& name : find_function(function.sampler)->inputs)
        in.push_back(name == "u1" ? u[0] : name == "u2" ? u[1] : row[column(function, name)]);
    double back[4];
    reference::find_evaluation<double>(function.sampler)(in.data(), back, precision);
    const Direction off{back[0] - d[0], back[1] - d[1], back[2] - d[2]};
    return length(off) < 0x1p-22;
}

struct Judge {
    const Function& function;
    const Table& table;
    const std::vector<std::vector<double>>& results;
    Real real;
    RowReader reader;
};

// |alpha wo|.
double stretched_length(const RowReader& reader, const double* row) {
    const Direction o = reader.wo(row);
    const auto alpha = reader.alpha(row);
    return std::hypot(alpha[0] * o[0], alpha[1] * o[1], o[2]);
}

// error / allowance, where NaN is the worst of errors and an infinite allowance no judgement (NaN).
double settle(double error, double allowance) {
    if (!std::isfinite(allowance)) return std::numeric_limits<double>::quiet_NaN();
    if (std::isnan(error)) return std::numeric_limits<double>::infinity();
    return error == 0 ? 0 : error / allowance;
}

// The error of a result of this size, off by this difference, in its unit; NaN if it is not judged.
template <class R>
double error_of(const Judge& j, const double* row, const R* exact, const R& size, const R& difference) {
    constexpr double skip = std::numeric_limits<double>::quiet_NaN();
    const double unit = epsilon(j.real), smallest = j.real == Real::f32 ? 0x1p-126 : 0x1p-1022;
    const double largest = j.real == Real::f32 ? 0x1.fffffep127 : 0x1.fffffffffffffp1023;
    // Near the sign of a rounded product and outside the range of the type there is no relative error.
    const double lost = cancellation(j.reader, row);
    if (!(lost * unit < 0.01) || !std::isfinite(size) || size >= largest) return skip;
    if (at_edge(j.function, row, j.real)) return skip;
    if (grazes(j.function, j.reader, row, static_cast<double>(exact[0]), unit)) return skip;
    if (j.function.kind == Kind::inverse) {
        const double u[2] = {static_cast<double>(exact[0]), static_cast<double>(exact[1])};
        if (!is_inverse(j.function, j.reader, row, u, precision(j.real))) return skip;
    }
    if (size < smallest && difference <= 2 * smallest) return 0;
    if (j.function.unit == Unit::area) {
        // In float alphas that are so small, or so far apart, count as others.
        const auto [alpha_x, alpha_y] = j.reader.alpha(row);
        const double least = 1e-6 + 0x1p-17 * std::max(alpha_x, alpha_y);
        if (j.real == Real::f32 && std::min(alpha_x, alpha_y) < least) return skip;
        if (reference::rim_margin(j.function.model, row, precision(j.real)) < 0x1p-8) return skip;
        const auto evaluation = reference::find_evaluation<double>(j.function.model);
        const double condition = absolute_condition(j.function, evaluation, row, precision(j.real));
        return settle(static_cast<double>(difference), unit * (stretched_length(j.reader, row) + condition));
    }
    if (j.function.unit == Unit::condition) {
        const auto evaluation = reference::find_evaluation<double>(j.function.model);
        double condition = absolute_condition(j.function, evaluation, row, precision(j.real));
        // In double a lobe may be narrower than a rounding error of float.
        if (j.real == Real::f64)
            condition = std::max(
                condition, absolute_condition(j.function, evaluation, row, precision(j.real), -1, 0x1p-38));
        if (j.function.kind == Kind::inverse && !is_settled(condition)) return skip;
        return settle(static_cast<double>(difference), unit * (static_cast<double>(size) + condition));
    }
    if (size < smallest) return std::numeric_limits<double>::infinity();
    double allowance = lost * grazing(j.reader, row, unit);
    if (j.function.unit == Unit::exponent) allowance *= 1 + 2 * exponent(j.function, j.reader, row);
    return settle(static_cast<double>(difference / size), unit * allowance);
}

// The error of row i in its unit; NaN if the row is not judged. Of a pair each number counts alone: one may be a million
// times the other.
template <class R>
double error_at(const Judge& j, std::size_t i) {
    const std::vector<double> row = j.table.row(i);
    const std::vector<R> in(row.begin(), row.end());
    R exact[4];
    reference::find_evaluation<R>(j.function.model)(in.data(), exact, precision(j.real));
    double worst = std::numeric_limits<double>::quiet_NaN();
    R size = 0, difference = 0;
    for (std::size_t k = 0; k < j.function.outputs.size(); ++k) {
        R delta = static_cast<R>(j.results[k][i]) - exact[k];
        if (j.function.outputs[k] == "u1") delta -= std::nearbyint(delta);  // an azimuth
        size += exact[k] * exact[k];
        difference += delta * delta;
        if (j.function.kind == Kind::pair)
            worst = std::fmax(worst,
                              error_of<R>(j, row.data(), exact, R(std::abs(exact[k])), R(std::abs(delta))));
    }
    if (j.function.kind == Kind::pair) return worst;
    return error_of<R>(j, row.data(), exact, R(std::sqrt(size)), R(std::sqrt(difference)));
}

template <class R>
Errors judged_errors(const Judge& judge) {
    std::vector<Errors> parts(thread_count());
    parallel_for(judge.table.rows(), 256, [&](unsigned thread, std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const double error = error_at<R>(judge, i);
            if (!std::isnan(error)) parts[thread].add(error, i);
        }
    });
    for (std::size_t i = 1; i < parts.size(); ++i) parts[0].merge(parts[i]);
    return parts[0];
}

}  // namespace

Errors value_errors(runtime::Evaluator& evaluator, const Function& function, const Table& table) {
    const Real real = evaluator.input_real();
    const auto results = evaluate(evaluator, function, table);
    const Judge judge{function, table, results, real, RowReader(function)};
    return real == Real::f32 ? judged_errors<double>(judge) : judged_errors<long double>(judge);
}

std::vector<Finding> check_values(runtime::Evaluator& evaluator, const Function& function,
                                  const PointwiseOptions& options) {
    const Real real = evaluator.input_real();
    const Table table = pointwise_table(function, real, options);
    const auto results = evaluate(evaluator, function, table);
    const Judge judge{function, table, results, real, RowReader(function)};
    const Errors errors =
        real == Real::f32 ? judged_errors<double>(judge) : judged_errors<long double>(judge);
    Errors bad;
    const bool density = function.kind == Kind::density || function.kind == Kind::pair;
    for (std::size_t i = 0; i < table.rows(); ++i)
        for (const auto& column : results)
            bad.add(std::isfinite(column[i]) && (!density || column[i] >= 0) ? 0 : 1, i);

    const double limit = bounds_of(function, real).error * slack(options.math);
    // Where rounding has erased the half vector, the differences that measure the condition of an inverse lie beyond the
    // clamps of u and show none of it: its few worst rows say nothing.
    // Areas between arcs lose digits where alphas are 1e5 apart and where a small arc is next to -wo.
    const bool most = function.kind == Kind::inverse || function.unit == Unit::area;
    return {make_finding(most ? "pointwise, p99" : "pointwise, maximum",
                         most ? errors.percentile(99) : errors.max(), limit,
                         std::string(to_string(function.unit)), errors, function, table),
            make_finding(density ? "finite and not negative" : "finite", bad.max(), 0, "rows", bad, function,
                         table)};
}

}  // namespace vndf::conformance
