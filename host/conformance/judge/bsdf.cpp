#include "conformance/judge/bsdf.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "conformance/inputs/rows.h"
#include "conformance/judge/errors.h"
#include "conformance/judge/statistics.h"
#include "conformance/judge/user.h"
#include "splitmix64.h"

namespace vndf::conformance {
namespace {

constexpr double pi = 3.14159265358979323846;
constexpr std::size_t samples = bsdf_samples;
constexpr double smallest_alpha = 0.1;  // of lobes that the grid resolves
constexpr double furnace_limit = 1.002, typical = 1e-3, rare = 0.1;
constexpr double quadrature_error = 1e-3, most_deviations = 6.5;  // of mean weights

using Columns = std::vector<std::vector<double>>;

// Bins of the sphere in equal steps of theta and phi, with the midpoints of many parts of each.
struct Grid {
    static constexpr int theta = 24, phi = 48, fine = 8, bins = theta * phi;
    std::vector<Direction> node;
    std::vector<double> weight;
    std::vector<int> bin;
    reference::Bins edges;
    Grid() {
        constexpr double step_t = pi / (theta * fine), step_p = 2 * pi / (phi * fine);
        for (int t = 0; t < theta * fine; ++t)
            for (int p = 0; p < phi * fine; ++p) {
                node.push_back(direction(std::cos((t + .5) * step_t), (p + .5) * step_p));
                weight.push_back((std::cos(t * step_t) - std::cos((t + 1) * step_t)) * step_p);
                bin.push_back(t / fine * phi + p / fine);
            }
        for (int t = 0; t <= theta; ++t) edges.theta.push_back(t * fine * step_t);
        for (int p = 0; p <= phi; ++p) edges.phi.push_back(p * fine * step_p);
    }
    // `bins` for what is no direction.
    static int bin_of(const Direction& w) {
        if (!std::isfinite(dot(w, w))) return bins;
        const double turn = std::atan2(w[1], w[0]) / (2 * pi);
        const int t = static_cast<int>(std::acos(std::clamp(w[2], -1., 1.)) / pi * theta);
        const int p = static_cast<int>((turn < 0 ? turn + 1 : turn) * phi);
        return std::min(t, theta - 1) * phi + std::min(p, phi - 1);
    }
};

// A wi for each of the points, as the inputs of a value or a density.
Table pairs(const Function& function, std::vector<Point> points, const Columns& wi, Real real) {
    for (std::size_t i = 0; i < points.size(); ++i) points[i].wi = {wi[0][i], wi[1][i], wi[2][i]};
    return tabulate(function, points, real);
}

// The inputs of a sampler, whose third random number chooses a lobe.
Table draws(const Function& sample, const std::vector<Point>& points, std::uint64_t seed, Real real) {
    SplitMix64 random(seed);
    Table table;
    for (const std::string& name : sample.inputs) {
        std::vector<double>& column = table.columns.emplace_back();
        for (const Point& point : points)
            column.push_back(name[0] == 'u' ? 0 : rounded(point.scalar(name), real));
    }
    for (std::size_t i = 0; i < points.size(); ++i)
        for (std::size_t k = 1; k <= 3; ++k)
            table.columns[table.columns.size() - k][i] = static_cast<double>(random.bits() >> 40) * 0x1p-24;
    return table;
}

// What the function makes of row i of its inputs.
Finding::Value value_at(const Function& function, const Table& inputs, const Columns& results,
                        std::size_t i) {
    Finding::Value value{&function, inputs.row(i), {}};
    for (const std::vector<double>& column : results) value.result.push_back(column[i]);
    return value;
}

// Values of several functions at the same points.
struct Evaluated {
    const Function& function;
    const Table& inputs;
    const Columns& results;
};

// The finding that `figure`, of errors in the results of the first of these functions, stays below `limit`; the others are what it
// is compared with.
Finding found(std::string check, double figure, double limit, const char* unit, const Errors& errors,
              const std::vector<Evaluated>& functions) {
    const Evaluated& first = functions.front();
    Finding finding =
        make_finding(std::move(check), figure, limit, unit, errors, first.function, first.inputs);
    if (errors.count() == 0) return finding;
    for (const auto& [function, inputs, results] : functions)
        finding.beside.push_back(value_at(function, inputs, results, errors.worst_row()));
    finding.result = finding.beside.front().result;
    finding.beside.erase(finding.beside.begin());
    return finding;
}

// A histogram whose expectations can be drawn: nothing where the density is no number.
CellCounts drawable(const std::vector<std::uint32_t>& counts, std::vector<double> expected) {
    for (double& e : expected)
        if (!std::isfinite(e) || e < 0) e = 0;
    return {counts, std::move(expected)};
}

std::vector<Point> lobes_of(const Scope& scope, bool quick) {
    const double high = std::max(std::min(scope.alpha.high, 1.0), scope.alpha.low),
                 low = std::max(scope.alpha.low, smallest_alpha), middle = std::sqrt(low * high);
    std::vector<std::array<double, 2>> alphas{{high, high}, {middle, middle}, {low, low}};
    if (!scope.isotropic) alphas.insert(alphas.end(), {{high, middle}, {low, middle}});
    std::vector<Point> points;
    if (high < smallest_alpha) return points;
    for (const auto& alpha : alphas)
        for (const auto& wo : {direction(.95, .3), direction(.6, 2), direction(.15, -1)})
            points.push_back(make_point(wo, alpha, {1, 0}, {0, 0, 1}, {.5, .5}, 1.5));
    if (!quick) return points;
    std::vector<Point> some;  // each alpha, through the views in turn
    for (std::size_t i = 0; i < points.size(); i += 4) some.push_back(points[i]);
    return some;
}

class Check {
  public:
    Check(runtime::DeviceEvaluator& evaluator, const Function& value, const Function& density,
          const Function& sample, const Scope& scope, bool quick, std::size_t rows, std::uint64_t seed,
          double family_rate)
        : evaluator_(evaluator),
          value_(value),
          density_(density),
          sample_(sample),
          seed_(seed),
          real_(evaluator.input_real()) {
        Scope front = scope;
        front.domain = Domain::upper;
        points_ = scoped_points(value, front, rows, seed);
        check_values();
        check_samples();
        check_lobes(lobes_of(front, quick), family_rate);
    }
    BsdfFindings findings;

