// A built OpenCL program with the context and the queue that it runs in: what evaluators, exhaustion, bench and any other
// user of a device stand on.
#pragma once

#include <string>
#include <vector>

#include <fmt/format.h>

#include "error.h"
#include "runtime/devices.h"
#include "runtime/opencl_error.h"
#include "runtime/sources.h"

namespace vndf::runtime {

// Work-items of a group: enough for every CPU device to vectorise, and one size compiles once.
inline constexpr std::size_t group_size = 64;

// The least multiple of the group size that is not below `items`.
constexpr std::size_t whole_groups(std::size_t items) {
    return (items + group_size - 1) / group_size * group_size;
}

struct ProgramOptions {
    std::string build_options;        // appended, e.g. "-cl-fast-relaxed-math"; -cl-std=CL1.2 without another
    bool correct_divide_sqrt = true;  // by the device or by our own code
    std::string root = "kernels/batch/batch.cl";  // the source with the entry points
    std::vector<SourceFile> more_files;           // beside embedded_sources(); the root may be one of them
    std::string more_source;                      // OpenCL C after the root
    std::vector<std::string> functions;           // registered names to compile; empty: all
    std::vector<Substitution> substitutions;
    int mutant = 0;  // the substitution switched on; 0: none
};

class Program {
  public:
    // Builds it, in a context of its own. Throws InputError if the device lacks fp64 and double is asked for, or the
    // policy is for float only; BuildError with the build log if the compiler refuses the source or the options; DeviceError for
    // whatever else fails.
    Program(const Device& device, Math math, Real real, const ProgramOptions& options = {});
    // On the device of another program, in its context and its queue.
    Program(const Program& beside, Math math, Real real, const ProgramOptions& options = {});

    const Device& device() const { return device_; }
    Math math() const { return math_; }
    Real real() const { return real_; }
    const std::string& build_options() const { return build_options_; }
    const cl::Context& context() const { return context_; }
    const cl::CommandQueue& queue() const { return queue_; }

    cl::Kernel kernel(const std::string& name) const;
    // Of the source as the compiler gets it, and of what the driver made of it.
    std::size_t source_bytes() const { return source_bytes_; }
    std::size_t binary_bytes() const;
    // Whether there is a kernel of this name.
    bool has_kernel(const std::string& name) const;
    cl::Buffer buffer(std::size_t bytes) const { return cl::Buffer(context_, CL_MEM_READ_WRITE, bytes); }

    // Runs the kernel in whole groups of at least `items` work-items.
    void launch(const cl::Kernel& kernel, std::size_t items, cl::Event* event = nullptr) const;

    // body(); an OpenCL failure in it becomes a DeviceError: "cannot `deed` on ...".
    template <class Body>
    auto guarded(const std::string& deed, Body body) const {
        try {
            return body();
        } catch (const cl::Error& error) {
            throw failure(deed, error);
        }
    }

  private:
    void build(const ProgramOptions& options);
    std::string build_log() const;
    DeviceError failure(const std::string& deed, const cl::Error& error) const;

    Device device_;
    Math math_;
    Real real_;
    std::string build_options_;
    std::size_t source_bytes_ = 0;
    cl::Context context_;
    cl::CommandQueue queue_;
    cl::Program program_;
};

}  // namespace vndf::runtime
