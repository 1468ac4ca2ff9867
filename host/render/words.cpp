#include "render/words.h"

#include "kernels/render/queues.h"
#include "splitmix64.h"

namespace vndf::render {
namespace {

std::uint32_t reversed(std::uint32_t x) {
    std::uint32_t result = 0;
    for (int i = 0; i < 32; ++i) result |= (x >> i & 1) << (31 - i);
    return result;
}

}  // namespace

Words::Words(Random random, std::uint64_t seed, unsigned quads)
    : random_(random), seed_(seed), quads_(quads), sequence_(4 * quads) {}

std::vector<std::uint32_t> Words::of(std::uint64_t sample) {
    std::vector<std::uint32_t> words(VNDF_QUAD_WORDS * quads_);
    // The engine leaves out the first point, the origin.
    if (random_ == Random::sobol && sample > 0) {
        if (sample != next_) sequence_.seed(static_cast<std::uint32_t>(sample - 1));
        next_ = sample + 1;
    }
    for (unsigned quad = 0; quad < quads_; ++quad) {
        std::uint32_t* const at = &words[VNDF_QUAD_WORDS * quad];
        if (random_ == Random::philox) {
            at[0] = static_cast<std::uint32_t>(seed_);
            at[1] = static_cast<std::uint32_t>(seed_ >> 32);
            at[2] = static_cast<std::uint32_t>(sample);
            at[3] = quad;
            continue;
        }
        for (unsigned k = 0; k < 4; ++k) {
            at[2 * k] = sample == 0 ? 0 : reversed(sequence_());
            at[2 * k + 1] = static_cast<std::uint32_t>(splitmix64(splitmix64(seed_) + 4 * quad + k) >> 32);
        }
    }
    return words;
}

}  // namespace vndf::render
