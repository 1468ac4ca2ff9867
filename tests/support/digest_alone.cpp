// What digest_host.cpp leaves of the host build when it is compiled for another machine, without the libraries: float and strict
// alone (host_build.cpp with those switches).
#include "runtime/host_build.h"

namespace vndf::runtime {

HostFunction find_host_function_float_builtin(const char*) {
    return nullptr;
}
HostFunction find_host_function_double_strict(const char*) {
    return nullptr;
}
HostFunction find_host_function_double_builtin(const char*) {
    return nullptr;
}

}  // namespace vndf::runtime
