// A GGX lobe: one view direction and one roughness, stretched once for all that is asked of them.
//
// Source: the stretched view direction v = (alpha_x wo.x, alpha_y wo.y, wo.z) of Heitz 2014 and its successors, never
//     normalised: every map and density is homogeneous in v, so that a common factor falls out where the result is
//     normalised. Half the polar angle theta of v takes the place of cos theta, which loses 1 - |cos theta|:
//         tan(theta / 2) = l / (r + z) = (r - z) / l,   r = |v|, l = |(v.x, v.y)|,
//     the first above the surface, the second below it, where r + z cancels.
#ifndef VNDF_GGX_LOBE_H
#define VNDF_GGX_LOBE_H

#include "impl/range.h"

// theta of a v by its parts times 2^27: squares keep full precision down to v.x = 1e-27, and the largest, (2^27 1e6)^2, is far
// from overflow.
struct vndf_impl_axis {
    VNDF_REAL t;  // r 2^27
    // (x, y) / height = tan(theta / 2), (x, y) = weight (v.x, v.y) 2^27, and 2 z / height = 1 - tan^2(theta / 2). Above the
    // surface height is r + z; below it l^2, and the weight r - z, both over about l.
    VNDF_REAL height, weight, z;
    int level;  // v is near the horizon: |z| < height / 4
};

// What stands for l = 0: nothing beside any number above the surface, and not lost below it, where scale is large.
#define VNDF_IMPL_NO_LENGTH VNDF_R(8.67361737988403547e-19)  // 2^-60

// A power of two near 1 / l, for l2 = l^2.
VNDF_FN VNDF_REAL vndf_impl_rcp_root_scale(VNDF_REAL l2) {
#if VNDF_DOUBLE
    return VNDF_AS_REAL(0x5fe0000000000000 - ((VNDF_AS_INT(l2) >> 1) & 0x7ff0000000000000));
#else
    return VNDF_AS_REAL(0x5f000000 - ((VNDF_AS_INT(l2) >> 1) & 0x7f800000));
#endif
}
VNDF_FN struct vndf_impl_axis vndf_impl_axis_of(VNDF_REAL l2, VNDF_REAL z) {
    struct vndf_impl_axis v;
    VNDF_REAL size = vndf_impl_abs(z);
    v.t = VNDF_SQRT(VNDF_FMA(z, z, l2));
    VNDF_REAL sum = v.t + size;
    VNDF_REAL scale = vndf_impl_rcp_root_scale(l2), weight = sum * scale, height = l2 * scale;
    int front = z >= VNDF_R(0.0);
    v.weight = front ? VNDF_R(1.0) : weight;
    v.height = front ? sum : height;
    v.z = v.weight * z;
    v.level = sum > VNDF_R(5.0) * size;
    return v;
}

// What all samples, densities and terms of a lobe share. Made by vndf_ggx_lobe_of, used by the functions with _lobe in their
// names; its members are internals.
struct vndf_ggx_lobe {
    VNDF_REAL wo_x, wo_y, wo_z;
    VNDF_REAL alpha_x, alpha_y;  // clamped
    struct vndf_impl_axis axis;
    VNDF_REAL x, y;  // (x, y) / height = tan(theta / 2) along the azimuth of v
};

// The lobe of wo and alpha: all that does not depend on u, wi or wm.
// wo: unit vector, local frame, anywhere on the sphere.
// alpha: in [1e-8, 1e3] each.
// return: a struct for the functions vndf_ggx_..._lobe.
VNDF_FN struct vndf_ggx_lobe vndf_ggx_lobe_of(VNDF_REAL3 wo, VNDF_REAL2 alpha) {
    struct vndf_ggx_lobe lobe;
    lobe.wo_x = wo.x;
    lobe.wo_y = wo.y;
    lobe.wo_z = wo.z;
    lobe.alpha_x = vndf_impl_alpha(alpha.x);
    lobe.alpha_y = vndf_impl_alpha_y(alpha.y);
    VNDF_REAL kx = lobe.alpha_x * wo.x * VNDF_R(134217728.0), ky = lobe.alpha_y * wo.y * VNDF_R(134217728.0);
    VNDF_REAL l2 = VNDF_FMA(kx, kx, ky * ky);
    lobe.axis = vndf_impl_axis_of(l2, wo.z * VNDF_R(134217728.0));
    // Azimuth 0 for a v without one.
    lobe.x = lobe.axis.weight * (l2 > VNDF_R(0.0) ? kx : VNDF_IMPL_NO_LENGTH);
    lobe.y = lobe.axis.weight * ky;
    return lobe;
}

// Twice the projected area that wo sees, z + t.
VNDF_FN VNDF_REAL vndf_impl_lobe_twice_sigma(struct vndf_ggx_lobe lobe) {
    return lobe.axis.height * VNDF_R(7.450580596923828125e-09) / lobe.axis.weight;
}

#endif
