// The polar angle of the stretched view direction.
#ifndef VNDF_IMPL_CAPS_H
#define VNDF_IMPL_CAPS_H

#include "stretch.h"

VNDF_BEGIN

// P = 1 + cos and Q = 1 - cos of the polar angle of v, and the root of P. The smaller of the two is formed from
// its own root, l / t, so that neither is ever a difference.
struct vndf_impl_cap {
    VNDF_REAL p, q, sqrt_p;
    VNDF_REAL z, sine;  // cosine and sine of the polar angle: 1 / r = large_root / t
};
VNDF_FN struct vndf_impl_cap vndf_impl_cap_of(struct vndf_impl_view v) {
    struct vndf_impl_cap cap;
    VNDF_REAL large_root = (v.r + vndf_impl_abs(v.z)) * v.rcp_t, small_root = v.l * v.rcp_t;
    VNDF_REAL larger = large_root * large_root, smaller = small_root * small_root;
    int front = v.z >= VNDF_R(0.0);
    cap.z = v.z * (large_root * v.rcp_t);
    cap.sine = v.l * (large_root * v.rcp_t);
    cap.sqrt_p = front ? large_root : small_root;
    cap.p = front ? larger : smaller;
    cap.q = front ? smaller : larger;
    return cap;
}

VNDF_END

#endif
