// Directions even in a cap or reflections above the horizon, each half of the time, with the density of both together, the
// balance heuristic (Veach & Guibas, 1995), in the place of the sampler of the reflections into it.
#define VNDF_BENCH_CAP_BOTH
#include "cap_evenly.cl"

VNDF_FN VNDF_REAL4 vndf_bench_cap_both(VNDF_REAL3 wo, VNDF_REAL3 l, VNDF_REAL one_minus_cos, VNDF_REAL2 alpha,
                                       VNDF_REAL2 u) {
    int evenly = u.x < VNDF_R(0.5);
    VNDF_REAL2 v = VNDF_MAKE2(VNDF_R(2.0) * u.x - (evenly ? VNDF_R(0.0) : VNDF_R(1.0)), u.y);
    struct vndf_ggx_conic2026 lobe = vndf_ggx_conic2026_lobe(wo, alpha);
    VNDF_REAL3 mirrored = vndf_ggx_sample_wi_conic2026_lobe(lobe, v);
    VNDF_REAL4 even = vndf_bench_cap_evenly(wo, l, one_minus_cos, alpha, v);
    VNDF_REAL x = evenly ? even.x : mirrored.x, y = evenly ? even.y : mirrored.y,
              z = evenly ? even.z : mirrored.z;
    VNDF_REAL pdf = VNDF_R(0.5) * (even.w + vndf_ggx_pdf_wi_conic2026_lobe(lobe, VNDF_MAKE3(x, y, z)));
    VNDF_REAL dx = x - l.x, dy = y - l.y, dz = z - l.z;
    int hit = evenly || VNDF_R(0.5) * VNDF_FMA(dx, dx, VNDF_FMA(dy, dy, dz * dz)) <= one_minus_cos;
    return VNDF_MAKE4(x, y, z, hit ? pdf : VNDF_R(0.0));
}

VNDF_ENTRY_POINT(vndf_batch_vndf_ggx_sample_wi_cone2026_with_pdf, vndf_bench_cap_both, WO_CAP_ALPHA_U, WI_PDF)
