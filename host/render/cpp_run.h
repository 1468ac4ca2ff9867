// Stages of kernels/render as C++ functions that take their arguments as a device's kernels do. Included behind the stages,
// whose vndf_render_item it sets.
#pragma once

#include <cstddef>
#include <cstring>
#include <tuple>
#include <type_traits>
#include <utility>

#include "render/cpp_stages.h"

namespace vndf::render {
namespace {

template <class T>
T as(const Given& given) {
    if constexpr (std::is_pointer_v<T>) {
        return static_cast<T>(given.buffer);
    } else {
        T value;
        std::memcpy(&value, given.value, sizeof value);
        return value;
    }
}

template <auto stage>
struct Runner;
template <class... Types, void (*stage)(Types...)>
struct Runner<stage> {
    static void run(const std::vector<Given>& given, std::size_t begin, std::size_t end) {
        run(given, begin, end, std::index_sequence_for<Types...>());
    }
    template <std::size_t... index>
    static void run(const std::vector<Given>& given, std::size_t begin, std::size_t end,
                    std::index_sequence<index...>) {
        const std::tuple<Types...> arguments{as<Types>(given[index])...};
        for (std::size_t i = begin; i < end; ++i) {
            vndf_render_item = static_cast<uint>(i);
            std::apply(stage, arguments);
        }
    }
};

}  // namespace
}  // namespace vndf::render
