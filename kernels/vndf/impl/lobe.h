// A GGX lobe: one view direction and one roughness, stretched once for all that is asked of them.
//
// Source: the stretched view direction v = (alpha_x wo.x, alpha_y wo.y, wo.z) of Heitz 2014 and its successors, never
//     normalised: every map and density is homogeneous in v, so that a common factor falls out where the result is
//     normalised. Half the polar angle theta of v takes the place of cos theta, which loses 1 - |cos theta|:
//         tan(theta / 2) = l / (r + z) = (r - z) / l,   r = |v|, l = |(v.x, v.y)|,
//     the first above the surface, the second below it, where r + z cancels.
//
// Half vectors of a cap of stretched reflections, and the visible normals and reflections that they make.
//
// With t = tan(theta / 2) along the azimuth of v and u2 = 1 - rest, the cap's reflection o has 1 - o.z = 2 u2 / (1 + t^2), and
// o + v / |v| is parallel to h = (R e(phi) + t, rest), R^2 = u2 (rest + t^2): to (R e + (x, y), rest height) in a lobe's
// numbers. A normal's density in stretched space is |h| / (pi height).
#ifndef VNDF_IMPL_LOBE_H
#define VNDF_IMPL_LOBE_H

#include "exact.h"
#include "stretch.h"

VNDF_BEGIN

// theta of 2^27 v, whose squares neither underflow nor overflow.
struct vndf_impl_axis {
    VNDF_REAL t, l2;  // r, l^2
    // weight l / height = tan(theta / 2): l / (r + z) above the surface; below it (r - z) l / l^2, both over about l.
    VNDF_REAL height, weight, z;  // z: weight v.z
    int level;                    // near the horizon: |z| < height / 4
};

// What stands for l = 0: nothing beside r + z, and not lost below the surface.
VNDF_FN VNDF_REAL vndf_impl_no_length(VNDF_REAL z) {
    return z < VNDF_R(0.0)
               ? VNDF_R(8.67361737988403547e-19)
               : (VNDF_DOUBLE ? VNDF_R(7.88860905221011805e-31) : VNDF_R(9.31322574615478516e-10));
}

VNDF_FN struct vndf_impl_axis vndf_impl_axis_of(VNDF_REAL l2, VNDF_REAL z) {
    struct vndf_impl_axis v;
    int front = z >= VNDF_R(0.0);
    VNDF_REAL size = front ? z : -z, r = VNDF_SQRT(VNDF_FMA(z, z, l2)), sum = r + size;
    // A power of two near 1 / l.
#if VNDF_DOUBLE
    VNDF_REAL scale = VNDF_AS_REAL(0x5fe0000000000000 - ((VNDF_AS_INT(l2) >> 1) & 0x7ff0000000000000));
#else
    VNDF_REAL scale = VNDF_AS_REAL(0x5f000000 - ((VNDF_AS_INT(l2) >> 1) & 0x7f800000));
#endif
    VNDF_REAL weight = sum * scale, height = l2 * scale;
    v.t = r;
    v.l2 = l2;
    v.weight = front ? VNDF_R(1.0) : weight;
    v.height = front ? sum : height;
    v.z = v.weight * z;
    v.level = sum > VNDF_R(5.0) * size;
    return v;
}

// Its members are internals.
struct vndf_ggx_lobe {
    VNDF_REAL wo_x, wo_y, wo_z;
    VNDF_REAL alpha_x, alpha_y;  // clamped
    struct vndf_impl_axis axis;
    VNDF_REAL x, y;  // tan(theta / 2) height along the azimuth of v
};

// Twice the projected area that wo sees, z + t.
VNDF_FN VNDF_REAL vndf_impl_lobe_twice_sigma(struct vndf_ggx_lobe lobe) {
    return VNDF_DIVIDE(lobe.axis.height * VNDF_R(7.450580596923828125e-09), lobe.axis.weight);
}

// e + (x, y), e at azimuth u1 and height z, |e|^2 = e2. What rounding does to |e| is corrected: e2 - l2 = z (2 z_v - z), or
// `steep` where that cancels.
VNDF_FN struct vndf_impl_vector vndf_impl_cap_sum(struct vndf_ggx_lobe v, VNDF_REAL l2, VNDF_REAL u1,
                                                  VNDF_REAL z, VNDF_REAL e2, VNDF_REAL steep) {
    struct vndf_impl_vector h;
    VNDF_REAL radius = VNDF_SQRT(e2);
    VNDF_REAL ex = radius * vndf_impl_circle_cos(u1), ey = radius * vndf_impl_circle_sin(u1);
    VNDF_REAL hx = ex + v.x, hy = ey + v.y,
              excess = v.axis.level ? z * VNDF_FMA(VNDF_R(2.0), v.axis.z, -z) : steep;
    VNDF_REAL error = VNDF_DIVIDE(VNDF_FMA(ex - v.x, hx, VNDF_FMA(ey - v.y, hy, -excess)), e2 + l2);
    h.x = VNDF_FMA(-error, ex, hx);
    h.y = VNDF_FMA(-error, ey, hy);
    h.z = z;
    return h;
}

