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

using Columns = std::vector<std::vector<double>>;

// Bins of the sphere in theta and phi, with the midpoints of many parts of each.
struct Grid {
    static constexpr int theta = 24, phi = 48, fine = 8, bins = theta * phi;
    std::vector<Direction> node;
    std::vector<double> weight;
    std::vector<int> bin;
    Grid() {
        constexpr double step_t = pi / (theta * fine), step_p = 2 * pi / (phi * fine);
        for (int t = 0; t < theta * fine; ++t)
            for (int p = 0; p < phi * fine; ++p) {
                node.push_back(direction(std::cos((t + .5) * step_t), (p + .5) * step_p));
                weight.push_back((std::cos(t * step_t) - std::cos((t + 1) * step_t)) * step_p);
                bin.push_back(t / fine * phi + p / fine);
            }
    }
    static int bin_of(const Direction& w) {
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

Finding finding_of(std::string check, double figure, double limit, const char* unit, std::string where,
                   std::size_t count) {
    Finding finding;
    finding.check = std::move(check), finding.figure = figure, finding.limit = limit, finding.unit = unit;
    finding.worst = std::move(where), finding.count = count;
    return finding;
}

// The worst of a figure over lobes; NaN is.
void keep_worst(Finding& finding, double figure, const std::string& detail, const std::string& where) {
    ++finding.count;
    if (std::isnan(figure)) figure = std::numeric_limits<double>::infinity();
    const bool worse = finding.is_p ? figure < finding.figure : figure > finding.figure;
    if (worse || finding.worst.empty())
        finding.figure = figure, finding.detail = detail, finding.worst = where;
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
        const Table there = tabulate(value_, points_, real_), density = tabulate(density_, points_, real_);
        std::vector<Point> turned = points_;
        for (Point& point : turned) std::swap(point.wo, point.wi);
        const std::vector<double> f = evaluate(evaluator_, value_, there).front(),
                                  back =
                                      evaluate(evaluator_, value_, tabulate(value_, turned, real_)).front(),
                                  p = evaluate(evaluator_, density_, density).front();
        Errors bad, bad_density, reciprocal, without_cosine;
        for (std::size_t i = 0; i < points_.size(); ++i) {
            bad.add(std::isfinite(f[i]) && f[i] >= 0 ? 0 : 1, i);
            bad_density.add(std::isfinite(p[i]) && p[i] >= 0 ? 0 : 1, i);
            if (!(points_[i].wi[2] > .01) || !(points_[i].wo[2] > .01)) continue;
            const double a = f[i] * points_[i].wo[2], b = back[i] * points_[i].wi[2];
            if (a > 1e-20 || b > 1e-20) reciprocal.add(std::abs(a - b) / std::max(a, b), i);
            if (f[i] > 1e-20 || back[i] > 1e-20)
                without_cosine.add(std::abs(f[i] - back[i]) / std::max(f[i], back[i]), i);
        }
        findings.value.push_back(
            make_finding("finite and not negative", bad.max(), 0, "rows", bad, value_, there));
        findings.density.push_back(make_finding("finite and not negative", bad_density.max(), 0, "rows",
                                                bad_density, density_, density));
        add_errors(findings.value, "reciprocity", reciprocal, value_, there);
        if (reciprocal.percentile(50) > typical && without_cosine.percentile(50) < typical)
            findings.diagnosis = "the value lacks the cosine of wi: without it it is reciprocal";
    }

    // Unit vectors; weight is value over density.
    void check_samples() {
        const Table table = draws(sample_, points_, seed_, real_);
        const Columns d = evaluate(evaluator_, sample_, table);
        const std::vector<double> f = evaluate(evaluator_, value_, pairs(value_, points_, d, real_)).front(),
                                  p = evaluate(evaluator_, density_, pairs(density_, points_, d, real_))
                                          .front();
        Errors bad, size, weight;
        std::vector<double> ratio, with_cosine, over_cosine;
        for (std::size_t i = 0; i < points_.size(); ++i) {
            const Direction w{d[0][i], d[1][i], d[2][i]};
            const bool finite = std::isfinite(dot(w, w)) && std::isfinite(d[3][i]) && d[3][i] >= 0;
            bad.add(finite ? 0 : 1, i);
            if (!finite || d[3][i] == 0) continue;
            size.add(std::abs(length(w) - 1) / epsilon(real_), i);
            const double expected = f[i] / p[i];
            weight.add(std::abs(d[3][i] - expected) / std::max(d[3][i], expected), i);
            ratio.push_back(d[3][i] / expected);
            with_cosine.push_back(ratio.back() * std::abs(w[2])),
                over_cosine.push_back(ratio.back() / std::abs(w[2]));
        }
        findings.sample.push_back(
            make_finding("finite and not negative", bad.max(), 0, "rows", bad, sample_, table));
        Finding unit =
            make_finding("unit length", size.max(), length_bound("WI"), "eps", size, sample_, table);
        unit.concern = unit.figure * epsilon(real_) > beyond_rounding ? Concern::wrong : Concern::inexact;
        findings.sample.push_back(unit);
        add_errors(findings.sample, "weight is value over density", weight, sample_, table);
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

    // Samples against the density, and all light against what is reflected of it, by quadrature and by samples.
    void check_lobes(const std::vector<Point>& lobes, double family_rate) {
        static const Grid grid;
        findings.tests = lobes.size();
        Finding chi2 = finding_of(fmt::format("chi2 of the samples against {}", density_.name), 1,
                                  sidak(family_rate, std::max<std::size_t>(1, lobes.size())), "probability",
                                  {}, 0),
                furnace = finding_of("furnace", 0, furnace_limit, "of the light", {}, 0),
                mean = finding_of("mean weight is the light reflected", 0, 6.5, "standard errors", {}, 0),
                whole = finding_of("integral", 0, furnace_limit, "", {}, 0);
        chi2.is_p = true;
        for (const Point& lobe : lobes) {
            std::vector<Point> nodes(grid.node.size(), lobe);
            for (std::size_t i = 0; i < nodes.size(); ++i) nodes[i].wi = grid.node[i];
            const Table inputs = tabulate(value_, nodes, real_);
            const std::vector<double> f = evaluate(evaluator_, value_, inputs).front(),
                                      p = evaluate(evaluator_, density_, inputs).front();
            // What is drawn where nothing is reflected is lost, with what is drawn nowhere.
            std::vector<double> expected(Grid::bins + 1);
            double light = 0, total = 0;
            for (std::size_t i = 0; i < nodes.size(); ++i) {
                light += f[i] * grid.weight[i], total += p[i] * grid.weight[i];
                expected[f[i] > 0 ? grid.bin[i] : Grid::bins] +=
                    p[i] * grid.weight[i] * static_cast<double>(samples);
            }
            expected.back() += std::max(0.0, 1 - total) * static_cast<double>(samples);

            const Columns d = evaluate(evaluator_, sample_,
                                       draws(sample_, std::vector<Point>(samples, lobe), ++seed_, real_));
            std::vector<std::uint32_t> counts(Grid::bins + 1);
            Sums weights;
            for (std::size_t i = 0; i < samples; ++i) {
                ++counts[d[3][i] > 0 ? Grid::bin_of({d[0][i], d[1][i], d[2][i]}) : Grid::bins];
                weights.add(d[3][i]);
            }
            const std::string where =
                fmt::format("wo=({:.6g},{:.6g},{:.6g}) alpha=({:.6g},{:.6g})", lobe.wo[0], lobe.wo[1],
                            lobe.wo[2], lobe.alpha[0], lobe.alpha[1]);
            const ChiSquare chi = chi_square(counts, expected, 16);
            keep_worst(chi2, chi.p, fmt::format("chi2 {:.1f} with {} degrees", chi.statistic, chi.degrees),
                       where);
            keep_worst(furnace, light, "all light from everywhere, by quadrature of the value", where);
            keep_worst(whole, total, "by quadrature over the sphere", where);
            const double n = static_cast<double>(samples), average = weights.sum / n;
            const double error = std::sqrt(std::max(weights.squares / n - average * average, 1e-9) / n);
            keep_worst(mean, std::max(0.0, std::abs(average - light) - 1e-3) / error,
                       fmt::format("{:.5g} by samples, {:.5g} by quadrature", average, light), where);
        }
        if (lobes.empty()) return;
        findings.value.push_back(furnace);
        findings.density.push_back(whole);
        findings.sample.insert(findings.sample.end(), {chi2, mean});
        if (findings.diagnosis.empty()) findings.diagnosis = why(furnace, whole, chi2);
    }

    std::string why(const Finding& furnace, const Finding& whole, const Finding& chi2) const {
        const auto fails = [](const std::vector<Finding>& all, const std::string& check) {
            return std::any_of(all.begin(), all.end(), [&](const Finding& f) {
                return f.concern == Concern::wrong && !f.passed() && f.check.starts_with(check);
            });
        };
        if (fails(findings.sample, "unit length"))
            return "samples are no unit vectors: not normalised, or reflected about a normal that faces away "
                   "as if it faced wo";
        if (!furnace.passed())
            return "more light is reflected than there is: masking and shadowing (G2) are left out, or a "
                   "factor is too large";
        if (!whole.passed())
            return fmt::format("{} is no density: it integrates to {:.4g}", density_.name, whole.figure);
        if (fails(findings.value, "reciprocity"))
            return "masking or shadowing of one of the two directions is left out (G1 in place of G2)";
        if (!chi2.passed())
            return fmt::format("the samples do not follow {}, which is the density of others", density_.name);
        return {};
    }

    // Typical and rare relative errors that are no longer rounding.
    static void add_errors(std::vector<Finding>& to, const std::string& check, const Errors& errors,
                           const Function& function, const Table& table) {
        to.push_back(make_finding(check + ", median", errors.percentile(50), typical, "relative", errors,
                                  function, table));
        to.push_back(
            make_finding(check + ", p99", errors.percentile(99), rare, "relative", errors, function, table));
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
