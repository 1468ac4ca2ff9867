// Isotropic GGX visible normals in world space, without a tangent frame; and their density.
//
// Source: Benyoub, VNDF Importance Sampling for an Isotropic Smith-GGX Distribution, 2024 (paper wi = wo),
//     with the reference axis sigma = sign(n.z) z in place of its `up`, so that it is an isometry for every
//     n.
#ifndef VNDF_GGX_BENYOUB2024_H
#define VNDF_GGX_BENYOUB2024_H

#include "ggx_world.h"
#include "impl/exact.h"
#include "impl/lobe.h"

VNDF_BEGIN

// Half a turn about w = n + sigma takes sigma to n. Only the unit vector of the cap's azimuth is turned, which gives a vector
// across n; the height is added along n and alpha wo's part across n as it is: nothing is projected on n again.
VNDF_FN struct vndf_impl_sample vndf_impl_ggx_benyoub2024(VNDF_REAL3 wo, VNDF_REAL3 n, VNDF_REAL alpha_scalar,
                                                          VNDF_REAL2 u) {
    VNDF_REAL alpha = vndf_impl_alpha(alpha_scalar);
    // wo's part across n is (n x wo) x n: wo - z n would leave the rounding of |n| along n, where wo is near +-n.
    struct vndf_impl_vector c = vndf_impl_cross(n, wo);
    VNDF_REAL k = alpha * VNDF_R(134217728.0), kx = k * VNDF_FMA(c.y, n.z, -c.z * n.y),
              ky = k * VNDF_FMA(c.z, n.x, -c.x * n.z), kz = k * VNDF_FMA(c.x, n.y, -c.y * n.x);
    VNDF_REAL k2 = VNDF_FMA(kx, kx, VNDF_FMA(ky, ky, kz * kz));
    struct vndf_impl_axis v =
        vndf_impl_axis_of(k2, VNDF_FMA(wo.x, n.x, VNDF_FMA(wo.y, n.y, wo.z * n.z)) * VNDF_R(134217728.0));
    // The azimuth's unit vector, turned; it is wo's where wo has none.
    VNDF_REAL u1 = vndf_impl_u(u.x), u2 = vndf_impl_u(u.y);
    VNDF_REAL cosine = vndf_impl_circle_cos(u1), sine = vndf_impl_circle_sin(u1);
    VNDF_REAL along_w = VNDF_FMA(n.x, cosine, n.y * sine),
              w = VNDF_DIVIDE(along_w, VNDF_R(1.0) + vndf_impl_abs(n.z));
    VNDF_REAL ex = VNDF_FMA(w, n.x, -cosine), ey = VNDF_FMA(w, n.y, -sine),
              ez = n.z < VNDF_R(0.0) ? -along_w : along_w;
    VNDF_REAL least = k2 > VNDF_R(0.0) ? VNDF_R(0.0) : vndf_impl_no_length(v.z);
    VNDF_REAL vx = v.weight * VNDF_FMA(least, ex, kx), vy = v.weight * VNDF_FMA(least, ey, ky),
              vz = v.weight * VNDF_FMA(least, ez, kz);
    VNDF_REAL l2 = VNDF_FMA(vx, vx, VNDF_FMA(vy, vy, vz * vz)), rest = VNDF_R(1.0) - u2;
    VNDF_REAL z = rest * v.height, height2 = v.height * v.height, square = u2 * VNDF_FMA(rest, height2, l2);
    VNDF_REAL steep = rest * VNDF_FMA(u2, height2, -l2),
              excess = v.level ? z * VNDF_FMA(VNDF_R(2.0), v.z, -z) : steep;
    VNDF_REAL radius = VNDF_SQRT(square);
    ex *= radius;
    ey *= radius;
    ez *= radius;
    VNDF_REAL hx = ex + vx, hy = ey + vy, hz = ez + vz;
    // The two parts are across n to their own rounding, which is much to a sum that nearly vanishes.
    VNDF_REAL lean = VNDF_FMA(hx, n.x, VNDF_FMA(hy, n.y, hz * n.z));
    hx = VNDF_FMA(-lean, n.x, hx);
    hy = VNDF_FMA(-lean, n.y, hy);
    hz = VNDF_FMA(-lean, n.z, hz);
    // What is left across n is mended as in vndf_impl_cap_sum, twice: of a sum that nearly vanishes the first step leaves its
    // own rounding, enough to turn it away from wo.
    VNDF_REAL dx = ex - vx, dy = ey - vy, dz = ez - vz, scale = VNDF_DIVIDE(VNDF_R(1.0), square + l2);
    VNDF_REAL error = VNDF_FMA(dx, hx, VNDF_FMA(dy, hy, VNDF_FMA(dz, hz, -excess))) * scale;
    hx = VNDF_FMA(-error, ex, hx);
    hy = VNDF_FMA(-error, ey, hy);
    hz = VNDF_FMA(-error, ez, hz);
    error = VNDF_FMA(dx, hx, VNDF_FMA(dy, hy, VNDF_FMA(dz, hz, -excess))) * scale;
    hx = VNDF_FMA(-error, ex, hx);
    hy = VNDF_FMA(-error, ey, hy);
    hz = VNDF_FMA(-error, ez, hz);
    VNDF_REAL gx = VNDF_FMA(z, n.x, alpha * hx), gy = VNDF_FMA(z, n.y, alpha * hy),
              gz = VNDF_FMA(z, n.z, alpha * hz);
    VNDF_REAL length2 = VNDF_FMA(gx, gx, VNDF_FMA(gy, gy, gz * gz));
    VNDF_REAL length = VNDF_SQRT(length2), rcp = VNDF_DIVIDE(VNDF_R(1.0), length);
    int defined = length2 > VNDF_R(0.0) && length2 <= VNDF_REAL_MAX;
    struct vndf_impl_sample m;
    m.x = defined ? gx * rcp : n.x;
    m.y = defined ? gy * rcp : n.y;
    m.z = defined ? gz * rcp : n.z;
    VNDF_REAL h2 = VNDF_FMA(hx, hx, VNDF_FMA(hy, hy, VNDF_FMA(hz, hz, z * z))),
              ratio = VNDF_DIVIDE(length2, h2);
    VNDF_REAL pdf = VNDF_DIVIDE(VNDF_1_PI * (ratio * length), v.height * (alpha * alpha));
    m.pdf = defined && v.height > VNDF_R(0.0) ? vndf_impl_finite(pdf) : VNDF_R(0.0);
    return m;
}

