// The registered functions compiled as C++ (host_build.cpp, once for each real type and policy).
#pragma once

#include <cstddef>

namespace vndf::runtime {

// Evaluates n rows; the pointers are float or double arrays, one for each scalar in the registry's order.
using HostFunction = void (*)(const void* const* inputs, void* const* outputs, std::size_t n);

// The function of this name, or nullptr.
HostFunction find_host_function_float_strict(const char* name);
HostFunction find_host_function_float_builtin(const char* name);
HostFunction find_host_function_double_strict(const char* name);
HostFunction find_host_function_double_builtin(const char* name);

}  // namespace vndf::runtime
