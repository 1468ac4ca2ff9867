// Stage: the paths of a sample begin at the camera, one for each pixel first ... first + count - 1.
#ifndef VNDF_RENDER_GENERATE_H
#define VNDF_RENDER_GENERATE_H

#include "../vndf/effects.h"
#include "random.h"
#include "vector.h"

// Densities that count as certain in the choice between a path's own and the lights' samples: far above the lights', and
// neither its square nor that of its inverse leaves the range of numbers.
#define VNDF_CERTAIN 1e12f

VNDF_RENDER_KERNEL vndf_render_generate(const struct vndf_render_view view, VNDF_RENDER_IN(uint) words,
                                        const uint first, const uint stride, VNDF_RENDER_OUT(float) path,
                                        VNDF_RENDER_OUT(uint) slot, VNDF_RENDER_OUT(float) light) {
    const uint i = VNDF_RENDER_ITEM, pixel = first + i;
    const struct vndf_render_quad u = vndf_render_random(words + VNDF_QUAD_WORDS * VNDF_QUAD_CAMERA, pixel);
    const uint row = pixel / view.width, column = pixel - row * view.width;
    const float x = (2.0f * ((float)(int)column + u.a) - (float)(int)view.width) / (float)(int)view.width;
    const float y = 1.0f - 2.0f * ((float)(int)row + u.b) / (float)(int)view.height;
    const float dx = VNDF_FMA(x, view.right_x, VNDF_FMA(y, view.up_x, view.forward_x));
    const float dy = VNDF_FMA(x, view.right_y, VNDF_FMA(y, view.up_y, view.forward_y));
    const float dz = VNDF_FMA(x, view.right_z, VNDF_FMA(y, view.up_z, view.forward_z));
    const float scale = 1.0f / VNDF_SQRT(VNDF_FMA(dx, dx, VNDF_FMA(dy, dy, dz * dz)));
    vndf_render_store(
        vndf_render_vector_of(VNDF_FMA(x, view.shift_right_x, VNDF_FMA(y, view.shift_up_x, view.x)),
                              VNDF_FMA(x, view.shift_right_y, VNDF_FMA(y, view.shift_up_y, view.y)),
                              VNDF_FMA(x, view.shift_right_z, VNDF_FMA(y, view.shift_up_z, view.z))),
        path, VNDF_PATH_X, stride, i);
    vndf_render_store(vndf_render_vector_of(dx * scale, dy * scale, dz * scale), path, VNDF_PATH_DX, stride,
                      i);
    vndf_render_store(vndf_render_vector_of(1.0f, 1.0f, 1.0f), path, VNDF_PATH_RED, stride, i);
    path[VNDF_PATH_PDF * stride + i] = VNDF_CERTAIN;
#if VNDF_ABSORPTION
    path[VNDF_PATH_BODY * stride + i] = 0.0f;
#endif
    slot[i] = i;
    light[i] = 0.0f;
    light[stride + i] = 0.0f;
    light[2 * stride + i] = 0.0f;
}

#endif
