// Long tests in parts, for several processes.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <utility>

#include "catch.h"

namespace vndf {

// The environment's CLVNDF_SHARD, "2/4" for the second of four parts, counted from 0; without it the whole.
inline std::pair<std::size_t, std::size_t> shard() {
    const char* text = std::getenv("CLVNDF_SHARD");
    if (!text) return {0, 1};
    unsigned part = 0, parts = 0;
    REQUIRE(std::sscanf(text, "%u/%u", &part, &parts) == 2);
    REQUIRE((part >= 1 && part <= parts));
    return {part - 1, parts};
}

}  // namespace vndf
