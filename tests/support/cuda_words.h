// What CUDA, HIP and their runtime compilers know without a header, for clang without those headers.
#define __host__ __attribute__((host))
#define __device__ __attribute__((device))
#define __global__ __attribute__((global))
struct float2 {
    float x, y;
};
struct float3 {
    float x, y, z;
};
struct float4 {
    float x, y, z, w;
};
struct double2 {
    double x, y;
};
struct double3 {
    double x, y, z;
};
__device__ float fmaf(float, float, float);
__device__ double fma(double, double, double);
__device__ float fabsf(float);
__device__ double fabs(double);
__device__ float sqrtf(float);
__device__ double sqrt(double);
__device__ void* memcpy(void*, const void*, decltype(sizeof 0));
