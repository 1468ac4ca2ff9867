#include "runtime/no_device.h"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "error.h"
#include "runtime/opencl.h"
#include "runtime/opencl_error.h"
#include "text.h"

namespace vndf::runtime {
namespace {

std::string environment(const char* variable) {
    const char* const value = std::getenv(variable);
    return value ? value : "";
}

// Of the address space, or "".
std::string memory_limit() {
    rlimit limit{};
    if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return {};
    return fmt::format("the address space is limited to {} KiB (ulimit -v)", limit.rlim_cur / 1024);
}

// PoCL has no device if it cannot write to its cache.
std::string pocl_cache_failure() {
    const std::filesystem::path folder = pocl_cache_folder();
    if (folder.empty()) return {};
    std::error_code failure;
    std::filesystem::create_directories(folder, failure);  // as PoCL does
    if (!failure && access(folder.c_str(), W_OK) != 0) failure = {errno, std::generic_category()};
    if (!failure) return {};
    return fmt::format("it cannot write to its cache folder '{}' ({}); POCL_CACHE_DIR chooses another",
                       folder.string(), failure.message());
}

// What is known of a platform without devices.
std::string cause(const std::string& platform, cl_int status) {
    std::string likely = platform == "Portable Computing Language" ? pocl_cache_failure() : "";
    if (likely.empty()) likely = memory_limit();
    return fmt::format("'{}' is installed but offers no device ({}){}{}", platform, opencl_error_name(status),
                       likely.empty() ? "" : ": ", likely);
}

}  // namespace

// Where the first of these that is set says.
std::string pocl_cache_folder() {
    std::filesystem::path folder = environment("POCL_CACHE_DIR");
    if (folder.empty() && !environment("XDG_CACHE_HOME").empty())
        folder = std::filesystem::path(environment("XDG_CACHE_HOME")) / "pocl/kcache";
    if (folder.empty() && !environment("HOME").empty())
        folder = std::filesystem::path(environment("HOME")) / ".cache/pocl/kcache";
    return folder.string();
}

std::string why_without_device(const std::string& wanted) {
    std::vector<cl::Platform> platforms;
    try {
        cl::Platform::get(&platforms);
    } catch (const cl::Error&) {
        return {};  // the loader's answer to no platform at all
    }
    std::vector<std::string> causes;
    for (const cl::Platform& platform : platforms) {
        std::string name = "unnamed platform";
        cl_int status = CL_DEVICE_NOT_FOUND;
        std::vector<cl::Device> devices;
        try {
            name = platform.getInfo<CL_PLATFORM_NAME>();
            platform.getDevices(CL_DEVICE_TYPE_ALL, &devices);
        } catch (const cl::Error& error) {
            status = error.err();
        }
        if (devices.empty() && lower(name).find(lower(wanted)) != std::string::npos)
            causes.push_back(cause(name, status));
    }
    return fmt::format("{}", fmt::join(causes, "; "));
}

std::string no_device() {
    if (const std::string why = why_without_device(""); !why.empty()) return "no OpenCL device: " + why;
    const std::string limit = memory_limit(), vendors = environment("OCL_ICD_VENDORS");
    return fmt::format(
        "no OpenCL device on this machine: install an implementation such as pocl-opencl-icd{}{}",
        vendors.empty()
            ? ""
            : fmt::format("; OCL_ICD_VENDORS is '{}', and only what is named there counts", vendors),
        limit.empty() ? "" : fmt::format("; {}, and one that does not fit is passed over", limit));
}

void require_surviving_drivers() {
    const std::string limit = memory_limit();
    if (limit.empty()) return;
    const pid_t child = fork();
    if (child == 0) {
        why_without_device("");
        _exit(0);
    }
    int status = 0;
    while (child > 0 && waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
    if (child > 0 && WIFSIGNALED(status))
        throw DeviceError(
            fmt::format("an OpenCL driver ended the process that asked for its devices ({}): {}",
                        strsignal(WTERMSIG(status)), limit));
}

}  // namespace vndf::runtime
