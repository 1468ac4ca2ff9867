#include <chrono>
#include <map>

#include "render/stages.h"

namespace vndf::render {
namespace {

runtime::ProgramOptions options_of(const char* root, const std::string& switches) {
    runtime::ProgramOptions options;
    options.root = root;
    options.build_options = switches;
    return options;
}

// On a CPU more of them gain nothing, and lose over small triangles; on a GPU rays run together as it is.
unsigned packet_of(const runtime::Device& device, const Switches& switches) {
    if (switches.packet != 0) return switches.packet;
    return (device.type & CL_DEVICE_TYPE_CPU) != 0 ? 8 : 1;
}

// Two programs, so that another choice of effects compiles the stages that know them alone.
class DeviceStages final : public Stages {
  public:
    DeviceStages(const runtime::Device& device, runtime::Math math, const Switches& switches, bool timed)
        : packet_(packet_of(device, switches)),
          program_(device, math, runtime::Real::f32,
                   options_of("kernels/render/paths.cl",
                              fmt::format("{} -DVNDF_PACKET={}", switches.paths, packet_))),
          materials_(program_, math, runtime::Real::f32,
                     options_of("kernels/render/materials.cl", switches.materials)),
          timed_(timed) {}

    Buffer buffer(std::size_t bytes) override {
        return program_.guarded("allocate memory", [&] {
            // Never empty, which OpenCL refuses.
            bytes = std::max<std::size_t>(bytes, 4);
            buffers_.push_back(program_.buffer(bytes));
            program_.queue().enqueueFillBuffer(buffers_.back(), cl_uint{0}, 0, bytes / 4 * 4);
            bytes_ += bytes;
            return buffers_.size() - 1;
        });
    }

    void write(Buffer to, const void* from, std::size_t bytes, std::size_t offset) override {
        program_.guarded("write", [&] {
            program_.queue().enqueueWriteBuffer(buffers_[to], CL_TRUE, offset, bytes, from);
        });
    }

    void read(Buffer from, void* to, std::size_t bytes, std::size_t offset) override {
        program_.guarded(
            "read", [&] { program_.queue().enqueueReadBuffer(buffers_[from], CL_TRUE, offset, bytes, to); });
    }

    void launch(const std::string& stage, std::size_t items, Arguments arguments) override {
        program_.guarded("run the stage " + stage, [&] {
            auto found = kernels_.find(stage);
            if (found == kernels_.end())
                found = kernels_.emplace(stage, kernel("vndf_render_" + stage)).first;
            cl_uint index = 0;
            for (const Argument& argument : arguments) {
                if (argument.value)
                    found->second.setArg(index++, argument.size, argument.value);
                else
                    found->second.setArg(index++, buffers_[argument.buffer]);
            }
            if (!timed_) return program_.launch(found->second, items);
            program_.queue().finish();
            const auto start = std::chrono::steady_clock::now();
            program_.launch(found->second, items);
            program_.queue().finish();
            seconds_[stage] +=
                std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        });
    }

    double seconds(const std::string& stage) const override {
        const auto found = seconds_.find(stage);
        return found == seconds_.end() ? 0 : found->second;
    }

    std::string describe() const override { return program_.device().label(); }
    std::size_t bytes() const override { return bytes_; }
    unsigned packet() const override { return packet_; }
    bool has(const std::string& stage) const override {
        return program_.has_kernel("vndf_render_" + stage) || materials_.has_kernel("vndf_render_" + stage);
    }

  private:
    cl::Kernel kernel(const std::string& name) const {
        return (program_.has_kernel(name) ? program_ : materials_).kernel(name);
    }

    unsigned packet_;
    runtime::Program program_, materials_;
    bool timed_;
    std::map<std::string, double> seconds_;
    std::vector<cl::Buffer> buffers_;
    std::size_t bytes_ = 0;
    std::map<std::string, cl::Kernel> kernels_;
};

}  // namespace

std::unique_ptr<Stages> device_stages(const runtime::Device& device, runtime::Math math,
                                      const Switches& switches, bool timed) {
    return std::make_unique<DeviceStages>(device, math, switches, timed);
}

}  // namespace vndf::render
