// Builds an emitted file with a selftest on the first OpenCL device and runs it: emitted_selftest FILE [OPTIONS].
// Exit status: 0 all answers are the library's, 1 they are not, 2 no device or no build.
#define CL_TARGET_OPENCL_VERSION 120
#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>

#include <CL/cl.h>

int main(int argc, char** argv) {
    std::ifstream file(argv[1]);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    const char* source = text.c_str();
    cl_platform_id platform;
    cl_device_id device;
    if (clGetPlatformIDs(1, &platform, nullptr) ||
        clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, 1, &device, nullptr)) {
        std::puts("no OpenCL device");
        return 2;
    }
    cl_context context = clCreateContext(nullptr, 1, &device, nullptr, nullptr, nullptr);
    cl_program program = clCreateProgramWithSource(context, 1, &source, nullptr, nullptr);
    if (clBuildProgram(program, 1, &device, argc > 2 ? argv[2] : "-cl-fp32-correctly-rounded-divide-sqrt",
                       nullptr, nullptr)) {
        char log[4096] = "";
        clGetProgramBuildInfo(program, device, CL_PROGRAM_BUILD_LOG, sizeof log - 1, log, nullptr);
        std::puts(log);
        return 2;
    }
    cl_int wrong[2] = {-1, -1};
    cl_mem buffer = clCreateBuffer(context, CL_MEM_WRITE_ONLY, sizeof wrong, nullptr, nullptr);
    cl_kernel kernel = clCreateKernel(program, "vndf_selftest", nullptr);
    clSetKernelArg(kernel, 0, sizeof buffer, &buffer);
    cl_command_queue queue = clCreateCommandQueue(context, device, 0, nullptr);
    const std::size_t one = 1;
    clEnqueueNDRangeKernel(queue, kernel, 1, nullptr, &one, nullptr, 0, nullptr, nullptr);
    clEnqueueReadBuffer(queue, buffer, CL_TRUE, 0, sizeof wrong, wrong, 0, nullptr, nullptr);
    std::printf("%d other bits, %d wrong\n", wrong[0], wrong[1]);
    return wrong[0] || wrong[1];
}
