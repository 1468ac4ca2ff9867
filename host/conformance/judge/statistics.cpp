#include "conformance/judge/statistics.h"

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/non_central_chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

namespace vndf::conformance {

namespace {

struct Cell {
    double expected = 0;
    double observed = 0;
};

// Cells in increasing order of expectation, the small ones pooled until each expects `least` or more.
std::vector<Cell> pooled(std::span<const std::uint32_t> observed, std::span<const double> expected,
                         double least) {
    std::vector<std::size_t> order(expected.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return expected[a] < expected[b]; });
    std::vector<Cell> cells;
    Cell pool;
    for (const std::size_t i : order) {
        pool.expected += expected[i];
        pool.observed += observed[i];
        if (pool.expected < least) continue;
        cells.push_back(pool);
        pool = {};
    }
    if (cells.empty()) return {pool};
    cells.back().expected += pool.expected;
    cells.back().observed += pool.observed;
    return cells;
}

}  // namespace

ChiSquare chi_square(std::span<const std::uint32_t> observed, std::span<const double> expected,
                     double pool_below) {
    if (!std::all_of(expected.begin(), expected.end(), [](double e) { return std::isfinite(e) && e >= 0; }))
        return {std::numeric_limits<double>::infinity(), 0, 0};
    const std::vector<Cell> cells = pooled(observed, expected, pool_below);
    ChiSquare result{0, cells.size() - 1, 1};
    if (result.degrees == 0) return result;
    for (const Cell& cell : cells)
        result.statistic += (cell.observed - cell.expected) * (cell.observed - cell.expected) / cell.expected;
    const boost::math::chi_squared distribution(static_cast<double>(result.degrees));
    result.p = boost::math::cdf(boost::math::complement(distribution, result.statistic));
    return result;
}

double same_distribution_p(std::span<const std::uint32_t> a, std::span<const std::uint32_t> b) {
    const double all_a = std::accumulate(a.begin(), a.end(), 0.0),
                 all_b = std::accumulate(b.begin(), b.end(), 0.0);
    if (!(all_a > 0 && all_b > 0)) return 0;
    double statistic = 0, cells = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (a[i] + b[i] == 0) continue;
        const double difference = std::sqrt(all_b / all_a) * a[i] - std::sqrt(all_a / all_b) * b[i];
        statistic += difference * difference / (a[i] + b[i]), ++cells;
    }
    return cells > 1 ? boost::math::cdf(complement(boost::math::chi_squared(cells - 1), statistic)) : 1;
}

double kolmogorov_p(double distance, double n) {
    const double root = std::sqrt(n);
    const double lambda = (root + 0.12 + 0.11 / root) * distance;
    // Below 0.2 the alternating series converges slowly and 1 - p < 1e-11.
    if (!(lambda >= 0.2)) return 1;
    double p = 0;
    for (int k = 1; k <= 60; ++k) p += (k % 2 ? 2 : -2) * std::exp(-2.0 * k * k * lambda * lambda);
    return std::clamp(p, 0.0, 1.0);
}

Kolmogorov kolmogorov(std::span<const std::uint32_t> bins) {
    const double n = std::accumulate(bins.begin(), bins.end(), 0.0);
    const double width = 1.0 / static_cast<double>(bins.size());
    Kolmogorov result{0, width, 1};
    double below = 0;
    for (std::size_t bin = 0; bin < bins.size(); ++bin) {
        below += bins[bin];
        const double edge = static_cast<double>(bin + 1) * width;
        result.distance = std::max(result.distance, std::abs(below / n - edge));
    }
    result.p = n > 0 ? kolmogorov_p(result.distance, n) : 0;
    return result;
}

double sidak(double family_rate, std::size_t tests) {
    return tests == 0 ? family_rate : -std::expm1(std::log1p(-family_rate) / static_cast<double>(tests));
}

double mean_tolerance(double deviation, double range, double n, double p) {
    if (range <= 3 * deviation) {
        const double z = -boost::math::quantile(boost::math::normal(), p / 2);
        return std::max(6.5, z) * deviation / std::sqrt(n);
    }
    const double log_term = std::log(2 / p) / n;
    const double linear = range * log_term / 3;
    return linear + std::sqrt(linear * linear + 2 * deviation * deviation * log_term);
}

double noncentral_chi_square_p(double statistic, std::size_t degrees, double noncentrality) {
    if (degrees == 0) return 1;
    const boost::math::non_central_chi_squared distribution(static_cast<double>(degrees), noncentrality);
    return boost::math::cdf(boost::math::complement(distribution, statistic));
}

}  // namespace vndf::conformance
