// Walker's tables pick each row with exactly the chance that they say.
#include <cmath>
#include <random>

#include "render/alias.h"
#include "support/catch.h"

using namespace vndf;

TEST_CASE("rows are picked with exactly their chances, and every one that has a weight") {
    std::mt19937 random(1);
    std::exponential_distribution<double> level;
    std::vector<double> many(1000);
    for (double& w : many) w = random() % 3 == 0 ? 0 : std::pow(level(random), 8);
    for (const std::vector<double>& weights : {std::vector<double>{3},
                                               {0, 2},
                                               {1, 1e-12},
                                               {1e300, 1e299, 0, 1e-300},
                                               {1, 1, 1},
                                               {0, 0, 0, 0, 0},
                                               many}) {
        CAPTURE(weights.size(), weights[0]);
        const std::size_t n = weights.size();
        const render::Alias alias = render::alias_of(weights);
        double total = 0;
        for (const double w : weights) total += w;
        std::vector<double> picked(n);  // times n: sums of multiples of 2^-24
        for (std::size_t i = 0; i < n; ++i) {
            REQUIRE(alias.keep[i] * 0x1p24f == std::floor(alias.keep[i] * 0x1p24f));
            picked[i] += alias.keep[i];
            picked[alias.other[i]] += 1 - double{alias.keep[i]};
        }
        for (std::size_t i = 0; i < n; ++i) {
            CHECK(alias.chance[i] == picked[i] / static_cast<double>(n));
            if (total == 0) {
                CHECK(std::abs(picked[i] - 1) <= 0x1p-22);
                continue;
            }
            CHECK((alias.chance[i] > 0) == (weights[i] > 0));
            // What rounding leaves goes to the largest: it may be a step for each of the others.
            const bool largest = weights[i] * static_cast<double>(n) >= total;
            CHECK(std::abs(picked[i] - weights[i] / total * static_cast<double>(n)) <=
                  (largest ? 2 + static_cast<double>(n) : 2) * 0x1p-24);
        }
    }
}
