// Picking one of many by given chances with two numbers: Walker's alias method, its tables after Vose.
#pragma once

#include <cstdint>
#include <vector>

namespace vndf::render {

// Row i is kept with the probability keep[i], or else is other[i].
struct Alias {
    std::vector<float> keep;
    std::vector<std::uint32_t> other;
};

// weights: >= 0, not all 0, their sum finite.
Alias alias_of(const std::vector<double>& weights);

}  // namespace vndf::render
