// The statistics of the conformance checks: pure functions of counts and sums, each with its false-alarm
// rate.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace vndf::conformance {

// Outcome of Pearson's test.
struct ChiSquare {
    double statistic = 0;
    std::size_t degrees = 0;  // cells after pooling, less one
    double p = 1;             // probability of a statistic at least as large under the hypothesis
};

// Pearson's chi-squared test of counts against expected counts (same length, same total up to rounding).
// Cells that expect fewer than `pool_below` are pooled, in increasing order of expectation, until the pool
// expects as many: the distribution of the statistic needs it. Counts where nothing is expected stay in the
// pool, so they cannot hide. A negative or non-finite expectation gives p = 0, never a pass.
ChiSquare chi_square(std::span<const std::uint32_t> observed, std::span<const double> expected,
                     double pool_below = 5);

// The chance that two samples of one distribution differ by as much as these counts in the same cells.
double same_distribution_p(std::span<const std::uint32_t> a, std::span<const std::uint32_t> b);

// Outcome of the Kolmogorov-Smirnov test against the uniform distribution on [0, 1].
struct Kolmogorov {
    double distance = 0;    // largest |F_n - F| over the bin edges: at most the true distance
    double resolution = 0;  // the true distance is at most distance + resolution
    double p = 1;           // from `distance`, so binning causes no false alarm
};

// The test on counts in equal bins of [0, 1] (at least 2^16 of them for a resolution that does not matter).
Kolmogorov kolmogorov(std::span<const std::uint32_t> bins);

// P(D_n >= distance), the asymptotic Kolmogorov series with Stephens' correction for finite n.
double kolmogorov_p(double distance, double n);

// The rate per test that gives `family_rate` over `tests` independent tests (Sidak).
double sidak(double family_rate, std::size_t tests);

// Sum of a quantity and of its square over samples.
struct Sums {
    double sum = 0;
    double squares = 0;
    void add(double x) {
        sum += x;
        squares += x * x;
    }
    void merge(const Sums& other) {
        sum += other.sum;
        squares += other.squares;
    }
};

// Largest |mean of n samples - expectation| that chance explains, for a quantity with standard deviation
// `deviation`, never farther than `range` from its expectation: 6.5 standard errors, or more if `p`
// (two-sided) asks for more. Where the range exceeds three deviations, rare samples carry the variance (the
// tails of GGX at small alpha), the normal limit does not hold, and Bernstein's inequality takes its place.
double mean_tolerance(double deviation, double range, double n, double p);

// P(statistic or more) if the cell probabilities p differ from the hypothesis q by n sum (p - q)^2 / q =
// `noncentrality`: for a sampler whose bias is known.
double noncentral_chi_square_p(double statistic, std::size_t degrees, double noncentrality);

}  // namespace vndf::conformance