  private:
    // Finite and not negative; the same for both directions exchanged, of those above the surface.
    void check_values() {
        std::vector<Point> turned = points_;
        for (Point& point : turned) std::swap(point.wo, point.wi);
        const Table there = tabulate(value_, points_, real_), back = tabulate(value_, turned, real_),
                    density = tabulate(density_, points_, real_);
        const Columns values = evaluate(evaluator_, value_, there),
                      values_back = evaluate(evaluator_, value_, back),
                      densities = evaluate(evaluator_, density_, density);
        Errors bad, bad_density, reciprocal, without_cosine;
        for (std::size_t i = 0; i < points_.size(); ++i) {
            const double f = values[0][i], f_back = values_back[0][i], p = densities[0][i];
            bad.add(std::isfinite(f) && f >= 0 ? 0 : 1, i);
            bad_density.add(std::isfinite(p) && p >= 0 ? 0 : 1, i);
            if (!(points_[i].wi[2] > .01) || !(points_[i].wo[2] > .01)) continue;
            const double a = f * points_[i].wo[2], b = f_back * points_[i].wi[2];
            if (a > 1e-20 || b > 1e-20) reciprocal.add(std::abs(a - b) / std::max(a, b), i);
            if (f > 1e-20 || f_back > 1e-20)
                without_cosine.add(std::abs(f - f_back) / std::max(f, f_back), i);
        }
        findings.value.push_back(
            found("finite and not negative", bad.max(), 0, "rows", bad, {{value_, there, values}}));
        findings.density.push_back(found("finite and not negative", bad_density.max(), 0, "rows", bad_density,
                                         {{density_, density, densities}}));
        add_errors(findings.value, "reciprocity", reciprocal,
                   {{value_, there, values}, {value_, back, values_back}});
        if (reciprocal.percentile(50) > typical && without_cosine.percentile(50) < typical)
            findings.diagnosis = "the value lacks the cosine of wi: without it it is reciprocal";
    }

