// A Beckmann lobe: one view direction and one roughness, stretched once for all that is asked of them.
//
// Symbols: those of beckmann_slopes.h; l = |(alpha_x wo.x, alpha_y wo.y)|. sigma is wo.z + l h in front and l A e^(-a^2)
// behind the surface.
#ifndef VNDF_IMPL_BECKMANN_LOBE_H
#define VNDF_IMPL_BECKMANN_LOBE_H

#include "beckmann_slopes.h"
#include "world.h"

VNDF_BEGIN

// What all samples, densities and terms of a lobe share. Made by vndf_beckmann_lobe_of, used by the functions with _lobe in
// their names; its members are internals.
struct vndf_beckmann_lobe {
    VNDF_REAL wo_x, wo_y, wo_z;
    VNDF_REAL alpha_x, alpha_y, rcp_x, rcp_y;  // clamped, and 1 over them
    VNDF_REAL ex, ey;                          // the azimuth of the stretched wo, (1, 0) if it has none
    VNDF_REAL l;
    VNDF_REAL beyond;              // |a| over what the slopes limit it to, at least 1
    struct vndf_impl_pair square;  // a^2, in twice the precision
    int sees;                      // anything: not so at wo = -z
    struct vndf_impl_incidence_slopes slopes;
};

// a^2 = (z / l)^2 as a sum of two numbers: x = ax wo.x and y = ay wo.y are rounded, and so are the squares.
VNDF_FN struct vndf_impl_pair vndf_impl_beckmann_square(VNDF_REAL3 wo, VNDF_REAL alpha_x, VNDF_REAL alpha_y) {
    struct vndf_impl_pair square;
    VNDF_REAL up = VNDF_R(134217728.0), ax = alpha_x * up, ay = alpha_y * up, z = wo.z * up;
    VNDF_REAL x = ax * wo.x, y = ay * wo.y, x2 = x * x, y2 = y * y, z2 = z * z;
    // At least 2^-70 (double: 2^-518), against infinity: beyond lies a view that sees nothing.
    VNDF_REAL l2 = vndf_impl_max(x2 + y2, VNDF_R(0.015625) * VNDF_IMPL_ROOT_LEAST), a2 = VNDF_DIVIDE(z2, l2);
    VNDF_REAL cross = VNDF_FMA(x, VNDF_FMA(ax, wo.x, -x), y * VNDF_FMA(ay, wo.y, -y));
    VNDF_REAL squares = VNDF_FMA(x, x, -x2) + (VNDF_FMA(y, y, -y2) + vndf_impl_sum_error(x2, y2, l2));
    VNDF_REAL l2_low = VNDF_FMA(VNDF_R(2.0), cross, squares);
    square.head = a2;
    square.tail = VNDF_DIVIDE((VNDF_FMA(-a2, l2, z2) + (VNDF_FMA(z, z, -z2) - a2 * l2_low)), l2);
    return square;
}

// Squares are formed 2^40 times larger: they keep full precision down to wo.x = 1e-19 for every alpha in the domain. l
// carries the rounding errors of its products and of the root along, since a product of two G1 has no units to spare.
VNDF_FN struct vndf_beckmann_lobe vndf_impl_beckmann_lobe_of(VNDF_REAL3 wo, VNDF_REAL alpha_x,
                                                             VNDF_REAL alpha_y) {
    struct vndf_beckmann_lobe lobe;
    lobe.wo_x = wo.x;
    lobe.wo_y = wo.y;
    lobe.wo_z = wo.z;
    lobe.alpha_x = alpha_x;
    lobe.alpha_y = alpha_y;
    lobe.rcp_x = VNDF_DIVIDE(VNDF_R(1.0), alpha_x);
    // Made dependent, so that the two quotients are not packed (impl/stretch.h); the other choice is never taken.
    lobe.rcp_y = VNDF_DIVIDE(lobe.rcp_x > VNDF_R(0.0) ? VNDF_R(1.0) : VNDF_R(0.0), alpha_y);
    VNDF_REAL up = VNDF_R(1099511627776.0), least = VNDF_R(1e6) * VNDF_IMPL_ROOT_LEAST * VNDF_IMPL_ROOT_LEAST;
    VNDF_REAL ax = alpha_x * up, ay = alpha_y * up;
    VNDF_REAL x = ax * wo.x, y = ay * wo.y, square = VNDF_FMA(x, x, y * y);
    // Beyond, the length of wo has left the range of numbers.
    int tilted = square > least && square <= VNDF_REAL_MAX;
    VNDF_REAL root = VNDF_SQRT(tilted ? square : least), rcp = VNDF_DIVIDE(VNDF_R(1.0), root);
    lobe.ex = tilted ? x * rcp : VNDF_R(1.0);
    lobe.ey = tilted ? y * rcp : VNDF_R(0.0);
    VNDF_REAL low = VNDF_FMA(x, VNDF_FMA(ax, wo.x, -x), y * VNDF_FMA(ay, wo.y, -y));
    low = VNDF_FMA(VNDF_R(0.5), VNDF_FMA(-root, root, square), low);
    lobe.l = tilted ? VNDF_FMA(low, rcp, root) * VNDF_R(9.094947017729282379e-13) : VNDF_R(0.0);
    lobe.sees = tilted || wo.z >= VNDF_R(0.0);
    VNDF_REAL height = vndf_impl_abs(wo.z) * up, steep = vndf_impl_min(height * rcp, VNDF_IMPL_STEEP_LIMIT);
    lobe.beyond = vndf_impl_max(steep * VNDF_DIVIDE(VNDF_R(1.0), VNDF_IMPL_COT_LIMIT), VNDF_R(1.0));
    lobe.square = vndf_impl_beckmann_square(wo, alpha_x, alpha_y);
    lobe.slopes = vndf_impl_beckmann_incidence(steep, height, root, wo.z >= VNDF_R(0.0));
    return lobe;
}

