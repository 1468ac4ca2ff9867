// Exhaustion: a sampler's results for every u, judged where they are computed. vndf_exhaustive_<name> for each
// registered sampler counts the results that break what every result promises; nothing else leaves the device.
//
// Arguments: the lobe, one number for each of the sampler's scalars in the registry's order, u1 and u2 as the
// origins of the walk u_j = origin_j + 2^-24 ((step_j k + start_j) mod 2^24), whose indices k an item takes `strip`
// at once; `defined`, 0 where the sampler has no distribution at this lobe, and `documented`, 1 where it then returns
// the normal; `watch`, a bit for each invariant whose offenders compete for the first; tally: for each invariant the
// number of offenders, then the first offender's index. The host sets it to 0 and ~0. Invariants, in order:
//
//   finite   all four numbers, by their bits: fast math would fold a comparison
//   unit     the length of the direction within the registry's bound
//   upper    wm.z >= 0; about a normal n, wm . n no further below 0 than the bound; for a reflection the half vector's height
//   faces    wm . wo likewise; a reflection lies in its cap; the normal where that is documented
//   density  positive, and 0 where there is no distribution
//
// The strip is a loop inside an item: it has no memory access, so that CPU devices turn it into vector code.
#include "../vndf/vndf.h"
#include "shapes.h"

#pragma OPENCL FP_CONTRACT OFF

VNDF_FN int vndf_exhaustive_finite(VNDF_REAL x) {
    return (VNDF_AS_INT(x) & 0x7f800000) != 0x7f800000;
}

VNDF_FN VNDF_REAL vndf_exhaustive_walk(VNDF_REAL origin, uint step, uint start, uint k) {
    return VNDF_FMA((VNDF_REAL)(int)((step * k + start) & 0xffffff), VNDF_EPSILON, origin);
}

// | |d|^2 - 1 | <= 2 slack: exact to eps.
VNDF_FN int vndf_exhaustive_unit(VNDF_REAL4 d, VNDF_REAL slack) {
    VNDF_REAL excess = VNDF_FMA(d.z, d.z, VNDF_FMA(d.y, d.y, VNDF_FMA(d.x, d.x, VNDF_R(-1.0))));
    return vndf_impl_abs(excess) <= VNDF_R(2.0) * slack;
}

// Whether wi lies in the cap of Eto & Tokuyoshi 2023, wherever rounding may have moved it: the stretched reflection's
// height h2 h.z / (q r) - wo.z / r is at least -k wo.z / r, where h = wo + wi, q = |h stretched|^2, r = |wo stretched|.
// What is rounded to eps, apart from wi itself, is the sampler's half vector in the stretched frame, whose length is
// h2 / (r sqrt(q)): that moves wi by alpha r q / h2 eps.
VNDF_FN int vndf_exhaustive_in_cap(VNDF_REAL3 wo, VNDF_REAL2 alpha, VNDF_REAL4 wi, VNDF_REAL rest) {
    VNDF_REAL ax = vndf_impl_alpha(alpha.x), ay = vndf_impl_alpha_y(alpha.y);
    VNDF_REAL rx = VNDF_R(1.0) / ax, ry = VNDF_R(1.0) / ay;
    VNDF_REAL r = VNDF_SQRT(ax * wo.x * ax * wo.x + ay * wo.y * ay * wo.y + wo.z * wo.z);
    VNDF_REAL z = vndf_impl_max(wo.z, VNDF_R(0.0));
    VNDF_REAL hx = wo.x + wi.x, hy = wo.y + wi.y, hz = wo.z + wi.z;
    VNDF_REAL h2 = vndf_impl_max(hx * hx + hy * hy + hz * hz, VNDF_EPSILON * VNDF_EPSILON);
    VNDF_REAL sx = hx * rx, sy = hy * ry, q = sx * sx + sy * sy + hz * hz;
    VNDF_REAL move = VNDF_R(4.0) * VNDF_EPSILON * (VNDF_R(1.0) + vndf_impl_max(ax, ay) * r * q / h2);
    VNDF_REAL sum = vndf_impl_abs(hx) + vndf_impl_abs(hy) + vndf_impl_abs(hz) + move;
    VNDF_REAL turn = VNDF_R(2.0) * (vndf_impl_abs(sx) * rx + vndf_impl_abs(sy) * ry + vndf_impl_abs(hz)) +
                     move * (rx * rx + ry * ry + VNDF_R(1.0));
    VNDF_REAL slack = move * (h2 + VNDF_R(2.0) * sum * (vndf_impl_abs(hz) + move) + rest * z * turn);
    return h2 * hz - rest * z * q >= -slack;
}

