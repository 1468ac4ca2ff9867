// Stage: where a path meets a surface, its frame there; the path's place moves to it.
#ifndef VNDF_RENDER_SURFACE_H
#define VNDF_RENDER_SURFACE_H

#include "../vndf/effects.h"
#include "queues.h"
#include "vector.h"

VNDF_FN struct vndf_render_vector vndf_render_mix(struct vndf_render_vector a, struct vndf_render_vector b,
                                                  struct vndf_render_vector c, float b1, float b2) {
    const float b0 = 1.0f - b1 - b2;
    return vndf_render_vector_of(VNDF_FMA(b0, a.x, VNDF_FMA(b1, b.x, b2 * c.x)),
                                 VNDF_FMA(b0, a.y, VNDF_FMA(b1, b.y, b2 * c.y)),
                                 VNDF_FMA(b0, a.z, VNDF_FMA(b1, b.z, b2 * c.z)));
}

// Where corner `k` of a triangle is.
VNDF_FN struct vndf_render_vector vndf_render_corner(struct vndf_render_sizes sizes,
                                                     VNDF_RENDER_FROM(float) vertices,
                                                     VNDF_RENDER_FROM(uint) triangles, uint number, uint k) {
    return vndf_render_vector_at(vertices, VNDF_VERTEX_PLACE, sizes.vertices,
                                 triangles[k * sizes.triangles + number]);
}

// -1 where a surface with two sides is seen from behind.
VNDF_FN float vndf_render_side(struct vndf_render_vector face, struct vndf_render_vector wo) {
#if VNDF_BACK_FACING
    return vndf_render_dot(face, wo) < 0.0f ? -1.0f : 1.0f;
#else
    (void)face;
    (void)wo;
    return 1.0f;
#endif
}

VNDF_RENDER_KERNEL vndf_render_surface(const struct vndf_render_sizes sizes, VNDF_RENDER_IN(float) vertices,
                                       VNDF_RENDER_IN(uint) triangles, VNDF_RENDER_IN(float) hit,
                                       VNDF_RENDER_IN(uint) triangle, const uint count, const uint stride,
                                       VNDF_RENDER_OUT(float) path, VNDF_RENDER_OUT(float) surface,
                                       VNDF_RENDER_OUT(uint) material) {
    const uint i = VNDF_RENDER_ITEM;
    // Items beyond the count get some surface, and no other stage asks for it.
    const uint number = i < count ? triangle[i] : 0;
#if VNDF_SHADING_NORMAL
    const uint first = triangles[number], second = triangles[sizes.triangles + number],
               third = triangles[2 * sizes.triangles + number];
#endif
    const float b1 = hit[VNDF_HIT_B1 * stride + i], b2 = hit[VNDF_HIT_B2 * stride + i];
    const struct vndf_render_vector a = vndf_render_corner(sizes, vertices, triangles, number, 0),
                                    b = vndf_render_corner(sizes, vertices, triangles, number, 1),
                                    c = vndf_render_corner(sizes, vertices, triangles, number, 2);
    const struct vndf_render_vector wo =
        vndf_render_scaled(-1.0f, vndf_render_vector_at(path, VNDF_PATH_DX, stride, i));
    const struct vndf_render_vector ab = vndf_render_sum(b, -1.0f, a), ac = vndf_render_sum(c, -1.0f, a);
    const struct vndf_render_vector face = vndf_render_unit_vector(vndf_render_cross(ab, ac));
    const float side = vndf_render_side(face, wo);
    const struct vndf_render_vector geometric = vndf_render_scaled(side, face);
#if VNDF_SHADING_NORMAL
    const struct vndf_render_vector mixed =
        vndf_render_mix(vndf_render_vector_at(vertices, VNDF_VERTEX_NORMAL, sizes.vertices, first),
                        vndf_render_vector_at(vertices, VNDF_VERTEX_NORMAL, sizes.vertices, second),
                        vndf_render_vector_at(vertices, VNDF_VERTEX_NORMAL, sizes.vertices, third), b1, b2);
    const struct vndf_render_vector turned =
        vndf_render_scaled(side, vndf_render_unit_after(vndf_render_dot(face, face), mixed));
    // Bent until wo is one part in a hundred above its horizon, so that a coarse mesh has no black spots.
    const float lack = vndf_impl_max(0.01f - vndf_render_dot(turned, wo), 0.0f);
    const struct vndf_render_vector normal = vndf_render_unit_vector(vndf_render_sum(turned, lack, wo));
#else
    const struct vndf_render_vector normal = geometric;
#endif
    // The tangent runs along the circles about the vertical.
    const int pole = VNDF_FMA(normal.x, normal.x, normal.z * normal.z) < 1e-12f;
    const struct vndf_render_vector tangent =
        vndf_render_unit_vector(vndf_render_vector_of(pole ? 1.0f : normal.z, 0.0f, pole ? 0.0f : -normal.x));
    const struct vndf_render_vector wo_local = vndf_render_local(normal, tangent, wo),
                                    geometric_local = vndf_render_local(normal, tangent, geometric);
    // Rays begin beside the surface, by more than the rounding of its place and of the test for hits, which both go with the
    // triangle's corners.
    const struct vndf_render_vector place = vndf_render_mix(a, b, c, b1, b2);
    const float size2 = vndf_render_dot(place, place) + vndf_render_dot(ab, ab) + vndf_render_dot(ac, ac);
    const float offset = 1e-6f * VNDF_SQRT(size2);
    const struct vndf_render_vector origin = vndf_render_sum(place, offset, geometric);
    vndf_render_store(origin, path, VNDF_PATH_X, stride, i);
    vndf_render_store(normal, surface, VNDF_SURFACE_NORMAL, stride, i);
    vndf_render_store(tangent, surface, VNDF_SURFACE_TANGENT, stride, i);
    vndf_render_store(wo_local, surface, VNDF_SURFACE_WO, stride, i);
    vndf_render_store(geometric_local, surface, VNDF_SURFACE_GEOMETRIC, stride, i);
#if VNDF_DIELECTRIC
    surface[VNDF_SURFACE_OFFSET * stride + i] = side * offset;
#endif
    material[i] = triangles[VNDF_TRIANGLE_MATERIAL * sizes.triangles + number];
}

#endif
