#include "builds.h"

#include <chrono>
#include <numeric>

#include <fmt/format.h>

#include "registry.h"

namespace vndf::bench {
namespace {

using runtime::Math, runtime::Real;
using Clock = std::chrono::steady_clock;

struct Source {
    std::string name;
    runtime::ProgramOptions options;
    std::vector<std::string> kernels;
};

std::vector<std::string> plain_samplers() {
    std::vector<std::string> names;
    for (const Function& f : functions())
        if (is_plain_sampler(f)) names.push_back(f.name);
    return names;
}

Source samplers(const std::string& name, const std::vector<std::string>& functions) {
    Source source{name, {}, {}};
    source.options.functions = functions;
    for (const std::string& function : functions) source.kernels.push_back("vndf_batch_" + function);
    return source;
}

Source call_sites(const std::string& sampler, bool inlined) {
    Source source{
        fmt::format("12 calls of {}, {}", sampler, inlined ? "inlined" : "of one function"), {}, {}};
    source.options.root = "kernels/vndf/vndf.h";
    const std::string callee = inlined ? sampler : "bench_once";
    std::string code = fmt::format(
        "\n#line 1 \"call_sites\"\n"
        "__attribute__((noinline)) float3 bench_once(float3 wo, float2 alpha, float2 u) {{\n"
        "    return {}(wo, alpha, u);\n"
        "}}\n"
        "__kernel void bench_call_sites(__global float *a) {{\n"
        "    const size_t i = get_global_id(0);\n"
        "    float3 sum = (float3)(0.0f);\n",
        sampler);
    for (int k = 0; k < 12; ++k)
        code += fmt::format(
            "    sum += {}((float3)(a[i], 0.{}f, 0.8f), (float2)(a[i], 0.{}f), (float2)(0.5f, a[i]));\n",
            callee, k + 1, 12 - k);
    source.options.more_source = code + "    a[i] = sum.x + sum.y + sum.z;\n}\n";
    source.kernels = {"bench_call_sites"};
    return source;
}

// Builds it and runs every kernel once on one group: some drivers compile at the first launch.
runtime::Program build(const runtime::Program& beside, const Source& source, const cl::Buffer& buffer) {
    runtime::Program program(beside, Math::strict, Real::f32, source.options);
    for (const std::string& name : source.kernels) {
        const cl::Kernel kernel = program.kernel(name);
        const auto arguments = kernel.getInfo<CL_KERNEL_NUM_ARGS>();
        cl::Kernel launched = kernel;
        for (cl_uint i = 0; i < arguments; ++i)
            arguments > 1 && i + 1 == arguments ? launched.setArg(i, cl_uint{0}) : launched.setArg(i, buffer);
        program.launch(launched, runtime::group_size);
    }
    program.queue().finish();
    return program;
}

double seconds(const runtime::Program& beside, const Source& source, const cl::Buffer& buffer) {
    const auto start = Clock::now();
    build(beside, source, buffer);
    return std::chrono::duration<double>(Clock::now() - start).count();
}

BuildTime build_time(const runtime::Program& beside, const Source& source) {
    const cl::Buffer buffer = beside.buffer(runtime::group_size * sizeof(float));
    const std::vector<float> halves(runtime::group_size, 0.5f);
    beside.queue().enqueueWriteBuffer(buffer, CL_TRUE, 0, halves.size() * sizeof(float), halves.data());
    BuildTime time;
    time.program = source.name;
    time.cold_s = seconds(beside, source, buffer);
    time.warm_s = seconds(beside, source, buffer);
    const runtime::Program program = build(beside, source, buffer);
    time.source_bytes = program.source_bytes();
    time.binary_bytes = program.binary_bytes();
    return time;
}

}  // namespace

std::vector<BuildTime> build_times(const runtime::Program& beside) {
    const std::vector<std::string> all = plain_samplers();
    std::vector<Source> sources = {samplers("1 sampler", {"vndf_ggx_sample_wm_dupuy2023"}),
                                   samplers("10 samplers", {all.begin(), all.begin() + 10}),
                                   samplers(fmt::format("{} samplers", all.size()), all)};
    for (const char* sampler : {"vndf_ggx_sample_wm_dupuy2023", "vndf_ggx_sample_wi_conic2026",
                                "vndf_beckmann_sample_wm_jakob2014"})
        for (const bool inlined : {true, false}) sources.push_back(call_sites(sampler, inlined));
    std::vector<BuildTime> times;
    for (const Source& source : sources)
        times.push_back(beside.guarded("build " + source.name, [&] { return build_time(beside, source); }));
    return times;
}

}  // namespace vndf::bench
