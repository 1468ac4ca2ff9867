// Local frames: a tangent of a normal, and directions from world to local space and back.
//
// A frame is a normal n and a tangent t, unit vectors across each other: x is along t, y along n x t, z along n. Take
// vndf_tangent where there is none, and vndf_tangent_along where there is one that is not quite across n. Anisotropic lobes
// need a frame; isotropic ones do without (ggx_world.h).
#ifndef VNDF_FRAME_H
#define VNDF_FRAME_H

#include "impl/world.h"

VNDF_BEGIN

// A tangent of n, for every n.
// Source: Duff et al., Building an Orthonormal Basis, Revisited, 2017 (its b1): the image of x under the shortest turn from z
//     to n, for n.z < 0 from -z. No n has a bad basis, but it jumps where n.z changes sign.
// n: unit vector, any.
// return: unit vector across n, both to 6 eps; the zero vector for an n beyond the range of numbers.
// Accuracy: 3 eps (1 + condition number); double 5.5.
VNDF_FN VNDF_REAL3 vndf_tangent(VNDF_REAL3 n) {
    VNDF_REAL share = VNDF_DIVIDE(n.x, VNDF_R(1.0) + vndf_impl_abs(n.z));
    return vndf_impl_bounded_vector(VNDF_FMA(-n.x, share, VNDF_R(1.0)), -n.y * share,
                                    n.z < VNDF_R(0.0) ? n.x : -n.x, n, n);
}

// The tangent of n that is nearest to a direction.
// Source: this package: w's part across n, (n x w) x n, which keeps its digits where w is near n.
// n: unit vector.
// w: any vector of ordinary length (1e-3 to 1e3).
// return: unit vector across n, both to 6 eps; vndf_tangent(n) where w is along n.
// Accuracy: 3.5 eps (1 + condition number); double 3.5.
VNDF_FN VNDF_REAL3 vndf_tangent_along(VNDF_REAL3 n, VNDF_REAL3 w) {
    struct vndf_impl_vector c = vndf_impl_cross(n, w);
    VNDF_REAL length = vndf_impl_length(c),
              rcp = VNDF_DIVIDE(VNDF_R(1.0), length > VNDF_R(0.0) ? length : VNDF_R(1.0));
    VNDF_REAL3 e = VNDF_MAKE3(c.x * rcp, c.y * rcp, c.z * rcp), any = vndf_tangent(n);
    VNDF_REAL x = VNDF_FMA(e.y, n.z, -e.z * n.y), y = VNDF_FMA(e.z, n.x, -e.x * n.z),
              z = VNDF_FMA(e.x, n.y, -e.y * n.x);
    int along = length > VNDF_R(0.0);
    return vndf_impl_bounded_vector(along ? x : any.x, along ? y : any.y, along ? z : any.z, n, w);
}

// A direction in the frame of n and t.
// Source: this package: x = (n x t) . (n x w), y = -t . (n x w), z = n . w, so that small angles to n keep their digits,
//     whatever the rounding of t leaves along n.
// w: any vector, in the space that n and t are given in.
// n, t: unit vectors across each other.
// return: (x, y, z), as long as w.
// Accuracy: 1.25 eps (1 + condition number); double 2.
//     The length of (x, y), the sine of the angle to n, to 10 eps of itself.
VNDF_FN VNDF_REAL3 vndf_to_local(VNDF_REAL3 w, VNDF_REAL3 n, VNDF_REAL3 t) {
    struct vndf_impl_vector b = vndf_impl_cross(n, t), c = vndf_impl_cross(n, w);
    // No fma is negated: g++ 12 makes one instruction of both on Arm and RISC-V, which gives 0 for -0.
    VNDF_REAL x = VNDF_FMA(b.x, c.x, VNDF_FMA(b.y, c.y, b.z * c.z)),
              y = VNDF_FMA(-t.x, c.x, VNDF_FMA(-t.y, c.y, -t.z * c.z));
    return vndf_impl_bounded_vector(x, y, vndf_impl_dot(n.x, n.y, n.z, w.x, w.y, w.z), n, w);
}

// The direction that has these coordinates in the frame of n and t.
// w: any vector, local.
// n, t: unit vectors across each other.
// return: w.x t + w.y (n x t) + w.z n, as long as w; there and back a unit vector is itself to 10 eps.
// Accuracy: 0.75 eps (1 + condition number); double 0.75.
VNDF_FN VNDF_REAL3 vndf_to_world(VNDF_REAL3 w, VNDF_REAL3 n, VNDF_REAL3 t) {
    struct vndf_impl_vector b = vndf_impl_cross(n, t);
    return vndf_impl_bounded_vector(VNDF_FMA(w.x, t.x, VNDF_FMA(w.y, b.x, w.z * n.x)),
                                    VNDF_FMA(w.x, t.y, VNDF_FMA(w.y, b.y, w.z * n.y)),
                                    VNDF_FMA(w.x, t.z, VNDF_FMA(w.y, b.z, w.z * n.z)), n, w);
}

VNDF_END

#endif
