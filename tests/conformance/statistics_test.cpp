// The statistics behind `clvndf check`, against known values.
#include <cmath>
#include <random>
#include <vector>

#include "conformance/judge/statistics.h"
#include "support/catch.h"

using namespace vndf::conformance;
using Catch::Approx;

namespace {

// n numbers in equal bins of [0, 1): uniform, but for `shift` of each, which a power below 1 moves to the right.
std::vector<std::uint32_t> binned(std::size_t n, std::size_t bins, double power) {
    std::mt19937_64 engine(7);
    std::vector<std::uint32_t> counts(bins);
    for (std::size_t i = 0; i < n; ++i) {
        const double x = std::pow(static_cast<double>(engine() >> 11) * 0x1p-53, power);
        ++counts[static_cast<std::size_t>(x * static_cast<double>(bins))];
    }
    return counts;
}

}  // namespace

TEST_CASE("chi-squared has the tabulated quantiles") {
    // (44 - 50)^2 / 50 twice; one degree of freedom: 1.44, p = erfc(sqrt(0.72)).
    const ChiSquare coin = chi_square(std::vector<std::uint32_t>{44, 56}, std::vector<double>{50, 50});
    CHECK(coin.statistic == Approx(1.44));
    CHECK(coin.degrees == 1);
    CHECK(coin.p == Approx(std::erfc(std::sqrt(0.72))));
    // Two degrees of freedom: p = exp(-statistic / 2).
    const ChiSquare three =
        chi_square(std::vector<std::uint32_t>{20, 30, 40}, std::vector<double>{30, 30, 30});
    CHECK(three.p == Approx(std::exp(-three.statistic / 2)));
}

TEST_CASE("chi-squared pools cells that expect too few") {
    const ChiSquare pooled =
        chi_square(std::vector<std::uint32_t>{1, 2, 3, 94}, std::vector<double>{2, 2, 2, 94}, 5);
    CHECK(pooled.degrees == 1);  // the three small cells are one
    CHECK(pooled.statistic == 0);
    // What is left over joins the last cell.
    CHECK(chi_square(std::vector<std::uint32_t>{3, 3, 3}, std::vector<double>{3, 3, 3}, 5).degrees == 0);
}

TEST_CASE("chi-squared sees samples where none are expected") {
    const std::vector<double> expected{0, 500, 500};
    CHECK(chi_square(std::vector<std::uint32_t>{0, 500, 500}, expected).p > 0.9);
    CHECK(chi_square(std::vector<std::uint32_t>{400, 300, 300}, expected).p < 1e-12);
}

TEST_CASE("chi-squared never passes an expectation that is no number") {
    CHECK(chi_square(std::vector<std::uint32_t>{5, 5}, std::vector<double>{5, NAN}).p == 0);
    CHECK(chi_square(std::vector<std::uint32_t>{5, 5}, std::vector<double>{10, -1}).p == 0);
}

TEST_CASE("the Kolmogorov distribution has the tabulated quantiles") {
    // lambda for p = 0.10, 0.05, 0.01, 0.001 (Smirnov 1948).
    for (const auto& [lambda, p] :
         {std::pair(1.22385, 0.10), {1.35810, 0.05}, {1.62762, 0.01}, {1.94947, 0.001}})
        CHECK(kolmogorov_p(lambda / 1e6, 1e12) == Approx(p).epsilon(1e-4));
    CHECK(kolmogorov_p(0, 100) == 1);
    CHECK(kolmogorov_p(1, 1e6) == 0);
}

TEST_CASE("Kolmogorov-Smirnov on bins sees a distance above its noise and none below") {
    constexpr std::size_t n = 1 << 20, bins = 1 << 16;
    const Kolmogorov uniform = kolmogorov(binned(n, bins, 1));
    CHECK(uniform.p > 1e-6);
    CHECK(uniform.resolution == 0x1p-16);
    // F(x) = x^(1/0.98): the largest distance from x is 0.0073.
    const Kolmogorov bent = kolmogorov(binned(n, bins, 0.98));
    CHECK(bent.distance == Approx(0.0073).margin(0.003));
    CHECK(bent.p < 1e-12);
}

TEST_CASE("Sidak's level gives the family's rate") {
    CHECK(sidak(0.05, 10) == Approx(0.0051162).epsilon(1e-4));
    const double level = sidak(1e-6, 10000);
    CHECK(-std::expm1(10000 * std::log1p(-level)) == Approx(1e-6));
}

TEST_CASE("a mean's tolerance is 6.5 standard errors, or more where rare samples carry the variance") {
    CHECK(mean_tolerance(0.5, 1, 10000, 1e-9) == Approx(6.5 * 0.5 / 100));
    CHECK(mean_tolerance(0.5, 1, 10000, 1e-12) > 6.5 * 0.5 / 100);  // a level that asks for 7.1
    // One sample in a million is 1, the others 0: two of them in 2^20 samples are no miracle.
    const double p = 1e-6, n = 0x1p20;
    CHECK(mean_tolerance(std::sqrt(p), 1, n, 1e-10) > 10 / n);
    CHECK(6.5 * std::sqrt(p / n) < 10 / n);  // which the normal limit would call one
}

TEST_CASE("a known bias shifts chi-squared by its noncentrality") {
    CHECK(noncentral_chi_square_p(1000, 1000, 1e-9) == Approx(0.4941).margin(1e-3));
    CHECK(noncentral_chi_square_p(1500, 1000, 0) < 1e-20);
    CHECK(noncentral_chi_square_p(1500, 1000, 500) > 0.1);
}

TEST_CASE("two samples of one distribution agree, of two do not") {
    // (60 - 40)^2 / 100 twice; one degree of freedom.
    const std::vector<std::uint32_t> heads{60, 40}, tails{40, 60};
    CHECK(same_distribution_p(heads, tails) == Approx(std::erfc(std::sqrt(4.0))));
    const std::size_t bins = 64;
    const auto uniform = binned(1 << 16, bins, 1), fewer = binned(1 << 13, bins, 1);
    CHECK(same_distribution_p(uniform, fewer) > 1e-3);
    CHECK(same_distribution_p(uniform, binned(1 << 16, bins, 0.9)) < 1e-9);
    CHECK(same_distribution_p(uniform, std::vector<std::uint32_t>(bins)) == 0);
}
