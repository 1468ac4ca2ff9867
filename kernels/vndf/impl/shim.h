// What differs between the languages: how functions are declared, vector types, fma, sqrt, library functions and the bits of
// numbers. OpenCL C 1.2 to 3.0 and C++ for OpenCL share one half; C99, C++11, CUDA and HIP (also by NVRTC and HIPRTC, which
// have no headers) the other.
#ifndef VNDF_IMPL_SHIM_H
#define VNDF_IMPL_SHIM_H

#include "../config.h"

// Fast math around these headers, not in them: sums whose order is their accuracy, and comparisons that find infinities, are
// meant literally. VNDF_IMPL_PRECISE, how much can be switched off: 2 everything; 1 reassociation, which is all that clang
// takes on GPUs and for SPIR-V, and which leaves quick division; 0 nothing. Tests set it lower.
#ifdef VNDF_IMPL_PRECISE
#elif defined(__NVCC__) || defined(__CUDACC_RTC__)
#define VNDF_IMPL_PRECISE 0
#elif defined(__clang__) && __clang_major__ >= 14
#if defined(__CUDA__) || defined(__HIP__)
#define VNDF_IMPL_PRECISE 1
#elif defined(__x86_64__) || (defined(__aarch64__) && __clang_major__ >= 19)
#define VNDF_IMPL_PRECISE 2
#else
#define VNDF_IMPL_PRECISE 1
#endif
#elif defined(__GNUC__) && !defined(__clang__) && VNDF_ALLOW_FAST_MATH
#define VNDF_IMPL_PRECISE 2
#else
#define VNDF_IMPL_PRECISE 0
#endif
#if VNDF_IMPL_PRECISE == 2 && defined(__clang__)
#define VNDF_IMPL_LITERALLY \
    _Pragma("float_control(push)") _Pragma("float_control(precise, on)") _Pragma("clang fp contract(off)")
#define VNDF_IMPL_NOT_LITERALLY _Pragma("float_control(pop)")
#elif VNDF_IMPL_PRECISE == 2
// These functions are then inlined into each other, but into no other.
#define VNDF_IMPL_LITERALLY              \
    _Pragma("GCC push_options") _Pragma( \
        "GCC optimize(\"no-unsafe-math-optimizations\", \"no-finite-math-only\", \"fp-contract=off\")")
#define VNDF_IMPL_NOT_LITERALLY _Pragma("GCC pop_options")
#elif VNDF_IMPL_PRECISE == 1 && (defined(__FAST_RELAXED_MATH__) || defined(__FAST_MATH__))
#define VNDF_IMPL_LITERALLY _Pragma("clang fp reassociate(off)")
#define VNDF_IMPL_NOT_LITERALLY _Pragma("clang fp reassociate(on)")
#else
#define VNDF_IMPL_LITERALLY
#define VNDF_IMPL_NOT_LITERALLY
#endif

#if defined(__OPENCL_C_VERSION__) || defined(__OPENCL_CPP_VERSION__) || defined(__OPENCL_VERSION__)

// Contraction is off in these headers, and after them what the build options say: a renderer's own code keeps it. A compiler
// that may not know the operator loses it altogether.
#ifdef __clang__
#define VNDF_IMPL_UNCONTRACTED _Pragma("OPENCL FP_CONTRACT OFF")
#define VNDF_IMPL_CONTRACTED _Pragma("OPENCL FP_CONTRACT DEFAULT")
#else
#pragma OPENCL FP_CONTRACT OFF
#define VNDF_IMPL_UNCONTRACTED
#define VNDF_IMPL_CONTRACTED
#endif
#if VNDF_DOUBLE && defined(cl_khr_fp64) && defined(__OPENCL_C_VERSION__)
#if __OPENCL_C_VERSION__ < 120
#pragma OPENCL EXTENSION cl_khr_fp64 : enable
#endif
#endif
// always_inline, not just inline: one call that stays a call keeps a CPU device from vectorising the kernel.
#ifndef VNDF_FN
#define VNDF_FN static inline __attribute__((always_inline, __unused__))
#endif
#define VNDF_BEGIN VNDF_IMPL_LITERALLY VNDF_IMPL_UNCONTRACTED
#define VNDF_END VNDF_IMPL_CONTRACTED VNDF_IMPL_NOT_LITERALLY

