// Picking one of many by given chances with two numbers: Walker's alias method, its tables after Vose.
#pragma once

#include <cstdint>
#include <vector>

namespace vndf::render {

// Row i is kept with the probability keep[i], or else is other[i]. keep is a multiple of 2^-24, as random numbers are, so that a row
// is picked with exactly its chance (their sum is 1), wherever there are rows enough for all.
struct Alias {
    std::vector<float> keep;
    std::vector<std::uint32_t> other;
    std::vector<double> chance;
};

// Of at most 2^28 weights >= 0, their sum finite. None with a weight is never picked: each chance is right to 2^-23 of the mean one, but
// the largest, which makes up for the others. Even where all weights are 0.
// Source: Vose, A Linear Algorithm for Generating Random Numbers with a Given Distribution, 1991.
Alias alias_of(const std::vector<double>& weights);

}  // namespace vndf::render