// --- Samples ---

// The normal of a slope in the plane of incidence and of one of y across it, with its visible density.
VNDF_FN struct vndf_impl_sample vndf_impl_beckmann_normal(struct vndf_beckmann_lobe lobe,
                                                          struct vndf_impl_visible_slope r,
                                                          VNDF_REAL across) {
    struct vndf_impl_incidence_slopes i = lobe.slopes;
    VNDF_REAL p = i.front ? r.x : r.y, q = i.front ? r.x : VNDF_FMA(VNDF_R(2.0), i.a, r.y);
    VNDF_REAL square = p * q, exponent = VNDF_FMA(across, across, square);
    VNDF_REAL low = VNDF_FMA(across, across, square - exponent) + VNDF_FMA(p, q, -square);
    // Where |a| is limited, the density grows with it on.
    VNDF_REAL share = VNDF_DIVIDE(VNDF_1_PI * r.y, i.area) * (i.front ? VNDF_R(1.0) : lobe.beyond);
    VNDF_REAL e = vndf_impl_moderate_exp(-exponent),
              weight = lobe.sees ? share * VNDF_FMA(-low, e, e) : VNDF_R(0.0);
    VNDF_REAL t = i.front ? -r.x : i.steep + r.y;
    return vndf_impl_beckmann_unstretch(lobe.ex, lobe.ey, t, across, lobe.alpha_x, lobe.alpha_y, weight);
}

// --- Terms ---

// h in front of the surface, but not so little that a product of it is subnormal: it is beside a.
VNDF_FN VNDF_REAL vndf_impl_beckmann_hidden(struct vndf_beckmann_lobe lobe) {
    return vndf_impl_max(lobe.slopes.hidden, VNDF_EPSILON * VNDF_EPSILON);
}

// The projected area that wo sees from in front of the surface.
VNDF_FN VNDF_REAL vndf_impl_beckmann_front_sigma(struct vndf_beckmann_lobe lobe) {
    return VNDF_FMA(lobe.l, vndf_impl_beckmann_hidden(lobe), lobe.wo_z);
}

// Of either side by one exponential.
VNDF_FN VNDF_REAL vndf_impl_beckmann_sigma(struct vndf_beckmann_lobe lobe) {
    VNDF_REAL unseen = vndf_impl_scaled_expx2(lobe.slopes.steep, lobe.l * lobe.slopes.ierfcx);
    return vndf_impl_finite(unseen + vndf_impl_max(lobe.wo_z, VNDF_R(0.0))) +
           vndf_impl_zero(lobe.wo_x, lobe.wo_y, lobe.wo_z);
}

// wi as another lobe of the same roughness, of which only the terms that are asked for are computed. Made dependent on wo's,
// so that LLVM's SLP pass does not pack the two (impl/stretch.h); the other choice is never taken.
VNDF_FN struct vndf_beckmann_lobe vndf_impl_beckmann_other(struct vndf_beckmann_lobe lobe, VNDF_REAL3 wi) {
    int never = lobe.slopes.hidden < VNDF_R(0.0);
    return vndf_impl_beckmann_lobe_of(wi, never ? VNDF_R(1.0) : lobe.alpha_x,
                                      never ? VNDF_R(1.0) : lobe.alpha_y);
}