#define VNDF_REAL2 VNDF_CAT(VNDF_REAL, 2)
#define VNDF_REAL3 VNDF_CAT(VNDF_REAL, 3)
#define VNDF_REAL4 VNDF_CAT(VNDF_REAL, 4)
#define VNDF_MAKE2(x, y) ((VNDF_REAL2)(x, y))
#define VNDF_MAKE3(x, y, z) ((VNDF_REAL3)(x, y, z))
#define VNDF_MAKE4(x, y, z, w) ((VNDF_REAL4)(x, y, z, w))

#if VNDF_SOFTWARE_FMA
VNDF_BEGIN
VNDF_FN VNDF_REAL vndf_impl_fma(VNDF_REAL a, VNDF_REAL b, VNDF_REAL c) {
    return c == VNDF_R(0.0) ? a * b + c : fma(a, b, c);
}
VNDF_END
#define VNDF_FMA(a, b, c) vndf_impl_fma(a, b, c)
#else
#define VNDF_FMA(a, b, c) fma(a, b, c)
#endif
#define VNDF_IMPL_SQRT(x) sqrt(x)
// A function of the language's library, and the fast one of it for VNDF_MATH native.
#define VNDF_STD(name) name
#if VNDF_POLICY == 2
#define VNDF_FAST(name) native_##name
#define VNDF_SIN_2PI(x) native_sin(VNDF_R(2.0) * VNDF_PI * (x))
#else
#define VNDF_FAST(name) name
#define VNDF_SIN_2PI(x) sinpi(VNDF_R(2.0) * (x))
#endif
#if VNDF_DOUBLE
#define VNDF_INT long
#define VNDF_AS_INT(x) as_long(x)
#define VNDF_AS_REAL(x) as_double(x)
#else
#define VNDF_INT int
#define VNDF_AS_INT(x) as_int(x)
#define VNDF_AS_REAL(x) as_float(x)
#endif

#else  // C, C++, CUDA, HIP

#if defined(__cplusplus) && __cplusplus < 201103L && !defined(_MSC_VER)
#error "clvndf: C++11 or later is needed"
#endif
#if VNDF_POLICY == 2
#error "clvndf: VNDF_MATH native exists on OpenCL devices only"
#undef VNDF_MATH
#define VNDF_MATH strict
#endif
#if defined(__CUDACC__) || defined(__CUDACC_RTC__) || defined(__HIPCC__) || defined(__HIPCC_RTC__)
#define VNDF_IMPL_GPU 1
#else
#define VNDF_IMPL_GPU 0
#endif

#if !defined(__CUDACC_RTC__) && !defined(__HIPCC_RTC__)
#include <float.h>
#include <math.h>
#include <string.h>

// Every macro by which a compiler tells of an option that changes results.
#if VNDF_ALLOW_FAST_MATH
#elif defined(__FAST_MATH__) || defined(_M_FP_FAST)
#error \
    "clvndf: -ffast-math (or /fp:fast) changes results; compile without it, or set VNDF_ALLOW_FAST_MATH to 1"
#elif defined(_M_FP_CONTRACT)
#error "clvndf: /fp:contract changes results; compile without it, or set VNDF_ALLOW_FAST_MATH to 1"
#elif defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__
#error "clvndf: -ffinite-math-only changes results; compile without it, or set VNDF_ALLOW_FAST_MATH to 1"
#elif defined(__ASSOCIATIVE_MATH__) || defined(__RECIPROCAL_MATH__) || defined(__NO_SIGNED_ZEROS__)
#error \
    "clvndf: -funsafe-math-optimizations (or -fassociative-math, -freciprocal-math, -fno-signed-zeros) changes results; compile without it, or set VNDF_ALLOW_FAST_MATH to 1"
// 16 and 32 are GCC's for "each type as itself" where there is a half; 1 and 64 for "float as double".
#elif FLT_EVAL_METHOD != 0 && FLT_EVAL_METHOD != 16 && FLT_EVAL_METHOD != 32 && \
    !(VNDF_DOUBLE && (FLT_EVAL_METHOD == 1 || FLT_EVAL_METHOD == 64))
#error \
    "clvndf: FLT_EVAL_METHOD is not 0 (-mfpmath=387, 32-bit x86 without -msse2 -mfpmath=sse, or a part of fast math), which changes results; compile otherwise, or set VNDF_ALLOW_FAST_MATH to 1"
