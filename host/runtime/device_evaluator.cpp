#include "runtime/device_evaluator.h"

#include <algorithm>

namespace vndf::runtime {
namespace {

constexpr std::size_t max_items = std::size_t{1} << 22;  // of a launch: bounds the memory on the device

}  // namespace

std::string DeviceEvaluator::describe() const {
    return fmt::format("{}, {} {}", program_.device().label(), to_string(program_.math()),
                       to_string(program_.real()));
}

cl::Kernel& DeviceEvaluator::kernel(const std::string& name) {
    const auto found = kernels_.find(name);
    return found != kernels_.end() ? found->second
                                   : kernels_.emplace(name, program_.kernel(name)).first->second;
}

cl::Buffer& DeviceEvaluator::buffer(std::size_t index, std::size_t bytes) {
    if (index >= buffers_.size()) buffers_.resize(index + 1);
    auto& [buffer, capacity] = buffers_[index];
    if (capacity < bytes) {
        buffer = program_.buffer(bytes);
        capacity = bytes;
    }
    return buffer;
}

template <class Body>
void DeviceEvaluator::in_chunks(const std::string& name, std::size_t n, Body body) {
    program_.guarded("run " + name, [&] {
        for (std::size_t first = 0; first < n; first += max_items)
            body(kernel("vndf_batch_" + name), first, std::min(max_items, n - first));
    });
}

void DeviceEvaluator::read_back(std::size_t index, void* to, std::size_t first, std::size_t items) {
    const std::size_t size = size_of(input_real());
    program_.queue().enqueueReadBuffer(buffers_[index].first, CL_TRUE, 0, items * size,
                                       static_cast<char*>(to) + first * size);
}

void DeviceEvaluator::run(const Function& function, std::size_t n, const std::vector<const void*>& inputs,
                          const std::vector<void*>& outputs) {
    const std::size_t size = size_of(input_real());
    in_chunks(function.name, n, [&](cl::Kernel& kernel, std::size_t first, std::size_t items) {
        const std::size_t padded = whole_groups(items);
        cl_uint argument = 0;
        std::vector<char> filled_up;
        for (const void* input : inputs) {
            cl::Buffer& to = buffer(argument, padded * size);
            const char* from = static_cast<const char*>(input) + first * size;
            if (padded > items) {
                // With the chunk's first item; in one write, which is all that Oclgrind takes for initialised.
                filled_up.assign(from, from + items * size);
                for (std::size_t i = items; i < padded; ++i)
                    filled_up.insert(filled_up.end(), from, from + size);
                from = filled_up.data();
            }
            program_.queue().enqueueWriteBuffer(to, CL_TRUE, 0, padded * size, from);
            kernel.setArg(argument++, to);
        }
        for (std::size_t i = 0; i < outputs.size(); ++i, ++argument)
            kernel.setArg(argument, buffer(argument, padded * size));
        kernel.setArg(argument, cl_uint{0});
        program_.launch(kernel, items);
        for (std::size_t i = 0; i < outputs.size(); ++i)
            read_back(inputs.size() + i, outputs[i], first, items);
    });
}

void DeviceEvaluator::uniforms(std::uint64_t seed, std::uint64_t stream, std::size_t n, void* u1, void* u2) {
    // A program of its own: most evaluators never need it, and it takes time to build.
    if (!uniforms_) {
        ProgramOptions options;
        options.root = "kernels/batch/uniforms.cl";
        uniforms_.emplace(program_, program_.math(), input_real(), options);
        kernels_["vndf_batch_uniforms"] = uniforms_->kernel("vndf_batch_uniforms");
    }
    const std::size_t size = size_of(input_real());
    in_chunks("uniforms", n, [&](cl::Kernel& kernel, std::size_t first, std::size_t items) {
        kernel.setArg(0, buffer(0, items * size));
        kernel.setArg(1, buffer(1, items * size));
        kernel.setArg(2, cl_ulong{seed});
        kernel.setArg(3, cl_ulong{stream});
        kernel.setArg(4, cl_ulong{first});
        kernel.setArg(5, static_cast<cl_uint>(items));
        program_.launch(kernel, items);
        read_back(0, u1, first, items);
        read_back(1, u2, first, items);
    });
}

}  // namespace vndf::runtime
