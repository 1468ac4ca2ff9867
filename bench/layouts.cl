// One sampler over arrays as renderers keep them: packed triples by vload3, float4 with a component to spare, structures; packed
// triples whose components are a distance apart that the compiler does not know; and packed triples of which every second
// component is multiplied by a 1 that it does not know, so that LLVM's SLP pass finds no two neighbours alike. Each streaming
// and going over BENCH_GROUPS groups again and again. BENCH_CALLEE: a sampler of (wo, alpha, u).
#include "../kernels/vndf/vndf.h"
#include "../kernels/batch/batch.cl"

struct bench_input {
    float wo[3], alpha[2], u[2];
};
struct bench_output {
    float w[3];
};

#define BENCH_STREAM get_global_id(0)
#define BENCH_CACHED ((get_group_id(0) % BENCH_GROUPS) * get_local_size(0) + get_local_id(0))

// Macros that stand for kernels:
// clang-format off
#define BENCH_LAYOUTS(mode, index)                                                                            \
    __kernel void aos_vload3_##mode(__global const float *restrict wo, __global const float *restrict alpha,  \
                                    __global const float *restrict u, __global float *restrict w) {           \
        const size_t i = index;                                                                               \
        vstore3(BENCH_CALLEE(vload3(i, wo), vload2(i, alpha), vload2(i, u)), i, w);                           \
    }                                                                                                         \
    __kernel void aos_float4_##mode(__global const float4 *restrict wo, __global const float2 *restrict alpha,\
                                    __global const float2 *restrict u, __global float4 *restrict w) {         \
        const size_t i = index;                                                                               \
        w[i] = (float4)(BENCH_CALLEE(wo[i].xyz, alpha[i], u[i]), 0.0f);                                       \
    }                                                                                                         \
    __kernel void aos_struct_##mode(__global const struct bench_input *restrict in,                           \
                                    __global struct bench_output *restrict out) {                             \
        const size_t i = index;                                                                               \
        const float3 r = BENCH_CALLEE((float3)(in[i].wo[0], in[i].wo[1], in[i].wo[2]),                        \
                                      (float2)(in[i].alpha[0], in[i].alpha[1]),                               \
                                      (float2)(in[i].u[0], in[i].u[1]));                                      \
        out[i].w[0] = r.x, out[i].w[1] = r.y, out[i].w[2] = r.z;                                              \
    }                                                                                                         \
    __kernel void aos_stride_##mode(__global const float *restrict wo, __global const float *restrict alpha,  \
                                    __global const float *restrict u, __global float *restrict w,             \
                                    const uint one, const uint two) {                                         \
        const size_t i = index;                                                                               \
        const float3 r = BENCH_CALLEE((float3)(wo[3 * i], wo[3 * i + one], wo[3 * i + two]),                  \
                                      (float2)(alpha[2 * i], alpha[2 * i + one]),                             \
                                      (float2)(u[2 * i], u[2 * i + one]));                                    \
        w[3 * i] = r.x, w[3 * i + one] = r.y, w[3 * i + two] = r.z;                                           \
    }                                                                                                         \
    __kernel void aos_one_##mode(__global const float *restrict wo, __global const float *restrict alpha,     \
                                 __global const float *restrict u, __global float *restrict w,                \
                                 const float one) {                                                           \
        const size_t i = index;                                                                               \
        const float3 r = BENCH_CALLEE((float3)(wo[3 * i], one * wo[3 * i + 1], wo[3 * i + 2]),                \
                                      (float2)(alpha[2 * i], one * alpha[2 * i + 1]),                         \
                                      (float2)(u[2 * i], one * u[2 * i + 1]));                                \
        w[3 * i] = r.x, w[3 * i + 1] = one * r.y, w[3 * i + 2] = r.z;                                         \
    }

BENCH_LAYOUTS(stream, BENCH_STREAM)
BENCH_LAYOUTS(cached, BENCH_CACHED)
// clang-format on