#endif
#if !VNDF_DOUBLE || VNDF_ALLOW_FAST_MATH
#elif defined(__cplusplus)
static_assert(sizeof(1.0) == sizeof(double), "clvndf: -fsingle-precision-constant changes results");
#elif __STDC_VERSION__ >= 201112L
_Static_assert(sizeof(1.0) == sizeof(double), "clvndf: -fsingle-precision-constant changes results");
#endif
#endif

#ifdef VNDF_FN
#elif VNDF_IMPL_GPU
#define VNDF_FN static inline __host__ __device__ __attribute__((__unused__))
#elif defined(__GNUC__)
#define VNDF_FN static inline __attribute__((__unused__))
#else
#define VNDF_FN static inline
#endif

// Structs of reals are other types for another VNDF_REAL: one program may hold both.
#ifdef __cplusplus
#define VNDF_BEGIN VNDF_IMPL_LITERALLY inline namespace VNDF_CAT(vndf_, VNDF_REAL) {
#define VNDF_END \
    }            \
    VNDF_IMPL_NOT_LITERALLY
#else
#define VNDF_BEGIN VNDF_IMPL_LITERALLY
#define VNDF_END VNDF_IMPL_NOT_LITERALLY
#endif

#ifndef VNDF_VECTOR_TYPES
#define VNDF_VECTOR_TYPES
#if VNDF_IMPL_GPU
typedef float2 vndf_float2;
typedef float3 vndf_float3;
typedef float4 vndf_float4;
typedef double2 vndf_double2;
typedef double3 vndf_double3;
#else
typedef struct vndf_float2 {
    float x, y;
} vndf_float2;
typedef struct vndf_float3 {
    float x, y, z;
} vndf_float3;
typedef struct vndf_float4 {
    float x, y, z, w;
} vndf_float4;
typedef struct vndf_double2 {
    double x, y;
} vndf_double2;
typedef struct vndf_double3 {
    double x, y, z;
} vndf_double3;
#endif
// CUDA 13 deprecates its own.
typedef struct vndf_double4 {
    double x, y, z, w;
} vndf_double4;
#endif

// How a vector is made and read goes with its type: alone, VNDF_MAKE3 and VNDF_GET3 would be for ours.
#if (defined(VNDF_MAKE2) || defined(VNDF_GET2)) && !defined(VNDF_REAL2)
#error "clvndf: VNDF_MAKE2 and VNDF_GET2 are for a vector type of your own: define VNDF_REAL2, too"
#undef VNDF_MAKE2
#undef VNDF_GET2
#endif
#if (defined(VNDF_MAKE3) || defined(VNDF_GET3)) && !defined(VNDF_REAL3)
#error "clvndf: VNDF_MAKE3 and VNDF_GET3 are for a vector type of your own: define VNDF_REAL3, too"
#undef VNDF_MAKE3
#undef VNDF_GET3
#endif
#if defined(VNDF_MAKE4) && !defined(VNDF_REAL4)
#error "clvndf: VNDF_MAKE4 is for a vector type of your own: define VNDF_REAL4, too"
#undef VNDF_MAKE4
#endif
#if (defined(VNDF_GET2) || defined(VNDF_GET3)) && !defined(__cplusplus)
#error "clvndf: VNDF_GET2 and VNDF_GET3 need C++; in C a vector type of your own has members x, y and z"
#undef VNDF_GET2
#undef VNDF_GET3
#endif
#ifndef VNDF_REAL2
#define VNDF_REAL2 VNDF_CAT(VNDF_CAT(vndf_, VNDF_REAL), 2)
#endif
#ifndef VNDF_REAL3
#define VNDF_REAL3 VNDF_CAT(VNDF_CAT(vndf_, VNDF_REAL), 3)
#endif
#ifndef VNDF_REAL4
#define VNDF_REAL4 VNDF_CAT(VNDF_CAT(vndf_, VNDF_REAL), 4)
#endif
#ifdef __cplusplus
#define VNDF_IMPL_BRACES(type) type
#else
#define VNDF_IMPL_BRACES(type) (type)
#endif
#ifndef VNDF_MAKE2
#define VNDF_MAKE2(x, y) (VNDF_IMPL_BRACES(VNDF_REAL2){x, y})
#endif
#ifndef VNDF_MAKE3
#define VNDF_MAKE3(x, y, z) (VNDF_IMPL_BRACES(VNDF_REAL3){x, y, z})
#endif
#ifndef VNDF_MAKE4
#define VNDF_MAKE4(x, y, z, w) (VNDF_IMPL_BRACES(VNDF_REAL4){x, y, z, w})
#endif

