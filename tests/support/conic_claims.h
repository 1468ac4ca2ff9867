// What is claimed of the zero-waste reflections, counted: over random lobes of the whole domain, on all cores.
#pragma once

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <thread>
#include <vector>

#include "reference/distribution.h"
#include "splitmix64.h"

namespace vndf::claims {

// A stream of numbers of its own for each block.
class Random : public SplitMix64 {
  public:
    explicit Random(std::uint64_t block) : SplitMix64(block * splitmix64_step + 1) {}
    double log_uniform(double low, double high) { return low * std::pow(high / low, uniform()); }
};

// A view from above the surface: half of them grazing; alphas over the domain, a third of the lobes isotropic.
struct Lobe {
    double x, y, z, alpha_x, alpha_y;
};
inline Lobe random_lobe(Random& random, double least_alpha, double most_alpha) {
    const double z = random.bits() % 2 ? random.uniform() + 1e-9 : random.log_uniform(1e-7, 1);
    const double phi = 2 * 3.14159265358979323846 * random.uniform(), s = std::sqrt((1 - z) * (1 + z));
    const double alpha = random.log_uniform(least_alpha, most_alpha);
    const double other = random.bits() % 3 ? random.log_uniform(least_alpha, most_alpha) : alpha;
    return {s * std::cos(phi), s * std::sin(phi), z, alpha, other};
}

// Uniform multiples of 2^-24, u2 in one of eight within 2^-16 of the rim.
struct DiskU {
    float u1, u2;
};
inline DiskU random_u(Random& random, std::uint64_t i) {
    const std::uint64_t bits = random.bits();
    const auto low = static_cast<std::uint32_t>(bits & 0xffffff);
    return {static_cast<float>(bits >> 40) * 0x1p-24f,
            (i % 8 ? static_cast<float>(low) : 0x1p24f - static_cast<float>(low & 0xff)) * 0x1p-24f};
}

// Calls visit(random, block) for blocks 0 ... count - 1.
template <class Visit>
void for_blocks(std::uint64_t count, Visit visit) {
    std::atomic<std::uint64_t> next{0};
    std::vector<std::thread> threads;
    for (unsigned i = 0; i < std::max(1u, std::thread::hardware_concurrency()); ++i)
        threads.emplace_back([&] {
            for (std::uint64_t block; (block = next++) < count;) {
                Random random(block);
                visit(random);
            }
        });
    for (std::thread& thread : threads) thread.join();
}

inline void raise(std::atomic<double>& worst, double x) {
    if (std::isnan(x)) x = INFINITY;
    for (double old = worst; old < x && !worst.compare_exchange_weak(old, x);) {
    }
}

constexpr std::uint64_t samples_of_lobe = 1024;

// Reflections of `samples` random u, one in eight next to the rim, that are not above the horizon or not finite (float).
std::uint64_t count_below(std::uint64_t samples);

struct Lost {
    std::uint64_t outside = 0;  // of the disk: no u gives this direction
    double worst_round_trip =
        0;  // of the angle between a direction and the reflection of its u, over its condition
};
// Judges a direction wi with its density, the u that the inverse gives of it and the reflection of that u: whether it is lost. The
// probability that surrounds wi up to there counts: where the density is low or u2 next to 1, the rounding of u moves a
// direction far.
template <class U, class V>
bool is_lost(const U& u, const V& wi, const V& back, double pdf, std::atomic<double>& worst) {
    const double off = std::hypot(back.x - wi.x, back.y - wi.y, back.z - wi.z), around = off * off * pdf;
    raise(worst, around);
    return !(u.x >= 0 && u.x <= 1 && u.y >= 0 && u.y <= 1 && around < 1e-16);
}

// How far the integral of pdf(x, y, z) by the rule is from 1.
template <class Pdf>
double off_one(const reference::QuadratureRule& rule, Pdf pdf) {
    double sum = 0;
    for (std::size_t i = 0; i < rule.size(); ++i)
        sum += rule.weight[i] * pdf(rule.x[i], rule.y[i], rule.z[i]);
    return std::abs(sum - 1);
}

// `directions` random directions above the horizon through the inverse (double), half of them near it.
Lost count_lost(std::uint64_t directions);

// The largest relative difference of the reflection probability (double) to the integral along the horizon's curve.
double worst_probability(std::uint64_t lobes);

// The largest difference of the density's integral (double) to 1.
double worst_integral(std::uint64_t lobes);

}  // namespace vndf::claims
