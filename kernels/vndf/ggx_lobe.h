// A GGX lobe: one view direction and one roughness, stretched once.
#ifndef VNDF_GGX_LOBE_H
#define VNDF_GGX_LOBE_H

#include "impl/lobe.h"

VNDF_BEGIN

// All that does not depend on u, wi or wm, for the functions with _lobe in their names.
// wo: unit vector, local frame, anywhere on the sphere.
// alpha: in [1e-8, 1e3] each.
VNDF_FN struct vndf_ggx_lobe vndf_ggx_lobe_of(VNDF_REAL3 wo, VNDF_REAL2 alpha) {
    struct vndf_ggx_lobe v;
    v.wo_x = wo.x;
    v.wo_y = wo.y;
    v.wo_z = wo.z;
    v.alpha_x = vndf_impl_alpha(alpha.x);
    v.alpha_y = vndf_impl_alpha_y(alpha.y);
    VNDF_REAL kx = v.alpha_x * wo.x * VNDF_R(134217728.0), ky = v.alpha_y * wo.y * VNDF_R(134217728.0);
    VNDF_REAL l2 = VNDF_FMA(kx, kx, ky * ky);
    v.axis = vndf_impl_axis_of(l2, wo.z * VNDF_R(134217728.0));
    // Azimuth 0 for a v without one.
    v.x = v.axis.weight * (l2 > VNDF_R(0.0) ? kx : vndf_impl_no_length(wo.z));
    v.y = v.axis.weight * ky;
    return v;
}

VNDF_END

#endif
