// Directions even in a cap, with their density, in the place of the sampler of the reflections into it.
#include "../kernels/vndf/ggx_conic2026.h"
#include "../kernels/batch/entry_point.h"

VNDF_FN VNDF_REAL4 vndf_bench_cap_evenly(VNDF_REAL3 wo, VNDF_REAL3 l, VNDF_REAL one_minus_cos,
                                         VNDF_REAL2 alpha, VNDF_REAL2 u) {
    (void)wo;
    (void)alpha;
    VNDF_REAL gap = u.y * one_minus_cos, radius = VNDF_SQRT(gap * (VNDF_R(2.0) - gap)),
              height = VNDF_R(1.0) - gap;
    VNDF_REAL x = radius * vndf_impl_circle_cos(u.x), y = radius * vndf_impl_circle_sin(u.x);
    // Duff et al., Building an Orthonormal Basis, Revisited, 2017.
    VNDF_REAL s = l.z < VNDF_R(0.0) ? VNDF_R(-1.0) : VNDF_R(1.0), k = -VNDF_DIVIDE(VNDF_R(1.0), s + l.z),
              both = l.x * l.y * k;
    VNDF_REAL pdf = VNDF_DIVIDE(VNDF_R(0.5) * VNDF_1_PI, one_minus_cos);
    return VNDF_MAKE4(VNDF_FMA(x, VNDF_FMA(s * l.x * l.x, k, VNDF_R(1.0)), VNDF_FMA(y, both, height * l.x)),
                      VNDF_FMA(x, s * both, VNDF_FMA(y, VNDF_FMA(l.y * l.y, k, s), height * l.y)),
                      VNDF_FMA(x, -s * l.x, VNDF_FMA(y, -l.y, height * l.z)), pdf);
}

#ifndef VNDF_BENCH_CAP_BOTH
VNDF_ENTRY_POINT(vndf_batch_vndf_ggx_sample_wi_cone2026_with_pdf, vndf_bench_cap_evenly, WO_CAP_ALPHA_U,
                 WI_PDF)
#endif
