// The sphere as a square by areas: equal areas of the square are equal solid angles.
//
// Source: Clarberg, Fast Equal-Area Mapping of the (Hemi)Sphere using SIMD, 2008. Here y is up: it is the centre of the square, the
// four corners are -y, the diamond between the middles of the edges is the horizon, and x and z grow with the square's.
// Across an edge it goes on at the mirrored place of the same edge.
#ifndef VNDF_RENDER_OCTAHEDRAL_H
#define VNDF_RENDER_OCTAHEDRAL_H

#include "vector.h"

struct vndf_render_place {
    float x, y;  // in [0, 1]
};

// The unit vector at (x, y), both in [0, 1].
// Accuracy: 4 * 2^-24 from the direction that is there, and from the length 1 (octahedral_test).
VNDF_FN struct vndf_render_vector vndf_render_octahedral_direction(float x, float y) {
    const float u = VNDF_FMA(2.0f, x, -1.0f), v = VNDF_FMA(2.0f, y, -1.0f);
    const float au = vndf_impl_abs(u), av = vndf_impl_abs(v);
    const int above = au + av <= 1.0f;
    // A corner is folded onto the centre.
    const float a = above ? au : 1.0f - av, b = above ? av : 1.0f - au;
    const float r = a + b, turn = b / (r > 0.0f ? 4.0f * r : 1.0f);
    const float sine = r * VNDF_SQRT(VNDF_FMA(-r, r, 2.0f)), height = VNDF_FMA(-r, r, 1.0f);
    const float dx = sine * vndf_impl_circle_cos(turn), dz = sine * vndf_impl_circle_sin(turn);
    return vndf_render_vector_of(u < 0.0f ? -dx : dx, above ? height : -height, v < 0.0f ? -dz : dz);
}

// Where a unit vector is in the square.
// Accuracy: each coordinate 2 * 2^-24 (octahedral_test).
VNDF_FN struct vndf_render_place vndf_render_octahedral_place(struct vndf_render_vector d) {
    const float ax = vndf_impl_abs(d.x), az = vndf_impl_abs(d.z);
    // r^2 = 1 - |y|, without its cancellation; what rounding has above 1 goes.
    const float square = VNDF_FMA(ax, ax, az * az) / (1.0f + vndf_impl_abs(d.y));
    const float r = VNDF_SQRT(vndf_impl_min(square, 1.0f));
    const float b = r * 4.0f * vndf_impl_turn(ax, az), a = r - b;
    const int below = d.y < 0.0f;
    const float u = below ? 1.0f - b : a, v = below ? 1.0f - a : b;
    struct vndf_render_place p;
    p.x = VNDF_FMA(0.5f, d.x < 0.0f ? -u : u, 0.5f);
    p.y = VNDF_FMA(0.5f, d.z < 0.0f ? -v : v, 0.5f);
    return p;
}

#endif