// The plain cap.
VNDF_FN struct vndf_impl_vector vndf_impl_cap_half(struct vndf_ggx_lobe v, VNDF_REAL2 u) {
    VNDF_REAL u1 = vndf_impl_u(u.x), u2 = vndf_impl_u(u.y), rest = VNDF_R(1.0) - u2;
    VNDF_REAL height = v.axis.height, h2 = height * height, l2 = VNDF_FMA(v.x, v.x, v.y * v.y);
    return vndf_impl_cap_sum(v, l2, u1, rest * height, u2 * VNDF_FMA(rest, h2, l2),
                             rest * VNDF_FMA(u2, h2, -l2));
}

// The reflection of wo about the unstretched normal g of a half vector, and its density D / (2 n), n = height / weight = k
// wo.z + |v|.
VNDF_FN struct vndf_impl_sample vndf_impl_lobe_reflection(struct vndf_ggx_lobe v, VNDF_REAL height,
                                                          struct vndf_impl_vector h) {
    struct vndf_impl_sample o;
    // Reflect about g of any length: no rounding of g can tilt the mirror.
    VNDF_REAL gx = v.alpha_x * h.x, gy = v.alpha_y * h.y;
    VNDF_REAL g2 = VNDF_FMA(gx, gx, VNDF_FMA(gy, gy, h.z * h.z));
    VNDF_REAL cosine = VNDF_FMA(v.wo_x, gx, VNDF_FMA(v.wo_y, gy, v.wo_z * h.z));
    VNDF_REAL twice = VNDF_DIVIDE(VNDF_R(2.0) * cosine, g2);
    o.x = VNDF_FMA(twice, gx, -v.wo_x);
    o.y = VNDF_FMA(twice, gy, -v.wo_y);
    o.z = VNDF_FMA(twice, h.z, -v.wo_z);
    // Only the direction of wo counts: the length that the mirror kept is divided out.
    VNDF_REAL o2 = VNDF_FMA(o.x, o.x, VNDF_FMA(o.y, o.y, o.z * o.z)), length = VNDF_SQRT(o2),
              rcp = VNDF_DIVIDE(VNDF_R(1.0), length);
    o.x *= rcp;
    o.y *= rcp;
    o.z *= rcp;
    VNDF_REAL ratio = VNDF_DIVIDE(g2, VNDF_FMA(h.x, h.x, VNDF_FMA(h.y, h.y, h.z * h.z)));
    // Made dependent, so that the two quotients are not packed (impl/stretch.h); the other choice is never taken.
    VNDF_REAL n = VNDF_DIVIDE(height, v.axis.weight),
              area = n < VNDF_R(0.0) ? VNDF_R(1.0) : v.alpha_x * v.alpha_y;
    VNDF_REAL density = VNDF_DIVIDE((VNDF_R(67108864.0) * VNDF_1_PI) * (ratio * ratio * length), area);
    VNDF_REAL pdf = vndf_impl_bounded_quotient(density, n);
    o.pdf = height > VNDF_R(0.0) ? vndf_impl_finite(pdf) : VNDF_R(0.0);
    return vndf_impl_where(o2 > VNDF_R(0.0) && o2 <= VNDF_REAL_MAX, o);
}

// What the maps by disks and slopes need of a lobe: the azimuth of v, and of theta its cosine z, its sine, P = 1 + z and Q = 1
// - z, never as differences, and the root of P, which keeps its digits where P underflows.
struct vndf_impl_polar {
    VNDF_REAL x, y, z, sine, p, q, sqrt_p;
};
VNDF_FN struct vndf_impl_polar vndf_impl_polar_of(struct vndf_ggx_lobe v) {
    struct vndf_impl_polar polar;
    // Each root and quotient feeds the next: alike they would be packed (impl/stretch.h).
    VNDF_REAL l = VNDF_SQRT(VNDF_FMA(v.x, v.x, v.y * v.y)), l2 = l * l,
              height2 = v.axis.height * v.axis.height;
    VNDF_REAL rcp = VNDF_DIVIDE(VNDF_R(2.0), l2 + height2), rcp_l = VNDF_DIVIDE(VNDF_R(1.0), l);
    VNDF_REAL level = VNDF_R(2.0) * v.axis.z * v.axis.height, steep = height2 - l2;
    polar.x = v.x * rcp_l;
    polar.y = v.y * rcp_l;
    polar.z = VNDF_R(0.5) * (v.axis.level ? level : steep) * rcp;
    polar.sine = l * v.axis.height * rcp;
    polar.p = height2 * rcp;
    polar.q = l2 * rcp;
    polar.sqrt_p = v.axis.height * VNDF_SQRT(rcp);
    return polar;
}

VNDF_END

#endif
