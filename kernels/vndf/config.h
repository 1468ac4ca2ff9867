// Switches, number types and the OpenCL C / C++ shim. Every switch may be set with -D or before the include.
//
// For users:
//   VNDF_REAL  float (default) or double (needs fp64 on the device)
//   VNDF_MATH  strict (default): only + - * / fma sqrt, comparisons and integer operations, and our own
//              polynomials: the same bits on every device that rounds division and sqrt correctly;
//              builtin: OpenCL's sinpi, log, erf ... with the specification's bounds;
//              native: native_* where OpenCL has one (float only; OpenCL only), never promised
//   VNDF_SOFTWARE_FMA  0 (default); 1 for OpenCL devices that do not report CL_FP_FMA: libclc's emulated fma gives
//              -0 for (-0) + 0, which costs `strict` the sign of a zero
// For C++ users with vector types of their own (members x, y, z, w; brace initialisation):
//   VNDF_REAL2, VNDF_REAL3, VNDF_REAL4
//
// In C++ compile `strict` with -ffp-contract=off: a compiler that fuses a * b + c changes bits. In OpenCL C
// this header switches contraction off, and programs should be built with
// -cl-fp32-correctly-rounded-divide-sqrt where the device offers it.
#ifndef VNDF_CONFIG_H
#define VNDF_CONFIG_H

#ifndef VNDF_REAL
#define VNDF_REAL float
#endif
#ifndef VNDF_MATH
#define VNDF_MATH strict
#endif
#ifndef VNDF_SOFTWARE_FMA
#define VNDF_SOFTWARE_FMA 0
#endif

#define VNDF_CAT_(a, b) a##b
#define VNDF_CAT(a, b) VNDF_CAT_(a, b)

#define VNDF_REAL_IS_float 0
#define VNDF_REAL_IS_double 1
#define VNDF_MATH_IS_strict 0
#define VNDF_MATH_IS_builtin 1
#define VNDF_MATH_IS_native 2
// VNDF_DOUBLE: 1 if VNDF_REAL is double. VNDF_POLICY: 0 strict, 1 builtin, 2 native.
#define VNDF_DOUBLE VNDF_CAT(VNDF_REAL_IS_, VNDF_REAL)
#define VNDF_POLICY VNDF_CAT(VNDF_MATH_IS_, VNDF_MATH)

// VNDF_R(0.5): a literal of type VNDF_REAL.
#if VNDF_DOUBLE
#define VNDF_R(x) x
#else
#define VNDF_R(x) x##f
#endif

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

#ifdef __FAST_MATH__
#error "clvndf: -ffast-math (or /fp:fast) breaks the strict policy's promises; compile without it"
#endif
#if VNDF_POLICY == 2
#error "clvndf: VNDF_MATH native exists on OpenCL devices only"
#endif
#include <cmath>
#include <cstdint>
#include <cstring>
#define VNDF_FN [[maybe_unused]] static inline

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

// The clamps of the public domain (see vndf.h).
#define VNDF_ALPHA_MIN VNDF_R(1e-8)
#define VNDF_ALPHA_MAX VNDF_R(1e3)
#if VNDF_DOUBLE
#define VNDF_U_MIN 2.7105054312137610850e-20  // 2^-65
#define VNDF_U_MAX 0.99999999999999988898     // 1 - 2^-53
#else
#define VNDF_U_MIN 1.1641532182693481445e-10f   // 2^-33
#define VNDF_U_MAX 0.999999940395355224609375f  // 1 - 2^-24
#endif

#define VNDF_PI VNDF_R(3.14159265358979323846)
#define VNDF_1_PI VNDF_R(0.318309886183790671538)
#define VNDF_2_PI VNDF_R(0.636619772367581343076)
#define VNDF_1_SQRT_PI VNDF_R(0.564189583547756286948)
#define VNDF_SQRT_PI VNDF_R(1.77245385090551602730)

#endif