// o i / G2 = o i + i l_o h_o + o l_i h_i, o = wo.z and i = wi.z above the horizon, times 2^40: with the same bits for wo and
// wi exchanged.
VNDF_FN VNDF_REAL vndf_impl_beckmann_both(struct vndf_beckmann_lobe o, struct vndf_beckmann_lobe i) {
    VNDF_REAL up = VNDF_R(1099511627776.0), kz_o = up * o.wo_z, kz_i = up * i.wo_z;
    VNDF_REAL hidden_o = vndf_impl_beckmann_hidden(o);
    // Made dependent on wo's, which is positive, so that LLVM's SLP pass does not pack the two (impl/stretch.h).
    i.l = hidden_o > VNDF_R(0.0) ? i.l : VNDF_R(0.0);
    VNDF_REAL unseen = kz_i * (o.l * hidden_o) + kz_o * (i.l * vndf_impl_beckmann_hidden(i));
    return kz_o * i.wo_z + unseen;
}

// --- Densities ---

// z > 0 at least 2^-62 (double: 2^-510), below which slopes are too large for any number.
VNDF_FN VNDF_REAL vndf_impl_beckmann_height(VNDF_REAL z) {
    return vndf_impl_max(z, VNDF_R(4.0) * VNDF_IMPL_ROOT_LEAST);
}

// The exponent of D / sigma(wo) behind the surface, q - a^2, for a normal that faces away from wo, as a sum of two
// numbers: q is small beside a^2.
VNDF_FN struct vndf_impl_pair vndf_impl_hidden_exponent(struct vndf_impl_pair square, VNDF_REAL q) {
    struct vndf_impl_pair exponent;
    VNDF_REAL head = q - square.head, tail = vndf_impl_sum_error(q, -square.head, head) - square.tail,
              sum = head + tail;
    // Where a is large the tail may be more than a correction of the exponential (math.h).
    int beyond = vndf_impl_abs(tail) > VNDF_R(1e-2);
    exponent.head = beyond ? sum : head;
    exponent.tail =
        beyond ? vndf_impl_min(vndf_impl_max(tail - (sum - head), VNDF_R(-1e-2)), VNDF_R(1e-2)) : tail;
    return exponent;
}

// weight D / sigma(wo), as a number and a power of two, whose exponentials leave e^-exponent: q of D, and behind the surface
// q - a^2. 1 / height^4 of D is `rise`^2.
VNDF_FN struct vndf_impl_power vndf_impl_beckmann_share(struct vndf_beckmann_lobe lobe,
                                                        struct vndf_impl_pair exponent, VNDF_REAL rise,
                                                        VNDF_REAL weight) {
    int front = lobe.slopes.front, level = lobe.l > VNDF_R(0.0);
    // Powers of two apart: below the horizon l I(a) may be as small as weight.
    // Each is made dependent on the one before, which is positive, so that LLVM's SLP pass does not pack them
    // (impl/stretch.h).
    struct vndf_impl_power area = vndf_impl_split(front ? vndf_impl_beckmann_front_sigma(lobe)
                                                        : (level ? lobe.l : VNDF_R(1.0))),
                           scale;
    struct vndf_impl_power least =
        vndf_impl_split(area.part > VNDF_R(0.0) ? lobe.slopes.hidden : VNDF_R(1.0));
    struct vndf_impl_power up = vndf_impl_split(least.part > VNDF_R(0.0) ? rise : VNDF_R(1.0));
    // Where |a| is limited, the density grows with its square on.
    VNDF_REAL seen = VNDF_DIVIDE(weight, area.part),
              share = front ? seen : VNDF_DIVIDE(seen, least.part) * lobe.beyond * lobe.beyond;
    scale.part = VNDF_1_PI * share * (up.part * lobe.rcp_x) * (up.part * lobe.rcp_y);
    scale.exponent = 2 * up.exponent - area.exponent - (front ? 0 : least.exponent);
    scale.part = front || level ? scale.part : VNDF_R(0.0);
    return vndf_impl_exp_power(-exponent.head, -exponent.tail, scale);
}

