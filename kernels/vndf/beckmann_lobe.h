// A Beckmann lobe: one view direction and one roughness, stretched once for all that is asked of them.
#ifndef VNDF_BECKMANN_LOBE_H
#define VNDF_BECKMANN_LOBE_H

#include "impl/beckmann_lobe.h"

VNDF_BEGIN

// The lobe of wo and alpha: all that does not depend on u, wi or wm.
// wo: unit vector, local frame, anywhere on the sphere.
// alpha: in [1e-8, 1e3] each.
// return: a struct for the functions vndf_beckmann_..._lobe.
VNDF_FN struct vndf_beckmann_lobe vndf_beckmann_lobe_of(VNDF_REAL3 wo, VNDF_REAL2 alpha) {
    return vndf_impl_beckmann_lobe_of(wo, vndf_impl_alpha(alpha.x), vndf_impl_alpha_y(alpha.y));
}

VNDF_END

#endif
