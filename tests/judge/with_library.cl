// A file that includes the library and another of its own.
#include "vndf/vndf.h"
#include "mine.h"

float3 my_sample(float3 wo, float2 alpha, float2 u) {
    return MINE_OR_NOT(vndf_ggx_sample_wm_dupuy2023(wo, alpha, u));
}
