// Vectors as structs of three floats (a float3 would keep PoCL from vectorising across work-items).
#ifndef VNDF_RENDER_VECTOR_H
#define VNDF_RENDER_VECTOR_H

#include "language.h"

struct vndf_render_vector {
    float x, y, z;
};

VNDF_FN struct vndf_render_vector vndf_render_vector_of(float x, float y, float z) {
    struct vndf_render_vector v;
    v.x = x;
    v.y = y;
    v.z = z;
    return v;
}
// Planes k, k + 1 and k + 2 of item i.
VNDF_FN struct vndf_render_vector vndf_render_vector_at(VNDF_RENDER_FROM(float) planes, uint k, uint stride,
                                                        uint i) {
    return vndf_render_vector_of(planes[k * stride + i], planes[(k + 1) * stride + i],
                                 planes[(k + 2) * stride + i]);
}
VNDF_FN void vndf_render_store(struct vndf_render_vector v, VNDF_RENDER_TO(float) planes, uint k, uint stride,
                               uint i) {
    planes[k * stride + i] = v.x;
    planes[(k + 1) * stride + i] = v.y;
    planes[(k + 2) * stride + i] = v.z;
}
VNDF_FN float vndf_render_dot(struct vndf_render_vector a, struct vndf_render_vector b) {
    return VNDF_FMA(a.x, b.x, VNDF_FMA(a.y, b.y, a.z * b.z));
}
VNDF_FN struct vndf_render_vector vndf_render_scaled(float k, struct vndf_render_vector a) {
    return vndf_render_vector_of(k * a.x, k * a.y, k * a.z);
}
// a + k b.
VNDF_FN struct vndf_render_vector vndf_render_sum(struct vndf_render_vector a, float k,
                                                  struct vndf_render_vector b) {
    return vndf_render_vector_of(VNDF_FMA(k, b.x, a.x), VNDF_FMA(k, b.y, a.y), VNDF_FMA(k, b.z, a.z));
}
VNDF_FN struct vndf_render_vector vndf_render_cross(struct vndf_render_vector a,
                                                    struct vndf_render_vector b) {
    return vndf_render_vector_of(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}
VNDF_FN struct vndf_render_vector vndf_render_unit_vector(struct vndf_render_vector v) {
    const float square = vndf_render_dot(v, v);
    return vndf_render_scaled(1.0f / VNDF_SQRT(square > 0.0f ? square : 1.0f), v);
}

// The same, made dependent on a number >= 0, so that LLVM does not pack it with what that comes from; the other choice is never
// taken.
VNDF_FN struct vndf_render_vector vndf_render_unit_after(float before, struct vndf_render_vector v) {
    const float square = vndf_render_dot(v, v);
    return vndf_render_scaled(1.0f / VNDF_SQRT(square > 0.0f && before >= 0.0f ? square : 1.0f), v);
}

VNDF_FN struct vndf_render_vector vndf_render_either(struct vndf_render_vector a, struct vndf_render_vector b,
                                                     int first) {
    return vndf_render_vector_of(first ? a.x : b.x, first ? a.y : b.y, first ? a.z : b.z);
}

// 1 - cos of the angle between two unit vectors, of near ones without cancellation.
VNDF_FN float vndf_render_gap(struct vndf_render_vector a, struct vndf_render_vector b) {
    const float dx = b.x - a.x, dy = b.y - a.y, dz = b.z - a.z;
    return 0.5f * VNDF_FMA(dx, dx, VNDF_FMA(dy, dy, dz * dz));
}

// Directions with one angle to an axis, a unit vector: 1 - cos of it.
struct vndf_render_toward {
    struct vndf_render_vector axis;
    float gap;
};
// One of them. turn: which, in [0, 1).
// Source of the frame: Duff et al., Building an Orthonormal Basis, Revisited, 2017, about y, which is up.
VNDF_FN struct vndf_render_vector vndf_render_about(struct vndf_render_toward to, float turn) {
    const float nx = to.axis.x, ny = to.axis.y, nz = to.axis.z;
    const float radius = VNDF_SQRT(to.gap * (2.0f - to.gap)), height = 1.0f - to.gap;
    const float x = radius * vndf_impl_circle_cos(turn), y = radius * vndf_impl_circle_sin(turn);
    const float s = ny < 0.0f ? -1.0f : 1.0f, k = -1.0f / (s + ny), both = nx * nz * k;
    return vndf_render_vector_of(VNDF_FMA(x, VNDF_FMA(s * nx * nx, k, 1.0f), VNDF_FMA(y, both, height * nx)),
                                 VNDF_FMA(x, -s * nx, VNDF_FMA(y, -nz, height * ny)),
                                 VNDF_FMA(x, s * both, VNDF_FMA(y, VNDF_FMA(nz * nz, k, s), height * nz)));
}

// w in the frame of two unit vectors.
VNDF_FN struct vndf_render_vector vndf_render_local(struct vndf_render_vector normal,
                                                    struct vndf_render_vector tangent,
                                                    struct vndf_render_vector w) {
    return vndf_render_vector_of(vndf_render_dot(w, tangent),
                                 vndf_render_dot(w, vndf_render_cross(normal, tangent)),
                                 vndf_render_dot(w, normal));
}

// And back.
VNDF_FN struct vndf_render_vector vndf_render_world(struct vndf_render_vector normal,
                                                    struct vndf_render_vector tangent,
                                                    struct vndf_render_vector w) {
    return vndf_render_sum(
        vndf_render_sum(vndf_render_scaled(w.x, tangent), w.y, vndf_render_cross(normal, tangent)), w.z,
        normal);
}

#endif
