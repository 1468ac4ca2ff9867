#include "runtime/devices.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdlib>

#include <fmt/format.h>

#include "error.h"
#include "runtime/no_device.h"
#include "text.h"

namespace vndf::runtime {
namespace {

// A device that fails to answer one question is still a device.
template <cl_device_info name, class T>
T info(const cl::Device& device, T otherwise) {
    try {
        return static_cast<T>(device.getInfo<name>());
    } catch (const cl::Error&) {
        return otherwise;
    }
}

std::string trimmed(std::string text) {
    while (!text.empty() && (std::isspace(static_cast<unsigned char>(text.back())) || text.back() == '\0')) {
        text.pop_back();
    }
    return text;
}

Device describe(const cl::Device& handle, const std::string& platform, const std::string& version) {
    Device d;
    d.handle = handle;
    d.platform = platform;
    d.platform_version = version;
    d.name = trimmed(info<CL_DEVICE_NAME>(handle, std::string("unnamed device")));
    d.driver = trimmed(info<CL_DRIVER_VERSION>(handle, std::string()));
    d.c_version = trimmed(info<CL_DEVICE_OPENCL_C_VERSION>(handle, std::string()));
    d.type = info<CL_DEVICE_TYPE>(handle, cl_device_type{0});
    d.fp64 = info<CL_DEVICE_DOUBLE_FP_CONFIG>(handle, cl_device_fp_config{0}) != 0;
    const auto single = info<CL_DEVICE_SINGLE_FP_CONFIG>(handle, cl_device_fp_config{0});
    d.fma = (single & CL_FP_FMA) != 0;
    d.denormals = (single & CL_FP_DENORM) != 0;
    d.correct_divide_sqrt = (single & CL_FP_CORRECTLY_ROUNDED_DIVIDE_SQRT) != 0;
    d.compiler = info<CL_DEVICE_COMPILER_AVAILABLE>(handle, cl_bool{CL_TRUE}) != CL_FALSE;
    d.group_limit = info<CL_DEVICE_MAX_WORK_GROUP_SIZE>(handle, std::size_t{0});
    d.address_bits = info<CL_DEVICE_ADDRESS_BITS>(handle, 0u);
    d.compute_units = info<CL_DEVICE_MAX_COMPUTE_UNITS>(handle, 0u);
    d.clock_mhz = info<CL_DEVICE_MAX_CLOCK_FREQUENCY>(handle, 0u);
    d.memory_bytes = info<CL_DEVICE_GLOBAL_MEM_SIZE>(handle, 0ull);
    return d;
}

void append_devices(const cl::Platform& platform, std::vector<Device>& all) {
    try {
        std::vector<cl::Device> handles;
        platform.getDevices(CL_DEVICE_TYPE_ALL, &handles);
        const std::string name = trimmed(platform.getInfo<CL_PLATFORM_NAME>());
        const std::string version = trimmed(platform.getInfo<CL_PLATFORM_VERSION>());
        for (const cl::Device& handle : handles) all.push_back(describe(handle, name, version));
    } catch (const cl::Error&) {
        // Installed without a usable device (Clover on a machine without a GPU answers so).
    }
}

const Device& default_device(const std::vector<Device>& all) {
    const auto pocl = std::find_if(all.begin(), all.end(), [](const Device& d) {
        return d.platform == "Portable Computing Language" && (d.type & CL_DEVICE_TYPE_CPU) != 0;
    });
    if (pocl != all.end()) return *pocl;
    const auto builds = std::find_if(all.begin(), all.end(), [](const Device& d) { return d.compiler; });
    return builds == all.end() ? all.front() : *builds;
}

// Of the devices whose platform or name contains `name`, or of `name`#N the N-th alone.
struct Matches {
    std::string name;
    std::vector<const Device*> devices;
};

std::vector<const Device*> named(const std::vector<Device>& all, const std::string& name) {
    std::vector<const Device*> devices;
    for (const Device& d : all)
        if (lower(d.platform).find(lower(name)) != std::string::npos ||
            lower(d.name).find(lower(name)) != std::string::npos)
            devices.push_back(&d);
    return devices;
}

Matches matches_of(const std::vector<Device>& all, const std::string& wanted, const std::string& option) {
    const std::size_t sign = wanted.rfind('#');
    Matches whole{wanted, named(all, wanted)};
    if (!whole.devices.empty() || sign == std::string::npos) return whole;
    std::size_t number = 0;
    const char* const end = wanted.data() + wanted.size();
    const auto [after, error] = std::from_chars(wanted.data() + sign + 1, end, number);
    Matches part{wanted.substr(0, sign), named(all, wanted.substr(0, sign))};
    if (error != std::errc() || after != end || part.devices.empty()) return whole;
    if (number < 1 || number > part.devices.size())
        throw InputError(fmt::format("{}: '{}': '{}' matches {} device{}; #1 is the first", option, wanted,
                                     part.name, part.devices.size(), part.devices.size() == 1 ? "" : "s"));
    part.devices = {part.devices[number - 1]};
    return part;
}

constexpr std::string_view every = "all", every_of = "all:";

// Which option or variable asks, whose value becomes `wanted`.
std::string asking(std::string& wanted) {
    const char* const variable = std::getenv("CLVNDF_DEVICE");
    if (!wanted.empty() || !variable) return "--device";
    wanted = variable;
    return "CLVNDF_DEVICE";
}

std::string labels(const std::vector<Device>& all) {
    std::string text;
    for (const Device& d : all) text += (text.empty() ? "'" : ", '") + d.label() + "'";
    return text;
}

// Those that `wanted` names; throws if there are none.
Matches matching(const std::vector<Device>& all, const std::string& wanted, const std::string& option) {
    Matches matches = matches_of(all, wanted, option);
    if (!matches.devices.empty()) return matches;
    if (const std::string why = why_without_device(wanted); !why.empty())
        throw DeviceError(fmt::format("{} '{}': {}", option, wanted, why));
    throw InputError(fmt::format("{}: no platform or device name contains '{}'; there are {}", option, wanted,
                                 labels(all)));
}

}  // namespace

std::string Device::kind() const {
    return fmt::format("{}, {}, driver {}{}{}{}{}", label(), platform_version, driver, fp64 ? ", fp64" : "",
                       fma ? ", fma" : "", denormals ? ", subnormals" : "",
                       correct_divide_sqrt ? ", correctly rounded division" : "");
}

std::vector<Device> devices() {
    require_surviving_drivers();
    std::vector<cl::Platform> platforms;
    try {
        cl::Platform::get(&platforms);
    } catch (const cl::Error&) {
        return {};  // the loader's answer to no platform at all
    }
    std::vector<Device> all;
    for (const cl::Platform& platform : platforms) append_devices(platform, all);
    return all;
}

Choice choose_device(const std::vector<Device>& all, std::string wanted) {
    const std::string option = asking(wanted);
    if (all.empty()) throw DeviceError(no_device());
    if (wanted.empty()) return {default_device(all), {}};
    if (wants_all(wanted))
        throw InputError(
            fmt::format("{} '{}': this command uses one device; there are {}", option, wanted, labels(all)));
    const auto [name, matches] = matching(all, wanted, option);
    if (matches.size() == 1) return {*matches.front(), {}};
    return {*matches.front(),
            fmt::format("{}: '{}' matches {} devices; taking '{}', the first ('{}#2' is the second)", option,
                        wanted, matches.size(), matches.front()->label(), name)};
}

void require_compiler(const Device& device) {
    if (device.compiler) return;
    throw DeviceError(fmt::format(
        "\"{}\" ({}) has no compiler (CL_DEVICE_COMPILER_AVAILABLE is false), and kernels are built from "
        "their sources; --device picks another device",
        device.name, device.platform_version));
}

bool wants_all(std::string wanted) {
    asking(wanted);
    return wanted == every || (wanted.starts_with(every_of) && wanted.size() > every_of.size());
}

std::string one_of_all(const std::string& wanted) {
    if (wanted == every) return {};
    return wants_all(wanted) ? wanted.substr(every_of.size()) : wanted;
}

std::vector<Device> choose_devices(const std::vector<Device>& all, std::string wanted) {
    const std::string option = asking(wanted);
    if (all.empty()) throw DeviceError(no_device());
    if (wanted == every) return all;
    std::vector<Device> chosen;
    for (const Device* device : matching(all, one_of_all(wanted), option).devices) chosen.push_back(*device);
    return chosen;
}

void require_real(const Device& device, Real real) {
    if (real == Real::f64 && !device.fp64) {
        throw InputError(fmt::format("--real double: '{}' has no fp64; float is allowed", device.label()));
    }
}

Choice choose_device(std::string wanted) {
    return choose_device(devices(), std::move(wanted));
}

}  // namespace vndf::runtime
