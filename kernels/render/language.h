// The stages as OpenCL kernels, and as C++ functions of the same text: kernels, address spaces, the index of the work-item,
// and vectors of eight.
//
// float in every policy, whatever VNDF_REAL: meshes, films and queues are float.
#ifndef VNDF_RENDER_LANGUAGE_H
#define VNDF_RENDER_LANGUAGE_H

#include "../vndf/vndf.h"

#if defined(__OPENCL_VERSION__) || defined(__OPENCL_C_VERSION__)

#define VNDF_RENDER_KERNEL __kernel void
#define VNDF_RENDER_IN(type) __global const type* restrict
#define VNDF_RENDER_OUT(type) __global type* restrict
#define VNDF_RENDER_FROM(type) __global const type*
#define VNDF_RENDER_TO(type) __global type*
#define VNDF_RENDER_CONSTANT __constant
#define VNDF_RENDER_ITEM ((uint)get_global_id(0))
#define VNDF_RENDER_8(x) ((float8)(x))
#define VNDF_RENDER_BYTES(mask) as_ulong(convert_char8(mask))
#define VNDF_RENDER_CLZ(x) ((int)clz(x))
#define VNDF_RENDER_BITS(x) as_uint(x)
// After the last header of vndf/: each leaves contraction as the build options have it.
#define VNDF_RENDER_UNCONTRACTED _Pragma("OPENCL FP_CONTRACT OFF")

#else

#include <stdint.h>
#include <string.h>

#define VNDF_RENDER_KERNEL static inline void
#define VNDF_RENDER_IN(type) const type*
#define VNDF_RENDER_OUT(type) type*
#define VNDF_RENDER_FROM(type) const type*
#define VNDF_RENDER_TO(type) type*
#define VNDF_RENDER_CONSTANT [[maybe_unused]] static const
#define VNDF_RENDER_ITEM vndf_render_item
#define VNDF_RENDER_8(x) (float8{} + (x))
#define VNDF_RENDER_BYTES(mask) vndf_render_bytes(mask)
#define VNDF_RENDER_CLZ(x) __builtin_clzll(x)
#define VNDF_RENDER_BITS(x) vndf_render_bits(x)
#define VNDF_RENDER_UNCONTRACTED

typedef uint32_t uint;
typedef uint64_t ulong;
typedef float float8 __attribute__((vector_size(32)));
typedef int32_t int8 __attribute__((vector_size(32)));
typedef uint32_t uint8 __attribute__((vector_size(32)));

[[maybe_unused]] static thread_local uint vndf_render_item;

static inline ulong vndf_render_bytes(int8 mask) {
    typedef char char8 __attribute__((vector_size(8)));
    const char8 bytes = __builtin_convertvector(mask, char8);
    ulong bits;
    memcpy(&bits, &bytes, sizeof bits);
    return bits;
}
static inline uint vndf_render_bits(float x) {
    uint bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}
static inline float8 vload8(size_t i, const float* from) {
    float8 v;
    memcpy(&v, from + 8 * i, sizeof v);
    return v;
}
static inline void vstore8(float8 v, size_t i, float* to) {
    memcpy(to + 8 * i, &v, sizeof v);
}
static inline void vstore8(int8 v, size_t i, int* to) {
    memcpy(to + 8 * i, &v, sizeof v);
}

#endif

VNDF_RENDER_UNCONTRACTED

#endif