    // Unit vectors; weight is value over density.
    void check_samples() {
        const Table table = draws(sample_, points_, seed_, real_);
        const Columns d = evaluate(evaluator_, sample_, table);
        const Table value_table = pairs(value_, points_, d, real_),
                    density_table = pairs(density_, points_, d, real_);
        const Columns f = evaluate(evaluator_, value_, value_table),
                      p = evaluate(evaluator_, density_, density_table);
        Errors bad, size, weight;
        std::vector<double> ratio, with_cosine, over_cosine;
        for (std::size_t i = 0; i < points_.size(); ++i) {
            const Direction w{d[0][i], d[1][i], d[2][i]};
            const bool finite = std::isfinite(dot(w, w)) && std::isfinite(d[3][i]) && d[3][i] >= 0;
            bad.add(finite ? 0 : 1, i);
            if (!finite || d[3][i] == 0) continue;
            size.add(std::abs(length(w) - 1) / epsilon(real_), i);
            const double expected = f[0][i] / p[0][i];
            weight.add(std::abs(d[3][i] - expected) / std::max(d[3][i], expected), i);
            ratio.push_back(d[3][i] / expected);
            with_cosine.push_back(ratio.back() * std::abs(w[2])),
                over_cosine.push_back(ratio.back() / std::abs(w[2]));
        }
        findings.sample.push_back(
            found("finite and not negative", bad.max(), 0, "rows", bad, {{sample_, table, d}}));
        Finding unit =
            found("unit length", size.max(), length_bound("WI"), "eps", size, {{sample_, table, d}});
        unit.concern = unit.figure * epsilon(real_) > beyond_rounding ? Concern::wrong : Concern::inexact;
        findings.sample.push_back(unit);
        add_errors(findings.sample, "weight is value over density", weight,
                   {{sample_, table, d}, {value_, value_table, f}, {density_, density_table, p}});
        if (weight.percentile(50) > typical && findings.diagnosis.empty())
            findings.diagnosis = why_weights(ratio, with_cosine, over_cosine);
    }

    static std::string why_weights(std::vector<double> ratio, std::vector<double> with_cosine,
                                   std::vector<double> over_cosine) {
        const auto constant = [](std::vector<double>& all) {
            std::sort(all.begin(), all.end());
            const std::size_t n = all.size();
            return n > 0 && all[n - 1 - n / 20] - all[n / 20] < 2e-3 * all[n / 2] ? all[n / 2] : 0;
        };
        if (const double c = constant(ratio); c > 0)
            return fmt::format("weights are {:.4g} times value over density: a factor in one of the three",
                               c);
        if (constant(with_cosine) > 0) return "weights lack the cosine of wi that the value has";
        if (constant(over_cosine) > 0) return "weights have a cosine of wi that the value lacks";
        return {};
    }

    // What quadrature finds in a lobe: all light that is reflected, the integral of the density, and how many samples each bin is
    // to have, with one more for those that are lost.
    struct Expected {
        double light = 0, total = 0;
        std::vector<double> counts = std::vector<double>(Grid::bins + 1);
    };
    Expected expectation(const Grid& grid, const Point& lobe) {
        std::vector<Point> nodes(grid.node.size(), lobe);
        for (std::size_t i = 0; i < nodes.size(); ++i) nodes[i].wi = grid.node[i];
        const Table inputs = tabulate(value_, nodes, real_);
        const std::vector<double> f = evaluate(evaluator_, value_, inputs).front(),
                                  p = evaluate(evaluator_, density_, inputs).front();
        Expected e;
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            e.light += f[i] * grid.weight[i], e.total += p[i] * grid.weight[i];
            // What is drawn where nothing is reflected is lost, with what is drawn nowhere.
            e.counts[f[i] > 0 ? grid.bin[i] : Grid::bins] +=
                p[i] * grid.weight[i] * static_cast<double>(samples);
        }
        e.counts.back() += std::max(0.0, 1 - e.total) * static_cast<double>(samples);
        return e;
    }