// A visible normal about n, in the frame that wo and n are given in.
// wo: unit vector, any orientation. At wo = -n, where nothing is visible: a unit
//     vector with density 0.
// n: unit macroscopic normal, any, n = -z included.
// alpha: scalar, in [1e-8, 1e3].
// u: u.x the azimuth of the cap, u.y its height.
//     The azimuth jumps where n.z changes sign.
// return: unit vector wm with wm . n >= 0 to rounding, density vndf_ggx_pdf_wm_benyoub2024(wo, n, wm, alpha).
// Accuracy: angle to the exact map, 99th percentile: 0.75 eps (1 + condition number), 0.75 behind the surface; double 0.75, 0.75.
//     wo . n carries the rounding of both vectors: the condition number is about 1 / sqrt((wo . n)^2 +
//     alpha^2).
VNDF_FN VNDF_REAL3 vndf_ggx_sample_wm_benyoub2024(VNDF_REAL3 wo, VNDF_REAL3 n, VNDF_REAL alpha,
                                                  VNDF_REAL2 u) {
    return vndf_impl_direction(vndf_impl_ggx_benyoub2024(wo, n, alpha, u));
}

// The same; w: its density per steradian of wm, from the sampler's own terms.
VNDF_FN VNDF_REAL4 vndf_ggx_sample_wm_benyoub2024_with_pdf(VNDF_REAL3 wo, VNDF_REAL3 n, VNDF_REAL alpha,
                                                           VNDF_REAL2 u) {
    return vndf_impl_direction_pdf(vndf_impl_ggx_benyoub2024(wo, n, alpha, u));
}

// The distribution of visible normals about n.
// Source: Dupuy & Benyoub 2023, Equation 1, for alpha_x = alpha_y in the frame of n, whose z components are
//     dot products with n and whose tangential lengths are those of cross products with n.
// wo, n: unit vectors as above.
// wm: unit normal.
// return: per steradian of wm; 0 for wm . n <= 0 or wo . wm <= 0.
// Accuracy: 4 eps (1 + condition number); double 86.
VNDF_FN VNDF_REAL vndf_ggx_pdf_wm_benyoub2024(VNDF_REAL3 wo, VNDF_REAL3 n, VNDF_REAL3 wm, VNDF_REAL alpha) {
    return vndf_ggx_pdf_wm_world(wo, n, wm, alpha);
}

VNDF_END

#endif