// 1 - k of Equation 6, and of the polygon bound: the least ratio of its vertices.
VNDF_FN VNDF_REAL vndf_exhaustive_eto2023(VNDF_REAL3 wo, VNDF_REAL2 alpha) {
    VNDF_REAL low = vndf_impl_min(vndf_impl_alpha(alpha.x), vndf_impl_alpha_y(alpha.y));
    VNDF_REAL a = vndf_impl_min(low, VNDF_R(1.0)), z = vndf_impl_max(wo.z, VNDF_R(0.0));
    VNDF_REAL s = VNDF_R(1.0) + VNDF_SQRT(wo.x * wo.x + wo.y * wo.y);
    return a * a * (s * s + z * z) / (s * s + a * a * z * z);
}
VNDF_FN VNDF_REAL vndf_exhaustive_ratio(VNDF_REAL low, VNDF_REAL high, VNDF_REAL x, VNDF_REAL y,
                                        VNDF_REAL z2) {
    VNDF_REAL slant = low / high;
    return low * low * (x + y + z2) / (slant * x * slant + y + low * z2 * low);
}
VNDF_FN VNDF_REAL vndf_exhaustive_polygon(VNDF_REAL3 wo, VNDF_REAL2 alpha) {
    VNDF_REAL ax = vndf_impl_alpha(alpha.x), ay = vndf_impl_alpha_y(alpha.y);
    VNDF_REAL low = vndf_impl_min(ax, ay), high = vndf_impl_max(ax, ay);
    VNDF_REAL along = VNDF_R(1.0) + vndf_impl_abs(ax < ay ? wo.x : wo.y);
    VNDF_REAL sine = VNDF_SQRT(wo.x * wo.x + wo.y * wo.y), s = VNDF_R(1.0) + sine, z2 = wo.z * wo.z;
    VNDF_REAL less = z2 / s, side = along * along;
    VNDF_REAL first = vndf_exhaustive_ratio(low, high, VNDF_R(0.0), side, z2);
    VNDF_REAL second = vndf_exhaustive_ratio(low, high, vndf_impl_max(s * s - side, VNDF_R(0.0)), side, z2);
    VNDF_REAL third = vndf_exhaustive_ratio(low, high, VNDF_R(0.0), less * less, z2);
    return vndf_impl_min(vndf_impl_min(first, second), third);
}

// Whether wi lies in the cap about l, wherever rounding may have moved it: by the chord between the directions.
VNDF_FN int vndf_exhaustive_in_light(VNDF_REAL3 l, VNDF_REAL one_minus_cos, VNDF_REAL4 wi) {
    VNDF_REAL rcp_l = VNDF_R(1.0) / VNDF_SQRT(l.x * l.x + l.y * l.y + l.z * l.z);
    VNDF_REAL rcp_wi = VNDF_R(1.0) / VNDF_SQRT(wi.x * wi.x + wi.y * wi.y + wi.z * wi.z);
    VNDF_REAL x = wi.x * rcp_wi - l.x * rcp_l, y = wi.y * rcp_wi - l.y * rcp_l,
              z = wi.z * rcp_wi - l.z * rcp_l;
    return VNDF_SQRT(x * x + y * y + z * z) <=
           VNDF_SQRT(VNDF_R(2.0) * one_minus_cos) + VNDF_R(32.0) * VNDF_EPSILON;
}

// Whether a reflection lies where its density is positive: in its cap, or above the horizon.
#define VNDF_EXHAUSTIVE_INSIDE_vndf_ggx_pdf_wi_eto2023(wo, alpha, d) \
    vndf_exhaustive_in_cap(wo, alpha, d, vndf_exhaustive_eto2023(wo, alpha))