    // Samples against the density, and all light against what is reflected of it, by quadrature and by samples. The tests are of
    // the value, of the density, and two of the sampler.
    LobePicture judged(const Grid& grid, const Point& lobe, double level) {
        const Expected expected = expectation(grid, lobe);
        const Table inputs = draws(sample_, std::vector<Point>(samples, lobe), ++seed_, real_);
        const Columns d = evaluate(evaluator_, sample_, inputs);
        std::vector<std::uint32_t> counts(Grid::bins + 1);
        Sums weights;
        for (std::size_t i = 0; i < samples; ++i) {
            ++counts[d[3][i] > 0 ? Grid::bin_of({d[0][i], d[1][i], d[2][i]}) : Grid::bins];
            weights.add(d[3][i]);
        }
        const double n = static_cast<double>(samples), average = weights.sum / n;
        const double error = std::sqrt(std::max(weights.squares / n - average * average, 1e-9) / n);
        const double difference = average - expected.light, beyond = std::abs(difference) - quadrature_error;
        const ChiSquare chi = chi_square(counts, expected.counts, 16);

        LobePicture picture;
        picture.row = inputs.row(0);
        picture.directions = drawable(counts, expected.counts), picture.bins = grid.edges;
        picture.means = {{"weight", difference, quadrature_error + most_deviations * error, error}};
        picture.notes = {fmt::format("all light: {:.5g} reflected, by quadrature", expected.light),
                         fmt::format("mean weight: {:.5g} ± {:.2g}", average, error),
                         fmt::format("integral of the density: {:.5g}", expected.total),
                         fmt::format("χ² {:.1f} in {} cells", chi.statistic, chi.degrees + 1),
                         fmt::format("expected in no cell: {:.0f}", expected.counts.back())};
        picture.tests = {
            {"furnace", false, expected.light, "all light from everywhere, by quadrature of the value",
             furnace_limit, "of the light"},
            {"integral", false, expected.total, "by quadrature over the sphere", furnace_limit, ""},
            {fmt::format("chi2 of the samples against {}", density_.name), true, chi.p,
             fmt::format("chi2 {:.1f} with {} degrees", chi.statistic, chi.degrees), level},
            {"mean weight is the light reflected", false,
             beyond <= 0 ? 0 : beyond / error,  // NaN stays
             fmt::format("{:.5g} by samples, {:.5g} by quadrature", average, expected.light), most_deviations,
             "standard errors"}};
        return picture;
    }

    void check_lobes(const std::vector<Point>& lobes, double family_rate) {
        static const Grid grid;
        findings.tests = lobes.size();
        const double level = sidak(family_rate, lobes.size());
        WorstLobes value(sample_), density(sample_), sample(sample_);
        for (const Point& lobe : lobes) {
            const LobePicture& seen = findings.pictures.emplace_back(judged(grid, lobe, level));
            value.add(seen.tests[0], seen.row), density.add(seen.tests[1], seen.row);
            sample.add(seen.tests[2], seen.row), sample.add(seen.tests[3], seen.row);
        }
        value.append_to(findings.value), density.append_to(findings.density);
        sample.append_to(findings.sample);
        if (findings.diagnosis.empty()) findings.diagnosis = why();
    }

    // The first finding of this name that says that something is wrong.
    static const Finding* failed(const std::vector<Finding>& all, const std::string& check) {
        const auto found = std::find_if(all.begin(), all.end(), [&](const Finding& f) {
            return f.concern == Concern::wrong && !f.passed() && f.check.starts_with(check);
        });
        return found == all.end() ? nullptr : &*found;
    }

    std::string why() const {
        for (const auto& [all, function] : {std::pair(&findings.value, &value_),
                                            {&findings.density, &density_},
                                            {&findings.sample, &sample_}})
            if (failed(*all, "finite"))
                return fmt::format("{} gives what is no number, or negative", function->name);
        if (failed(findings.sample, "unit length"))
            return "samples are no unit vectors: not normalised, or reflected about a normal that faces away "
                   "as if it faced wo";
        if (failed(findings.value, "furnace"))
            return "more light is reflected than there is: masking and shadowing (G2) are left out, or a "
                   "factor is too large";
        if (const Finding* whole = failed(findings.density, "integral"))
            return fmt::format("{} is no density: it integrates to {:.4g}", density_.name, whole->figure);
        if (failed(findings.value, "reciprocity"))
            return "masking or shadowing of one of the two directions is left out (G1 in place of G2)";
        if (failed(findings.sample, "chi2"))
            return fmt::format("the samples do not follow {}, which is the density of others", density_.name);
        return {};
    }

    // Typical and rare relative errors that are no longer rounding.
    static void add_errors(std::vector<Finding>& to, const std::string& check, const Errors& errors,
                           const std::vector<Evaluated>& functions) {
        to.push_back(
            found(check + ", median", errors.percentile(50), typical, "relative", errors, functions));
        to.push_back(found(check + ", p99", errors.percentile(99), rare, "relative", errors, functions));
    }

    runtime::DeviceEvaluator& evaluator_;
    const Function &value_, &density_, &sample_;
    std::uint64_t seed_;
    Real real_;
    std::vector<Point> points_;
};

}  // namespace

BsdfFindings check_bsdf(runtime::DeviceEvaluator& evaluator, const Function& value, const Function& density,
                        const Function& sample, const Scope& scope, bool quick, std::size_t rows,
                        std::uint64_t seed, double family_rate) {
    return Check(evaluator, value, density, sample, scope, quick, rows, seed, family_rate).findings;
}

}  // namespace vndf::conformance
