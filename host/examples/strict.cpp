// Strict samples in a renderer that is built with -cl-fast-relaxed-math: the sampler is compiled apart, with
// its own options, and the object linked into the program. Exit status 0 if its results have the bits that the
// headers have in C++, whatever those of the same text are that is compiled as the renderer is.
#define CL_HPP_MINIMUM_OPENCL_VERSION 110
#define CL_HPP_TARGET_OPENCL_VERSION 300
#define CL_HPP_ENABLE_EXCEPTIONS
#include <cstdio>
#include <cstring>
#include <CL/opencl.hpp>
#include <clvndf/sources.h>
#include <vndf/vndf.h>

const char* const sampler = R"(
#include "vndf/ggx_dupuy2023.h"
float3 sample_wm(float3 wo, float2 alpha, float2 u) { return vndf_ggx_sample_wm_dupuy2023(wo, alpha, u); }
)";
const char* const renderer = R"(
float3 sample_wm(float3 wo, float2 alpha, float2 u);
kernel void sample(float3 wo, float2 alpha, global float* wm) {
    const uint i = get_global_id(0);
    vstore3(sample_wm(wo, alpha, (float2)(i % 256 / 256.0f, i / 256 / 256.0f)), i, wm);
}
)";

cl::Program object(const char* text, const char* options) {
    const cl_device_id device = cl::Device::getDefault()();
    const cl::Program program(text);
    cl_program header[CLVNDF_HEADERS];
    for (int i = 0; i < CLVNDF_HEADERS; ++i)
        header[i] =
            clCreateProgramWithSource(cl::Context::getDefault()(), 1, &clvndf_header_text[i], NULL, NULL);
    clCompileProgram(program(), 1, &device, options, CLVNDF_HEADERS, header, clvndf_header_name, NULL, NULL);
    for (cl_program h : header) clReleaseProgram(h);
    return program;
}

int main() {
    const int n = 65536;
    std::vector<vndf_float3> wm(n);
    const cl::Buffer buffer(CL_MEM_WRITE_ONLY, n * sizeof wm[0]);
    const char* const fast = "-cl-fast-relaxed-math";
    const auto other_bits = [&](const char* options) {
        const cl::Program program = cl::linkProgram({object(renderer, fast), object(sampler, options)});
        cl::KernelFunctor<cl_float3, cl_float2, cl::Buffer> sample(program, "sample");
        sample(cl::EnqueueArgs(n, 64), {{0.6f, 0.0f, 0.8f}}, {{0.5f, 0.1f}}, buffer);
        cl::copy(buffer, wm.begin(), wm.end());
        int count = 0;
        for (int i = 0; i < n; ++i) {
            const vndf_float2 u = {i % 256 / 256.0f, i / 256 / 256.0f};
            const vndf_float3 m = vndf_ggx_sample_wm_dupuy2023({0.6f, 0.0f, 0.8f}, {0.5f, 0.1f}, u);
            count += std::memcmp(&m, &wm[i], sizeof m) != 0;
        }
        return count;
    };
    const auto config = cl::Device::getDefault().getInfo<CL_DEVICE_SINGLE_FP_CONFIG>();
    const int strict = other_bits(clvndf_build_options(CLVNDF_STRICT, CLVNDF_FLOAT, config));
    const int relaxed = other_bits(fast);
    std::printf("of %d with other bits: %d of the strict object, %d of fast math\n", n, strict, relaxed);
    return strict != 0;
}
