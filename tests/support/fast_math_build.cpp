// kernels/vndf as C++ once more, in strict float, for compilers that are told to loosen arithmetic.
#define find_host_function_float_strict find_fast_math_function_float
#include "../../host/runtime/host_build.cpp"
