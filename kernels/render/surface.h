// Stage: where a path meets a surface, its frame there; the path's place moves to it.
#ifndef VNDF_RENDER_SURFACE_H
#define VNDF_RENDER_SURFACE_H

#include "../vndf/effects.h"
#include "queues.h"
#include "texture.h"

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

#if VNDF_RENDER_TANGENT || VNDF_RENDER_NORMAL_MAP
// Along the texture coordinates, at right angles to the normal; zero where the mesh has no tangents.
VNDF_FN struct vndf_render_vector vndf_render_mesh_tangent(struct vndf_render_looks looks,
                                                           struct vndf_render_spot spot,
                                                           struct vndf_render_vector normal) {
    const struct vndf_render_vector t =
        vndf_render_vector_of(vndf_render_vertex(looks, spot, VNDF_VERTEX_TANGENT),
                              vndf_render_vertex(looks, spot, VNDF_VERTEX_TANGENT + 1),
                              vndf_render_vertex(looks, spot, VNDF_VERTEX_TANGENT + 2));
    return vndf_render_unit_vector(vndf_render_sum(t, -vndf_render_dot(t, normal), normal));
}
// The other one of the plane.
VNDF_FN struct vndf_render_vector vndf_render_mesh_bitangent(struct vndf_render_looks looks,
                                                             struct vndf_render_spot spot,
                                                             struct vndf_render_vector normal,
                                                             struct vndf_render_vector tangent) {
    return vndf_render_scaled(looks.vertices[(VNDF_VERTEX_TANGENT + 3) * looks.sizes.vertices + spot.first],
                              vndf_render_cross(normal, tangent));
}
#endif

#if VNDF_RENDER_NORMAL_MAP
// A byte has no 0: the two next to it count as such.
VNDF_FN float vndf_render_signed(float x) {
    const float s = VNDF_FMA(2.0f, x, -1.0f);
    return vndf_impl_abs(s) < 0.005f ? 0.0f : s;
}
// The normal that a map has in the plane of the mesh's tangents.
VNDF_FN struct vndf_render_vector vndf_render_mapped(struct vndf_render_looks looks,
                                                     struct vndf_render_spot spot,
                                                     struct vndf_render_vector normal) {
    const struct vndf_render_vector tangent = vndf_render_mesh_tangent(looks, spot, normal),
                                    bitangent = vndf_render_mesh_bitangent(looks, spot, normal, tangent);
    const struct vndf_render_colour map = vndf_render_look(looks, spot, VNDF_SLOT_NORMAL, 0, 1.0f);
    const float scale = vndf_render_dressing(looks, spot, VNDF_DRESSING_NORMAL_SCALE);
    const float x = scale * vndf_render_signed(map.r);
    // Dependent on x for the compiler alone, which would pack the two.
    const float y = scale * vndf_render_signed(x > -3e38f ? map.g : 0.0f), z = VNDF_FMA(2.0f, map.b, -1.0f);
    const struct vndf_render_vector bent = vndf_render_unit_vector(
        vndf_render_sum(vndf_render_sum(vndf_render_scaled(x, tangent), y, bitangent), z, normal));
    const int flat = !vndf_render_has(looks, spot, VNDF_SLOT_NORMAL) || (x == 0.0f && y == 0.0f) ||
                     vndf_render_dot(tangent, tangent) == 0.0f;
    return vndf_render_vector_of(flat ? normal.x : bent.x, flat ? normal.y : bent.y,
                                 flat ? normal.z : bent.z);
}
#endif

#if VNDF_RENDER_TANGENT
// The direction of alpha_x: the mesh's tangent, turned as the material says; `usual` where the mesh has none.
VNDF_FN struct vndf_render_vector vndf_render_turned_tangent(struct vndf_render_looks looks,
                                                             struct vndf_render_spot spot,
                                                             struct vndf_render_vector normal,
                                                             struct vndf_render_vector usual) {
    const struct vndf_render_vector t = vndf_render_mesh_tangent(looks, spot, normal),
                                    b = vndf_render_mesh_bitangent(looks, spot, normal, t);
    float c = vndf_render_dressing(looks, spot, VNDF_DRESSING_TURN),
          s = vndf_render_dressing(looks, spot, VNDF_DRESSING_TURN + 1);
#if VNDF_RENDER_LAYER_TEXTURE
    const struct vndf_render_colour map =
        vndf_render_layer_texture(looks, spot, VNDF_SLOT_ANISOTROPY, vndf_render_dot(t, t));
    const int says = vndf_render_has(looks, spot, VNDF_SLOT_ANISOTROPY);
    const float x = says ? VNDF_FMA(2.0f, map.r, -1.0f) : 1.0f,
                y = says ? VNDF_FMA(2.0f, map.g, -1.0f) : 0.0f;
    const float turned = VNDF_FMA(c, x, -s * y);
    s = VNDF_FMA(s, x, c * y);
    c = turned;
#endif
    const struct vndf_render_vector along =
        vndf_render_unit_vector(vndf_render_sum(vndf_render_scaled(c, t), s, b));
    const int there = vndf_render_dot(along, along) > 0.0f;
    return vndf_render_vector_of(there ? along.x : usual.x, there ? along.y : usual.y,
                                 there ? along.z : usual.z);
}
#endif

