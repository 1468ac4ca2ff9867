// The OpenCL devices of this machine, and the choice of one.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "runtime/evaluator.h"
#include "runtime/opencl.h"

namespace vndf::runtime {

struct Device {
    cl::Device handle;
    std::string platform, platform_version;
    std::string name, driver, c_version;
    cl_device_type type = 0;
    bool fp64 = false;
    bool fma = false;                  // float
    bool denormals = false;            // float
    bool correct_divide_sqrt = false;  // float: / and sqrt correctly rounded on request
    bool compiler = true;              // for sources, which programs are built from
    std::size_t group_limit = 0;       // work-items of a group, at most
    unsigned address_bits = 0;
    unsigned compute_units = 0, clock_mhz = 0;
    unsigned long long memory_bytes = 0;

    std::string label() const { return platform + " / " + name; }
    // The same for devices that give the same results at the same speed, as far as they say.
    std::string kind() const;
};

// Every device of every platform, in the loader's order. A platform without devices, or one that fails to
// list them, is passed over. Throws DeviceError where asking would end the process.
std::vector<Device> devices();

struct Choice {
    Device device;
    std::string note;  // if several devices matched: which one was taken, for stderr
};

// The first device whose platform or device name contains `wanted` (case does not matter), or of `wanted`#N the N-th. Nothing
// wanted: the environment's CLVNDF_DEVICE, else PoCL's CPU device, else the first device with a compiler. Throws InputError,
// listing the devices there are; DeviceError, with the likely cause, if there are none, or only a platform of that name.
Choice choose_device(std::string wanted = {});
Choice choose_device(const std::vector<Device>& all, std::string wanted);

// Whether `wanted`, or without it CLVNDF_DEVICE, asks for several devices: "all", or "all:NAME", those whose platform or
// device name contains NAME.
bool wants_all(std::string wanted);

// What asks for one of them: "" for "all", "NAME" for "all:NAME", and anything else for itself.
std::string one_of_all(const std::string& wanted);

// Those, in the loader's order. Throws as choose_device() does.
std::vector<Device> choose_devices(const std::vector<Device>& all, std::string wanted);

// Throws InputError if the device has no numbers of this type.
void require_real(const Device& device, Real real);

// Throws DeviceError if the device has no compiler.
void require_compiler(const Device& device);

}  // namespace vndf::runtime
