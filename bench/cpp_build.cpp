#include "cpp_build.h"

// The host build's source once more, under another name.
#define find_host_function_float_strict find_native_function_float_strict
#include "runtime/host_build.cpp"

namespace vndf::bench {

runtime::HostFunction find_cpp_function(const char* name) {
    return runtime::find_native_function_float_strict(name);
}

}  // namespace vndf::bench
