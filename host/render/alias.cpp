#include "render/alias.h"

#include <cmath>
#include <numeric>

namespace vndf::render {

Alias alias_of(const std::vector<double>& weights) {
    const std::size_t n = weights.size();
    const double mean = std::accumulate(weights.begin(), weights.end(), 0.0) / static_cast<double>(n);
    std::vector<double> share(n);
    std::vector<std::uint32_t> low, high;
    for (std::size_t i = 0; i < n; ++i) {
        share[i] = weights[i] / mean;
        (share[i] < 1 ? low : high).push_back(static_cast<std::uint32_t>(i));
    }
    Alias alias{std::vector<float>(n, 1.0f), std::vector<std::uint32_t>(n)};
    std::iota(alias.other.begin(), alias.other.end(), 0u);
    while (!low.empty() && !high.empty()) {
        const std::uint32_t small = low.back(), large = high.back();
        low.pop_back();
        // Rounded down, so that a row without weight is never kept.
        auto keep = static_cast<float>(share[small]);
        if (keep > share[small]) keep = std::nextafter(keep, 0.0f);
        alias.keep[small] = keep;
        alias.other[small] = large;
        share[large] -= 1 - share[small];
        if (share[large] >= 1) continue;
        high.pop_back();
        low.push_back(large);
    }
    return alias;
}

}  // namespace vndf::render
