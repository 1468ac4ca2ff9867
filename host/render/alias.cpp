#include "render/alias.h"

#include <algorithm>

namespace vndf::render {
namespace {

constexpr std::int64_t one = 1 << 24;  // shares of a row of the table

// One share for each row that has a weight, of the others as many as it calls for.
std::vector<std::int64_t> shares_of(const std::vector<double>& weights) {
    double total = 0;
    std::int64_t positive = 0;
    for (const double w : weights) total += w, positive += w > 0;
    const std::int64_t others = static_cast<std::int64_t>(weights.size()) * one - positive;
    std::vector<std::int64_t> shares;
    double sum = 0;
    std::int64_t given = 0;
    for (const double w : weights) {
        sum += w;
        const auto until =
            static_cast<std::int64_t>(std::min(sum / total, 1.0) * static_cast<double>(others));
        shares.push_back((w > 0) + until - given);
        given = until;
    }
    // What rounding left.
    *std::max_element(shares.begin(), shares.end()) += others - given;
    return shares;
}

}  // namespace

Alias alias_of(const std::vector<double>& weights) {
    const std::size_t n = weights.size();
    const bool any = std::any_of(weights.begin(), weights.end(), [](double w) { return w > 0; });
    std::vector<std::int64_t> shares = shares_of(any ? weights : std::vector<double>(n, 1));
    Alias alias{std::vector<float>(n, 1), std::vector<std::uint32_t>(n), std::vector<double>(n)};
    std::vector<std::uint32_t> small, large;
    for (std::uint32_t i = 0; i < n; ++i) {
        alias.chance[i] = static_cast<double>(shares[i]) / one / static_cast<double>(n);
        alias.other[i] = i;
        (shares[i] < one ? small : large).push_back(i);
    }
    // What is left is as much as the rows left have on average: beside one with less there is one with more.
    while (!small.empty()) {
        const std::uint32_t row = small.back(), from = large.back();
        small.pop_back();
        alias.keep[row] = static_cast<float>(shares[row]) / one;
        alias.other[row] = from;
        shares[from] -= one - shares[row];
        if (shares[from] >= one) continue;
        large.pop_back();
        small.push_back(from);
    }
    return alias;
}

}  // namespace vndf::render
