// The one place that includes the OpenCL C++ bindings, so that their switches agree everywhere.
#pragma once

// 110, not 120: with minimum 120 and target 300 the bindings of Debian 12 do not compile.
#define CL_HPP_MINIMUM_OPENCL_VERSION 110
#define CL_HPP_TARGET_OPENCL_VERSION 300
#define CL_HPP_ENABLE_EXCEPTIONS
#include <CL/opencl.hpp>