VNDF_RENDER_KERNEL vndf_render_surface(const struct vndf_render_sizes sizes, VNDF_RENDER_IN(float) vertices,
                                       VNDF_RENDER_IN(uint) triangles, VNDF_RENDER_IN(float) dressings,
                                       VNDF_RENDER_IN(uint) textures, VNDF_RENDER_IN(uint) texels,
                                       VNDF_RENDER_IN(float) hit, VNDF_RENDER_IN(uint) triangle,
                                       const uint count, const uint stride, VNDF_RENDER_OUT(float) path,
                                       VNDF_RENDER_OUT(float) surface, VNDF_RENDER_OUT(uint) material) {
    const uint i = VNDF_RENDER_ITEM;
    // Items beyond the count get some surface, and no other stage asks for it.
    const uint number = i < count ? triangle[i] : 0;
#if VNDF_SHADING_NORMAL
    const uint first = triangles[number], second = triangles[sizes.triangles + number],
               third = triangles[2 * sizes.triangles + number];
#endif
    const float b1 = hit[VNDF_HIT_B1 * stride + i], b2 = hit[VNDF_HIT_B2 * stride + i];
#if VNDF_RENDER_TANGENT || VNDF_RENDER_NORMAL_MAP
    const struct vndf_render_looks looks =
        vndf_render_looks_of(sizes, vertices, triangles, dressings, textures, texels);
    const struct vndf_render_spot spot = vndf_render_spot_of(looks, number, b1, b2);
#else
    (void)dressings;
    (void)textures;
    (void)texels;
#endif
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
    const struct vndf_render_vector smooth = vndf_render_unit_after(vndf_render_dot(face, face), mixed);
#if VNDF_RENDER_NORMAL_MAP
    const struct vndf_render_vector turned =
        vndf_render_scaled(side, vndf_render_mapped(looks, spot, smooth));
#else
    const struct vndf_render_vector turned = vndf_render_scaled(side, smooth);
#endif
    // Bent until wo is one part in a hundred above its horizon, or as far as above the face's, so that a coarse mesh has no black
    // spots, and a flat one keeps its normal.
    const float least = vndf_impl_min(0.01f, vndf_render_dot(geometric, wo));
    const float lack = vndf_impl_max(least - vndf_render_dot(turned, wo), 0.0f);
    const struct vndf_render_vector normal = vndf_render_unit_vector(vndf_render_sum(turned, lack, wo));
#else
    const struct vndf_render_vector normal = geometric;
#endif
    // The tangent runs along the circles about the vertical.
    const int pole = VNDF_FMA(normal.x, normal.x, normal.z * normal.z) < 1e-12f;
    const struct vndf_render_vector around =
        vndf_render_unit_vector(vndf_render_vector_of(pole ? 1.0f : normal.z, 0.0f, pole ? 0.0f : -normal.x));
#if VNDF_RENDER_TANGENT
    const struct vndf_render_vector tangent =
        vndf_render_turned_tangent(looks, spot, vndf_render_scaled(side, normal), around);
#else
    const struct vndf_render_vector tangent = around;
#endif
    const struct vndf_render_vector wo_local = vndf_render_local(normal, tangent, wo),
                                    geometric_local = vndf_render_local(normal, tangent, geometric);
    // Rays begin beside the surface, by more than the rounding of its place and of the test for hits, which both go with the
    // triangle's corners.
    const struct vndf_render_vector place = vndf_render_mix(a, b, c, b1, b2);
    const float size2 = vndf_render_dot(place, place) + vndf_render_dot(ab, ab) + vndf_render_dot(ac, ac);
    const float offset = 1e-6f * VNDF_SQRT(size2);
    const struct vndf_render_vector origin = vndf_render_sum(place, offset, geometric);
#if VNDF_RENDER_LAMP
    const struct vndf_render_vector way =
        vndf_render_sum(place, -1.0f, vndf_render_vector_at(path, VNDF_PATH_X, stride, i));
    surface[VNDF_SURFACE_SOLID * stride + i] =
        vndf_render_dot(way, way) / vndf_impl_max(vndf_impl_abs(vndf_render_dot(face, wo)), 1e-20f);
#endif
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
