// The claims of kernels/doc/ggx_conic2026.md in full:
//   conic_claims [SAMPLES [DIRECTIONS [LOBES]]]      1e10, 1e9 and 2000 unless given; exit status 1 if one fails
#include <cstdio>
#include <cstdlib>

#include "conic_claims.h"

int main(int argc, char** argv) {
    const auto count = [&](int i, double otherwise) {
        char* end = nullptr;
        const double value = i < argc ? std::strtod(argv[i], &end) : otherwise;
        if (i < argc && (end == argv[i] || *end != 0 || !(value >= 1 && value <= 1e15))) {
            std::fprintf(
                stderr, "conic_claims: '%s' is not a count from 1 to 1e15 (reflections, directions, lobes)\n",
                argv[i]);
            std::exit(2);
        }
        return static_cast<std::uint64_t>(value);
    };
    bool holds = true;
    const auto say = [&](bool good, const char* format, auto... values) {
        std::printf(format, values...);
        std::printf("%s\n", good ? "" : ": FAILED");
        std::fflush(stdout);
        holds = holds && good;
    };
    const std::uint64_t samples = count(1, 1e10), directions = count(2, 1e9), lobes = count(3, 2000);
    using namespace vndf::claims;
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
    return holds ? 0 : 1;
}
