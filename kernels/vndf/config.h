// Switches and constants. Every switch may be set with -D or before the include; a value that
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
//   VNDF_SOFTWARE_DIVIDE  0 (default); 1 for OpenCL devices that do not report CL_FP_CORRECTLY_ROUNDED_DIVIDE_SQRT: quotients
//              and roots of float are made those of hardware that rounds correctly (impl/divide.h), and with them the bits
//   VNDF_ALLOW_FAST_MATH  0 (default): in C and C++, compiler options that change results are errors; 1: they are not, and
//              what holds is the promise of fast math below
//   VNDF_FN    how functions are declared. Default: static, inlined always in OpenCL C, for __host__ and __device__ in CUDA and
//              HIP. Set it where a sampler is called at many places and kernels take minutes to build, to `static
//              __attribute__((noinline))` (PoCL then does not vectorise the kernel; one wrapper that is not inlined, called
//              from all places, does as well), or where a compiler wants words of its own
// For vector types of your own in C, C++, CUDA and HIP, each alone or together:
//   VNDF_REAL2, VNDF_REAL3, VNDF_REAL4   the type, with members x, y, z and made by braces: glm, Imath, linalg
//   VNDF_MAKE2(x, y), VNDF_MAKE3(x, y, z), VNDF_MAKE4(x, y, z, w)   makes one otherwise
//   VNDF_GET2(v, i), VNDF_GET3(v, i)   component i of a type without such members, v[i] for Eigen and std::array (C++):
//              functions then return what converts to it
//
// Compiler options. In C and C++ compile `strict` with -ffp-contract=off: a compiler that fuses a * b + c changes bits. Fast
// math and arithmetic wider than the type (-mfpmath=387; 32-bit x86 needs -msse2 -mfpmath=sse) are errors where the
// compiler tells of them. It tells of nothing, and only you can take care, in the case of
//   contraction, with every compiler but MSVC (/fp:contract);
//   clang++: -fno-signed-zeros and -fapprox-func; up to version 14 also -funsafe-math-optimizations, -fassociative-math
//     and -freciprocal-math;
//   nvcc, device code: --use_fast_math, --ftz=true, --prec-div=false, --prec-sqrt=false, and --fmad=true, its default;
//   linking with g++ -ffast-math or -Ofast: the program then flushes subnormal numbers, however this was compiled.
// In OpenCL C build programs with -cl-fp32-correctly-rounded-divide-sqrt where the device offers it, else with
// -DVNDF_SOFTWARE_DIVIDE=1.
//
// Fast math. -ffast-math with VNDF_ALLOW_FAST_MATH 1, and OpenCL's options that loosen (-cl-fast-relaxed-math,
// -cl-unsafe-math-optimizations, -cl-finite-math-only, -cl-no-signed-zeros, -cl-mad-enable, -cl-denorms-are-zero,
// -cl-single-precision-constant), stay outside these headers: they switch them off for themselves and leave your code as it
// is (impl/shim.h). Bits and bounds are not promised then; but for alpha in [1e-3, 10] and |wo.z| >= 1e-2 samples are unit
// within 8 * 2^-24, directions within 1e-5 of those of strict (99.9 %; 1e-4 at most) and densities and terms within 1e-4; and
// everywhere results are finite where those of strict are. It is tested for clang on CPUs (14 or later; so for PoCL) and g++.
// clang for GPUs and SPIR-V can be told of reassociation alone, under -cl-fast-relaxed-math and -ffast-math, and keeps quick
// division: there the largest errors of vndf_beckmann_sample_wm_heitz_deon2014 (1.1e-3, density 0.03),
// vndf_beckmann_slope_cdf_inverse, vndf_ggx_invert_wi_conic2026 (0.01), vndf_tangent and vndf_tangent_along (0.02) are more,
// since a last digit of a quotient may decide over the branch or be what is left of a difference; all else holds. So does
// NVIDIA's OpenCL (driver 580, H100, by `clvndf policies --flags renderers`), where all results are finite and values have
// errors of up to 1.6e-4 in four functions of Beckmann and GGX in world space, 3.6e-4 in vndf_beckmann_pdf_wi_world, 7e-4 in
// vndf_beckmann_sample_wm_heitz_deon2014's density and its slope, 2.3e-3 in vndf_jacobian_refract; directions of
// vndf_beckmann_sample_wm_walter2007 are within 8.1e-4. Of other compilers nothing is known: that command measures.
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
#ifndef VNDF_SOFTWARE_DIVIDE
#define VNDF_SOFTWARE_DIVIDE 0
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
#if VNDF_CAT(VNDF_SWITCH_IS_, VNDF_SOFTWARE_DIVIDE) >= 1
#else
#error "clvndf: unknown VNDF_SOFTWARE_DIVIDE; 0 and 1 are allowed"
#undef VNDF_SOFTWARE_DIVIDE
#define VNDF_SOFTWARE_DIVIDE 0
#endif
#if VNDF_CAT(VNDF_SWITCH_IS_, VNDF_ALLOW_FAST_MATH) >= 1
#else
#error "clvndf: unknown VNDF_ALLOW_FAST_MATH; 0 and 1 are allowed"
#undef VNDF_ALLOW_FAST_MATH
#define VNDF_ALLOW_FAST_MATH 0
#endif

// VNDF_DOUBLE: 1 if VNDF_REAL is double. VNDF_POLICY: 0 strict, 1 builtin, 2 native.
#if VNDF_CAT(VNDF_REAL_IS_, VNDF_REAL) == VNDF_REAL_IS_double
#define VNDF_DOUBLE 1
#else
#define VNDF_DOUBLE 0
#endif
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

#if VNDF_DOUBLE
#define VNDF_REAL_MAX 1.79769313486231570815e+308
#define VNDF_EPSILON 1.11022302462515654042e-16  // 2^-53
#else
#define VNDF_REAL_MAX 3.40282346638528859812e+38f
#define VNDF_EPSILON 5.96046447753906250000e-08f  // 2^-24
#endif

// The clamps of the public domain (see vndf.h). Below the least alpha a float direction cannot tell the lobe from a mirror; above
// the largest, squares would leave the range of numbers.
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