#define VNDF_EXHAUSTIVE_INSIDE_vndf_ggx_pdf_wi_eto2023_polygon(wo, alpha, d) \
    vndf_exhaustive_in_cap(wo, alpha, d, vndf_exhaustive_polygon(wo, alpha))
#define VNDF_EXHAUSTIVE_INSIDE_vndf_ggx_pdf_wi_conic2026(wo, alpha, d) \
    (wo.z > VNDF_R(0.0) ? d.z > VNDF_R(0.0)                            \
                        : vndf_exhaustive_in_cap(wo, alpha, d, vndf_exhaustive_eto2023(wo, alpha)))
#define VNDF_EXHAUSTIVE_INSIDE_vndf_ggx_pdf_wm(wo, alpha, d) 1
#define VNDF_EXHAUSTIVE_INSIDE_vndf_ggx_pdf_wm_benyoub2024(wo, alpha, d) 1
#define VNDF_EXHAUSTIVE_INSIDE_vndf_ggx_pdf_wm_walter2007(wo, alpha, d) 1
#define VNDF_EXHAUSTIVE_INSIDE_vndf_beckmann_pdf_wm(wo, alpha, d) 1
#define VNDF_EXHAUSTIVE_INSIDE_vndf_beckmann_pdf_wm_walter2007(wo, alpha, d) 1

// The invariants `upper` and `faces` by the kind of result and of arguments. A plain distribution of normals has no wo.
#define VNDF_EXHAUSTIVE_DOT(d, v) vndf_impl_dot(d.x, d.y, d.z, v##_x, v##_y, v##_z)
#define VNDF_EXHAUSTIVE_SLACK (-VNDF_BOUND_SIDE * VNDF_EPSILON)
#define VNDF_EXHAUSTIVE_UNIT_WM(d) vndf_exhaustive_unit(d, VNDF_BOUND_LENGTH_WM* VNDF_EPSILON)
#define VNDF_EXHAUSTIVE_UNIT_WI(d) vndf_exhaustive_unit(d, VNDF_BOUND_LENGTH_WI* VNDF_EPSILON)
#define VNDF_EXHAUSTIVE_UPPER_WM_WO_ALPHA_U(d) (d.z >= VNDF_R(0.0))
#define VNDF_EXHAUSTIVE_UPPER_WM_LOBE_U(d) VNDF_EXHAUSTIVE_UPPER_WM_WO_ALPHA_U(d)
#define VNDF_EXHAUSTIVE_UPPER_WM_BECKMANN_LOBE_U(d) VNDF_EXHAUSTIVE_UPPER_WM_WO_ALPHA_U(d)
#define VNDF_EXHAUSTIVE_UPPER_WM_ALPHA_U(d) (d.z >= VNDF_R(0.0))
#define VNDF_EXHAUSTIVE_UPPER_WM_WO_N_ALPHA1_U(d) (VNDF_EXHAUSTIVE_DOT(d, n) >= VNDF_EXHAUSTIVE_SLACK)
#define VNDF_EXHAUSTIVE_UPPER_WI_WO_ALPHA_U(d) (wo_z + d.z >= VNDF_EXHAUSTIVE_SLACK)
#define VNDF_EXHAUSTIVE_UPPER_WI_LOBE_U(d) VNDF_EXHAUSTIVE_UPPER_WI_WO_ALPHA_U(d)
#define VNDF_EXHAUSTIVE_UPPER_WI_CONIC2026_LOBE_U(d) VNDF_EXHAUSTIVE_UPPER_WI_WO_ALPHA_U(d)
#define VNDF_EXHAUSTIVE_UPPER_WI_WO_CAP_ALPHA_U(d) VNDF_EXHAUSTIVE_UPPER_WI_WO_ALPHA_U(d)
#define VNDF_EXHAUSTIVE_UPPER_WI_CONE2026_LOBE_U(d) VNDF_EXHAUSTIVE_UPPER_WI_WO_ALPHA_U(d)
#define VNDF_EXHAUSTIVE_UPPER_WI_WO_ALPHA1_U(d) (wo_z + d.z >= VNDF_EXHAUSTIVE_SLACK)
#define VNDF_EXHAUSTIVE_FACES_WM_WO_ALPHA_U(d, inside) (VNDF_EXHAUSTIVE_DOT(d, wo) >= VNDF_EXHAUSTIVE_SLACK)
#define VNDF_EXHAUSTIVE_FACES_WM_LOBE_U(d, inside) VNDF_EXHAUSTIVE_FACES_WM_WO_ALPHA_U(d, inside)
#define VNDF_EXHAUSTIVE_FACES_WM_BECKMANN_LOBE_U(d, inside) VNDF_EXHAUSTIVE_FACES_WM_WO_ALPHA_U(d, inside)
#define VNDF_EXHAUSTIVE_FACES_WM_ALPHA_U(d, inside) 1
#define VNDF_EXHAUSTIVE_FACES_WM_WO_N_ALPHA1_U(d, inside) \
    (VNDF_EXHAUSTIVE_DOT(d, wo) >= VNDF_EXHAUSTIVE_SLACK)
