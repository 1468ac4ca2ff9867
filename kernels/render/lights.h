// Stages: directions towards the lights, and the light of the paths that leave the scene.
//
// The lights are the sky and a sun in it, both at infinity. A sample goes to the sun with the probability sun_share, else to
// the sky above the horizon by its cosine; what counts is the density of both together.
#ifndef VNDF_RENDER_LIGHTS_H
#define VNDF_RENDER_LIGHTS_H

#include "random.h"
#include "vector.h"

// 1 - cos of the angle to the middle of the sun, of directions near it without cancellation.
VNDF_FN float vndf_render_gap(struct vndf_render_sky sky, float x, float y, float z) {
    const float dx = x - sky.sun_x, dy = y - sky.sun_y, dz = z - sky.sun_z;
    return 0.5f * VNDF_FMA(dx, dx, VNDF_FMA(dy, dy, dz * dz));
}

VNDF_FN float vndf_render_light_pdf(struct vndf_render_sky sky, float up, int in_sun) {
    const float sun = in_sun ? sky.sun_share / (2.0f * VNDF_PI * sky.sun_gap) : 0.0f;
    return VNDF_FMA(VNDF_1_PI * vndf_impl_max(up, 0.0f), 1.0f - sky.sun_share, sun);
}

// One channel of the sky.
VNDF_FN float vndf_render_radiance(float zenith, float horizon, float ground, float low4, int above,
                                   float sun, int in_sun) {
    return (above ? VNDF_FMA(horizon - zenith, low4, zenith) : ground) + (in_sun ? sun : 0.0f);
}

// (1 - up)^4.
VNDF_FN float vndf_render_low4(float up) {
    const float low2 = vndf_impl_square(1.0f - up);
    return low2 * low2;
}

VNDF_RENDER_KERNEL vndf_render_lights(const struct vndf_render_sky sky, VNDF_RENDER_IN(uint) words,
                                      const uint quad, VNDF_RENDER_IN(uint) slot, const uint first,
                                      VNDF_RENDER_IN(float) surface, const uint stride,
                                      VNDF_RENDER_OUT(float) light) {
    const uint i = VNDF_RENDER_ITEM;
    const struct vndf_render_quad u = vndf_render_random(words + VNDF_QUAD_WORDS * quad, first + slot[i]);
    const int to_sun = u.a < sky.sun_share;
    // About the middle of the sun, even in 1 - cos; about the zenith, even in cos^2.
    const float gap = to_sun ? u.b * sky.sun_gap : 1.0f - VNDF_SQRT(u.b);
    const float radius = VNDF_SQRT(gap * (2.0f - gap)), height = 1.0f - gap;
    const float a = radius * vndf_impl_circle_cos(u.c), b = radius * vndf_impl_circle_sin(u.c);
    const float nx = to_sun ? sky.sun_x : 0.0f, ny = to_sun ? sky.sun_y : 1.0f,
                nz = to_sun ? sky.sun_z : 0.0f;
    // Duff et al., Building an Orthonormal Basis, Revisited, 2017, about y, which is up.
    const float s = ny < 0.0f ? -1.0f : 1.0f, k = -1.0f / (s + ny), c = nx * nz * k;
    const float x = VNDF_FMA(a, VNDF_FMA(s * nx * nx, k, 1.0f), VNDF_FMA(b, c, height * nx));
    const float y = VNDF_FMA(a, -s * nx, VNDF_FMA(b, -nz, height * ny));
    const float z = VNDF_FMA(a, s * c, VNDF_FMA(b, VNDF_FMA(nz * nz, k, s), height * nz));
    const int in_sun = vndf_render_gap(sky, x, y, z) <= sky.sun_gap;
    const float low4 = vndf_render_low4(y);
    const struct vndf_render_vector wi = vndf_render_vector_of(x, y, z);
    vndf_render_store(wi, light, VNDF_LIGHT_DX, stride, i);
    light[VNDF_LIGHT_RED * stride + i] = vndf_render_radiance(sky.zenith_red, sky.horizon_red, sky.ground_red,
                                                              low4, y >= 0.0f, sky.sun_red, in_sun);
    light[VNDF_LIGHT_GREEN * stride + i] = vndf_render_radiance(
        sky.zenith_green, sky.horizon_green, sky.ground_green, low4, y >= 0.0f, sky.sun_green, in_sun);
    light[VNDF_LIGHT_BLUE * stride + i] = vndf_render_radiance(
        sky.zenith_blue, sky.horizon_blue, sky.ground_blue, low4, y >= 0.0f, sky.sun_blue, in_sun);
    light[VNDF_LIGHT_PDF * stride + i] = vndf_render_light_pdf(sky, y, in_sun);
    const struct vndf_render_vector framed =
        vndf_render_local(vndf_render_vector_at(surface, VNDF_SURFACE_NORMAL, stride, i),
                          vndf_render_vector_at(surface, VNDF_SURFACE_TANGENT, stride, i), wi);
    vndf_render_store(framed, light, VNDF_LIGHT_X, stride, i);
}

