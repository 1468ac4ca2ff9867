#define VNDF_REAL float
#include "support/math_accuracy.h"

#include <bit>
#include <cstdint>

#include "parallel.h"

namespace {

// The largest error in eps and in ulps over every normal float from low to high (0 < low < high).
struct Largest {
    double eps = 0, ulps = 0;
    float at = 0;
};

// error(x) of the exact value exact(x), which `add` takes together; each in double, whose own rounding is 2^-29 eps.
template <class Judge>
Largest exhaust(float low, float high, Judge judge) {
    const std::uint32_t first = std::bit_cast<std::uint32_t>(low), last = std::bit_cast<std::uint32_t>(high);
    std::vector<Largest> parts(vndf::thread_count());
    vndf::parallel_for(
        std::size_t{last} - first + 1, std::size_t{1} << 20,
        [&](unsigned thread, std::size_t begin, std::size_t end) {
            Largest& largest = parts[thread];
            for (std::size_t i = begin; i < end; ++i) {
                const float x = std::bit_cast<float>(first + static_cast<std::uint32_t>(i));
                const auto [difference, exact] = judge(x);
                const double size = std::abs(exact);
                // 2^exponent of the exact value.
                const double binade = std::bit_cast<double>(std::bit_cast<std::uint64_t>(size) >> 52 << 52);
                const double ulps = std::abs(difference) / (binade * 0x1p-23);
                if (!(ulps <= largest.ulps)) largest.ulps = ulps, largest.at = x;
                if (const double relative = std::abs(difference) / size * 0x1p24; !(relative <= largest.eps))
                    largest.eps = relative;
            }
        });
    for (const Largest& part : parts)
        if (!(part.ulps <= parts[0].ulps)) parts[0].ulps = part.ulps, parts[0].at = part.at;
    for (const Largest& part : parts) parts[0].eps = std::max(parts[0].eps, part.eps);
    return parts[0];
}

struct Judged {
    double difference, exact;
};

void check(const std::string& name, float low, float high, const Largest& largest, double stated,
           double bound) {
    std::printf("%-16s [%a, %a]: %.3f ulp, %.3f eps; largest at %a\n", name.c_str(), low, high, largest.ulps,
                largest.eps, largest.at);
    std::fflush(stdout);
    CAPTURE(name, low, high, largest.ulps, hex(largest.at));
    CHECK(largest.ulps <= stated);
    CHECK(largest.ulps > stated - 0.02);
    CHECK(largest.eps <= bound);
}

}  // namespace

// Minutes to an hour: clvndf_tests "[exhaustive]".
TEST_CASE("float: the largest error over every number is the one stated", "[.][exhaustive]") {
    for (const Claim& claim : claims) {
        const bool negative = claim.high <= 0;
        const float first = negative ? -claim.high : claim.low, low = std::max(first, smallest);
        const float high = negative ? -claim.low : claim.high;
        const bool absolute = claim.error == Error::absolute;
        const Largest largest = exhaust(low, high, [&](float size) {
            const float x = negative ? -size : size;
            const double exact = claim.in_double(x), difference = claim.function(x) - exact;
            return absolute ? Judged{2 * difference, 1} : Judged{difference, exact};
        });
        check(claim.name, negative ? -high : low, negative ? -low : high, largest, claim.exhausted,
              absolute ? 2 * claim.bound() : claim.bound());
    }
}

TEST_CASE("float: the largest error of the inverses over every number is the one stated", "[.][exhaustive]") {
    const auto erfcinv = [](float q) {
        const double x = vndf_impl_erfcinv(q);
        return Judged{error_of_inverse(x, 1 - static_cast<double>(q), static_cast<double>(q)) * x, x};
    };
    check("erfcinv", share_low, 1, exhaust(share_low, 0x1.fffffep-1f, erfcinv), 3.27, 4.1);
    check("erfcinv", 1, 2, exhaust(0x1.000002p0f, 0x1.fffffep0f, erfcinv), 2.67, 4.1);
    check("erfinv_ratio", share_low, 1,
          exhaust(share_low, 0x1.fffffep-1f,
                  [](float r) {
                      const double ratio = vndf_impl_erfinv_ratio(r),
                                   p = std::sqrt(1 - static_cast<double>(r));
                      return Judged{error_of_inverse(ratio * p, p, r / (1 + p)) * ratio, ratio};
                  }),
          3.04, 3.5);
}
