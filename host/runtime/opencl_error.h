// OpenCL's status codes by name.
#pragma once

#include <string>

namespace vndf::runtime {

// "CL_BUILD_PROGRAM_FAILURE"; a code without a known name as "OpenCL status -1234".
std::string opencl_error_name(int code);

}  // namespace vndf::runtime
