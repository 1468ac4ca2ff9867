// Stages: directions towards the lights, and the light of the paths that leave the scene.
//
// A sample goes to one kind of light, each with its share (vndf_render_sky): to the sun; to the sky above the horizon by its
// cosine, or to the environment by its brightness (environment.h); to a triangle that shines; to a light at a point; to a sphere
// (spheres.h). What counts for the first two, which are at infinity, is the density of both together, unless the sun is sampled
// alone (VNDF_RENDER_CAPS_ALONE).
#ifndef VNDF_RENDER_LIGHTS_H
#define VNDF_RENDER_LIGHTS_H

#include "effects.h"
#if VNDF_RENDER_ENVIRONMENT
#include "environment.h"
#endif
#include "meet.h"
#include "random.h"
#include "spheres.h"
#include "texture.h"

// What comes from a direction at infinity, and the density with which it is sampled.
struct vndf_render_far {
    struct vndf_render_vector radiance;
    float pdf;
};

// A sample of light: `pdf` as VNDF_LIGHT_PDF.
struct vndf_render_lit {
    struct vndf_render_vector direction, radiance;
    float pdf, distance;
};

#if VNDF_RENDER_SUN
VNDF_FN struct vndf_render_vector vndf_render_sun(struct vndf_render_sky sky) {
    return vndf_render_vector_of(sky.sun_x, sky.sun_y, sky.sun_z);
}
VNDF_FN int vndf_render_in_sun(struct vndf_render_sky sky, struct vndf_render_vector w) {
    return vndf_render_gap(vndf_render_sun(sky), w) <= sky.sun_gap;
}
// Of even samples of it.
VNDF_FN float vndf_render_sun_pdf(struct vndf_render_sky sky) {
    return sky.sun_share / (2.0f * VNDF_PI * sky.sun_gap);
}
#endif

#if VNDF_RENDER_SKY
// One channel of the sky.
VNDF_FN float vndf_render_radiance(float zenith, float horizon, float ground, float low4, int above) {
    return above ? VNDF_FMA(horizon - zenith, low4, zenith) : ground;
}

// (1 - up)^4.
VNDF_FN float vndf_render_low4(float up) {
    const float low2 = vndf_impl_square(1.0f - up);
    return low2 * low2;
}
#endif

VNDF_FN struct vndf_render_far vndf_render_far_of(struct vndf_render_sky sky, VNDF_RENDER_FROM(float) around,
                                                  VNDF_RENDER_FROM(float) around_pdf,
                                                  struct vndf_render_vector w) {
    float pdf = 0.0f;
    struct vndf_render_vector radiance = vndf_render_vector_of(0.0f, 0.0f, 0.0f);
#if VNDF_RENDER_SKY
    const int above = w.y >= 0.0f;
    const float low4 = vndf_render_low4(w.y);
    pdf = VNDF_1_PI * vndf_impl_max(w.y, 0.0f);
    radiance = vndf_render_vector_of(
        vndf_render_radiance(sky.zenith_red, sky.horizon_red, sky.ground_red, low4, above),
        vndf_render_radiance(sky.zenith_green, sky.horizon_green, sky.ground_green, low4, above),
        vndf_render_radiance(sky.zenith_blue, sky.horizon_blue, sky.ground_blue, low4, above));
#endif
#if VNDF_RENDER_ENVIRONMENT
    const int there = sky.side > 0;
    const uint side = there ? sky.side : 1;
    const struct vndf_render_vector image = vndf_render_env_radiance(around, side, w);
    const float image_pdf = vndf_render_env_pdf(around_pdf, side, w);
    radiance = vndf_render_vector_of(there ? image.x : radiance.x, there ? image.y : radiance.y,
                                     there ? image.z : radiance.z);
    pdf = there ? image_pdf : pdf;
#else
    (void)around;
    (void)around_pdf;
    (void)w;
#endif
    struct vndf_render_far far;
#if VNDF_RENDER_SUN && !VNDF_RENDER_CAPS_ALONE
    const int in_sun = vndf_render_in_sun(sky, w);
    const float sun = in_sun ? vndf_render_sun_pdf(sky) : 0.0f;
    far.radiance = vndf_render_vector_of(radiance.x + (in_sun ? sky.sun_red : 0.0f),
                                         radiance.y + (in_sun ? sky.sun_green : 0.0f),
                                         radiance.z + (in_sun ? sky.sun_blue : 0.0f));
    far.pdf = VNDF_FMA(pdf, sky.sky_share, sun);
#else
    far.radiance = radiance;
    far.pdf = pdf * sky.sky_share;
#endif
    return far;
}

