#include "conformance/judge/extremes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "conformance/inputs/grids.h"
#include "conformance/inputs/rows.h"

namespace vndf::conformance {
namespace {

using Columns = std::vector<std::vector<double>>;

// Numbers of any size that the type has, subnormal ones included, and its special ones.
class Sizes {
  public:
    explicit Sizes(Real real) : f32_(real == Real::f32) {}

    double largest() const {
        return f32_ ? std::numeric_limits<float>::max() : std::numeric_limits<double>::max();
    }

    double number() {
        const int least = f32_ ? -149 : -1074, end = f32_ ? 127 : 1023;
        const double sign = engine_() % 2 ? 1 : -1;
        switch (engine_() % 8) {
            case 0:
                return sign * 0.0;
            case 1:
                return sign * largest();
            default:
                return sign * std::ldexp(1 + static_cast<double>(engine_() >> 41) * 0x1p-23,
                                         least + static_cast<int>(engine_() % (end - least)));
        }
    }
    bool chance() { return engine_() % 2; }

  private:
    bool f32_;
    std::mt19937_64 engine_{1};
};

// "wo" of "wo_x"; a scalar's own name.
std::string argument(const std::string& name) {
    return name.substr(0, name.find('_') == name.size() - 2 ? name.size() - 2 : name.size());
}

// Every other argument replaced: a vector by one of another length, or component by component.
void make_extreme(const Function& function, Sizes& sizes, std::vector<double>& row) {
    for (std::size_t i = 0; i < row.size();) {
        std::size_t end = i + 1;
        while (end < row.size() && argument(function.inputs[end]) == argument(function.inputs[i])) ++end;
        const bool replaced = sizes.chance(), longer = end - i == 3 && sizes.chance();
        const double length = sizes.number();
        for (; i < end; ++i) {
            if (!replaced) continue;
            if (longer)
                row[i] *= std::abs(length);
            else if (sizes.chance())
                row[i] = sizes.number();
        }
    }
}

double not_finite(const Columns& results, std::size_t i) {
    return std::all_of(results.begin(), results.end(), [&](const auto& c) { return std::isfinite(c[i]); })
               ? 0
               : 1;
}

Finding finite(runtime::Evaluator& evaluator, const Function& function, const PointwiseOptions& options) {
    const Table table = extreme_table(function, evaluator.input_real(), options.random_points / 4);
    const Columns results = evaluate(evaluator, function, table);
    Errors errors;
    for (std::size_t i = 0; i < table.rows(); ++i) errors.add(not_finite(results, i), i);
    return make_finding("finite for finite arguments", errors.max(), 0, "non-finite", errors, function,
                        table);
}

double length_error(const Columns& results, std::size_t i) {
    return std::abs(length({results[0][i], results[1][i], results[2][i]}) - 1);
}

Finding unit(runtime::Evaluator& evaluator, const Function& sampler, const PointwiseOptions& options) {
    std::vector<Point> points = random_points(sampler, options.random_points / 8, options.seed);
    for (const Point& point : guard_points(sampler)) points.push_back(point);
    for (std::size_t i = 0; i < points.size(); ++i)
        for (double& x : points[i].wo) x *= std::array{1e-3, 0.03, 40.0, 1e3}[i % 4];
    const Real real = evaluator.input_real();
    const Table table = tabulate(sampler, points, real);
    const Columns results = evaluate(evaluator, sampler, table);
    Errors errors;
    const bool misses = may_miss(sampler);
    for (std::size_t i = 0; i < table.rows(); ++i)
        if (!misses || !reference::is_lost({results[0][i], results[1][i], results[2][i]}))
            errors.add(length_error(results, i) / epsilon(real), i);
    const double limit = length_bound(sampler.result) * invariant_slack(options.math);
    return make_finding("unit length for any length of wo", errors.max(), limit, "eps", errors, sampler,
                        table);
}

// wo = -n, where nothing is visible: a normal on the horizon, its reflection -wo, or (0, 0, 1) from a map that ends at the
// horizon; of a cap some unit vector; of what may miss a zero vector; with density 0.
Finding nothing_visible(runtime::Evaluator& evaluator, const Function& sampler,
                        const PointwiseOptions& options) {
    std::vector<Point> points;
    for (const auto& n : {Direction{0, 0, 1}, direction(0, 1.3), direction(-.9, .4), Direction{0, 0, -1}}) {
        if (column(sampler, "n_x") < 0 && n != Direction{0, 0, 1}) continue;
        for (const auto& alpha : {std::array{1e-8, 1e-8}, {.01, .01}, {1., 1.}, {.6, .1}, {.1, 1e3}})
            for (const double u1 : {0., .2, .5, .7, 1.})
                for (const double u2 : {0., .3, .5, .9, 1.}) {
                    Point point = make_point({0, 0, 1}, alpha, {1, 0}, n, {u1, u2}, 1.5);
                    point.wo = {-n[0], -n[1], -n[2]};
                    points.push_back(point);
                }
    }
    const Real real = evaluator.input_real();
    const Table table = tabulate(sampler, points, real);
    const Columns results = evaluate(evaluator, sampler, table);
    const RowReader reader(sampler);
    Errors errors;
    for (std::size_t i = 0; i < table.rows(); ++i) {
        const std::vector<double> row = table.row(i);
        const Direction d{results[0][i], results[1][i], results[2][i]}, n = reader.n(row.data());
        const bool anywhere = reader.has_cap() || may_miss(sampler);
        double off = may_miss(sampler) ? length(d) : length_error(results, i);
        if (!anywhere && (sampler.domain == Domain::upper || sampler.result == "WI"))
            off = std::max({off, std::abs(d[0]), std::abs(d[1]), std::abs(d[2] - 1)});
        else if (!anywhere)
            off = std::max(off, std::abs(dot(d, n)));
        if (sampler.with_pdf && results[3][i] != 0) off = 1;
        errors.add(off / epsilon(real), i);
    }
    return make_finding("as documented at wo = -n", errors.max(),
                        length_bound("WM") * invariant_slack(options.math), "eps", errors, sampler, table);
}

}  // namespace

Table extreme_table(const Function& function, Real real, std::size_t rows) {
    const Table plain = tabulate(function, random_points(function, rows, 1), real);
    Table table = plain;
    Sizes sizes(real);
    for (std::size_t i = 0; i < rows; ++i) {
        std::vector<double> row = plain.row(i);
        make_extreme(function, sizes, row);
        for (std::size_t j = 0; j < row.size(); ++j)
            table.columns[j][i] = rounded(std::clamp(row[j], -sizes.largest(), sizes.largest()), real);
    }
    return table;
}

std::vector<Finding> check_extremes(runtime::Evaluator& evaluator, const Function& function,
                                    const PointwiseOptions& options) {
    std::vector<Finding> findings{finite(evaluator, function, options)};
    if (function.kind != Kind::sampler || column(function, "wo_x") < 0) return findings;
    findings.push_back(unit(evaluator, function, options));
    findings.push_back(nothing_visible(evaluator, function, options));
    return findings;
}

}  // namespace vndf::conformance
