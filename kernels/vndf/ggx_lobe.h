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

// What all samples, densities and terms of a lobe share. Made by vndf_ggx_lobe_of, used by the functions with _lobe in their
// names; its members are internals.
struct vndf_ggx_lobe {
    VNDF_REAL wo_x, wo_y, wo_z;
    VNDF_REAL alpha_x, alpha_y;  // clamped
    VNDF_REAL t;                 // r 2^27
    // (x, y) / height = tan(theta / 2) along the azimuth of v, and 2 z / height = 1 - tan^2(theta / 2). Above the surface
    // these are v.x, v.y, r + z and z, times 2^27; below it v.x (r - z), v.y (r - z), l^2 and z (r - z), over about l.
    VNDF_REAL x, y, z, height;
    VNDF_REAL weight;  // 1, or what stands for r - z; so that height / weight = (r + z) 2^27 = 2 sigma 2^27
    int level;         // v is near the horizon: |z| < height / 4
};

// The azimuth 0 of a v without one: this part of its length is added along x.
#if VNDF_DOUBLE
#define VNDF_IMPL_AZIMUTH 8.67361737988403547e-19  // 2^-60
#else
#define VNDF_IMPL_AZIMUTH 3.7252902984619140625e-09f  // 2^-28
#endif

// A power of two near 1 / l, for l2 = l^2.
VNDF_FN VNDF_REAL vndf_impl_rcp_root_scale(VNDF_REAL l2) {
#if VNDF_DOUBLE
    return VNDF_AS_REAL(0x5fe0000000000000 - ((VNDF_AS_INT(l2) >> 1) & 0x7ff0000000000000));
#else
    return VNDF_AS_REAL(0x5f000000 - ((VNDF_AS_INT(l2) >> 1) & 0x7f800000));
#endif
}

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
    // v 2^27: squares keep full precision down to wo.x = 1e-19 for every alpha in the domain, and the largest, (2^27 1e3)^2,
    // is far from overflow.
    VNDF_REAL kx = lobe.alpha_x * wo.x * VNDF_R(134217728.0), ky = lobe.alpha_y * wo.y * VNDF_R(134217728.0),
              kz = wo.z * VNDF_R(134217728.0), size = vndf_impl_abs(kz);
    VNDF_REAL l2 = VNDF_FMA(kx, kx, ky * ky);
    lobe.t = VNDF_SQRT(VNDF_FMA(kz, kz, l2));
    VNDF_REAL sum = lobe.t + size;
    // Below the surface numbers of second degree in v, brought back to the first.
    int front = wo.z >= VNDF_R(0.0);
    VNDF_REAL scale = vndf_impl_rcp_root_scale(l2), low = l2 * scale;
    VNDF_REAL larger = front ? VNDF_R(1.0) : sum, scaled = larger * scale;
    lobe.weight = front ? larger : scaled;
    lobe.height = front ? sum : low;
    lobe.x = VNDF_FMA(lobe.weight, kx, larger * VNDF_IMPL_AZIMUTH);
    lobe.y = lobe.weight * ky;
    lobe.z = lobe.weight * kz;
    lobe.level = sum > VNDF_R(5.0) * size;
    return lobe;
}

#endif
