// What a launch's random numbers share (kernels/render/random.h).
#pragma once

#include <cstdint>
#include <vector>

#include <boost/random/sobol.hpp>

namespace vndf::render {

enum class Random { sobol, philox };

// The words of each sample in turn.
class Words {
  public:
    Words(Random random, std::uint64_t seed, unsigned quads);

    // Of the next sample: VNDF_QUAD_WORDS for each quad.
    std::vector<std::uint32_t> next();

  private:
    using Sequence = boost::random::sobol_engine<std::uint32_t, 32>;

    Random random_;
    std::uint64_t seed_;
    unsigned quads_;
    std::uint32_t sample_ = 0;
    Sequence sequence_;
};

}  // namespace vndf::render
