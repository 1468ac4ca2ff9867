// The README's OpenCL example builds without an include path, and does what the C++ example does.
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "runtime/devices.h"
#include "runtime/opencl.h"
#include "support/catch.h"
#include "vndf/vndf.h"

namespace {

using namespace vndf::runtime;
const std::filesystem::path root = CLVNDF_SOURCE_DIR;

std::string read(const std::filesystem::path& path) {
    std::ifstream file(path);
    REQUIRE(file);
    return {std::istreambuf_iterator<char>(file), {}};
}

// metal.cl with the headers of kernels/vndf handed over by name.
cl::Program build(const cl::Context& context, const cl::Device& device) {
    std::vector<std::string> names;
    std::vector<cl::Program> headers;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root / "kernels/vndf")) {
        if (entry.path().extension() != ".h") continue;
        names.push_back(std::filesystem::relative(entry.path(), root / "kernels").generic_string());
        headers.emplace_back(context, read(entry.path()));
    }
    std::vector<cl_program> handles;
    std::vector<const char*> c_names;
    for (std::size_t i = 0; i < names.size(); ++i) {
        handles.push_back(headers[i]());
        c_names.push_back(names[i].c_str());
    }
    const cl::Program source(context, read(root / "tests/embedding/metal.cl"));
    const cl_device_id id = device();
    const cl_int status = clCompileProgram(source(), 1, &id, "-cl-std=CL1.2", cl_uint(handles.size()),
                                           handles.data(), c_names.data(), nullptr, nullptr);
    INFO(source.getBuildInfo<CL_PROGRAM_BUILD_LOG>(device));
    REQUIRE(status == CL_SUCCESS);
    return cl::linkProgram({source});
}

bool same_bits(float a, float b) {
    return std::memcmp(&a, &b, sizeof a) == 0;
}

}  // namespace

TEST_CASE("the OpenCL example builds from named headers and gives the bits of the C++ example") {
    const cl::Device device = choose_device().device.handle;
    const cl::Context context(device);
    const cl::CommandQueue queue(context, device);
    cl::Kernel kernel(build(context, device), "sample_metal");

    constexpr std::size_t n = 4096;
    const vndf_float2 alpha = {0.5f, 0.1f};
    std::vector<float> wo, u;
    for (std::size_t i = 0; i < n; ++i) {
        const float z = (float(i) + 0.5f) / float(n);
        wo.insert(wo.end(), {-std::sqrt(1 - z * z), 0.0f, z});
        u.insert(u.end(), {float(i * 977 % n) / float(n), float(i * 331 % n) / float(n)});
    }
    const auto input = [&](std::vector<float>& v) { return cl::Buffer(context, v.begin(), v.end(), true); };
    const auto output = [&](std::size_t floats) {
        return cl::Buffer(context, CL_MEM_WRITE_ONLY, floats * sizeof(float));
    };
    const cl::Buffer wo_buffer = input(wo), u_buffer = input(u);
    const cl::Buffer wi_buffer = output(3 * n), weight_buffer = output(n), pdf_buffer = output(n);
    kernel.setArg(0, wo_buffer);
    kernel.setArg(1, u_buffer);
    kernel.setArg(2, alpha);
    kernel.setArg(3, 1.0f);
    kernel.setArg(4, wi_buffer);
    kernel.setArg(5, weight_buffer);
    kernel.setArg(6, pdf_buffer);
    queue.enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(n), cl::NDRange(64));

    std::vector<float> wi(3 * n), weight(n), pdf(n);
    queue.enqueueReadBuffer(wi_buffer, CL_TRUE, 0, 3 * n * sizeof(float), wi.data());
    queue.enqueueReadBuffer(weight_buffer, CL_TRUE, 0, n * sizeof(float), weight.data());
    queue.enqueueReadBuffer(pdf_buffer, CL_TRUE, 0, n * sizeof(float), pdf.data());

    std::size_t different = 0, reflected = 0;
    for (std::size_t i = 0; i < n; ++i) {
        const vndf_float3 o = {wo[3 * i], wo[3 * i + 1], wo[3 * i + 2]};
        const vndf_float4 sample = vndf_ggx_sample_wm_dupuy2023_with_pdf(o, alpha, {u[2 * i], u[2 * i + 1]});
        const vndf_float3 m = {sample.x, sample.y, sample.z}, r = vndf_reflect(o, m);
        const bool same = same_bits(wi[3 * i], r.x) && same_bits(wi[3 * i + 1], r.y) &&
                          same_bits(wi[3 * i + 2], r.z) &&
                          same_bits(weight[i], vndf_ggx_weight(o, r, alpha)) &&
                          same_bits(pdf[i], sample.w * vndf_jacobian_reflect(o, m));
        different += !same;
        reflected += r.z > 0;
    }
    CHECK(different == 0);
    CHECK(reflected > n / 2);
}
