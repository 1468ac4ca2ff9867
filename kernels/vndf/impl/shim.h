// What differs between OpenCL C and C++: how functions are declared, vector types, fma, sqrt and the bits of numbers.
#ifndef VNDF_IMPL_SHIM_H
#define VNDF_IMPL_SHIM_H

#include "../config.h"

#if defined(__OPENCL_VERSION__) || defined(__OPENCL_C_VERSION__)

#pragma OPENCL FP_CONTRACT OFF
#if VNDF_DOUBLE
#if __OPENCL_C_VERSION__ < 120 && defined(cl_khr_fp64)
#pragma OPENCL EXTENSION cl_khr_fp64 : enable
#endif
#endif
// always_inline, not just inline: one call that stays a call keeps a CPU device from vectorising the kernel.
#define VNDF_FN static inline __attribute__((always_inline))
#define VNDF_REAL2 VNDF_CAT(VNDF_REAL, 2)
#define VNDF_REAL3 VNDF_CAT(VNDF_REAL, 3)
#define VNDF_REAL4 VNDF_CAT(VNDF_REAL, 4)
#define VNDF_MAKE2(x, y) ((VNDF_REAL2)((x), (y)))
#define VNDF_MAKE3(x, y, z) ((VNDF_REAL3)((x), (y), (z)))
#define VNDF_MAKE4(x, y, z, w) ((VNDF_REAL4)((x), (y), (z), (w)))
#if VNDF_SOFTWARE_FMA
VNDF_FN VNDF_REAL vndf_impl_fma(VNDF_REAL a, VNDF_REAL b, VNDF_REAL c) {
    return c == VNDF_R(0.0) ? a * b + c : fma(a, b, c);
}
#define VNDF_FMA(a, b, c) vndf_impl_fma(a, b, c)
#else
#define VNDF_FMA(a, b, c) fma((VNDF_REAL)(a), (VNDF_REAL)(b), (VNDF_REAL)(c))
#endif
#define VNDF_SQRT(x) sqrt((VNDF_REAL)(x))
#if VNDF_DOUBLE
#define VNDF_INT long
#define VNDF_AS_INT(x) as_long(x)
#define VNDF_AS_REAL(x) as_double(x)
#define VNDF_TO_INT(x) convert_long(x)
#define VNDF_TO_REAL(x) convert_double(x)
#else
#define VNDF_INT int
#define VNDF_AS_INT(x) as_int(x)
#define VNDF_AS_REAL(x) as_float(x)
#define VNDF_TO_INT(x) convert_int(x)
#define VNDF_TO_REAL(x) convert_float(x)
#endif

#else  // C++

#if VNDF_POLICY == 2
#error "clvndf: VNDF_MATH native exists on OpenCL devices only"
#undef VNDF_MATH
#define VNDF_MATH strict
#endif
#include <cfloat>
#include <cmath>
#include <cstdint>
#include <cstring>

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
#if VNDF_DOUBLE && !VNDF_ALLOW_FAST_MATH
static_assert(sizeof(1.0) == sizeof(double), "clvndf: -fsingle-precision-constant changes results");
#endif
#define VNDF_FN [[maybe_unused]] static inline

#if defined(VNDF_REAL2) + defined(VNDF_REAL3) + defined(VNDF_REAL4) != 0 && \
    !(defined(VNDF_REAL2) && defined(VNDF_REAL3) && defined(VNDF_REAL4))
#error "clvndf: vector types of your own are all three: VNDF_REAL2, VNDF_REAL3 and VNDF_REAL4"
#undef VNDF_REAL2
#undef VNDF_REAL3
#undef VNDF_REAL4
#endif
#ifndef VNDF_REAL3
#ifndef VNDF_VECTOR_TYPES
#define VNDF_VECTOR_TYPES
struct vndf_float2 {
    float x, y;
};
struct vndf_float3 {
    float x, y, z;
};
struct vndf_float4 {
    float x, y, z, w;
};
struct vndf_double2 {
    double x, y;
};
struct vndf_double3 {
    double x, y, z;
};
struct vndf_double4 {
    double x, y, z, w;
};
#endif
#define VNDF_REAL2 VNDF_CAT(VNDF_CAT(vndf_, VNDF_REAL), 2)
#define VNDF_REAL3 VNDF_CAT(VNDF_CAT(vndf_, VNDF_REAL), 3)
#define VNDF_REAL4 VNDF_CAT(VNDF_CAT(vndf_, VNDF_REAL), 4)
#endif
#define VNDF_MAKE2(x, y) (VNDF_REAL2{(x), (y)})
#define VNDF_MAKE3(x, y, z) (VNDF_REAL3{(x), (y), (z)})
#define VNDF_MAKE4(x, y, z, w) (VNDF_REAL4{(x), (y), (z), (w)})
#define VNDF_FMA(a, b, c) std::fma((VNDF_REAL)(a), (VNDF_REAL)(b), (VNDF_REAL)(c))
#define VNDF_SQRT(x) std::sqrt((VNDF_REAL)(x))
#if VNDF_DOUBLE
#define VNDF_INT std::int64_t
#else
#define VNDF_INT std::int32_t
#endif
static inline VNDF_INT vndf_impl_as_int(VNDF_REAL x) {
    VNDF_INT i;
    std::memcpy(&i, &x, sizeof i);
    return i;
}
static inline VNDF_REAL vndf_impl_as_real(VNDF_INT i) {
    VNDF_REAL x;
    std::memcpy(&x, &i, sizeof x);
    return x;
}
#define VNDF_AS_INT(x) vndf_impl_as_int(x)
#define VNDF_AS_REAL(x) vndf_impl_as_real(x)
#define VNDF_TO_INT(x) static_cast<VNDF_INT>(x)
#define VNDF_TO_REAL(x) static_cast<VNDF_REAL>(x)

#endif

#endif
