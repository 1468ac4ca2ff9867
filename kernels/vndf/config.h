// Switches, number types and the OpenCL C / C++ shim. Every switch may be set with -D or before the include; a value that
// is not listed here is an error.
//
// For users:
//   VNDF_REAL  float (default) or double (needs fp64 on the device)
//   VNDF_MATH  strict (default): only + - * / fma sqrt, comparisons and integer operations, and our own
//              polynomials: the same bits on every device that rounds division and sqrt correctly;
//              builtin: OpenCL's sinpi, log, erf ... with the specification's bounds;
//              native: native_* where OpenCL has one (float only; OpenCL only), never promised
//   VNDF_SOFTWARE_FMA  0 (default); 1 for OpenCL devices that do not report CL_FP_FMA: libclc's emulated fma gives
//              -0 for (-0) + 0, which costs `strict` the sign of a zero
//   VNDF_ALLOW_FAST_MATH  0 (default): in C++, compiler options that change results are errors; 1: they are not, and
//              neither bits nor bounds are promised
// For C++ users with vector types of their own (members x, y, z, w; brace initialisation):
//   VNDF_REAL2, VNDF_REAL3, VNDF_REAL4
//
// Compiler options. In C++ compile `strict` with -ffp-contract=off: a compiler that fuses a * b + c changes bits. Fast
// math and arithmetic wider than the type (-mfpmath=387; 32-bit x86 needs -msse2 -mfpmath=sse) are errors where the
// compiler tells of them. It tells of nothing, and only you can take care, in the case of
//   contraction, with every compiler but MSVC (/fp:contract);
//   clang++: -fno-signed-zeros and -fapprox-func; up to version 14 also -funsafe-math-optimizations, -fassociative-math
//     and -freciprocal-math;
//   nvcc, device code: --use_fast_math, --ftz=true, --prec-div=false, --prec-sqrt=false, and --fmad=true, its default;
//   linking with g++ -ffast-math or -Ofast: the program then flushes subnormal numbers, however this was compiled.
// In OpenCL C this header switches contraction off, and programs should be built with
// -cl-fp32-correctly-rounded-divide-sqrt where the device offers it. The options that loosen (-cl-fast-relaxed-math,
// -cl-unsafe-math-optimizations, -cl-finite-math-only, -cl-no-signed-zeros, -cl-mad-enable, -cl-denorms-are-zero,
// -cl-single-precision-constant) are no errors, but nothing is promised with them; `clvndf policies` measures what they cost.
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
#ifndef VNDF_ALLOW_FAST_MATH
#define VNDF_ALLOW_FAST_MATH 0
#endif

#define VNDF_CAT_(a, b) a##b
#define VNDF_CAT(a, b) VNDF_CAT_(a, b)

// The values allowed; others paste to an unknown name, which the preprocessor takes for 0.
#define VNDF_REAL_IS_float 1
#define VNDF_REAL_IS_double 2
#define VNDF_MATH_IS_strict 1
#define VNDF_MATH_IS_builtin 2
#define VNDF_MATH_IS_native 3
#define VNDF_SWITCH_IS_0 1
#define VNDF_SWITCH_IS_1 2

// After an error the default takes over, so that the error stays alone. #else, because of a value that no expression can
// hold, such as long double, neither a condition nor its opposite is true.
#if VNDF_CAT(VNDF_REAL_IS_, VNDF_REAL) >= 1
#else
#error "clvndf: unknown VNDF_REAL; float and double are allowed"
#undef VNDF_REAL
#define VNDF_REAL float
#endif
#if VNDF_CAT(VNDF_MATH_IS_, VNDF_MATH) >= 1
#else
#error "clvndf: unknown VNDF_MATH; strict, builtin and native are allowed"
#undef VNDF_MATH
#define VNDF_MATH strict
#endif
#if VNDF_CAT(VNDF_SWITCH_IS_, VNDF_SOFTWARE_FMA) >= 1
#else
#error "clvndf: unknown VNDF_SOFTWARE_FMA; 0 and 1 are allowed"
#undef VNDF_SOFTWARE_FMA
#define VNDF_SOFTWARE_FMA 0
#endif
#if VNDF_CAT(VNDF_SWITCH_IS_, VNDF_ALLOW_FAST_MATH) >= 1
#else
#error "clvndf: unknown VNDF_ALLOW_FAST_MATH; 0 and 1 are allowed"
#undef VNDF_ALLOW_FAST_MATH
#define VNDF_ALLOW_FAST_MATH 0
#endif

// VNDF_DOUBLE: 1 if VNDF_REAL is double. VNDF_POLICY: 0 strict, 1 builtin, 2 native.
#define VNDF_DOUBLE (VNDF_CAT(VNDF_REAL_IS_, VNDF_REAL) - 1)
#define VNDF_POLICY (VNDF_CAT(VNDF_MATH_IS_, VNDF_MATH) - 1)

#if VNDF_DOUBLE && VNDF_POLICY == 2
#error "clvndf: VNDF_MATH native exists for VNDF_REAL float only"
#undef VNDF_MATH
#define VNDF_MATH strict
#endif

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
