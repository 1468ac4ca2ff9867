// Inputs of a function in which zeros stand wherever its domain allows one, each with either sign.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "registry.h"

namespace vndf {

// Unit vectors along an axis and in the planes between two, with every pattern of signs of their zeros; and one without.
inline std::vector<std::array<double, 3>> directions_with_zeros() {
    std::vector<std::array<double, 3>> all{{-0.48, 0.6, 0.64}};
    const std::array<double, 3> bases[] = {{0, 0, 1},     {0, 0, -1},     {1, 0, 0},      {-1, 0, 0},
                                           {0, 1, 0},     {0, -1, 0},     {0, 0.6, 0.8},  {0, -0.8, -0.6},
                                           {0.6, 0, 0.8}, {-0.8, 0, 0.6}, {0.8, 0, -0.6}, {0.8, -0.6, 0}};
    for (const std::array<double, 3>& v : bases)
        for (int signs = 0; signs < 8; ++signs) {
            std::array<double, 3> w = v;
            bool each_once = true;
            for (int k = 0; k < 3; ++k)
                if (signs >> k & 1) v[k] == 0 ? w[k] = -0.0 : each_once = false;
            if (each_once) all.push_back(w);
        }
    return all;
}

// Rows of the function's inputs. Directions: every pair of the above (a third goes through them in turn). Other
// arguments: none 0, each 0 alone, all 0, with either sign.
inline std::vector<std::vector<double>> rows_with_zeros(const Function& function) {
    const auto directions = directions_with_zeros();
    std::vector<std::vector<double>> rows{{}};
    int vectors = 0, scalars = 0;
    std::vector<bool> is_scalar;
    for (const std::string& name : function.inputs) {
        vectors += name.ends_with("_z");
        is_scalar.push_back(name.find('_') == name.npos || name.starts_with("alpha") ||
                            name.starts_with("slope") || name.starts_with("cos_theta") ||
                            name == "wo_dot_wm" || name == "one_minus_cos");
        scalars += is_scalar.back();
    }
    for (int v = 0; v < vectors; ++v) {
        std::vector<std::vector<double>> longer;
        for (const auto& row : rows)
            for (std::size_t i = 0; i < (v < 2 ? directions.size() : 3); ++i) {
                const auto& d = directions[v < 2 ? i : (rows.size() + longer.size() * 7) % directions.size()];
                longer.push_back(row);
                longer.back().insert(longer.back().end(), d.begin(), d.end());
            }
        rows = longer;
    }
    std::vector<std::vector<double>> choices{std::vector<double>(scalars, 0.3)};
    for (int s = 1; s < scalars; ++s) choices[0][s] = s % 2 ? 0.9 : 0.1;  // alpha_x and alpha_y differ
    for (const double zero : {0.0, -0.0}) {
        for (int s = 0; s < scalars && scalars > 1; ++s) {
            choices.push_back(choices[0]);
            choices.back()[s] = zero;
        }
        if (scalars) choices.push_back(std::vector<double>(scalars, zero));
    }
    std::vector<std::vector<double>> all;
    for (const auto& row : rows)
        for (const auto& choice : choices) {
            auto vector = row.begin();
            auto scalar = choice.begin();
            all.emplace_back();
            for (const bool is : is_scalar) all.back().push_back(is ? *scalar++ : *vector++);
        }
    return all;
}

}  // namespace vndf
