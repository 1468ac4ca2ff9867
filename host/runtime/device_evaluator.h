// Evaluation on an OpenCL device: one program with the entry points of kernels/batch.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "runtime/devices.h"
#include "runtime/evaluator.h"
#include "runtime/sources.h"

namespace vndf::runtime {

struct ProgramOptions {
    std::vector<std::string> functions;  // registered names to compile; empty: all
    std::string build_options;           // appended, e.g. "-cl-fast-relaxed-math"
    std::vector<Substitution> substitutions;
    int mutant = 0;                               // the substitution switched on; 0: none
    std::string root = "kernels/batch/batch.cl";  // the embedded source with the entry points
    std::string more_source;                      // OpenCL C after it
    cl::Context context;                          // shared with the caller; default: a new one
};

class DeviceEvaluator final : public Evaluator {
  public:
    // Builds the program. Throws InputError if the device lacks fp64 and double is asked for, or the policy is
    // float only; DeviceError with the build log if the build fails.
    DeviceEvaluator(const Device& device, Math math, Real real, const ProgramOptions& options = {});

    void run(const Function& function, std::size_t n, const std::vector<const void*>& inputs,
             const std::vector<void*>& outputs) override;

    // Fills u1 and u2 with n numbers in [0, 1) each, made on the device by Philox: item i depends on (seed,
    // stream, i) alone. Multiples of 2^-24 in float, of 2^-53 in double.
    void uniforms(std::uint64_t seed, std::uint64_t stream, std::size_t n, void* u1, void* u2);

    Real input_real() const override { return real_; }
    Real output_real() const override { return real_; }
    std::string describe() const override;

    const Device& device() const { return device_; }
    const std::string& build_options() const { return build_options_; }

    // For callers with launches of their own.
    const cl::Context& context() const { return context_; }
    const cl::Program& program() const { return program_; }

  private:
    cl::Program built(const std::string& name, const std::string& source) const;
    cl::Kernel& kernel(const std::string& name);
    cl::Buffer& buffer(std::size_t index, std::size_t bytes);
    void launch(cl::Kernel& kernel, std::size_t items);
    void read_back(std::size_t index, void* to, std::size_t first, std::size_t items);
    template <class Body>
    void in_chunks(const std::string& name, std::size_t n, Body body);

    Device device_;
    Math math_;
    Real real_;
    std::string build_options_;
    cl::Context context_;
    cl::CommandQueue queue_;
    cl::Program program_;
    std::map<std::string, cl::Kernel> kernels_;
    // One for each kernel argument, with its size in bytes; reused from launch to launch.
    std::vector<std::pair<cl::Buffer, std::size_t>> buffers_;
};

}  // namespace vndf::runtime
