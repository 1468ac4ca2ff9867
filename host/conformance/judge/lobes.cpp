#include "conformance/judge/lobes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "conformance/inputs/rows.h"
#include "reference/distribution.h"

namespace vndf::conformance {
namespace {

constexpr std::size_t pivot_cells = LobePicture::cells, angle_bins = LobePicture::cells;
constexpr std::size_t ks_bins = std::size_t{1} << 16;
constexpr std::size_t pool_below = 16;  // expectation per cell: at levels of 1e-10 more than the usual 5
constexpr std::size_t chunk = 1024;
constexpr std::size_t means = reference::Moments::count + 3;

// Counts and sums of the samples.
struct Tally {
    std::vector<std::uint32_t> pivots = std::vector<std::uint32_t>(pivot_cells * pivot_cells);
    std::array<std::vector<std::uint32_t>, 2> pivot{std::vector<std::uint32_t>(ks_bins),
                                                    std::vector<std::uint32_t>(ks_bins)};
    // One more for directions outside every bin.
    std::vector<std::uint32_t> histogram = std::vector<std::uint32_t>(angle_bins * angle_bins + 1);
    std::array<double, means> sums{};
};

// The bin of a number in [0, 1], both ends included.
std::size_t bin_of(double x, std::size_t bins) {
    const auto bin = static_cast<std::size_t>(std::max(0.0, x) * static_cast<double>(bins));
    return std::min(bin, bins - 1);
}

// The interval of ascending edges that holds x, or edges.size() - 1 if none does (or x is NaN).
std::size_t interval(const std::vector<double>& edges, double x) {
    if (!(x >= edges.front()) || !(x <= edges.back())) return edges.size() - 1;
    const auto above = std::upper_bound(edges.begin() + 1, edges.end() - 1, x);
    return static_cast<std::size_t>(above - edges.begin()) - 1;
}

// The quantities whose means are tested: the moments of the direction, and the direction of the stretched
// normal (x / alpha_x, y / alpha_y, z), wide in every lobe where x and y of the direction itself are small.
class Quantities {
  public:
    Quantities(const Function& sampler, const std::vector<double>& row) {
        const RowReader reader(sampler);
        n_ = reader.n(row.data());
        wo_ = reader.has_wo() ? reader.wo(row.data()) : n_;
        const double scale = 1 / length(wo_);
        for (double& component : wo_) component *= scale;
        alpha_ = reader.alpha(row.data());
        world_ = reader.has_n();
    }

    std::array<double, means> operator()(const Direction& d) const {
        const auto [x, y, z] = d;
        const Direction h = stretched(d);
        const double scale = 1 / length(h);
        return {x,     y,     z,           x * x,        y * y,        z * z,       x * y,
                x * z, y * z, dot(d, wo_), h[0] * scale, h[1] * scale, h[2] * scale};
    }

  private:
    Direction stretched(const Direction& d) const {
        if (!world_) return {d[0] / alpha_[0], d[1] / alpha_[1], d[2]};
        const double along = dot(d, n_);  // isotropic: what is tangential is divided
        Direction h;
        for (int k = 0; k < 3; ++k) h[k] = (d[k] - along * n_[k]) / alpha_[0] + along * n_[k];
        return h;
    }

