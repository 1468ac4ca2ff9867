// Stage: what happens where a path meets a surface. Its ray towards a light, and the direction in which it goes on.
#ifndef VNDF_RENDER_SHADE_H
#define VNDF_RENDER_SHADE_H

#include "lights.h"
#include "material.h"

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
VNDF_FN float vndf_render_dot(struct vndf_render_vector a, struct vndf_render_vector b) {
    return VNDF_FMA(a.x, b.x, VNDF_FMA(a.y, b.y, a.z * b.z));
}
// a + k b.
VNDF_FN struct vndf_render_vector vndf_render_sum(struct vndf_render_vector a, float k, struct vndf_render_vector b) {
    return vndf_render_vector_of(VNDF_FMA(k, b.x, a.x), VNDF_FMA(k, b.y, a.y), VNDF_FMA(k, b.z, a.z));
}
VNDF_FN struct vndf_render_vector vndf_render_cross(struct vndf_render_vector a, struct vndf_render_vector b) {
    return vndf_render_vector_of(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}
VNDF_FN struct vndf_render_vector vndf_render_unit_vector(struct vndf_render_vector v) {
    const float square = vndf_render_dot(v, v), scale = 1.0f / VNDF_SQRT(square > 0.0f ? square : 1.0f);
    return vndf_render_vector_of(v.x * scale, v.y * scale, v.z * scale);
}
// A corner's place or normal.
VNDF_FN struct vndf_render_vector vndf_render_corner(VNDF_RENDER_FROM(float) vertices, uint vertex, int member) {
    VNDF_RENDER_FROM(float) const at = vertices + VNDF_VERTEX_SIZE * vertex + member;
    return vndf_render_vector_of(at[0], at[1], at[2]);
}
VNDF_FN struct vndf_render_vector vndf_render_mix(struct vndf_render_vector a, struct vndf_render_vector b,
                                                  struct vndf_render_vector c, float b1, float b2) {
    const float b0 = 1.0f - b1 - b2;
    return vndf_render_vector_of(VNDF_FMA(b0, a.x, VNDF_FMA(b1, b.x, b2 * c.x)),
                                 VNDF_FMA(b0, a.y, VNDF_FMA(b1, b.y, b2 * c.y)),
                                 VNDF_FMA(b0, a.z, VNDF_FMA(b1, b.z, b2 * c.z)));
}

// A point of the mesh: where rays that leave it begin, and its frame: normal, tangent along the circle about the vertical, and
// what is across both.
struct vndf_render_point {
    struct vndf_render_vector at, geometric, normal, tangent, across;
    uint material;
};

// wo: towards where the path comes from. Both normals are turned to its side. The shading normal is bent until wo is one part
// in a hundred above its horizon, so that no coarse mesh has black spots.
VNDF_FN struct vndf_render_point vndf_render_point_of(VNDF_RENDER_FROM(float) vertices,
                                                      VNDF_RENDER_FROM(uint) triangles, uint triangle, float b1,
                                                      float b2, struct vndf_render_vector wo) {
    struct vndf_render_point point;
    VNDF_RENDER_FROM(uint) const corners = triangles + VNDF_TRIANGLE_SIZE * triangle;
    const uint i = corners[0], j = corners[1], k = corners[2];
    point.material = corners[VNDF_TRIANGLE_MATERIAL];
    const struct vndf_render_vector a = vndf_render_corner(vertices, i, 0), b = vndf_render_corner(vertices, j, 0),
                                    c = vndf_render_corner(vertices, k, 0);
    const struct vndf_render_vector face = vndf_render_unit_vector(
        vndf_render_cross(vndf_render_sum(b, -1.0f, a), vndf_render_sum(c, -1.0f, a)));
    const struct vndf_render_vector smooth = vndf_render_mix(
        vndf_render_corner(vertices, i, VNDF_VERTEX_NORMAL), vndf_render_corner(vertices, j, VNDF_VERTEX_NORMAL),
        vndf_render_corner(vertices, k, VNDF_VERTEX_NORMAL), b1, b2);
    const float side = vndf_render_dot(face, wo) < 0.0f ? -1.0f : 1.0f;
    point.geometric = vndf_render_vector_of(side * face.x, side * face.y, side * face.z);
    const struct vndf_render_vector turned = vndf_render_unit_vector(
        vndf_render_vector_of(side * smooth.x, side * smooth.y, side * smooth.z));
    const float lack = vndf_impl_max(0.01f - vndf_render_dot(turned, wo), 0.0f);
    point.normal = vndf_render_unit_vector(vndf_render_sum(turned, lack, wo));
    const struct vndf_render_vector n = point.normal;
    const int pole = VNDF_FMA(n.x, n.x, n.z * n.z) < 1e-12f;
    point.tangent = vndf_render_unit_vector(vndf_render_vector_of(pole ? 1.0f : n.z, 0.0f, pole ? 0.0f : -n.x));
    point.across = vndf_render_cross(n, point.tangent);
    // Rays begin beside the surface by more than the rounding of its place.
    const struct vndf_render_vector place = vndf_render_mix(a, b, c, b1, b2);
    const float size = vndf_impl_max(vndf_impl_max(vndf_impl_abs(place.x), vndf_impl_abs(place.y)),
                                     vndf_impl_max(vndf_impl_abs(place.z), 1e-3f));
    point.at = vndf_render_sum(place, 2e-6f * size, point.geometric);
    return point;
}

VNDF_FN VNDF_REAL3 vndf_render_local(struct vndf_render_point p, struct vndf_render_vector w) {
    return VNDF_MAKE3(vndf_render_dot(w, p.tangent), vndf_render_dot(w, p.across), vndf_render_dot(w, p.normal));
}

VNDF_RENDER_KERNEL vndf_render_shade(VNDF_RENDER_IN(float) vertices, VNDF_RENDER_IN(uint) triangles,
                                     VNDF_RENDER_IN(float) materials, VNDF_RENDER_IN(uint) words, const uint quad,
                                     VNDF_RENDER_IN(float) hit, VNDF_RENDER_IN(uint) triangle,
                                     VNDF_RENDER_IN(float) lights, VNDF_RENDER_IN(uint) slot, const uint first,
                                     const uint count, const uint stride, const int roulette,
                                     VNDF_RENDER_OUT(float) path, VNDF_RENDER_OUT(float) shadow,
                                     VNDF_RENDER_OUT(uint) alive) {
    const uint i = VNDF_RENDER_ITEM;
    const int met = i < count && triangle[i] != VNDF_MISS;
    const struct vndf_render_vector wo =
        vndf_render_vector_of(-path[VNDF_PATH_DX * stride + i], -path[VNDF_PATH_DY * stride + i],
                              -path[VNDF_PATH_DZ * stride + i]);
    const struct vndf_render_point p =
        vndf_render_point_of(vertices, triangles, met ? triangle[i] : 0, hit[VNDF_HIT_B1 * stride + i],
                             hit[VNDF_HIT_B2 * stride + i], wo);
    const struct vndf_render_bsdf bsdf = vndf_render_bsdf_of(materials + VNDF_MATERIAL_SIZE * p.material);
    const VNDF_REAL3 wo_local = vndf_render_local(p, wo);
    const float red = path[VNDF_PATH_RED * stride + i], green = path[VNDF_PATH_GREEN * stride + i],
                blue = path[VNDF_PATH_BLUE * stride + i];

    // Towards the light.
    const struct vndf_render_vector to_light =
        vndf_render_vector_of(lights[VNDF_LIGHT_DX * stride + i], lights[VNDF_LIGHT_DY * stride + i],
                              lights[VNDF_LIGHT_DZ * stride + i]);
    const struct vndf_render_value lit = vndf_render_evaluate(bsdf, wo_local, vndf_render_local(p, to_light));
    // f / q times the power heuristic 1 / (1 + (p / q)^2), f = weight p, for the light's density q: never more than the weight.
    const float light_pdf = lights[VNDF_LIGHT_PDF * stride + i];
    const float ratio = vndf_impl_min(lit.pdf / vndf_impl_max(light_pdf, 1e-12f), 1e15f);
    const float share = ratio * vndf_render_mis(ratio);
    const int reached = met && light_pdf > 0.0f && vndf_render_dot(to_light, p.geometric) > 0.0f;
    shadow[VNDF_SHADOW_X * stride + i] = p.at.x;
    shadow[VNDF_SHADOW_Y * stride + i] = p.at.y;
    shadow[VNDF_SHADOW_Z * stride + i] = p.at.z;
    shadow[VNDF_SHADOW_DX * stride + i] = to_light.x;
    shadow[VNDF_SHADOW_DY * stride + i] = to_light.y;
    shadow[VNDF_SHADOW_DZ * stride + i] = to_light.z;
    shadow[VNDF_SHADOW_RED * stride + i] =
        reached ? red * lit.red * share * lights[VNDF_LIGHT_RED * stride + i] : 0.0f;
    shadow[VNDF_SHADOW_GREEN * stride + i] =
        reached ? green * lit.green * share * lights[VNDF_LIGHT_GREEN * stride + i] : 0.0f;
    shadow[VNDF_SHADOW_BLUE * stride + i] =
        reached ? blue * lit.blue * share * lights[VNDF_LIGHT_BLUE * stride + i] : 0.0f;

    // And on.
    const struct vndf_render_quad u = vndf_render_random(words + VNDF_QUAD_WORDS * quad, first + slot[i]);
    const struct vndf_render_scattered wi = vndf_render_scatter(bsdf, wo_local, u.a, u.b);
    const struct vndf_render_vector on = vndf_render_unit_vector(vndf_render_sum(
        vndf_render_sum(vndf_render_vector_of(wi.x * p.tangent.x, wi.x * p.tangent.y, wi.x * p.tangent.z), wi.y,
                        p.across),
        wi.z, p.normal));
    const float next_red = red * wi.value.red, next_green = green * wi.value.green,
                next_blue = blue * wi.value.blue;
    const float brightest = vndf_impl_max(vndf_impl_max(next_red, next_green), next_blue);
    // Paths that carry little end early, and those that do not carry what they would have.
    const float chance = roulette ? vndf_impl_min(brightest, 1.0f) : 1.0f;
    const int goes_on = met && brightest > 0.0f && u.d < chance && vndf_render_dot(on, p.geometric) > 0.0f;
    const float raised = 1.0f / (goes_on ? chance : 1.0f);
    path[VNDF_PATH_X * stride + i] = p.at.x;
    path[VNDF_PATH_Y * stride + i] = p.at.y;
    path[VNDF_PATH_Z * stride + i] = p.at.z;
    path[VNDF_PATH_DX * stride + i] = on.x;
    path[VNDF_PATH_DY * stride + i] = on.y;
    path[VNDF_PATH_DZ * stride + i] = on.z;
    path[VNDF_PATH_RED * stride + i] = next_red * raised;
    path[VNDF_PATH_GREEN * stride + i] = next_green * raised;
    path[VNDF_PATH_BLUE * stride + i] = next_blue * raised;
    path[VNDF_PATH_PDF * stride + i] = vndf_impl_max(wi.value.pdf, 1e-12f);
    alive[i] = goes_on ? 1u : 0u;
}

#endif
