// Numbers that the format bounds: what is out of bounds is shown as the nearest that is not.
#pragma once

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "gltf/json.h"
#include "gltf/warnings.h"
#include "render/material.h"

namespace vndf::gltf {

// Far enough from the limits of floats that products of a few such numbers are finite.
constexpr double largest_value = 1e6;

class Values {
  public:
    explicit Values(Warnings& warnings) : warnings_(warnings) {}

    float number(const Item& item, double otherwise, double low, double high) const {
        return static_cast<float>(item ? clamped(item, read(item), low, high) : otherwise);
    }
    template <std::size_t N>
    std::array<float, N> numbers(const Item& item, std::array<float, N> otherwise, double low,
                                 double high) const {
        if (!item) return otherwise;
        const std::array<double, N> values = item.numbers<N>();
        for (std::size_t i = 0; i < N; ++i)
            otherwise[i] = static_cast<float>(clamped(item, values[i], low, high));
        return otherwise;
    }

  private:
    static double read(const Item& item) {
        constexpr double any = std::numeric_limits<double>::max();
        return item.number(-any, any);
    }
    double clamped(const Item& item, double x, double low, double high) const {
        const double nearest = std::clamp(x, low, high);
        if (nearest != x)
            warnings_.add("values out of range, clamped",
                          fmt::format("{} {:g} to {:g}", item.place(), x, nearest));
        return nearest;
    }

    Warnings& warnings_;
};

}  // namespace vndf::gltf
