// Kernels that call the library, for languages.sh: nvcc and NVRTC compile them.
#include "vndf/vndf.h"

extern "C" __global__ void sample(const VNDF_REAL* in, VNDF_REAL* out) {
    const int i = blockIdx.x * blockDim.x + threadIdx.x;
    const VNDF_REAL2 alpha = VNDF_MAKE2(in[4], in[5]), u = VNDF_MAKE2(in[6 * i], in[6 * i + 1]);
    const VNDF_REAL3 wo = VNDF_MAKE3(in[6 * i + 2], in[6 * i + 3], in[6 * i + 4]);
    const VNDF_REAL3 cap = vndf_ggx_sample_wm_dupuy2023(wo, alpha, u);
    const VNDF_REAL4 conic = vndf_ggx_sample_wi_conic2026_with_pdf(wo, alpha, u);
    const VNDF_REAL3 jakob = vndf_beckmann_sample_wm_jakob2014(wo, alpha, u);
    out[3 * i] = cap.x + conic.w;
    out[3 * i + 1] = cap.y + jakob.y;
    out[3 * i + 2] = cap.z + vndf_beckmann_pdf_wm(wo, jakob, alpha);
}
