// The README's OpenCL example builds without an include path, and does what the C++ example does.
#include <cstring>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "clvndf/sources.h"
#include "runtime/devices.h"
#include "runtime/opencl.h"
#include "runtime/sources.h"
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
    std::vector<cl::Program> headers;
    std::vector<cl_program> handles;
    for (const char* text : clvndf_header_text) {
        headers.emplace_back(context, std::string(text));
        handles.push_back(headers.back()());
    }
    const cl::Program source(context, read(root / "tests/embedding/metal.cl"));
    const cl_device_id id = device();
    const cl_int status = clCompileProgram(source(), 1, &id, "-cl-std=CL1.2", CLVNDF_HEADERS, handles.data(),
                                           clvndf_header_name, nullptr, nullptr);
    INFO(source.getBuildInfo<CL_PROGRAM_BUILD_LOG>(device));
    REQUIRE(status == CL_SUCCESS);
    return cl::linkProgram({source});
}

// A text as its own: without #line, and without what makes includes optional.
std::string as_written(std::string text) {
    for (const char* added : {"#line \\d+( \".*\")?\n", "#ifndef VNDF_ONE_TEXT\n(?=#include)"})
        text = std::regex_replace(text, std::regex(added), "");
    return std::regex_replace(text, std::regex("(#include \".*\"\n)#endif\n"), "$1");
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

TEST_CASE("the strings for users are the headers, each after those that it includes") {
    std::set<std::string> before;
    for (int i = 0; i < CLVNDF_HEADERS; ++i) {
        const std::string name = clvndf_header_name[i], text = as_written(clvndf_header_text[i]);
        CHECK(text == read(root / "kernels" / name));
        static const std::regex include("#include \"(.*)\"");
        for (std::sregex_iterator found(text.begin(), text.end(), include), end; found != end; ++found) {
            const auto beside = std::filesystem::path(name).parent_path() / (*found)[1].str();
            INFO(name << " includes " << beside);
            CHECK(before.count(beside.lexically_normal().generic_string()) == 1);
        }
        before.insert(name);
    }
    for (const SourceFile& file : embedded_sources()) {
        const bool header = file.path.substr(0, 13) == "kernels/vndf/";
        INFO(file.path);
        CHECK(before.count(std::string(file.path.substr(header ? 8 : 0))) == header);
    }
}

TEST_CASE("the build options for users are the library's own") {
    for (int math = 0; math < 3; ++math) {
        for (int real = 0; real < 2; ++real) {
            for (const cl_device_fp_config config : {CL_FP_FMA, CL_FP_CORRECTLY_ROUNDED_DIVIDE_SQRT,
                                                     CL_FP_FMA | CL_FP_CORRECTLY_ROUNDED_DIVIDE_SQRT, 0}) {
                const bool fma = config & CL_FP_FMA, correct = config & CL_FP_CORRECTLY_ROUNDED_DIVIDE_SQRT;
                CHECK(clvndf_build_options(clvndf_math(math), clvndf_real(real), config) ==
                      build_options(Math(math), Real(real), fma,
                                    correct ? Division::hardware : Division::software));
            }
        }
    }
}
