// A GGX lobe: one view direction and one roughness, stretched once for all that is asked of them.
#ifndef VNDF_GGX_LOBE_H
#define VNDF_GGX_LOBE_H

#include "impl/lobe.h"

VNDF_BEGIN

// The lobe of wo and alpha: all that does not depend on u, wi or wm.
// wo: unit vector, local frame, anywhere on the sphere.
// alpha: in [1e-8, 1e3] each.
// return: a struct for the functions vndf_ggx_..._lobe.
VNDF_FN struct vndf_ggx_lobe vndf_ggx_lobe_of(VNDF_REAL3 wo, VNDF_REAL2 alpha) {
    return vndf_impl_lobe_of(wo, alpha);
}

VNDF_END

#endif