// About the zenith, even in cos^2; or about the middle of the sun, even in 1 - cos.
VNDF_FN struct vndf_render_toward vndf_render_up_or_sun(struct vndf_render_sky sky, int to_sun, float b) {
    struct vndf_render_toward to;
#if VNDF_RENDER_SUN
    to.gap = to_sun ? b * sky.sun_gap : 1.0f - VNDF_SQRT(b);
    to.axis = vndf_render_vector_of(to_sun ? sky.sun_x : 0.0f, to_sun ? sky.sun_y : 1.0f,
                                    to_sun ? sky.sun_z : 0.0f);
#else
    (void)sky;
    (void)to_sun;
    to.gap = 1.0f - VNDF_SQRT(b);
    to.axis = vndf_render_vector_of(0.0f, 1.0f, 0.0f);
#endif
    return to;
}

#if VNDF_RENDER_LAMP
// What a surface shines with at a place.
VNDF_FN struct vndf_render_vector vndf_render_shining(struct vndf_render_looks looks,
                                                      struct vndf_render_spot spot,
                                                      VNDF_RENDER_FROM(float) materials) {
    const uint count = looks.sizes.materials;
    // As vndf_render_rgb_at.
    const float one = looks.sizes.one;
    struct vndf_render_vector own =
        vndf_render_vector_of(materials[VNDF_MATERIAL_EMISSION * count + spot.material],
                              one * materials[(VNDF_MATERIAL_EMISSION + 1) * count + spot.material],
                              one * (one * materials[(VNDF_MATERIAL_EMISSION + 2) * count + spot.material]));
#if VNDF_RENDER_EMISSION_TEXTURE || VNDF_RENDER_VERTEX_COLOUR
    const struct vndf_render_vector look = vndf_render_emission_look(looks, spot, 1.0f);
    own = vndf_render_vector_of(own.x * look.x, own.y * look.y, own.z * look.z);
#endif
    return own;
}

// Towards a triangle that shines, picked by its chance, and a point of it, even in area.
VNDF_FN struct vndf_render_lit vndf_render_to_lamp(struct vndf_render_looks looks,
                                                   VNDF_RENDER_FROM(float) materials,
                                                   VNDF_RENDER_FROM(float) lamps,
                                                   VNDF_RENDER_FROM(uint) lamp_numbers, uint count,
                                                   struct vndf_render_vector from,
                                                   struct vndf_render_quad pick, float d, float e) {
    const uint first = vndf_render_row_by(pick.a, count);
    const uint lamp = pick.b < lamps[VNDF_LAMP_KEEP * count + first]
                          ? first
                          : lamp_numbers[VNDF_LAMP_OTHER * count + first];
    const uint triangle = lamp_numbers[VNDF_LAMP_TRIANGLE * count + lamp];
    const float root = VNDF_SQRT(d), b2 = root * e, b1 = root - b2;
    const struct vndf_render_spot spot = vndf_render_spot_of(looks, triangle, b1, b2);
    const struct vndf_render_vector a = vndf_render_vector_at(looks.vertices, VNDF_VERTEX_PLACE,
                                                              looks.sizes.vertices, spot.first),
                                    b = vndf_render_vector_at(looks.vertices, VNDF_VERTEX_PLACE,
                                                              looks.sizes.vertices, spot.second),
                                    c = vndf_render_vector_at(looks.vertices, VNDF_VERTEX_PLACE,
                                                              looks.sizes.vertices, spot.third);
    const struct vndf_render_vector ab = vndf_render_sum(b, -1.0f, a), ac = vndf_render_sum(c, -1.0f, a);
    const struct vndf_render_vector way =
        vndf_render_sum(vndf_render_sum(vndf_render_sum(a, b1, ab), b2, ac), -1.0f, from);
    const float square = vndf_render_dot(way, way);
    struct vndf_render_lit lit;
    lit.distance = VNDF_SQRT(square);
    lit.direction = vndf_render_unit_vector(way);
    // Times twice the area.
    const float cosine = vndf_impl_abs(vndf_render_dot(vndf_render_cross(ab, ac), lit.direction));
    lit.pdf = vndf_impl_min(
        lamps[VNDF_LAMP_TWICE_CHANCE * count + lamp] * square / vndf_impl_max(cosine, 1e-30f), 1e30f);
    lit.radiance = vndf_render_shining(looks, spot, materials);
    return lit;
}
#endif

