// What a launch's random numbers share (kernels/render/random.h).
#pragma once

#include <cstdint>
#include <vector>

#include <boost/random/sobol.hpp>

namespace vndf::render {

enum class Random { sobol, philox };

class Words {
  public:
    Words(Random random, std::uint64_t seed, unsigned quads);

    // Of a sample: VNDF_QUAD_WORDS for each quad.
    std::vector<std::uint32_t> of(std::uint64_t sample);

  private:
    using Sequence = boost::random::sobol_engine<std::uint32_t, 32>;

    Random random_;
    std::uint64_t seed_;
    unsigned quads_;
    Sequence sequence_;
    std::uint64_t next_ = 1;  // the sample whose point the sequence gives next
};

}  // namespace vndf::render