#if VNDF_DOUBLE
#define VNDF_STD(name) name
#define VNDF_INT long long
#else
#define VNDF_STD(name) name##f
#define VNDF_INT int
#endif
#define VNDF_FAST(name) VNDF_STD(name)
#if VNDF_IMPL_PRECISE == 2 && defined(__clang__) && VNDF_ALLOW_FAST_MATH
// clang++ 14 takes library functions literally in operands of a conversion alone; the two of this one cancel.
#if VNDF_DOUBLE
#define VNDF_IMPL_EXACTLY(x) ((double)(long double)(x))
#else
#define VNDF_IMPL_EXACTLY(x) ((float)(double)(x))
#endif
#else
#define VNDF_IMPL_EXACTLY(x) x
#endif
#define VNDF_FMA(a, b, c) VNDF_IMPL_EXACTLY(VNDF_STD(fma)(a, b, c))
#define VNDF_IMPL_SQRT(x) VNDF_IMPL_EXACTLY(VNDF_STD(sqrt)(x))
#define VNDF_SIN_2PI(x) VNDF_STD(sin)(VNDF_R(2.0) * VNDF_PI * (x))

VNDF_BEGIN
VNDF_FN VNDF_INT vndf_impl_as_int(VNDF_REAL x) {
    VNDF_INT i;
    memcpy(&i, &x, sizeof i);
    return i;
}
VNDF_FN VNDF_REAL vndf_impl_as_real(VNDF_INT i) {
    VNDF_REAL x;
    memcpy(&x, &i, sizeof x);
    return x;
}
VNDF_END
#define VNDF_AS_INT(x) vndf_impl_as_int(x)
#define VNDF_AS_REAL(x) vndf_impl_as_real(x)

// A type without members x, y and z is made of and into one that has them, where functions are called and where they return.
#if VNDF_IMPL_GPU
#define VNDF_IMPL_MEMBER __host__ __device__
#else
#define VNDF_IMPL_MEMBER
#endif
#ifdef VNDF_GET2
VNDF_BEGIN
struct vndf_impl_vector2 {
    VNDF_REAL x, y;
    VNDF_IMPL_MEMBER vndf_impl_vector2(VNDF_REAL a, VNDF_REAL b) : x(a), y(b) {}
    VNDF_IMPL_MEMBER vndf_impl_vector2(const VNDF_REAL2& v) : x(VNDF_GET2(v, 0)), y(VNDF_GET2(v, 1)) {}
    VNDF_IMPL_MEMBER operator VNDF_REAL2() const { return VNDF_MAKE2(x, y); }
};
VNDF_END
#undef VNDF_REAL2
#undef VNDF_MAKE2
#define VNDF_REAL2 vndf_impl_vector2
#define VNDF_MAKE2(x, y) vndf_impl_vector2(x, y)
#endif
#ifdef VNDF_GET3
VNDF_BEGIN
struct vndf_impl_vector3 {
    VNDF_REAL x, y, z;
    VNDF_IMPL_MEMBER vndf_impl_vector3(VNDF_REAL a, VNDF_REAL b, VNDF_REAL c) : x(a), y(b), z(c) {}
    VNDF_IMPL_MEMBER vndf_impl_vector3(const VNDF_REAL3& v)
        : x(VNDF_GET3(v, 0)), y(VNDF_GET3(v, 1)), z(VNDF_GET3(v, 2)) {}
    VNDF_IMPL_MEMBER operator VNDF_REAL3() const { return VNDF_MAKE3(x, y, z); }
};
VNDF_END
#undef VNDF_REAL3
#undef VNDF_MAKE3
#define VNDF_REAL3 vndf_impl_vector3
#define VNDF_MAKE3(x, y, z) vndf_impl_vector3(x, y, z)
#endif

#endif

#include "divide.h"

#endif
