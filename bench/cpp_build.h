// The kernel headers compiled as C++ for this very machine (-O3 -march=native), for comparison.
#pragma once

#include "runtime/host_build.h"

namespace vndf::bench {

// The function of this name in strict float, or nullptr.
runtime::HostFunction find_cpp_function(const char* name);

}  // namespace vndf::bench