#if VNDF_RENDER_POINT_LIGHT
// Towards a light at a point, or at infinity. The radiance is the irradiance that it makes where it is faced.
// Source: KHR_lights_punctual.
VNDF_FN struct vndf_render_lit vndf_render_to_point(VNDF_RENDER_FROM(float) points, uint count,
                                                    struct vndf_render_vector from,
                                                    struct vndf_render_quad pick) {
    const uint row = vndf_render_row_picked(points, VNDF_POINT_KEEP, VNDF_POINT_OTHER, count, pick);
    const struct vndf_render_vector axis = vndf_render_vector_at(points, VNDF_POINT_AXIS, count, row);
    const struct vndf_render_vector way =
        vndf_render_sum(vndf_render_vector_at(points, VNDF_POINT_PLACE, count, row), -1.0f, from);
    const int far = points[VNDF_POINT_FAR * count + row] > 0.0f;
    const float square = vndf_render_dot(way, way);
    const struct vndf_render_vector unit = vndf_render_unit_vector(way);
    struct vndf_render_lit lit;
    lit.direction =
        vndf_render_vector_of(far ? -axis.x : unit.x, far ? -axis.y : unit.y, far ? -axis.z : unit.z);
    lit.distance = far ? VNDF_RENDER_ANYWHERE : VNDF_SQRT(square);
    const float part =
        vndf_render_spot_part(points[VNDF_POINT_SLOPE * count + row], -vndf_render_dot(lit.direction, axis),
                              points[VNDF_POINT_OFFSET * count + row]);
    const float scale = part / (far || square == 0.0f ? 1.0f : square);
    lit.radiance = vndf_render_scaled(scale, vndf_render_vector_at(points, VNDF_POINT_RED, count, row));
    lit.pdf = -points[VNDF_POINT_CHANCE * count + row];
    return lit;
}
#endif

// The sample of another kind of light in this one's place, if `other`.
VNDF_FN struct vndf_render_lit vndf_render_rather(struct vndf_render_lit own, struct vndf_render_lit its,
                                                  float share, int other) {
    struct vndf_render_lit lit;
    lit.direction = vndf_render_either(its.direction, own.direction, other);
    lit.radiance = vndf_render_either(its.radiance, own.radiance, other);
    lit.pdf = other ? share * its.pdf : own.pdf;
    lit.distance = other ? its.distance : own.distance;
    return lit;
}

