// The OpenCL functions that samplers and listings call, on NVIDIA, where clang has no device library of its own: CUDA's
// libdevice, and for vectors what CUDA's helper_math.h does. In fast math what nvcc --use_fast_math takes.
#ifndef LIBDEVICE_H
#define LIBDEVICE_H
#pragma OPENCL FP_CONTRACT ON

#define LIBDEVICE(result, name, parameters, value)                        \
    result __attribute__((overloadable, always_inline)) name parameters { \
        return value;                                                     \
    }

float __nv_sinf(float), __nv_cosf(float), __nv_tanf(float), __nv_expf(float), __nv_logf(float);
float __nv_atan2f(float, float), __nv_erff(float), __nv_rsqrtf(float);
void __nv_sincosf(float, __private float*, __private float*);

LIBDEVICE(size_t, get_global_id, (uint dimension),
          __nvvm_read_ptx_sreg_ctaid_x() * __nvvm_read_ptx_sreg_ntid_x() + __nvvm_read_ptx_sreg_tid_x())
LIBDEVICE(int, convert_int, (float x), (int)x)
LIBDEVICE(float, convert_float, (int x), (float)x)

LIBDEVICE(float, sqrt, (float x), __builtin_sqrtf(x))
LIBDEVICE(float, fma, (float a, float b, float c), __builtin_fmaf(a, b, c))
LIBDEVICE(float, mad, (float a, float b, float c), (a * b + c))
LIBDEVICE(float, fabs, (float x), __builtin_fabsf(x))
LIBDEVICE(float, min, (float x, float y), __builtin_fminf(x, y))
LIBDEVICE(float, max, (float x, float y), __builtin_fmaxf(x, y))
LIBDEVICE(float, clamp, (float x, float low, float high), min(max(x, low), high))

LIBDEVICE(float, atan2, (float y, float x), __nv_atan2f(y, x))
LIBDEVICE(float, erf, (float x), __nv_erff(x))
#ifdef __FAST_RELAXED_MATH__
LIBDEVICE(float, rsqrt, (float x), __nvvm_rsqrt_approx_ftz_f(x))
LIBDEVICE(float, sin, (float x), __nvvm_sin_approx_ftz_f(x))
LIBDEVICE(float, cos, (float x), __nvvm_cos_approx_ftz_f(x))
LIBDEVICE(float, tan, (float x), sin(x) / cos(x))
LIBDEVICE(float, exp, (float x), (__nvvm_ex2_approx_ftz_f(M_LOG2E_F * x)))
LIBDEVICE(float, log, (float x), __nvvm_lg2_approx_ftz_f(x) * M_LN2_F)
LIBDEVICE(float, sincos, (float x, __private float* cosine), (*cosine = cos(x), sin(x)))
#else
LIBDEVICE(float, rsqrt, (float x), __nv_rsqrtf(x))
LIBDEVICE(float, sin, (float x), __nv_sinf(x))
LIBDEVICE(float, cos, (float x), __nv_cosf(x))
LIBDEVICE(float, tan, (float x), __nv_tanf(x))
LIBDEVICE(float, exp, (float x), __nv_expf(x))
LIBDEVICE(float, log, (float x), __nv_logf(x))
static inline float libdevice_sincos(float x, __private float* cosine) {
    float sine;
    __nv_sincosf(x, &sine, cosine);
    return sine;
}
LIBDEVICE(float, sincos, (float x, __private float* cosine), libdevice_sincos(x, cosine))
#endif

LIBDEVICE(float, dot, (float3 a, float3 b), (a.x * b.x + a.y * b.y + a.z * b.z))
LIBDEVICE(float, length, (float2 a), sqrt(a.x* a.x + a.y * a.y))
LIBDEVICE(float3, normalize, (float3 a), a* rsqrt(dot(a, a)))
LIBDEVICE(float3, cross, (float3 a, float3 b), a.yzx* b.zxy - a.zxy * b.yzx)
#undef LIBDEVICE

#endif
