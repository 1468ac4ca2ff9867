// kernels/vndf as C++ once more, compiled without optimisation: every operation that the source asks for is executed, and
// no other. Compiled once for each VNDF_REAL, set by CMake.
#define find_host_function_float_strict find_unoptimised_function_float
#define find_host_function_double_strict find_unoptimised_function_double
#include "../../host/runtime/host_build.cpp"