// The weight of a sample with the density p beside one that has q in the same direction, by the power heuristic: from the
// ratio, since densities reach 1e38 and their squares nothing that is a number.
// Source: Veach & Guibas, Optimally Combining Sampling Techniques for Monte Carlo Rendering, 1995.
VNDF_FN float vndf_render_mis(float q_over_p) {
    const float ratio = vndf_impl_min(q_over_p, 1e15f);
    return 1.0f / VNDF_FMA(ratio, ratio, 1.0f);
}

// Adds to the light of a path's pixel what it carries of this much. Items beyond the count have a slot of their own, which nobody
// reads.
VNDF_FN void vndf_render_add_light(struct vndf_render_vector radiance, float kept,
                                   VNDF_RENDER_FROM(float) path, VNDF_RENDER_FROM(uint) slot, uint count,
                                   uint stride, uint i, VNDF_RENDER_TO(float) light) {
    const uint to = i < count ? slot[i] : stride - 1;
    light[to] += kept * path[VNDF_PATH_RED * stride + i] * radiance.x;
    light[stride + to] += kept * path[VNDF_PATH_GREEN * stride + i] * radiance.y;
    light[2 * stride + to] += kept * path[VNDF_PATH_BLUE * stride + i] * radiance.z;
}

VNDF_RENDER_KERNEL vndf_render_leave(const struct vndf_render_sky sky, VNDF_RENDER_IN(float) path,
                                     VNDF_RENDER_IN(uint) triangle, VNDF_RENDER_IN(uint) slot,
                                     const uint count, const uint stride, VNDF_RENDER_OUT(float) light) {
    const uint i = VNDF_RENDER_ITEM;
    const float x = path[VNDF_PATH_DX * stride + i], y = path[VNDF_PATH_DY * stride + i],
                z = path[VNDF_PATH_DZ * stride + i];
    const int in_sun = vndf_render_gap(sky, x, y, z) <= sky.sun_gap;
    const float pdf = vndf_render_light_pdf(sky, y, in_sun), low4 = vndf_render_low4(y);
    const float weight = vndf_render_mis(pdf / path[VNDF_PATH_PDF * stride + i]);
    const int left = triangle[i] == VNDF_MISS && i < count;
    const struct vndf_render_vector radiance =
        vndf_render_vector_of(vndf_render_radiance(sky.zenith_red, sky.horizon_red, sky.ground_red, low4,
                                                   y >= 0.0f, sky.sun_red, in_sun),
                              vndf_render_radiance(sky.zenith_green, sky.horizon_green, sky.ground_green,
                                                   low4, y >= 0.0f, sky.sun_green, in_sun),
                              vndf_render_radiance(sky.zenith_blue, sky.horizon_blue, sky.ground_blue, low4,
                                                   y >= 0.0f, sky.sun_blue, in_sun));
    vndf_render_add_light(radiance, left ? weight : 0.0f, path, slot, count, stride, i, light);
}

#endif
