// The mirror step: reflections about a normal of any length, half vectors, and the density of both.
#ifndef VNDF_IMPL_MIRROR_H
#define VNDF_IMPL_MIRROR_H

#include "exact.h"
#include "stretch.h"

VNDF_BEGIN

// D / (2 n) of a normal whose unstretched form is `ratio` times as long squared, for a normaliser n > 0.
VNDF_FN VNDF_REAL vndf_impl_reflection_density(VNDF_REAL ratio, VNDF_REAL n, VNDF_REAL alpha_x,
                                               VNDF_REAL alpha_y) {
    VNDF_REAL density =
        VNDF_DIVIDE(VNDF_R(0.5) * VNDF_1_PI * ratio, vndf_impl_max(n, VNDF_IMPL_LEAST)) * ratio;
    return vndf_impl_bounded_quotient(density, alpha_x * alpha_y);
}

// The reflection of wo about the unstretched normal g of h, as long as wo, and |g|^2 / |h|^2.
struct vndf_impl_mirror {
    VNDF_REAL x, y, z, ratio;
    int defined;  // h is no zero vector
};
VNDF_FN struct vndf_impl_mirror vndf_impl_mirror_of(VNDF_REAL wo_x, VNDF_REAL wo_y, VNDF_REAL wo_z,
                                                    VNDF_REAL hx, VNDF_REAL hy, VNDF_REAL hz,
                                                    VNDF_REAL alpha_x, VNDF_REAL alpha_y) {
    struct vndf_impl_mirror o;
    // Reflect about the normal g of any length: no rounding of g can tilt the mirror.
    VNDF_REAL gx = alpha_x * hx, gy = alpha_y * hy;
    VNDF_REAL g2 = VNDF_FMA(gx, gx, VNDF_FMA(gy, gy, hz * hz)),
              h2 = VNDF_FMA(hx, hx, VNDF_FMA(hy, hy, hz * hz));
    VNDF_REAL cosine = VNDF_FMA(wo_x, gx, VNDF_FMA(wo_y, gy, wo_z * hz));
    o.defined = g2 > VNDF_R(0.0);
    VNDF_REAL twice = o.defined ? VNDF_DIVIDE(VNDF_R(2.0) * cosine, g2) : VNDF_R(0.0);
    o.ratio = VNDF_DIVIDE(g2, h2);
    o.x = VNDF_FMA(twice, gx, -wo_x);
    o.y = VNDF_FMA(twice, gy, -wo_y);
    o.z = VNDF_FMA(twice, hz, -wo_z);
    return o;
}

// The reflection of wo about a sampled normal, a unit vector, with its density: that of the normal over 4 wo . m.
VNDF_FN struct vndf_impl_sample vndf_impl_mirrored(VNDF_REAL wo_x, VNDF_REAL wo_y, VNDF_REAL wo_z,
                                                   struct vndf_impl_sample m) {
    struct vndf_impl_sample o;
    VNDF_REAL cosine = vndf_impl_max(vndf_impl_dot(wo_x, wo_y, wo_z, m.x, m.y, m.z), VNDF_R(0.0));
    VNDF_REAL twice = cosine + cosine;
    o.x = VNDF_FMA(twice, m.x, -wo_x);
    o.y = VNDF_FMA(twice, m.y, -wo_y);
    o.z = VNDF_FMA(twice, m.z, -wo_z);
    // Only the direction of wo counts: the length that the mirror kept is divided out.
    VNDF_REAL o2 = VNDF_FMA(o.x, o.x, VNDF_FMA(o.y, o.y, o.z * o.z)),
              rcp = VNDF_DIVIDE(VNDF_R(1.0), VNDF_SQRT(o2));
    o.x *= rcp;
    o.y *= rcp;
    o.z *= rcp;
    o.pdf = vndf_impl_finite(vndf_impl_bounded_quotient(VNDF_R(0.25) * m.pdf, cosine));
    return vndf_impl_where(o2 > VNDF_R(0.0) && o2 <= VNDF_REAL_MAX, o);
}

// Half vector h = wo + wi of the vectors as given, times a power of two `scale`; its squared length; q of D.
struct vndf_impl_half {
    VNDF_REAL z, length2, q, scale;
    VNDF_REAL q_slope;  // half the 1-norm of dq/dh, for z > 0
};
VNDF_FN struct vndf_impl_half vndf_impl_half_along(VNDF_REAL x, VNDF_REAL y, VNDF_REAL z, VNDF_REAL alpha_x,
                                                   VNDF_REAL alpha_y) {
    struct vndf_impl_half h;
    VNDF_REAL largest = vndf_impl_max(vndf_impl_max(vndf_impl_abs(x), vndf_impl_abs(y)), vndf_impl_abs(z));
    h.scale = vndf_impl_scale(largest);
    x *= h.scale;
    y *= h.scale;
    h.z = z * h.scale;
    VNDF_REAL rcp_x = VNDF_DIVIDE(VNDF_R(1.0), alpha_x), rcp_y = VNDF_DIVIDE(VNDF_R(1.0), alpha_y);
    // Quotients with little more than one rounding; of two shapes: alike they would be packed (impl/stretch.h).
    VNDF_REAL sx = x * rcp_x, sy = y * rcp_y;
    sx += VNDF_FMA(-sx, alpha_x, x) * rcp_x;
    sy = VNDF_FMA(VNDF_FMA(-sy, alpha_y, y), rcp_y, sy);
    h.length2 = VNDF_FMA(x, x, VNDF_FMA(y, y, h.z * h.z));
    h.q = VNDF_FMA(sx, sx, VNDF_FMA(sy, sy, h.z * h.z));
    h.q_slope = VNDF_FMA(vndf_impl_abs(sx), rcp_x, VNDF_FMA(vndf_impl_abs(sy), rcp_y, h.z));
    return h;
}
VNDF_FN struct vndf_impl_half vndf_impl_half_of(VNDF_REAL3 wo, VNDF_REAL3 wi, VNDF_REAL alpha_x,
                                                VNDF_REAL alpha_y) {
    return vndf_impl_half_along(wo.x + wi.x, wo.y + wi.y, wo.z + wi.z, alpha_x, alpha_y);
}

// D / (2 n) of the half vector, for a normaliser n.
VNDF_FN VNDF_REAL vndf_impl_ggx_reflection_pdf(struct vndf_impl_half h, VNDF_REAL n, VNDF_REAL alpha_x,
                                               VNDF_REAL alpha_y) {
    VNDF_REAL ratio = VNDF_DIVIDE(h.length2, h.q > VNDF_R(0.0) ? h.q : VNDF_R(1.0));
    VNDF_REAL pdf = vndf_impl_reflection_density(ratio, n, alpha_x, alpha_y);
    return h.z > VNDF_R(0.0) && n > VNDF_R(0.0) ? vndf_impl_finite(pdf) : VNDF_R(0.0);
}

VNDF_END

#endif
