// SplitMix64: Steele, Lea & Flood, Fast Splittable Pseudorandom Number Generators, 2014. Integers alone, so that every
// machine draws the same.
#pragma once

#include <cstdint>

namespace vndf {

constexpr std::uint64_t splitmix64_step = 0x9e3779b97f4a7c15;

// The number that the generator draws in state x: a hash.
constexpr std::uint64_t splitmix64(std::uint64_t x) {
    x += splitmix64_step;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9;
    x = (x ^ (x >> 27)) * 0x94d049bb133111eb;
    return x ^ (x >> 31);
}

class SplitMix64 {
  public:
    explicit SplitMix64(std::uint64_t state) : state_(state) {}

    std::uint64_t bits() {
        const std::uint64_t drawn = splitmix64(state_);
        state_ += splitmix64_step;
        return drawn;
    }
    // In [0, 1), multiples of 2^-53.
    double uniform() { return static_cast<double>(bits() >> 11) * 0x1p-53; }

  private:
    std::uint64_t state_;
};

}  // namespace vndf
