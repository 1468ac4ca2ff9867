// GGX visible normals by half disks.
//
// Source: Heitz, A Simpler and Exact Sampling Routine for the GGX Distribution of Visible Normals, 2017 (V =
//     wo), with the conditional of P2 in parentheses, T2 = T1 x V and no threshold on V.z.
#ifndef VNDF_GGX_HEITZ2017_H
#define VNDF_GGX_HEITZ2017_H

#include "ggx.h"
#include "impl/lobe.h"

VNDF_BEGIN

// P = 1 + V.z. The half disk that faces the viewer has probability 1 / P and angle pi u2 P; the tangent one
// is entered from its far end, at the angle pi (1 - u2) P / V.z, so that neither forms u2 - 1 / P. Its height
// V.z (sqrt(1 - u1 + b^2 S^2) - b S) is V.z (1 - u1) over the sum.
VNDF_FN struct vndf_impl_sample vndf_impl_ggx_heitz2017(struct vndf_ggx_lobe v, VNDF_REAL2 u) {
    VNDF_REAL u1 = vndf_impl_u(u.x), u2 = vndf_impl_u(u.y), rest = VNDF_R(1.0) - u1;
    // Below the surface, and where |wo| has left the range of numbers, they are not used, and only bounded.
    VNDF_REAL l = VNDF_SQRT(VNDF_FMA(v.x, v.x, v.y * v.y)), rcp_t = VNDF_DIVIDE(VNDF_R(1.0), v.axis.t),
              rcp_l = VNDF_DIVIDE(VNDF_R(1.0), l);
    VNDF_REAL z = vndf_impl_share(vndf_impl_abs(v.axis.z) * rcp_t), sine = vndf_impl_share(l * rcp_t),
              p = VNDF_R(1.0) + z;
    int facing = u2 * p < VNDF_R(1.0);
    // Half a turn at most: where z is lost in P = 1 + z the quotient may be any number. z = 0 has no tangent disk, and its
    // quotient is not used.
    VNDF_REAL turn = facing ? VNDF_R(0.5) * u2 * p : VNDF_DIVIDE(VNDF_R(0.5) * (VNDF_R(1.0) - u2) * p, z);
    turn = turn < VNDF_R(0.5) ? turn : VNDF_R(0.5);
    VNDF_REAL radius = VNDF_SQRT(u1), p1 = radius * vndf_impl_circle_cos(turn);
    VNDF_REAL b = radius * vndf_impl_circle_sin(turn), bs = b * sine;
    VNDF_REAL depth = VNDF_SQRT(facing ? rest : VNDF_FMA(bs, bs, rest));
    VNDF_REAL hz = facing ? VNDF_FMA(depth, z, bs) : VNDF_DIVIDE(z * rest, depth + bs);
    VNDF_REAL p2 = facing ? b : -b * z;
    VNDF_REAL along = VNDF_FMA(depth, sine, -p2 * z);
    // T1 = (1, 0, 0) where the stretched view direction has no azimuth.
    int vertical = v.wo_x == VNDF_R(0.0) && v.wo_y == VNDF_R(0.0);
    VNDF_REAL ex = vertical ? VNDF_R(0.0) : v.x * rcp_l, ey = vertical ? VNDF_R(1.0) : v.y * rcp_l;
    struct vndf_impl_sample m =
        vndf_impl_ggx_unstretch(VNDF_FMA(along, ex, p1 * ey), VNDF_FMA(along, ey, -p1 * ex), hz, v.alpha_x,
                                v.alpha_y, VNDF_DIVIDE(VNDF_R(2.0) * depth, p));
    return vndf_impl_where(v.wo_z >= VNDF_R(0.0), m);
}

// A visible normal by half disks.
// wo: unit vector, local frame, wo.z >= 0. The method is not defined below the
//     horizon: (0, 0, 1) with density 0.
// alpha: in [1e-8, 1e3] each.
// u: u.x the squared radius, u.y the angle and with it the half disk.
// return: unit vector wm, wm.z >= 0, with density vndf_ggx_pdf_wm(wo, wm, alpha).
// Accuracy: angle to the exact map, 99th percentile: 1 eps (1 + condition number); double 1.
VNDF_FN VNDF_REAL3 vndf_ggx_sample_wm_heitz2017(VNDF_REAL3 wo, VNDF_REAL2 alpha, VNDF_REAL2 u) {
    return vndf_impl_direction(vndf_impl_ggx_heitz2017(vndf_ggx_lobe_of(wo, alpha), u));
}

// The same; w: its density per steradian of wm, from the sampler's own terms.
VNDF_FN VNDF_REAL4 vndf_ggx_sample_wm_heitz2017_with_pdf(VNDF_REAL3 wo, VNDF_REAL2 alpha, VNDF_REAL2 u) {
    return vndf_impl_direction_pdf(vndf_impl_ggx_heitz2017(vndf_ggx_lobe_of(wo, alpha), u));
}

// The same for many u and one wo and alpha.
// Accuracy: angle to the exact map, 99th percentile: 1 eps (1 + condition number); double 1.
VNDF_FN VNDF_REAL3 vndf_ggx_sample_wm_heitz2017_lobe(struct vndf_ggx_lobe lobe, VNDF_REAL2 u) {
    return vndf_impl_direction(vndf_impl_ggx_heitz2017(lobe, u));
}

// The same; w: its density, from the sampler's own terms.
VNDF_FN VNDF_REAL4 vndf_ggx_sample_wm_heitz2017_lobe_with_pdf(struct vndf_ggx_lobe lobe, VNDF_REAL2 u) {
    return vndf_impl_direction_pdf(vndf_impl_ggx_heitz2017(lobe, u));
}

VNDF_END

#endif
