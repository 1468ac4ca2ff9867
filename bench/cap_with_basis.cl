// The cap for a surface in world space, in the place of the isotropic sampler: a basis about n (Duff et al., Building an
// Orthonormal Basis, Revisited, 2017), wo into it, the cap, the normal back. Ours under the policy strict, otherwise the
// published listing.
#include "../kernels/vndf/ggx_dupuy2023.h"
#include "../kernels/batch/entry_point.h"

VNDF_FN VNDF_REAL3 vndf_bench_cap_with_basis(VNDF_REAL3 wo, VNDF_REAL3 n, VNDF_REAL alpha, VNDF_REAL2 u) {
    VNDF_REAL sign = n.z < VNDF_R(0.0) ? VNDF_R(-1.0) : VNDF_R(1.0), a = VNDF_R(-1.0) / (sign + n.z);
    VNDF_REAL b = n.x * n.y * a, tx = VNDF_FMA(sign * n.x, n.x * a, VNDF_R(1.0)), ty = sign * b,
              tz = -sign * n.x;
    VNDF_REAL bx = b, by = VNDF_FMA(n.y, n.y * a, sign), bz = -n.y;
    VNDF_REAL3 local_wo = VNDF_MAKE3(VNDF_FMA(wo.x, tx, VNDF_FMA(wo.y, ty, wo.z * tz)),
                                     VNDF_FMA(wo.x, bx, VNDF_FMA(wo.y, by, wo.z * bz)),
                                     VNDF_FMA(wo.x, n.x, VNDF_FMA(wo.y, n.y, wo.z * n.z)));
    VNDF_REAL3 m = vndf_ggx_sample_wm_dupuy2023(local_wo, VNDF_MAKE2(alpha, alpha), u);
    return VNDF_MAKE3(VNDF_FMA(m.x, tx, VNDF_FMA(m.y, bx, m.z * n.x)),
                      VNDF_FMA(m.x, ty, VNDF_FMA(m.y, by, m.z * n.y)),
                      VNDF_FMA(m.x, tz, VNDF_FMA(m.y, bz, m.z * n.z)));
}

#if VNDF_IMPL_STRICT
VNDF_ENTRY_POINT(vndf_batch_vndf_ggx_sample_wm_benyoub2024, vndf_bench_cap_with_basis, WO_N_ALPHA1_U, WM)
#else
#include "published/ggx_dupuy2023.cl"

static inline float3 published_cap_with_basis(float3 wi, float3 n, float alpha, float2 u) {
    float s = copysign(1.0f, n.z);
    float a = -1.0f / (s + n.z);
    float b = n.x * n.y * a;
    float3 t1 = (float3)(1.0f + s * n.x * n.x * a, s * b, -s * n.x);
    float3 t2 = (float3)(b, s + n.y * n.y * a, -n.y);
    float3 wi_local = (float3)(dot(wi, t1), dot(wi, t2), dot(wi, n));
    float3 wm = published_ggx_sample_wm_dupuy2023(wi_local, (float2)(alpha, alpha), u);
    return wm.x * t1 + wm.y * t2 + wm.z * n;
}

VNDF_ENTRY_POINT(vndf_batch_vndf_ggx_sample_wm_benyoub2024, published_cap_with_basis, WO_N_ALPHA1_U, WM)
#endif