// The same for a normal (tx, ty, 1) z, z > 0; cosine is wo . normal, exact to rounding. Behind the surface the exponents of
// D and sigma combine: with the slope |a| + tau along wo and y across, q - a^2 = tau (2 |a| + tau) + y^2. A normal that
// faces away (tau < 0) occurs only as the half vector of two rounded directions.
VNDF_FN struct vndf_impl_power vndf_impl_beckmann_visible(struct vndf_beckmann_lobe lobe, VNDF_REAL tx,
                                                          VNDF_REAL ty, VNDF_REAL z, VNDF_REAL cosine,
                                                          int rounded, VNDF_REAL rise, VNDF_REAL weight) {
    int front = lobe.slopes.front;
    // Slopes beyond 2^62 (double: 2^510) have the density 0.
    VNDF_REAL limit = VNDF_DIVIDE(VNDF_R(0.25), VNDF_IMPL_ROOT_LEAST);
    VNDF_REAL sx = tx * lobe.rcp_x, sy = ty * lobe.rcp_y;
    VNDF_REAL qx = vndf_impl_min(vndf_impl_abs(sx), limit), qy = vndf_impl_min(vndf_impl_abs(sy), limit);
    VNDF_REAL q = VNDF_FMA(qx, qx, qy * qy);
    // tau = cosine / (z l): both times a power of two, since the product may underflow.
    VNDF_REAL l = lobe.l > VNDF_R(0.0) ? lobe.l : VNDF_R(1.0),
              tau = VNDF_DIVIDE(VNDF_DIVIDE(cosine, VNDF_IMPL_ROOT_LEAST),
                                VNDF_DIVIDE(z, VNDF_IMPL_ROOT_LEAST) * l);
    VNDF_REAL lean = vndf_impl_min(vndf_impl_max(tau, VNDF_R(0.0)), limit);
    VNDF_REAL across =
        vndf_impl_min(vndf_impl_abs(vndf_impl_difference_of_products(sx, lobe.ey, sy, lobe.ex)), limit);
    VNDF_REAL steep = VNDF_FMA(lean, VNDF_FMA(VNDF_R(2.0), lobe.slopes.steep, lean), across * across);
    struct vndf_impl_pair hidden = vndf_impl_hidden_exponent(lobe.square, q);
    int away = rounded && !front && tau < VNDF_R(0.0);
    struct vndf_impl_pair left;
    left.head = front ? q : (away ? hidden.head : steep);
    left.tail = away ? hidden.tail : VNDF_R(0.0);
    return vndf_impl_beckmann_share(lobe, left, rise, weight);
}

// weight D(h) / sigma(wo) of a normal h of any length, with wo . h; 0 where it points to or below the horizon.
VNDF_FN struct vndf_impl_power vndf_impl_beckmann_along(struct vndf_beckmann_lobe lobe, VNDF_REAL x,
                                                        VNDF_REAL y, VNDF_REAL z, VNDF_REAL cosine,
                                                        int rounded, VNDF_REAL weight) {
    VNDF_REAL height = vndf_impl_beckmann_height(z);
    int above = z > VNDF_R(0.0);
    // ty waits for tx, which is finite: side by side they would be packed (impl/stretch.h).
    VNDF_REAL tx = VNDF_DIVIDE(x, height), ty = VNDF_DIVIDE(tx <= VNDF_REAL_MAX ? y : VNDF_R(0.0), height);
    VNDF_REAL rise = VNDF_FMA(tx, tx, VNDF_FMA(ty, ty, VNDF_R(1.0)));
    return vndf_impl_beckmann_visible(lobe, tx, ty, height, above ? cosine : VNDF_R(0.0), rounded, rise,
                                      above ? weight : VNDF_R(0.0));
}

// The same of the half vector wo + wi.
VNDF_FN struct vndf_impl_power vndf_impl_beckmann_half(struct vndf_beckmann_lobe lobe, VNDF_REAL3 wi,
                                                       VNDF_REAL weight) {
    VNDF_REAL3 wo = VNDF_MAKE3(lobe.wo_x, lobe.wo_y, lobe.wo_z);
    struct vndf_impl_half_sum h = vndf_impl_half_sum_of(wo, wi);
    // With the rounding errors of h: near wi = -wo it is the square of a small h.
    return vndf_impl_beckmann_along(lobe, h.head.x, h.head.y, h.head.z, vndf_impl_half_dot(wo, h), 1, weight);
}

#undef VNDF_IMPL_STEEP_LIMIT
#undef VNDF_IMPL_COT_LIMIT

VNDF_END

#endif
