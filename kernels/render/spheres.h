// Lights that are spheres: a point or spot light with a radius. Their samples, and the stage in which paths meet them.
//
// A sphere shines outwards, evenly: from a place it is a cap of directions of one radiance, I / (pi R^2) of the point light's candela I,
// which lights a surface that faces it by I / d^2 as the point does. A spot keeps its cone, by the direction from the centre to
// the place. A light hides nothing and has no shadow: what is behind it is seen through it, so that each is by itself.
#ifndef VNDF_RENDER_SPHERES_H
#define VNDF_RENDER_SPHERES_H

#include "effects.h"
#include "material.h"
#include "media.h"
#include "meet.h"
#include "random.h"
#include "vector.h"

#if VNDF_RENDER_NEAR_LIGHT
// Which of `count` rows to look at first, by a number in [0, 1).
VNDF_FN uint vndf_render_row_by(float a, uint count) {
    const uint row = (uint)(int)(a * (float)(int)count);
    return row < count ? row : (count > 0 ? count - 1 : 0);
}

// The row that an alias table picks, whose chances to keep a row and other rows are in these planes.
VNDF_FN uint vndf_render_row_picked(VNDF_RENDER_FROM(float) rows, int keep, int other, uint count,
                                    struct vndf_render_quad pick) {
    const uint first = vndf_render_row_by(pick.a, count);
    return pick.b < rows[keep * count + first] ? first : (uint)(int)rows[other * count + first];
}

// The part of a spot's light in a direction of this cosine with its axis.
// Source: KHR_lights_punctual.
VNDF_FN float vndf_render_spot_part(float slope, float cosine, float offset) {
    const float part = vndf_impl_max(vndf_impl_min(VNDF_FMA(slope, cosine, offset), 1.0f), 0.0f);
    return part * part;
}
#endif

#if VNDF_RENDER_SPHERE_LIGHT

// A sphere as a place sees it; from within it is nothing.
struct vndf_render_ball {
    struct vndf_render_vector axis;  // to its centre
    float distance, gap;             // of the centre; 1 - cos of the half angle of the cap
    struct vndf_render_vector radiance;
    float chance;  // to be picked
};
VNDF_FN struct vndf_render_ball vndf_render_ball_of(VNDF_RENDER_FROM(float) spheres, uint count, uint row,
                                                    struct vndf_render_vector from) {
    const struct vndf_render_vector axis = vndf_render_vector_at(spheres, VNDF_SPHERE_AXIS, count, row),
                                    way = vndf_render_sum(
                                        vndf_render_vector_at(spheres, VNDF_SPHERE_PLACE, count, row), -1.0f,
                                        from);
    const float radius = spheres[VNDF_SPHERE_RADIUS * count + row];
    const float square = vndf_render_dot(way, way);
    struct vndf_render_ball ball;
    ball.distance = VNDF_SQRT(square);
    const int outside = ball.distance > radius;
    ball.axis = vndf_render_scaled(1.0f / (outside ? ball.distance : 1.0f), way);
    const float sine = outside ? radius / ball.distance : 0.0f;
    const float cosine = VNDF_SQRT((1.0f - sine) * (1.0f + sine));
    ball.gap = sine * sine / (1.0f + cosine);
    const float part =
        vndf_render_spot_part(spheres[VNDF_SPHERE_SLOPE * count + row], -vndf_render_dot(ball.axis, axis),
                              spheres[VNDF_SPHERE_OFFSET * count + row]);
    ball.radiance = vndf_render_scaled(outside ? part : 0.0f,
                                       vndf_render_vector_at(spheres, VNDF_SPHERE_RED, count, row));
    ball.chance = outside ? spheres[VNDF_SPHERE_CHANCE * count + row] : 0.0f;
    return ball;
}

// One of them, by its chance.
VNDF_FN struct vndf_render_ball vndf_render_ball_picked(VNDF_RENDER_FROM(float) spheres, uint count,
                                                        struct vndf_render_vector from,
                                                        struct vndf_render_quad pick) {
    const uint row = vndf_render_row_picked(spheres, VNDF_SPHERE_KEEP, VNDF_SPHERE_OTHER, count, pick);
    return vndf_render_ball_of(spheres, count, row, from);
}

// Of even samples of its cap.
VNDF_FN float vndf_render_ball_pdf(struct vndf_render_ball ball) {
    return vndf_impl_min(ball.chance / (2.0f * VNDF_PI * vndf_impl_max(ball.gap, 1e-30f)), 1e30f);
}

// How far it is to a sphere whose centre is at this distance and whose cap has this 1 - cos, in a direction with another to its centre.
VNDF_FN float vndf_render_sphere_way(float distance, float cap, float gap) {
    const float depth2 = cap * (2.0f - cap) - gap * (2.0f - gap);
    return distance * ((1.0f - gap) - VNDF_SQRT(vndf_impl_max(depth2, 0.0f)));
}
VNDF_FN float vndf_render_ball_way(struct vndf_render_ball ball, float gap) {
    return vndf_render_sphere_way(ball.distance, ball.gap, gap);
}

// What paths meet of one sphere, before what they hit. A launch for each: without a loop over them it is vectorised.
VNDF_RENDER_KERNEL vndf_render_spheres(const struct vndf_render_sky sky, VNDF_RENDER_IN(float) spheres,
                                       const uint row, const struct vndf_render_sizes sizes,
                                       VNDF_RENDER_IN(float) materials, VNDF_RENDER_IN(float) hit,
                                       VNDF_RENDER_IN(float) path, VNDF_RENDER_IN(uint) slot,
                                       const uint count, const uint stride, VNDF_RENDER_OUT(float) light) {
    const uint i = VNDF_RENDER_ITEM;
    const struct vndf_render_ball ball =
        vndf_render_ball_of(spheres, sky.spheres, row, vndf_render_vector_at(path, VNDF_PATH_X, stride, i));
    const float gap = vndf_render_gap(ball.axis, vndf_render_vector_at(path, VNDF_PATH_DX, stride, i));
    const int met = i < count && ball.chance > 0.0f && gap <= ball.gap &&
                    vndf_render_ball_way(ball, gap) < hit[VNDF_HIT_WAY * stride + i];
    const float weight = vndf_render_meets_cap(sky.sphere_share * vndf_render_ball_pdf(ball),
                                               sky.sphere_share * ball.chance, path, stride, i);
    struct vndf_render_vector radiance = ball.radiance;
#if VNDF_DIELECTRIC && VNDF_ABSORPTION
    // As lights that are sampled: from forever away.
    const struct vndf_rgb left =
        vndf_render_left(sizes, materials, path[VNDF_PATH_BODY * stride + i], VNDF_RENDER_FOREVER);
    radiance = vndf_render_vector_of(radiance.x * left.r, radiance.y * left.g, radiance.z * left.b);
#else
    (void)sizes;
    (void)materials;
#endif
    vndf_render_add_light(radiance, met ? weight : 0.0f, path, slot, count, stride, i, light);
}

#endif

#endif
