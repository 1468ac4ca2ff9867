// Evaluation on an OpenCL device: a program with the entry points of kernels/batch, and buffers for their arrays.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "runtime/evaluator.h"
#include "runtime/program.h"

namespace vndf::runtime {

class DeviceEvaluator final : public Evaluator {
  public:
    explicit DeviceEvaluator(Program program) : program_(std::move(program)) {}
    DeviceEvaluator(const Device& device, Math math, Real real, const ProgramOptions& options = {})
        : DeviceEvaluator(Program(device, math, real, options)) {}

    void run(const Function& function, std::size_t n, const std::vector<const void*>& inputs,
             const std::vector<void*>& outputs) override;

    // Fills u1 and u2 with n numbers in [0, 1) each, made on the device by Philox: item i depends on (seed,
    // stream, i) alone. Multiples of 2^-24 in float, of 2^-53 in double.
    void uniforms(std::uint64_t seed, std::uint64_t stream, std::size_t n, void* u1, void* u2);

    Real input_real() const override { return program_.real(); }
    Real output_real() const override { return program_.real(); }
    std::string describe() const override;

    const Program& program() const { return program_; }

  private:
    cl::Kernel& kernel(const std::string& name);
    cl::Buffer& buffer(std::size_t index, std::size_t bytes);
    void read_back(std::size_t index, void* to, std::size_t first, std::size_t items);
    template <class Body>
    void in_chunks(const std::string& name, std::size_t n, Body body);

    Program program_;
    std::optional<Program> uniforms_;  // built when it is first needed
    std::map<std::string, cl::Kernel> kernels_;
    // One for each kernel argument, with its size in bytes; reused from launch to launch.
    std::vector<std::pair<cl::Buffer, std::size_t>> buffers_;
};

}  // namespace vndf::runtime
