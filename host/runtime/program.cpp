#include "runtime/program.h"

#include <numeric>

namespace vndf::runtime {
namespace {

std::string all_options(const Device& device, Math math, Real real, const ProgramOptions& options) {
    const Division division = !options.correct_divide_sqrt ? Division::loose
                              : device.correct_divide_sqrt ? Division::hardware
                                                           : Division::software;
    std::string text = options.build_options.find("-cl-std=") == std::string::npos ? "-cl-std=CL1.2 " : "";
    text += runtime::build_options(math, real, device.fma, division);
    if (options.mutant != 0) text += fmt::format(" -DVNDF_MUTANT={}", options.mutant);
    if (!options.build_options.empty()) text += ' ' + options.build_options;
    return text;
}

std::string indented(const std::string& text) {
    std::string out;
    for (char c : text) out += c == '\n' ? std::string("\n  ") : std::string(1, c);
    return out;
}

}  // namespace

Program::Program(const Device& device, Math math, Real real, const ProgramOptions& options)
    : device_(device), math_(math), real_(real), build_options_(all_options(device, math, real, options)) {
    require_real(device, real);
    require_policy(math, real);
    require_compiler(device);
    guarded("make a context and a queue", [&] {
        context_ = cl::Context(device.handle);
        // With profiling for those who time their launches.
        queue_ = cl::CommandQueue(context_, device.handle, CL_QUEUE_PROFILING_ENABLE);
    });
    build(options);
}

Program::Program(const Program& beside, Math math, Real real, const ProgramOptions& options)
    : device_(beside.device_),
      math_(math),
      real_(real),
      build_options_(all_options(device_, math, real, options)),
      context_(beside.context_),
      queue_(beside.queue_) {
    require_real(device_, real);
    require_policy(math, real);
    build(options);
}

void Program::build(const ProgramOptions& options) {
    std::vector<SourceFile> files = embedded_sources();
    files.insert(files.end(), options.more_files.begin(), options.more_files.end());
    const std::string source =
        assemble(options.root, {options.functions, options.substitutions}, files) + options.more_source;
    source_bytes_ = source.size();
    guarded("build " + options.root, [&] { program_ = cl::Program(context_, source); });
    // Not by the bindings' build(), which throws that there is no log in place of what went wrong.
    const cl_device_id device = device_.handle();
    const cl_int status = clBuildProgram(program_(), 1, &device, build_options_.c_str(), nullptr, nullptr);
    if (status == CL_SUCCESS) return;
    const std::string message = fmt::format("cannot build {} on \"{}\" ({}): {}\n  options: {}\n  {}",
                                            options.root, device_.name, device_.platform_version,
                                            opencl_error_name(status), build_options_, indented(build_log()));
    if (status == CL_BUILD_PROGRAM_FAILURE || status == CL_INVALID_BUILD_OPTIONS) throw BuildError(message);
    throw DeviceError(message);
}

std::string Program::build_log() const {
    try {
        return program_.getBuildInfo<CL_PROGRAM_BUILD_LOG>(device_.handle);
    } catch (const cl::Error&) {
        return "the driver says no more";
    }
}

cl::Kernel Program::kernel(const std::string& name) const {
    return guarded("find the kernel " + name, [&] { return cl::Kernel(program_, name.c_str()); });
}

std::size_t Program::binary_bytes() const {
    return guarded("measure the program", [&] {
        const auto sizes = program_.getInfo<CL_PROGRAM_BINARY_SIZES>();
        return std::accumulate(sizes.begin(), sizes.end(), std::size_t{0});
    });
}

bool Program::has_kernel(const std::string& name) const {
    const std::string names =
        ';' + guarded("list kernels", [&] { return program_.getInfo<CL_PROGRAM_KERNEL_NAMES>(); }) + ';';
    return names.find(';' + name + ';') != names.npos;
}

void Program::launch(const cl::Kernel& kernel, std::size_t items, cl::Event* event) const {
    const std::size_t allowed = kernel.getWorkGroupInfo<CL_KERNEL_WORK_GROUP_SIZE>(device_.handle);
    std::size_t local = group_size;
    while (local > allowed) local /= 2;
    queue_.enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(whole_groups(items)), cl::NDRange(local),
                                nullptr, event);
}

DeviceError Program::failure(const std::string& deed, const cl::Error& error) const {
    return DeviceError(fmt::format("cannot {} on \"{}\" ({}): {} failed with {}\n  options: {}", deed,
                                   device_.name, device_.platform_version, error.what(),
                                   opencl_error_name(error.err()), build_options_));
}

}  // namespace vndf::runtime
