// The published listings behind the same entry points as the registered functions of the same paper, so that
// whatever runs, checks or times vndf_batch_<name> takes this program in place of kernels/batch/batch.cl.
#include "ggx_dupuy2023.cl"
#include "ggx_heitz2017.cl"
#include "ggx_heitz2018.cl"
#include "ggx_eto2023.cl"
#include "ggx_benyoub2024.cl"
#include "heitz_deon2014.cl"

#include "../../kernels/vndf/impl/shim.h"
#include "../../kernels/batch/entry_point.h"

#define PUBLISHED(name, arguments, result) \
    VNDF_ENTRY_POINT(vndf_batch_vndf_##name, published_##name, arguments, result)
PUBLISHED(ggx_sample_wm_heitz_deon2014, WO_ALPHA_U, WM)
PUBLISHED(ggx_sample_wm_heitz2017, WO_ALPHA_U, WM)
PUBLISHED(ggx_sample_wm_heitz2018, WO_ALPHA_U, WM)
PUBLISHED(ggx_sample_wm_dupuy2023, WO_ALPHA_U, WM)
PUBLISHED(ggx_sample_wm_benyoub2024, WO_N_ALPHA1_U, WM)
PUBLISHED(ggx_sample_wi_eto2023, WO_ALPHA_U, WI)
PUBLISHED(beckmann_sample_wm_heitz_deon2014, WO_ALPHA_U, WM)
#undef PUBLISHED
