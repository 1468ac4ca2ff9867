// What programs cost to build.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "runtime/program.h"

namespace vndf::bench {

struct BuildTime {
    std::string program;
    // Until all of its kernels have run, with an empty compiler cache and from the cache.
    double cold_s = 0, warm_s = 0;
    std::size_t source_bytes = 0, binary_bytes = 0;
};

// One, ten and all samplers in strict float; and, for the cap, conic2026 and Jakob's map, twelve call sites in one kernel, all
// inlined, and the same calls of one function that is not.
std::vector<BuildTime> build_times(const runtime::Program& beside);

}  // namespace vndf::bench
