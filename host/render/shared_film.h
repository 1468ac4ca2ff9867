// A film whose parts are traced by several, to the bits that one would give it: a part gets its samples in their order.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "render/wavefront.h"

namespace vndf::render {

// Of the one who shares out. Tasks are numbered round by round: in each round every part gets the same samples, after those of
// the round before.
class SharedFilm {
  public:
    // Goes on from a state. shares: how many work on it.
    SharedFilm(const Settings& settings, State state, std::size_t shares);

    // Parts of a round. A task needs the result of that many tasks before it.
    std::size_t parts() const { return parts_; }
    // Bytes for trace_part(); nothing if all pixels would have `end` samples. A round that begins now has at most `samples`.
    std::optional<std::string> task(std::size_t number, std::uint64_t end, std::uint64_t samples);
    // What trace_part() returned, in the order of the tasks. True at the end of a round.
    bool take(std::size_t number, const std::string& traced);

    // After the last whole round; of a round of one sample also what is taken of it.
    const State& state() const { return state_; }
    std::uint32_t part_pixels() const { return part_pixels_; }

  private:
    struct Round {
        std::uint64_t sample, samples;
    };
    Part part(std::size_t number) const;

    std::uint32_t pixels_, part_pixels_;
    std::size_t parts_;
    std::uint64_t next_sample_;
    bool began_in_the_middle_;  // of a sample
    std::vector<Round> rounds_;
    State state_, growing_;
};

// What others do.
std::string trace_part(Wavefront& wavefront, const std::string& task);

}  // namespace vndf::render
