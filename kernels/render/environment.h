// Light from all around: what an image of the environment has in a direction, and directions drawn by its brightness.
//
// The square of octahedral.h in side * side cells (a power of two, at most 1024). radiance: red, green and blue of their middles,
// (side + 2)^2 each, with what is beyond the edges around them; between the middles it is interpolated. pdf, keep and other: one
// for each cell; cell i is drawn with the density pdf[i] by Walker's alias method: it is kept with the probability
// keep[i], or else is other[i].
#ifndef VNDF_RENDER_ENVIRONMENT_H
#define VNDF_RENDER_ENVIRONMENT_H

#include "octahedral.h"

struct vndf_render_env_draw {
    struct vndf_render_vector direction, radiance;
    float pdf;  // per steradian
};

// One channel between four middles.
VNDF_FN float vndf_render_env_between(VNDF_RENDER_FROM(float) texels, uint low, uint across, uint up, float s,
                                      float t) {
    const float a = texels[low], b = texels[low + across], c = texels[low + up],
                d = texels[low + up + across];
    const float below = VNDF_FMA(s, b - a, a), above = VNDF_FMA(s, d - c, c);
    return VNDF_FMA(t, above - below, below);
}

// What comes from a place of the square.
VNDF_FN struct vndf_render_vector vndf_render_env_at(VNDF_RENDER_FROM(float) radiance, uint side,
                                                     struct vndf_render_place p) {
    // The middle of cell i, counted from the border, is at i.
    const float x = VNDF_FMA(p.x, (float)(int)side, 0.5f), y = VNDF_FMA(p.y, (float)(int)side, 0.5f);
    const int column = (int)x, row = (int)y;
    const float s = x - (float)column, t = y - (float)row;
    // 1, as the compiler does not know, which would load two neighbours as one vector, and PoCL then not vectorise.
    const uint across = side > 0 ? 1u : 0u;
    const uint stride = side + 2, plane = stride * stride, low = (uint)row * stride + (uint)column;
    return vndf_render_vector_of(vndf_render_env_between(radiance, low, across, stride, s, t),
                                 vndf_render_env_between(radiance, plane + low, across, stride, s, t),
                                 vndf_render_env_between(radiance, 2 * plane + low, across, stride, s, t));
}

// What comes from a direction.
VNDF_FN struct vndf_render_vector vndf_render_env_radiance(VNDF_RENDER_FROM(float) radiance, uint side,
                                                           struct vndf_render_vector direction) {
    return vndf_render_env_at(radiance, side, vndf_render_octahedral_place(direction));
}

// The density with which a direction is drawn.
VNDF_FN float vndf_render_env_pdf(VNDF_RENDER_FROM(float) pdf, uint side,
                                  struct vndf_render_vector direction) {
    const struct vndf_render_place p = vndf_render_octahedral_place(direction);
    const float last = (float)(int)(side - 1);
    const int column = (int)vndf_impl_min(p.x * (float)(int)side, last),
              row = (int)vndf_impl_min(p.y * (float)(int)side, last);
    return pdf[(uint)row * side + (uint)column];
}

// A direction by four numbers in [0, 1): the cell, whether it is kept, and the place in it.
VNDF_FN struct vndf_render_env_draw vndf_render_env_sample(VNDF_RENDER_FROM(float) radiance,
                                                           VNDF_RENDER_FROM(float) pdf,
                                                           VNDF_RENDER_FROM(float) keep,
                                                           VNDF_RENDER_FROM(uint) other, uint side, float b,
                                                           float c, float d, float e) {
    const uint first = (uint)(int)(b * (float)(int)(side * side));
    const uint cell = c < keep[first] ? first : other[first];
    const float size = 1.0f / (float)(int)side;
    const uint row = (uint)(int)((float)(int)cell * size), column = cell - row * side;  // exactly
    struct vndf_render_place p;
    p.x = ((float)(int)column + d) * size;
    p.y = ((float)(int)row + e) * size;
    struct vndf_render_env_draw draw;
    draw.direction = vndf_render_octahedral_direction(p.x, p.y);
    draw.radiance = vndf_render_env_at(radiance, side, p);
    draw.pdf = pdf[cell];
    return draw;
}

#endif