#define VNDF_EXHAUSTIVE_FACES_WI_WO_ALPHA_U(d, inside) \
    inside(VNDF_MAKE3(wo_x, wo_y, wo_z), VNDF_MAKE2(alpha_x, alpha_y), d)
#define VNDF_EXHAUSTIVE_FACES_WI_LOBE_U(d, inside) VNDF_EXHAUSTIVE_FACES_WI_WO_ALPHA_U(d, inside)
#define VNDF_EXHAUSTIVE_FACES_WI_CONIC2026_LOBE_U(d, inside) VNDF_EXHAUSTIVE_FACES_WI_WO_ALPHA_U(d, inside)
#define VNDF_EXHAUSTIVE_FACES_WI_WO_CAP_ALPHA_U(d, inside) \
    vndf_exhaustive_in_light(VNDF_MAKE3(l_x, l_y, l_z), one_minus_cos, d)
#define VNDF_EXHAUSTIVE_FACES_WI_CONE2026_LOBE_U(d, inside) VNDF_EXHAUSTIVE_FACES_WI_WO_CAP_ALPHA_U(d, inside)
#define VNDF_EXHAUSTIVE_UPPER_WI_WO_NG_ALPHA_U(d) VNDF_EXHAUSTIVE_UPPER_WI_WO_ALPHA_U(d)
#define VNDF_EXHAUSTIVE_UPPER_WI_TILTED2026_LOBE_U(d) VNDF_EXHAUSTIVE_UPPER_WI_WO_ALPHA_U(d)
#define VNDF_EXHAUSTIVE_FACES_WI_WO_NG_ALPHA_U(d, inside) \
    ((d.z > VNDF_R(0.0)) & (VNDF_EXHAUSTIVE_DOT(d, ng) >= VNDF_EXHAUSTIVE_SLACK))
#define VNDF_EXHAUSTIVE_FACES_WI_TILTED2026_LOBE_U(d, inside) \
    VNDF_EXHAUSTIVE_FACES_WI_WO_NG_ALPHA_U(d, inside)
#define VNDF_EXHAUSTIVE_FACES_WI_WO_ALPHA1_U(d, inside) \
    inside(VNDF_MAKE3(wo_x, wo_y, wo_z), VNDF_MAKE2(alpha, alpha), d)

// Whether a sample may be lost, and is: a zero vector with density 0, of which nothing else is asked.
#define VNDF_EXHAUSTIVE_LOST_WO_ALPHA_U(d) 0
#define VNDF_EXHAUSTIVE_LOST_LOBE_U(d) 0
#define VNDF_EXHAUSTIVE_LOST_BECKMANN_LOBE_U(d) 0
#define VNDF_EXHAUSTIVE_LOST_ALPHA_U(d) 0
#define VNDF_EXHAUSTIVE_LOST_WO_N_ALPHA1_U(d) 0
#define VNDF_EXHAUSTIVE_LOST_WO_ALPHA1_U(d) 0
#define VNDF_EXHAUSTIVE_LOST_CONIC2026_LOBE_U(d) 0
#define VNDF_EXHAUSTIVE_LOST_WO_CAP_ALPHA_U(d) 0
#define VNDF_EXHAUSTIVE_LOST_CONE2026_LOBE_U(d) 0
#define VNDF_EXHAUSTIVE_LOST_WO_NG_ALPHA_U(d) \
    ((d.x == VNDF_R(0.0)) & (d.y == VNDF_R(0.0)) & (d.z == VNDF_R(0.0)) & (d.w == VNDF_R(0.0)))
