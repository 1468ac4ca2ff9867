// A sum by which damage and other content are noticed; no protection from who means it.
#pragma once

#include <cstdint>
#include <string_view>

namespace vndf {

// FNV-1a of bytes; `before`: of those that come before them.
constexpr std::uint64_t fnv1a(std::string_view bytes, std::uint64_t before = 0xcbf29ce484222325) {
    for (const char c : bytes) before = (before ^ static_cast<unsigned char>(c)) * 0x100000001b3;
    return before;
}

}  // namespace vndf
