#include "runtime/device_evaluator.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "error.h"
#include "runtime/opencl_error.h"

namespace vndf::runtime {
namespace {

constexpr std::size_t local_size =
    64;  // enough for every CPU device to vectorise, and one size compiles once
constexpr std::size_t max_items = std::size_t{1} << 22;  // of a launch: bounds the memory on the device

std::string all_options(const Device& device, Math math, Real real, const ProgramOptions& options) {
    std::string text =
        fmt::format("-cl-std=CL1.2 -DVNDF_REAL={} -DVNDF_MATH={}", to_string(real), to_string(math));
    if (device.correct_divide_sqrt) text += " -cl-fp32-correctly-rounded-divide-sqrt";
    if (!device.fma) text += " -DVNDF_SOFTWARE_FMA=1";
    if (options.mutant != 0) text += fmt::format(" -DVNDF_MUTANT={}", options.mutant);
    if (!options.build_options.empty()) text += ' ' + options.build_options;
    return text;
}

// Kernels have an item for each element of their arrays, in whole groups.
std::size_t padded(std::size_t items) {
    return (items + local_size - 1) / local_size * local_size;
}

std::string indented(const std::string& text) {
    std::string out;
    for (char c : text) out += c == '\n' ? std::string("\n  ") : std::string(1, c);
    return out;
}

}  // namespace

DeviceEvaluator::DeviceEvaluator(const Device& device, Math math, Real real, const ProgramOptions& options)
    : device_(device), math_(math), real_(real), build_options_(all_options(device, math, real, options)) {
    require_real(device, real);
    require_policy(math, real);
    const Assembly assembly{options.functions, options.substitutions};
    try {
        context_ = options.context() ? options.context : cl::Context(device.handle);
        queue_ = cl::CommandQueue(context_, device.handle);
    } catch (const cl::Error& error) {
        throw DeviceError(fmt::format("cannot use \"{}\" ({}): {} failed with {}", device.name,
                                      device.platform_version, error.what(), opencl_error_name(error.err())));
    }
    program_ = built(options.root, assemble(options.root, assembly) + options.more_source);
}

cl::Program DeviceEvaluator::built(const std::string& name, const std::string& source) const {
    const auto failure = [&](cl_int error, const std::string& log) {
        return DeviceError(fmt::format("cannot build {} on \"{}\" ({}): {}\n  options: {}\n  {}", name,
                                       device_.name, device_.platform_version, opencl_error_name(error),
                                       build_options_, indented(log)));
    };
    try {
        cl::Program program(context_, source);
        program.build({device_.handle}, build_options_.c_str());
        return program;
    } catch (const cl::BuildError& error) {
        std::string log;
        for (const auto& [_, text] : error.getBuildLog()) log += text;
        throw failure(error.err(), log);
    } catch (const cl::Error& error) {
        throw failure(error.err(), fmt::format("{} failed", error.what()));
    }
}

std::string DeviceEvaluator::describe() const {
    return fmt::format("{}, {} {}", device_.label(), to_string(math_), to_string(real_));
}

cl::Kernel& DeviceEvaluator::kernel(const std::string& name) {
    const auto found = kernels_.find(name);
    return found != kernels_.end() ? found->second
                                   : kernels_.emplace(name, cl::Kernel(program_, name.c_str())).first->second;
}

cl::Buffer& DeviceEvaluator::buffer(std::size_t index, std::size_t bytes) {
    if (index >= buffers_.size()) buffers_.resize(index + 1);
    auto& [buffer, capacity] = buffers_[index];
    if (capacity < bytes) {
        buffer = cl::Buffer(context_, CL_MEM_READ_WRITE, bytes);
        capacity = bytes;
    }
    return buffer;
}

void DeviceEvaluator::launch(cl::Kernel& kernel, std::size_t items) {
    const std::size_t allowed = kernel.getWorkGroupInfo<CL_KERNEL_WORK_GROUP_SIZE>(device_.handle);
    std::size_t local = local_size;
    while (local > allowed) local /= 2;
    queue_.enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(padded(items)), cl::NDRange(local));
}

template <class Body>
void DeviceEvaluator::in_chunks(const std::string& name, std::size_t n, Body body) {
    try {
        for (std::size_t first = 0; first < n; first += max_items) {
            body(kernel("vndf_batch_" + name), first, std::min(max_items, n - first));
        }
    } catch (const cl::Error& error) {
        throw DeviceError(fmt::format("cannot run {} on \"{}\" ({}): {} failed with {}\n  options: {}", name,
                                      device_.name, device_.platform_version, error.what(),
                                      opencl_error_name(error.err()), build_options_));
    }
}

void DeviceEvaluator::read_back(std::size_t index, void* to, std::size_t first, std::size_t items) {
    const std::size_t size = size_of(real_);
    queue_.enqueueReadBuffer(buffers_[index].first, CL_TRUE, 0, items * size,
                             static_cast<char*>(to) + first * size);
}

void DeviceEvaluator::run(const Function& function, std::size_t n, const std::vector<const void*>& inputs,
                          const std::vector<void*>& outputs) {
    const std::size_t size = size_of(real_);
    in_chunks(function.name, n, [&](cl::Kernel& kernel, std::size_t first, std::size_t items) {
        cl_uint argument = 0;
        std::vector<char> filled_up;
        for (const void* input : inputs) {
            cl::Buffer& to = buffer(argument, padded(items) * size);
            const char* from = static_cast<const char*>(input) + first * size;
            if (padded(items) > items) {
                // With the chunk's first item; in one write, which is all that Oclgrind takes for initialised.
                filled_up.assign(from, from + items * size);
                for (std::size_t i = items; i < padded(items); ++i)
                    filled_up.insert(filled_up.end(), from, from + size);
                from = filled_up.data();
            }
            queue_.enqueueWriteBuffer(to, CL_TRUE, 0, padded(items) * size, from);
            kernel.setArg(argument++, to);
        }
        for (std::size_t i = 0; i < outputs.size(); ++i, ++argument) {
            kernel.setArg(argument, buffer(argument, padded(items) * size));
        }
        kernel.setArg(argument, cl_uint{0});
        launch(kernel, items);
        for (std::size_t i = 0; i < outputs.size(); ++i)
            read_back(inputs.size() + i, outputs[i], first, items);
    });
}

void DeviceEvaluator::uniforms(std::uint64_t seed, std::uint64_t stream, std::size_t n, void* u1, void* u2) {
    const std::size_t size = size_of(real_);
    // A program of its own: most evaluators never need it, and it takes time to build.
    if (!kernels_.contains("vndf_batch_uniforms")) {
        const std::string root = "kernels/batch/uniforms.cl";
        kernels_["vndf_batch_uniforms"] = cl::Kernel(built(root, assemble(root)), "vndf_batch_uniforms");
    }
    in_chunks("uniforms", n, [&](cl::Kernel& kernel, std::size_t first, std::size_t items) {
        kernel.setArg(0, buffer(0, items * size));
        kernel.setArg(1, buffer(1, items * size));
        kernel.setArg(2, cl_ulong{seed});
        kernel.setArg(3, cl_ulong{stream});
        kernel.setArg(4, cl_ulong{first});
        kernel.setArg(5, static_cast<cl_uint>(items));
        launch(kernel, items);
        read_back(0, u1, first, items);
        read_back(1, u2, first, items);
    });
}

}  // namespace vndf::runtime