#define VNDF_EXHAUSTIVE_LOST_TILTED2026_LOBE_U(d) VNDF_EXHAUSTIVE_LOST_WO_NG_ALPHA_U(d)

#define VNDF_EXHAUSTIVE_ARGUMENT(v) const VNDF_REAL lobe_##v,
#define VNDF_EXHAUSTIVE_BIND(v) VNDF_REAL v = lobe_##v;

#define VNDF_EXHAUSTIVE(name, function, arguments, result, inside)                                          \
    __kernel void name(VNDF_SCALARS_##arguments(VNDF_EXHAUSTIVE_ARGUMENT) const uint step1,                 \
                       const uint start1, const uint step2, const uint start2, const uint strip,            \
                       const uint defined, const uint documented, const uint watch, __global uint* tally) { \
        VNDF_SCALARS_##arguments(VNDF_EXHAUSTIVE_BIND);                                                     \
        const uint from = (uint)get_global_id(0) * strip;                                                   \
        uint not_finite = 0, not_unit = 0, not_upper = 0, not_facing = 0, not_density = 0, first = ~0u;     \
        for (uint k = from; k != from + strip; ++k) {                                                       \
            u1 = vndf_exhaustive_walk(lobe_u1, step1, start1, k);                                           \
            u2 = vndf_exhaustive_walk(lobe_u2, step2, start2, k);                                           \
            const VNDF_REAL4 d = function(VNDF_CALL_##arguments);                                           \
            const int finite = vndf_exhaustive_finite(d.x) & vndf_exhaustive_finite(d.y) &                  \
                               vndf_exhaustive_finite(d.z) & vndf_exhaustive_finite(d.w);                   \
            const int lost = VNDF_EXHAUSTIVE_LOST_##arguments(d);                                           \
            const int unit = VNDF_EXHAUSTIVE_UNIT_##result(d) | lost;                                       \
            const int upper = VNDF_EXHAUSTIVE_UPPER_##result##_##arguments(d) | lost;                       \
            const int normal = (d.x == VNDF_R(0.0)) & (d.y == VNDF_R(0.0)) & (d.z == VNDF_R(1.0));          \
            const int faces = defined ? VNDF_EXHAUSTIVE_FACES_##result##_##arguments(d, inside) | lost      \
                                      : normal | !documented;                                               \
            const int density = defined ? (d.w > VNDF_R(0.0)) | lost : d.w == VNDF_R(0.0);                  \
            not_finite += !finite;                                                                          \
            not_unit += !unit;                                                                              \
            not_upper += !upper;                                                                            \
            not_facing += !faces;                                                                           \
            not_density += !density;                                                                        \
            const uint broken =                                                                             \
                (finite ? 0 : 1) | (unit ? 0 : 2) | (upper ? 0 : 4) | (faces ? 0 : 8) | (density ? 0 : 16); \
            const uint offender = broken & watch ? k : ~0u;                                                 \
            first = offender < first ? offender : first;                                                    \
        }                                                                                                   \
        if (not_finite + not_unit + not_upper + not_facing + not_density) {                                 \
            atomic_add(&tally[0], not_finite);                                                              \
            atomic_add(&tally[1], not_unit);                                                                \
            atomic_add(&tally[2], not_upper);                                                               \
            atomic_add(&tally[3], not_facing);                                                              \
            atomic_add(&tally[4], not_density);                                                             \
            atomic_min(&tally[5], first);                                                                   \
        }                                                                                                   \
    }

#define VNDF_SAMPLER(name, ndf, arguments, result, density, method, domain, float_bounds, double_bounds, \
                     source)                                                                             \
    VNDF_EXHAUSTIVE(vndf_exhaustive_##name, name##_with_pdf, arguments, result,                          \
                    VNDF_EXHAUSTIVE_INSIDE_##density)
#include "../registry.def"
