#include "conformance/judge/own_density.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "conformance/inputs/rows.h"
#include "conformance/judge/errors.h"
#include "conformance/judge/statistics.h"
#include "reference/distribution.h"
#include "splitmix64.h"

namespace vndf::conformance {
namespace {

constexpr std::size_t cells = 16, nodes = 12;  // either way, of the histogram and of a cell
constexpr std::size_t samples = std::size_t{1} << 17;
constexpr double pi = 3.14159265358979323846;

// A histogram of the stretched normals (x / alpha_x, y / alpha_y, z), or of the half vectors of reflections: in the cosine and
// the azimuth, in which every lobe is wide.
struct Quadrature {
    Table inputs;
    std::vector<double> weight;
    std::vector<std::size_t> cell;
};

// The density's integral over each cell, by midpoints. Stretching back makes alpha_x alpha_y / length^3 of a solid angle.
Quadrature quadrature(const Function& density, const Point& lobe, Real real) {
    constexpr std::size_t fine = cells * nodes;
    constexpr double step = 1.0 / fine, turn = 2 * pi * step;
    const bool reflected = column(density, "wi_x") >= 0;
    Quadrature q;
    std::vector<Point> points;
    for (std::size_t i = 0; i < fine; ++i)
        for (std::size_t j = 0; j < fine; ++j) {
            const double cosine = (static_cast<double>(i) + .5) * step,
                         phi = (static_cast<double>(j) + .5) * turn, sine = std::sqrt(1 - cosine * cosine);
            Direction m{lobe.alpha[0] * sine * std::cos(phi), lobe.alpha[1] * sine * std::sin(phi), cosine};
            const double size = length(m);
            for (double& x : m) x /= size;
            Point point = lobe;
            point.wm = m;
            double weight = step * turn * lobe.alpha[0] * lobe.alpha[1] / (size * size * size);
            // A density of what a view does not see is asked for by nobody.
            const double c = dot(lobe.wo, m);
            if (column(density, "wo_x") >= 0 && !(c > 0)) continue;
            if (reflected) {
                for (int k = 0; k < 3; ++k) point.wi[k] = 2 * c * m[k] - lobe.wo[k];
                if (!(point.wi[2] > 0)) continue;
                weight *= 4 * c;
            }
            points.push_back(point);
            q.weight.push_back(weight);
            q.cell.push_back(i / nodes * cells + j / nodes);
        }
    q.inputs = tabulate(density, points, real);
    return q;
}

// The last cell is for what is in none: below, or a reflection below the horizon, where a density may be 0.
std::vector<std::uint32_t> histogram(const std::vector<std::vector<double>>& d, const Point& lobe,
                                     bool reflected) {
    std::vector<std::uint32_t> counts(cells * cells + 1);
    for (std::size_t i = 0; i < samples; ++i) {
        Direction m{d[0][i], d[1][i], d[2][i]};
        const bool above = m[2] > 0;
        if (reflected)
            for (int k = 0; k < 3; ++k) m[k] += lobe.wo[k];
        m[0] /= lobe.alpha[0], m[1] /= lobe.alpha[1];
        const double cosine = m[2] / length(m), turns = std::atan2(m[1], m[0]) / (2 * pi);
        if (!(above && cosine > 0)) {
            ++counts.back();
            continue;
        }
        const auto part = [](double x) { return static_cast<std::size_t>(std::min(x, 1 - 1e-12) * cells); };
        ++counts[part(cosine) * cells + part(turns < 0 ? turns + 1 : turns)];
    }
    return counts;
}

// What is expected of the last cell: what is missing in the others. Where that agrees to a hundredth, which the integral of the density
// is judged by, the shape alone counts.
void settle_rest(const std::vector<std::uint32_t>& counts, std::vector<double>& expected) {
    const double n = static_cast<double>(samples), outside = counts.back();
    const double inside = std::accumulate(expected.begin(), expected.end(), 0.0);
    expected.back() = std::max(0.0, n - inside);
    if (!(std::abs(n - inside - outside) < 0.01 * n)) return;
    for (double& x : expected) x *= (n - outside) / inside;
    expected.back() = outside;
}

}  // namespace

std::vector<Point> own_density_lobes(const Function& sampler, const Scope& scope) {
    return lobes(sampler, scope, true);
}

Finding check_own_density(runtime::DeviceEvaluator& evaluator, const Function& sampler,
                          const Function& density, const Scope& scope, std::uint64_t seed, double level) {
    const Real real = evaluator.input_real();
    Finding finding;
    finding.check = fmt::format("chi2 of the samples against {}", density.name);
    finding.is_p = true, finding.figure = 1, finding.unit = "probability";
    finding.limit = level;
    for (const Point& lobe : own_density_lobes(sampler, scope)) {
        const std::vector<double> row = tabulate(sampler, {lobe}, real).row(0);
        const reference::Distribution distribution(sampler.density, RowReader(sampler).lobe(row.data()),
                                                   precision(real));
        if (!(distribution.pivot_rounding() < 1e-3)) continue;
        SplitMix64 random(seed + finding.count);
        std::vector<Point> points(samples, lobe);
        for (Point& point : points) point.u = {random.uniform(), random.uniform()};
        const auto drawn = evaluate(evaluator, sampler, tabulate(sampler, points, real));
        const auto counts = histogram(drawn, lobe, column(density, "wi_x") >= 0);

        const Quadrature q = quadrature(density, lobe, real);
        const std::vector<double> values = evaluate(evaluator, density, q.inputs).front();
        std::vector<double> expected(cells * cells + 1);
        for (std::size_t i = 0; i < values.size(); ++i)
            expected[q.cell[i]] += values[i] * q.weight[i] * static_cast<double>(samples);
        settle_rest(counts, expected);
        const ChiSquare chi = chi_square(counts, expected, 16);
        ++finding.count;
        if (finding.count > 1 && !(chi.p < finding.figure)) continue;
        finding.figure = chi.p;
        finding.detail = fmt::format("chi2 {:.1f} with {} degrees", chi.statistic, chi.degrees);
        finding.worst = hex_row(sampler, row);
    }
    return finding;
}

}  // namespace vndf::conformance
