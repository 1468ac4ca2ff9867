// Directions about a normal n in the frame that both are given in, and by their cosines alone, as functions of the local frame
// with one alpha take them: (sine, 0, cosine).
#ifndef VNDF_IMPL_WORLD_H
#define VNDF_IMPL_WORLD_H

#include "exact.h"
#include "range.h"

VNDF_BEGIN

// |c|; c times 2^27, against underflow.
VNDF_FN VNDF_REAL vndf_impl_length(struct vndf_impl_vector c) {
    VNDF_REAL x = c.x * VNDF_R(134217728.0), y = c.y * VNDF_R(134217728.0), z = c.z * VNDF_R(134217728.0);
    return VNDF_SQRT(VNDF_FMA(x, x, VNDF_FMA(y, y, z * z))) * VNDF_R(7.450580596923828125e-09);
}

// What is across n and along it, finite for finite vectors of any size; NaN for NaN across.
VNDF_FN VNDF_REAL3 vndf_impl_upright(VNDF_REAL across, VNDF_REAL along, VNDF_REAL3 n, VNDF_REAL3 w) {
    VNDF_REAL none = vndf_impl_zero(n.x, n.y, n.z) + vndf_impl_zero(w.x, w.y, w.z);
    return VNDF_MAKE3(vndf_impl_finite(across) + none, VNDF_R(0.0),
                      vndf_impl_max(vndf_impl_finite(along), -VNDF_REAL_MAX));
}

// w about n: the sine is |n x w|, which keeps its digits at every angle. The root of 1 - (n . w)^2 loses those of angles below
// 1e-3, and |w - (n . w) n| is the rounding of |n| where w is near n.
VNDF_FN VNDF_REAL3 vndf_impl_about(VNDF_REAL3 n, VNDF_REAL3 w) {
    return vndf_impl_upright(vndf_impl_length(vndf_impl_cross(n, w)),
                             vndf_impl_dot(n.x, n.y, n.z, w.x, w.y, w.z), n, w);
}

// (x, y, z), made of n and w; the zero vector where it has left the range of numbers, NaN for NaN.
VNDF_FN VNDF_REAL3 vndf_impl_bounded_vector(VNDF_REAL x, VNDF_REAL y, VNDF_REAL z, VNDF_REAL3 n,
                                            VNDF_REAL3 w) {
    VNDF_REAL none = vndf_impl_zero(n.x, n.y, n.z) + vndf_impl_zero(w.x, w.y, w.z);
    int finite = vndf_impl_zero(x, y, z) == VNDF_R(0.0);
    return VNDF_MAKE3(finite ? x : none, finite ? y : none, finite ? z : none);
}

// v for the next step: made dependent on all of the one before, which is a number, and each component on another, so that
// LLVM's SLP pass does not pack the two (impl/stretch.h).
VNDF_FN VNDF_REAL3 vndf_impl_next(VNDF_REAL3 v, VNDF_REAL3 before) {
    VNDF_REAL x = before.x + before.z <= VNDF_REAL_MAX ? v.x : VNDF_R(0.0),
              y = x <= VNDF_REAL_MAX ? v.y : VNDF_R(0.0);
    return VNDF_MAKE3(x, y, y <= VNDF_REAL_MAX ? v.z : VNDF_R(1.0));
}

// The half vector h = wo + wi, with what its sums round off: beside n its angle is a matter of their last bits.
struct vndf_impl_half_sum {
    VNDF_REAL3 head, tail;
};
VNDF_FN struct vndf_impl_half_sum vndf_impl_half_sum_of(VNDF_REAL3 wo, VNDF_REAL3 wi) {
    struct vndf_impl_half_sum h = {
        VNDF_MAKE3(wo.x + wi.x, wo.y + wi.y, wo.z + wi.z),
        VNDF_MAKE3(vndf_impl_sum_error(wo.x, wi.x, wo.x + wi.x), vndf_impl_sum_error(wo.y, wi.y, wo.y + wi.y),
                   vndf_impl_sum_error(wo.z, wi.z, wo.z + wi.z))};
    return h;
}
VNDF_FN struct vndf_impl_vector vndf_impl_half_cross(VNDF_REAL3 n, struct vndf_impl_half_sum h) {
    struct vndf_impl_vector c = vndf_impl_cross(n, h.head);
    c.x += VNDF_FMA(n.y, h.tail.z, -n.z * h.tail.y);
    c.y += VNDF_FMA(n.z, h.tail.x, -n.x * h.tail.z);
    c.z += VNDF_FMA(n.x, h.tail.y, -n.y * h.tail.x);
    return c;
}
VNDF_FN VNDF_REAL vndf_impl_half_dot(VNDF_REAL3 n, struct vndf_impl_half_sum h) {
    struct vndf_impl_pair dot = vndf_impl_dot_pair(n.x, n.y, n.z, h.head.x, h.head.y, h.head.z);
    VNDF_REAL low = VNDF_FMA(n.x, h.tail.x, VNDF_FMA(n.y, h.tail.y, n.z * h.tail.z));
    return dot.head + (dot.tail + low);
}

// A direction by its cosine, taken for an exact number; beyond 1, as rounding makes it, the sine is 0.
VNDF_FN VNDF_REAL3 vndf_impl_of_cosine(VNDF_REAL cosine) {
    return VNDF_MAKE3(vndf_impl_sin_from_cos(cosine), VNDF_R(0.0), cosine);
}
VNDF_FN VNDF_REAL3 vndf_impl_of_next_cosine(VNDF_REAL cosine, VNDF_REAL3 before) {
    return vndf_impl_of_cosine(before.x >= VNDF_R(0.0) ? cosine : VNDF_R(0.0));
}

VNDF_END

#endif