VNDF_RENDER_KERNEL vndf_render_lights(
    const struct vndf_render_sky sky, VNDF_RENDER_IN(float) around, VNDF_RENDER_IN(float) around_pdf,
    VNDF_RENDER_IN(float) around_keep, VNDF_RENDER_IN(uint) around_other, VNDF_RENDER_IN(float) lamps,
    VNDF_RENDER_IN(uint) lamp_numbers, VNDF_RENDER_IN(float) points, VNDF_RENDER_IN(float) spheres,
    const struct vndf_render_sizes sizes, VNDF_RENDER_IN(float) vertices, VNDF_RENDER_IN(uint) triangles,
    VNDF_RENDER_IN(float) dressings, VNDF_RENDER_IN(uint) textures, VNDF_RENDER_IN(uint) texels,
    VNDF_RENDER_IN(float) materials, VNDF_RENDER_IN(uint) words, const uint quad, const uint pick_quad,
    VNDF_RENDER_IN(uint) slot, const uint first, VNDF_RENDER_IN(float) surface, VNDF_RENDER_IN(float) path,
    const uint stride, VNDF_RENDER_OUT(float) light) {
    const uint i = VNDF_RENDER_ITEM;
    const struct vndf_render_quad u = vndf_render_random(words + VNDF_QUAD_WORDS * quad, first + slot[i]);
#if VNDF_RENDER_SUN
    const int to_sun = u.a < sky.sun_share;
#else
    const int to_sun = 0;
#endif
    struct vndf_render_toward to = vndf_render_up_or_sun(sky, to_sun, u.b);
#if VNDF_RENDER_PICKED_LIGHT
    const struct vndf_render_quad pick =
        vndf_render_random(words + VNDF_QUAD_WORDS * pick_quad, first + slot[i]);
#else
    (void)pick_quad;
#endif
#if VNDF_RENDER_NEAR_LIGHT
    const struct vndf_render_vector from = vndf_render_vector_at(path, VNDF_PATH_X, stride, i);
    const float beyond = u.a - sky.sun_share - sky.sky_share;
#else
    (void)path;
#endif
#if VNDF_RENDER_SPHERE_LIGHT
    const struct vndf_render_ball ball = vndf_render_ball_picked(spheres, sky.spheres, from, pick);
    const int to_ball = beyond >= sky.lamp_share + sky.point_share && sky.spheres > 0;
    to.axis = vndf_render_either(ball.axis, to.axis, to_ball);
    to.gap = to_ball ? u.b * ball.gap : to.gap;
#else
    (void)spheres;
#endif
#if VNDF_RENDER_CONES
    // In the middle of what the stage cones draws from.
#if VNDF_RENDER_SUN
    to.gap = to_sun ? 0.0f : to.gap;
#endif
#if VNDF_RENDER_SPHERE_LIGHT
    to.gap = to_ball ? 0.0f : to.gap;
#endif
#endif
    const struct vndf_render_vector about = vndf_render_about(to, u.c);
    struct vndf_render_lit lit;
    lit.direction = about;
#if VNDF_RENDER_ENVIRONMENT
#if VNDF_RENDER_SPHERE_LIGHT
    const int by_image = !to_sun && !to_ball && sky.side > 0;
#else
    const int by_image = !to_sun && sky.side > 0;
#endif
    const struct vndf_render_vector image =
        vndf_render_env_sample(around, around_pdf, around_keep, around_other, sky.side > 0 ? sky.side : 1,
                               pick.a, pick.b, u.b, u.c)
            .direction;
    lit.direction = vndf_render_either(image, lit.direction, by_image);
#else
    (void)around_keep;
    (void)around_other;
#endif
    const struct vndf_render_far far = vndf_render_far_of(sky, around, around_pdf, lit.direction);
    lit.radiance = far.radiance;
    lit.pdf = far.pdf;
    lit.distance = VNDF_RENDER_ANYWHERE;
#if VNDF_RENDER_SUN && VNDF_RENDER_CAPS_ALONE
    const float sun_pdf = VNDF_RENDER_CONES ? sky.sun_share : -vndf_render_sun_pdf(sky);
    lit.radiance = vndf_render_either(vndf_render_vector_of(sky.sun_red, sky.sun_green, sky.sun_blue),
                                      lit.radiance, to_sun);
    lit.pdf = to_sun ? sun_pdf : lit.pdf;
#endif
#if VNDF_RENDER_LAMP
    const struct vndf_render_looks looks =
        vndf_render_looks_of(sizes, vertices, triangles, dressings, textures, texels);
    lit = vndf_render_rather(
        lit, vndf_render_to_lamp(looks, materials, lamps, lamp_numbers, sky.lamps, from, pick, u.b, u.c),
        sky.lamp_share, beyond >= 0.0f && sky.lamps > 0);
#else
    (void)lamps;
    (void)lamp_numbers;
    (void)sizes;
    (void)vertices;
    (void)triangles;
    (void)dressings;
    (void)textures;
    (void)texels;
    (void)materials;
#endif
#if VNDF_RENDER_POINT_LIGHT
    lit = vndf_render_rather(lit, vndf_render_to_point(points, sky.points, from, pick), sky.point_share,
                             beyond >= sky.lamp_share && sky.points > 0);
#else
    (void)points;
#endif
#if VNDF_RENDER_SPHERE_LIGHT
    struct vndf_render_lit on_ball;
    on_ball.direction = about;
    on_ball.radiance = ball.radiance;
    on_ball.distance = VNDF_RENDER_CONES ? ball.distance : vndf_render_ball_way(ball, to.gap);
    on_ball.pdf = VNDF_RENDER_CONES        ? ball.chance
                  : VNDF_RENDER_CAPS_ALONE ? -vndf_render_ball_pdf(ball)
                                           : vndf_render_ball_pdf(ball);
    lit = vndf_render_rather(lit, on_ball, sky.sphere_share, to_ball);
#endif
#if VNDF_RENDER_CONES
    float gap = 0.0f;
#if VNDF_RENDER_SUN
    gap = to_sun ? sky.sun_gap : gap;
#endif
#if VNDF_RENDER_SPHERE_LIGHT
    gap = to_ball ? ball.gap : gap;
#endif
    light[VNDF_LIGHT_GAP * stride + i] = gap;
#endif
    vndf_render_store(lit.direction, light, VNDF_LIGHT_DX, stride, i);
    vndf_render_store(lit.radiance, light, VNDF_LIGHT_RED, stride, i);
    light[VNDF_LIGHT_PDF * stride + i] = lit.pdf;
#if VNDF_RENDER_NEAR_LIGHT
    light[VNDF_LIGHT_DISTANCE * stride + i] = lit.distance;
#endif
    const struct vndf_render_vector framed =
        vndf_render_local(vndf_render_vector_at(surface, VNDF_SURFACE_NORMAL, stride, i),
                          vndf_render_vector_at(surface, VNDF_SURFACE_TANGENT, stride, i), lit.direction);
    vndf_render_store(framed, light, VNDF_LIGHT_X, stride, i);
}

