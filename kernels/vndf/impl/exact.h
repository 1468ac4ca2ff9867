// Products and sums with one rounding or little more.
#ifndef VNDF_IMPL_EXACT_H
#define VNDF_IMPL_EXACT_H

#include "vector.h"

VNDF_BEGIN

// a b - c d without cancellation error: at most 1.5 ulp (Kahan).
VNDF_FN VNDF_REAL vndf_impl_difference_of_products(VNDF_REAL a, VNDF_REAL b, VNDF_REAL c, VNDF_REAL d) {
    VNDF_REAL cd = c * d;
    return VNDF_FMA(a, b, -cd) + VNDF_FMA(-c, d, cd);
}

// n x w, each component with the error of one rounding.
VNDF_FN struct vndf_impl_vector vndf_impl_cross(VNDF_REAL3 n, VNDF_REAL3 w) {
    struct vndf_impl_vector c;
    c.x = vndf_impl_difference_of_products(n.y, w.z, n.z, w.y);
    c.y = vndf_impl_difference_of_products(n.z, w.x, n.x, w.z);
    c.z = vndf_impl_difference_of_products(n.x, w.y, n.y, w.x);
    return c;
}

// The rounding error of s = a + b, exactly (Knuth).
VNDF_FN VNDF_REAL vndf_impl_sum_error(VNDF_REAL a, VNDF_REAL b, VNDF_REAL s) {
    VNDF_REAL t = s - a;
    return (a - (s - t)) + (b - t);
}

// a . b as head + tail: as if computed in twice the precision, so that a grazing wm . wo keeps its digits.
struct vndf_impl_pair {
    VNDF_REAL head, tail;
};
VNDF_FN struct vndf_impl_pair vndf_impl_dot_pair(VNDF_REAL ax, VNDF_REAL ay, VNDF_REAL az, VNDF_REAL bx,
                                                 VNDF_REAL by, VNDF_REAL bz) {
    VNDF_REAL px = ax * bx, py = ay * by, pz = az * bz;
    VNDF_REAL xy = px + py, sum = xy + pz;
    struct vndf_impl_pair dot;
    VNDF_REAL products = VNDF_FMA(ax, bx, -px) + VNDF_FMA(ay, by, -py) + VNDF_FMA(az, bz, -pz);
    dot.head = sum;
    dot.tail = products + (vndf_impl_sum_error(px, py, xy) + vndf_impl_sum_error(xy, pz, sum));
    return dot;
}
VNDF_FN VNDF_REAL vndf_impl_dot(VNDF_REAL ax, VNDF_REAL ay, VNDF_REAL az, VNDF_REAL bx, VNDF_REAL by,
                                VNDF_REAL bz) {
    struct vndf_impl_pair dot = vndf_impl_dot_pair(ax, ay, az, bx, by, bz);
    return dot.head + dot.tail;
}

// wo + eta wi of one component, in twice the precision.
VNDF_FN struct vndf_impl_pair vndf_impl_eta_sum(VNDF_REAL o, VNDF_REAL eta, VNDF_REAL i) {
    VNDF_REAL product = eta * i, sum = o + product;
    VNDF_REAL low = vndf_impl_sum_error(o, product, sum) + VNDF_FMA(eta, i, -product);
    struct vndf_impl_pair h;
    h.head = sum + low;
    h.tail = vndf_impl_sum_error(sum, low, h.head);  // where the sum cancels, low may be the larger
    return h;
}

// sin of the angle whose cosine is c: 1 - c c is rounded once.
VNDF_FN VNDF_REAL vndf_impl_sin_from_cos(VNDF_REAL c) {
    VNDF_REAL square = VNDF_FMA(-c, c, VNDF_R(1.0));
    return VNDF_SQRT(square > VNDF_R(0.0) ? square : VNDF_R(0.0));
}

// cos_theta - x sin_theta of the angle between the view direction and the slope x: the
// sine carries its rounding error along, since the difference vanishes at the end of the visible range.
VNDF_FN VNDF_REAL vndf_impl_visible_cosine(VNDF_REAL cos_theta, VNDF_REAL x) {
    VNDF_REAL square = cos_theta * cos_theta, rest = VNDF_R(1.0) - square;
    VNDF_REAL rest_error = ((VNDF_R(1.0) - rest) - square) - VNDF_FMA(cos_theta, cos_theta, -square);
    VNDF_REAL sine = VNDF_SQRT(rest > VNDF_R(0.0) ? rest : VNDF_R(0.0));
    VNDF_REAL sine_error = sine > VNDF_R(0.0)
                               ? VNDF_DIVIDE(VNDF_R(0.5) * (VNDF_FMA(-sine, sine, rest) + rest_error), sine)
                               : VNDF_R(0.0);
    return VNDF_FMA(-x, sine, cos_theta) - x * sine_error;
}

VNDF_END

#endif
