// A rough mirror under a white sky, on an OpenCL device, from C++ with CLHPP: which part of the light does it send on?
// Exit status 0 if it is the known one.
//
// CMake: find_package(clvndf) and the target clvndf::sources, which holds the library as strings.
#define CL_HPP_MINIMUM_OPENCL_VERSION 110
#define CL_HPP_TARGET_OPENCL_VERSION 300
#define CL_HPP_ENABLE_EXCEPTIONS
#include <cmath>
#include <cstdio>
#include <numeric>

#include <CL/opencl.hpp>
#include <clvndf/sources.h>

// The mean of these weights, brdf * cos(theta) / density, is the answer. pdf: the density of wi, for multiple
// importance sampling.
const char* const source = R"(
// alpha.y = ratio * alpha.x: of two alphas that look alike PoCL makes a kernel that is many times slower.
kernel void sample(float3 wo, float alpha_x, float ratio, global float* weight, global float* pdf) {
    const size_t i = get_global_id(0), side = 1024;
    const float2 alpha = (float2)(alpha_x, ratio * alpha_x);
    const float2 u = (float2)((i % side + 0.5f) / side, (i / side + 0.5f) / side);
    const float3 wi = vndf_reflect(wo, vndf_ggx_sample_wm_dupuy2023(wo, alpha, u));
    weight[i] = wi.z > 0.0f ? vndf_ggx_weight(wo, wi, alpha) : 0.0f;
    pdf[i] = vndf_ggx_pdf_wi(wo, wi, alpha);
}
)";

int main() try {
    const cl::Device device = cl::Device::getDefault();
    const cl::Context context(device);
    cl::CommandQueue queue(context, device);
    cl::Program program(context, cl::Program::Sources{CLVNDF_SOURCES, source});
    program.build(
        clvndf_build_options(CLVNDF_STRICT, CLVNDF_FLOAT, device.getInfo<CL_DEVICE_SINGLE_FP_CONFIG>()));

    const std::size_t n = 1024 * 1024;
    std::vector<float> weight(n), pdf(n);
    const cl::Buffer weights(context, CL_MEM_WRITE_ONLY, n * sizeof(float)),
        pdfs(context, CL_MEM_WRITE_ONLY, n * sizeof(float));
    cl::KernelFunctor<cl_float3, float, float, cl::Buffer, cl::Buffer> sample(program, "sample");
    sample(cl::EnqueueArgs(queue, n, 64), {{0.6f, 0.0f, 0.8f}}, 0.5f, 0.2f, weights, pdfs);
    cl::copy(queue, weights, weight.begin(), weight.end());
    cl::copy(queue, pdfs, pdf.begin(), pdf.end());

    const double reflected = std::accumulate(weight.begin(), weight.end(), 0.0) / n;
    std::printf("reflected: %.4f of the light, on %s\n", reflected, device.getInfo<CL_DEVICE_NAME>().c_str());
    return std::fabs(reflected - 0.80472) < 1e-4 ? 0 : 1;
} catch (const cl::BuildError& error) {
    for (const auto& log : error.getBuildLog()) std::fprintf(stderr, "%s\n", log.second.c_str());
    return 3;
} catch (const cl::Error& error) {
    std::fprintf(stderr, "%s: %d\n", error.what(), error.err());
    return 3;
}