    Direction n_, wo_;
    std::array<double, 2> alpha_;
    bool world_;
};

struct Expectation {
    std::array<double, means> mean{}, variance{};
};

Expectation expectation(const reference::Distribution& distribution, const Quantities& quantities) {
    Expectation e;
    const reference::QuadratureRule rule = distribution.rule();
    for (std::size_t i = 0; i < rule.size(); ++i) {
        const auto q = quantities({rule.x[i], rule.y[i], rule.z[i]});
        for (std::size_t k = 0; k < means; ++k) {
            e.mean[k] += rule.probability[i] * q[k];
            e.variance[k] += rule.probability[i] * q[k] * q[k];
        }
    }
    for (std::size_t k = 0; k < means; ++k)
        e.variance[k] = std::max(0.0, e.variance[k] - e.mean[k] * e.mean[k]);
    const reference::Moments moments = distribution.moments();
    std::copy(moments.mean.begin(), moments.mean.end(), e.mean.begin());
    std::copy(moments.variance.begin(), moments.variance.end(), e.variance.begin());
    return e;
}

// The cell of a direction in the histogram.
std::size_t cell_of(const reference::Bins& bins, double theta, double phi) {
    const double first = bins.phi.front(), last = bins.phi.back(), turn = last - first;
    const std::size_t row = interval(bins.theta, theta);
    const std::size_t column = interval(bins.phi, phi < first ? phi + turn : phi > last ? phi - turn : phi);
    return row < angle_bins && column < angle_bins ? row * angle_bins + column : angle_bins * angle_bins;
}

template <class T>
Tally count(const reference::Distribution& distribution, const reference::Bins& bins,
            const Quantities& quantities, std::size_t n, const T* x, const T* y, const T* z) {
    std::array<double, chunk> a, b;
    Tally tally;
    for (std::size_t begin = 0; begin < n; begin += chunk) {
        const std::size_t items = std::min(chunk, n - begin);
        const T *const xs = x + begin, *const ys = y + begin, *const zs = z + begin;
        distribution.pivots(items, xs, ys, zs, a.data(), b.data());
        for (std::size_t i = 0; i < items; ++i) {
            ++tally.pivot[0][bin_of(a[i], ks_bins)];
            ++tally.pivot[1][bin_of(b[i], ks_bins)];
            ++tally.pivots[bin_of(a[i], pivot_cells) * pivot_cells + bin_of(b[i], pivot_cells)];
            const auto q = quantities({xs[i], ys[i], zs[i]});
            for (std::size_t k = 0; k < means; ++k) tally.sums[k] += q[k];
        }
        if (begin >= n / histogram_share) continue;
        distribution.angles(items, xs, ys, zs, a.data(), b.data());
        for (std::size_t i = 0; i < items; ++i) ++tally.histogram[cell_of(bins, a[i], b[i])];
    }
    return tally;
}

std::vector<MeanTest> test_means(const Function& sampler, const Expectation& exact, const Tally& tally,
                                 double samples, Real real, double level, double bias) {
    static const char* const names[] = {"x",  "y",  "z",  "xx",          "yy",          "zz",         "xy",
                                        "xz", "yz", "wo", "stretched x", "stretched y", "stretched z"};
    std::vector<MeanTest> tests;
    const std::size_t tested = sampler.result == "WM" ? means : reference::Moments::count;
    for (std::size_t k = 0; k < tested; ++k) {
        const double deviation = std::sqrt(exact.variance[k]);
        const double rms = std::sqrt(exact.variance[k] + exact.mean[k] * exact.mean[k]);
        const double range = 1 + std::abs(exact.mean[k]);
        tests.push_back({names[k], tally.sums[k] / samples - exact.mean[k],
                         mean_tolerance(deviation, range, samples, level) + bias * deviation +
                             (2 * epsilon(real) + 1e-8) * rms,
                         deviation / std::sqrt(samples)});
    }
    return tests;
}

// The first that is no number, or the farthest from what is expected.
LobeTest worst_of(const std::vector<MeanTest>& means) {
    LobeTest worst{"means", false, 0, {}};
    for (const MeanTest& mean : means) {
        const double figure = std::abs(mean.difference) / mean.tolerance;
        if (!(figure > worst.figure) && !std::isnan(figure)) continue;
        worst.figure = figure;
        worst.detail =
            fmt::format("E[{}] off by {:.3g}, tolerance {:.3g}", mean.name, mean.difference, mean.tolerance);
        if (std::isnan(figure)) break;
    }
    return worst;
}

}  // namespace

bool is_of_lobe(const std::string& input) {
    return input != "u1" && input != "u2" && input != "u3";
}

bool LobePicture::passed() const {
    return std::all_of(tests.begin(), tests.end(), [](const LobeTest& test) { return test.passed(); });
}

void WorstLobes::add(const LobeTest& test, const std::vector<double>& row) {
    Finding finding;
    finding.check = test.name, finding.figure = test.figure, finding.detail = test.detail;
    finding.is_p = test.is_p, finding.limit = test.limit;
    finding.unit = test.is_p ? "probability" : test.unit;
    finding.worst = hex_row(sampler_, row, is_of_lobe);
    const auto [place, added] = findings_.try_emplace(test.name, finding);
    const std::size_t count = place->second.count + 1;
    if (!added && finding.severity() > place->second.severity()) place->second = finding;
    place->second.count = count;
}

void WorstLobes::append_to(std::vector<Finding>& findings) const {
    for (const auto& [_, finding] : findings_) findings.push_back(finding);
}

std::size_t tests_per_lobe(const Function& sampler) {
    return 4 + (sampler.result == "WM" ? means : reference::Moments::count) + (may_miss(sampler) ? 1 : 0);
}

namespace {

template <class T>
std::array<std::vector<T>, 3> without_lost(std::size_t n, const T* x, const T* y, const T* z) {
    std::array<std::vector<T>, 3> kept;
    for (std::size_t i = 0; i < n; ++i)
        if (!reference::is_lost({x[i], y[i], z[i]}))
            kept[0].push_back(x[i]), kept[1].push_back(y[i]), kept[2].push_back(z[i]);
    return kept;
}

LobeTest test_kept(double share, std::size_t all, std::size_t kept, double level) {
    const auto n = static_cast<double>(all);
    const std::uint32_t observed[2] = {static_cast<std::uint32_t>(kept),
                                       static_cast<std::uint32_t>(all - kept)};
    const double expected[2] = {n * share, n * std::max(0., 1 - share)};
    const ChiSquare chi = chi_square(observed, expected, pool_below);
    return {"chi2 of what is kept", true, chi.p,
            fmt::format("{} of {}, expected {:.0f}", kept, all, expected[0]), level};
}

}  // namespace

template <class T>
std::vector<LobeTest> test_lobe(const Function& sampler, const std::vector<double>& row, std::size_t n,
                                const T* x, const T* y, const T* z, double level, const KnownBias& bias,
                                LobePicture* picture) {
    const Real real = sizeof(T) == sizeof(float) ? Real::f32 : Real::f64;
    const reference::Distribution distribution(sampler.density, RowReader(sampler).lobe(row.data()),
                                               precision(real));
    const reference::Bins bins = distribution.bins(angle_bins, angle_bins);
    const Quantities quantities(sampler, row);
    std::vector<LobeTest> tests;
    std::array<std::vector<T>, 3> kept;
    if (may_miss(sampler)) {
        kept = without_lost(n, x, y, z);
        tests.push_back(test_kept(distribution.kept(), n, kept[0].size(), level));
        n = kept[0].size() - kept[0].size() % (histogram_share * chunk);
        if (n == 0) return tests;
        x = kept[0].data(), y = kept[1].data(), z = kept[2].data();
    }
    const Tally tally = count(distribution, bins, quantities, n, x, y, z);
    const auto samples = static_cast<double>(n);

    const auto add_chi_square = [&](const char* name, const std::vector<std::uint32_t>& observed,
                                    const std::vector<double>& expected) {
        const ChiSquare chi = chi_square(observed, expected, pool_below);
        const double noncentrality = bias.chi_square * std::accumulate(expected.begin(), expected.end(), 0.0);
        const double p =
            noncentrality > 0 ? noncentral_chi_square_p(chi.statistic, chi.degrees, noncentrality) : chi.p;
        tests.push_back(
            {name, true, p, fmt::format("chi2 {:.1f} with {} degrees", chi.statistic, chi.degrees), level});
    };
    // A direction rounded to T may have lost its place in the lobe: reflected ones at small alpha and grazing
    // angles, normals of Beckmann lobes seen from far below. Elsewhere rounding moves pivots and cells by less
    // than the tests resolve.
    if (distribution.pivot_rounding() * epsilon(real) / epsilon(Real::f32) < 1e-3) {
        constexpr std::size_t cells = pivot_cells * pivot_cells;
        const std::vector<double> uniform(cells, samples / cells);
        add_chi_square("chi2 of the pivots", tally.pivots, uniform);
        for (int i = 0; i < 2; ++i) {
            const Kolmogorov ks = kolmogorov(tally.pivot[i]);
            tests.push_back({i ? "KS of pivot 2" : "KS of pivot 1", true,
                             kolmogorov_p(std::max(0.0, ks.distance - bias.distance), samples),
                             fmt::format("distance {:.3g}", ks.distance), level});
        }
        std::vector<double> expected = distribution.bin_probabilities(bins);
        for (double& probability : expected) probability *= samples / histogram_share;
        expected.push_back(0);
        add_chi_square("chi2 of the directions", tally.histogram, expected);
        if (picture) {
            picture->pivots = {tally.pivots, uniform};
            picture->directions = {tally.histogram, expected};
            picture->bins = bins;
        }
    }

    const std::vector<MeanTest> averages =
        test_means(sampler, expectation(distribution, quantities), tally, samples, real, level, bias.mean);
    tests.push_back(worst_of(averages));
    if (picture) picture->row = row, picture->means = averages, picture->tests = tests;
    return tests;
}

template std::vector<LobeTest> test_lobe<float>(const Function&, const std::vector<double>&, std::size_t,
                                                const float*, const float*, const float*, double,
                                                const KnownBias&, LobePicture*);
template std::vector<LobeTest> test_lobe<double>(const Function&, const std::vector<double>&, std::size_t,
                                                 const double*, const double*, const double*, double,
                                                 const KnownBias&, LobePicture*);

}  // namespace vndf::conformance
