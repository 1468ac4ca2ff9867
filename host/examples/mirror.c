/* A rough mirror under a white sky, on an OpenCL device, from plain C: which part of the light does it send on?
   Exit status 0 if it is the known one.
       cc mirror.c $(pkg-config --cflags --libs clvndf OpenCL) -o mirror */
#define CL_TARGET_OPENCL_VERSION 120
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <CL/cl.h>
#include <clvndf/sources.h>

/* The mean of brdf * cos(theta) / density. alpha.y = ratio * alpha.x: see README.md on two that look alike. */
static const char kernel_source[] =
    "kernel void sample(float3 wo, float alpha_x, float ratio, global float* weight) {\n"
    "    const size_t i = get_global_id(0), side = 1024;\n"
    "    const float2 alpha = (float2)(alpha_x, ratio * alpha_x);\n"
    "    const float2 u = (float2)((i % side + 0.5f) / side, (i / side + 0.5f) / side);\n"
    "    const float3 wi = vndf_reflect(wo, vndf_ggx_sample_wm_dupuy2023(wo, alpha, u));\n"
    "    weight[i] = wi.z > 0.0f ? vndf_ggx_weight(wo, wi, alpha) : 0.0f;\n"
    "}\n";

#define REQUIRE(call) require(call, #call)
static void require(cl_int status, const char* call) {
    if (status == CL_SUCCESS) return;
    fprintf(stderr, "%d from %s\n", (int)status, call);
    exit(3);
}

int main(void) {
    cl_platform_id platform;
    cl_device_id device;
    cl_device_fp_config config;
    cl_int status;
    REQUIRE(clGetPlatformIDs(1, &platform, NULL));
    REQUIRE(clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, 1, &device, NULL));
    REQUIRE(clGetDeviceInfo(device, CL_DEVICE_SINGLE_FP_CONFIG, sizeof config, &config, NULL));
    cl_context context = clCreateContext(NULL, 1, &device, NULL, NULL, &status);
    cl_command_queue queue = clCreateCommandQueue(context, device, 0, &status);

    const char* text[] = {CLVNDF_SOURCES, kernel_source};
    cl_program program = clCreateProgramWithSource(context, sizeof text / sizeof *text, text, NULL, &status);
    const char* options = clvndf_build_options(CLVNDF_STRICT, CLVNDF_FLOAT, config);
    REQUIRE(clBuildProgram(program, 1, &device, options, NULL, NULL));

    static float weight[1024 * 1024];
    const size_t n = sizeof weight / sizeof *weight;
    const cl_float3 wo = {{0.6f, 0.0f, 0.8f}};
    const float alpha_x = 0.5f, ratio = 0.2f;
    cl_mem buffer = clCreateBuffer(context, CL_MEM_WRITE_ONLY, sizeof weight, NULL, &status);
    cl_kernel sample = clCreateKernel(program, "sample", &status);
    REQUIRE(clSetKernelArg(sample, 0, sizeof wo, &wo));
    REQUIRE(clSetKernelArg(sample, 1, sizeof alpha_x, &alpha_x));
    REQUIRE(clSetKernelArg(sample, 2, sizeof ratio, &ratio));
    REQUIRE(clSetKernelArg(sample, 3, sizeof buffer, &buffer));
    REQUIRE(clEnqueueNDRangeKernel(queue, sample, 1, NULL, &n, NULL, 0, NULL, NULL));
    REQUIRE(clEnqueueReadBuffer(queue, buffer, CL_TRUE, 0, sizeof weight, weight, 0, NULL, NULL));
    double mean = 0;
    for (size_t i = 0; i < n; ++i) mean += weight[i] / (double)n;
    printf("reflected: %.4f of the light\n", mean);
    return fabs(mean - 0.80472) < 1e-4 ? 0 : 1;
}
