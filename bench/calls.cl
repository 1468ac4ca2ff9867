// What a renderer writes with separate calls, beside the function that does it from common terms (calls.sh).
#include "../kernels/batch/batch.cl"

VNDF_FN VNDF_REAL3 vndf_calls_half(VNDF_REAL3 wo, VNDF_REAL3 wi) {
    VNDF_REAL x = wo.x + wi.x, y = wo.y + wi.y, z = wo.z + wi.z;
    VNDF_REAL rcp = VNDF_R(1.0) / VNDF_SQRT(VNDF_FMA(x, x, VNDF_FMA(y, y, z * z)));
    return VNDF_MAKE3(x * rcp, y * rcp, z * rcp);
}

// The value of a reflection, D G2 / (4 cos cos), and its density.
#define VNDF_CALLS_EVAL_PDF(ndf)                                                                     \
    VNDF_FN VNDF_REAL2 vndf_calls_##ndf##_eval_pdf(VNDF_REAL3 wo, VNDF_REAL3 wi, VNDF_REAL2 alpha) { \
        VNDF_REAL d = vndf_##ndf##_ndf(vndf_calls_half(wo, wi), alpha);                              \
        VNDF_REAL value = d * vndf_##ndf##_g2(wo, wi, alpha) / (VNDF_R(4.0) * wo.z * wi.z);          \
        return VNDF_MAKE2(value, vndf_##ndf##_pdf_wi(wo, wi, alpha));                                \
    }                                                                                                \
    VNDF_ENTRY_POINT(vndf_calls_separate_##ndf##_eval_pdf, vndf_calls_##ndf##_eval_pdf, WO_WI_ALPHA, EVAL_PDF)
VNDF_CALLS_EVAL_PDF(ggx)
VNDF_CALLS_EVAL_PDF(beckmann)

// The density of wi seen from wo, and that of wo seen from wi.
VNDF_FN VNDF_REAL2 vndf_calls_ggx_pdf_wi_both(VNDF_REAL3 wo, VNDF_REAL3 wi, VNDF_REAL2 alpha) {
    return VNDF_MAKE2(vndf_ggx_pdf_wi(wo, wi, alpha), vndf_ggx_pdf_wi(wi, wo, alpha));
}
VNDF_ENTRY_POINT(vndf_calls_separate_ggx_pdf_wi_both, vndf_calls_ggx_pdf_wi_both, WO_WI_ALPHA, PDF_BOTH)

// The weight of a visible normal's reflection as G2 / G1.
#define VNDF_CALLS_WEIGHT(ndf)                                                                    \
    VNDF_FN VNDF_REAL vndf_calls_##ndf##_weight(VNDF_REAL3 wo, VNDF_REAL3 wi, VNDF_REAL2 alpha) { \
        return vndf_##ndf##_g2(wo, wi, alpha) / vndf_##ndf##_g1(wo, alpha);                       \
    }                                                                                             \
    VNDF_ENTRY_POINT(vndf_calls_separate_##ndf##_weight, vndf_calls_##ndf##_weight, WO_WI_ALPHA, VALUE)
VNDF_CALLS_WEIGHT(ggx)
VNDF_CALLS_WEIGHT(beckmann)
