// The claims of kernels/doc/ggx_conic2026.md in full, or with "caps" those of ggx_cone2026.md:
//   conic_claims [SAMPLES [DIRECTIONS [LOBES]]]      1e10, 1e9 and 2000 unless given; exit status 1 if one fails
//   conic_claims caps [SAMPLES [DIRECTIONS [CAPS]]]  1e9, 1e8 and 1000 unless given
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "cone_claims.h"
#include "conic_claims.h"

namespace {

using namespace vndf::claims;

bool holds = true;

template <class... Values>
void say(bool good, const char* format, Values... values) {
    std::printf(format, values...);
    std::printf("%s\n", good ? "" : ": FAILED");
    std::fflush(stdout);
    holds = holds && good;
}

void count_horizon(std::uint64_t samples, std::uint64_t directions, std::uint64_t lobes) {
    const double probability = worst_probability(lobes);
    say(probability <= 1e-12, "P against quadrature, %.3g lobes: largest relative difference %.2g",
        double(lobes), probability);
    const double integral = worst_integral(lobes / 10);
    say(integral <= 1e-10, "integral of the density, %.3g lobes: largest difference to 1 %.2g",
        double(lobes / 10), integral);
    const Lost lost = count_lost(directions);
    say(lost.outside == 0 && lost.worst_round_trip < 1e-16,
        "%.3g directions above the horizon: %.0f without a u, largest probability between one and the "
        "reflection of its u %.2g",
        double(directions), double(lost.outside), lost.worst_round_trip);
    const std::uint64_t below = count_below(samples);
    say(below == 0, "%.3g reflections in float: %.0f below the horizon, not finite or not of unit length",
        double(samples), double(below));
}

void count_caps(std::uint64_t samples, std::uint64_t directions, std::uint64_t caps) {
    const double sigma = worst_sigma_cap(caps);
    say(sigma <= 1e-12, "sigma_C against quadrature, %.3g caps: largest relative difference %.2g",
        double(caps), sigma);
    const double integral = worst_cap_integral(caps / 10);
    say(integral <= 1e-8, "integral of the density, %.3g caps: largest difference to 1 %.2g",
        double(caps / 10), integral);
    const Lost lost = count_lost_in_caps(directions);
    say(lost.outside == 0 && lost.worst_round_trip < 1e-16,
        "%.3g directions in caps: %.0f without a u, largest probability between one and the reflection of "
        "its u %.2g",
        double(directions), double(lost.outside), lost.worst_round_trip);
    const std::uint64_t missed = count_missed(samples);
    say(missed == 0, "%.3g reflections in float: %.0f outside their cap, not finite or not of unit length",
        double(samples), double(missed));
}

}  // namespace

int main(int argc, char** argv) {
    const bool caps = argc > 1 && std::string_view(argv[1]) == "caps";
    const auto count = [&](int i, double otherwise) {
        i += caps ? 1 : 0;
        char* end = nullptr;
        const double value = i < argc ? std::strtod(argv[i], &end) : otherwise;
        if (i < argc && (end == argv[i] || *end != 0 || !(value >= 1 && value <= 1e15))) {
            std::fprintf(
                stderr,
                "conic_claims: '%s' is not a count from 1 to 1e15 (reflections, directions, lobes), which "
                "\"caps\" may precede\n",
                argv[i]);
            std::exit(2);
        }
        return static_cast<std::uint64_t>(value);
    };
    if (caps)
        count_caps(count(1, 1e9), count(2, 1e8), count(3, 1e3));
    else
        count_horizon(count(1, 1e10), count(2, 1e9), count(3, 2e3));
    return holds ? 0 : 1;
}
