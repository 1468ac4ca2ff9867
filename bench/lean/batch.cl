// The published listings on scalars, with the library's polynomials and no guard: what they cost where a CPU device can
// vectorise them, and so the yardstick of what accuracy costs. Behind the same entry points as the registered functions.
//
// LEAN_FACTORED: 1 +- z of the polar angle without cancellation, where the listing forms it; see factored.cl.
#ifndef LEAN_FACTORED
#define LEAN_FACTORED 0
#endif
#include "../../kernels/vndf/impl/math.h"
#include "../../kernels/batch/entry_point.h"

// 1 / |(x, y, z)|
static inline float lean_rcp_length(float x, float y, float z) {
    return 1.0f / sqrt(fma(x, x, fma(y, y, z * z)));
}

// 1 + z or 1 - z of a unit vector whose tangential part has the length squared l2.
static inline float lean_sum(float z, float l2) {
#if LEAN_FACTORED
    return z >= 0.0f ? 1.0f + z : l2 / (1.0f - z);
#else
    return 1.0f + z;
#endif
}

static inline float3 lean_unstretch(float hx, float hy, float hz, float2 alpha) {
    float gx = alpha.x * hx, gy = alpha.y * hy, rcp = lean_rcp_length(gx, gy, hz);
    return (float3)(gx * rcp, gy * rcp, hz * rcp);
}

#include "ggx_dupuy2023.cl"
#include "ggx_eto2023.cl"
#include "ggx_benyoub2024.cl"

#define LEAN(name, arguments, result) VNDF_ENTRY_POINT(vndf_batch_vndf_##name, lean_##name, arguments, result)
LEAN(ggx_sample_wm_dupuy2023, WO_ALPHA_U, WM)
LEAN(ggx_sample_wm_benyoub2024, WO_N_ALPHA1_U, WM)
LEAN(ggx_sample_wi_eto2023, WO_ALPHA_U, WI)

#if !LEAN_FACTORED
#include "ggx_heitz2017.cl"
#include "ggx_heitz2018.cl"
#include "heitz_deon2014.cl"

LEAN(ggx_sample_wm_heitz_deon2014, WO_ALPHA_U, WM)
LEAN(ggx_sample_wm_heitz2017, WO_ALPHA_U, WM)
LEAN(ggx_sample_wm_heitz2018, WO_ALPHA_U, WM)
LEAN(beckmann_sample_wm_heitz_deon2014, WO_ALPHA_U, WM)
#endif
#undef LEAN
