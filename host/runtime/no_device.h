// Why there is no OpenCL device where one was expected.
#pragma once

#include <string>

namespace vndf::runtime {

// For an error: which implementations there are, and what probably keeps each from offering a device. Of those whose
// name contains `wanted` alone (case does not matter); empty if there are none of that name.
std::string why_without_device(const std::string& wanted);

// For an error: that there is no device at all, why, and what to do.
std::string no_device();

// Where PoCL keeps what it compiled; empty if the environment does not say.
std::string pocl_cache_folder();

// Throws DeviceError if asking for the devices would end the process. Drivers do that where memory is limited (ulimit -v)
// and their threads find none; then a child asks first.
void require_surviving_drivers();

}  // namespace vndf::runtime