VNDF_RENDER_KERNEL vndf_render_leave(const struct vndf_render_sky sky, VNDF_RENDER_IN(float) around,
                                     VNDF_RENDER_IN(float) around_pdf, VNDF_RENDER_IN(float) path,
                                     VNDF_RENDER_IN(uint) triangle, VNDF_RENDER_IN(uint) slot,
                                     const uint count, const uint stride, VNDF_RENDER_OUT(float) light) {
    const uint i = VNDF_RENDER_ITEM;
    const struct vndf_render_vector w = vndf_render_vector_at(path, VNDF_PATH_DX, stride, i);
    const struct vndf_render_far far = vndf_render_far_of(sky, around, around_pdf, w);
    const float weight = vndf_render_mis(far.pdf / vndf_render_path_pdf(path, stride, i));
    const int left = triangle[i] == VNDF_MISS && i < count;
#if VNDF_RENDER_SUN && VNDF_RENDER_CAPS_ALONE
    const float meets = vndf_render_meets_cap(vndf_render_sun_pdf(sky), sky.sun_share, path, stride, i);
    vndf_render_add_light(vndf_render_vector_of(sky.sun_red, sky.sun_green, sky.sun_blue),
                          left && vndf_render_in_sun(sky, w) ? meets : 0.0f, path, slot, count, stride, i,
                          light);
#endif
    vndf_render_add_light(far.radiance, left ? weight : 0.0f, path, slot, count, stride, i, light);
}

#endif
