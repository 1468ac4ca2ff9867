// Stages: paths that met a surface move to the front, in their order, without atomics: count counts within chunks, offsets adds
// the chunks up, list says which path goes to which place, move fetches it.
#ifndef VNDF_RENDER_COMPACT_H
#define VNDF_RENDER_COMPACT_H

#include "../vndf/effects.h"
#include "language.h"
#include "queues.h"

VNDF_FN uint vndf_render_met(VNDF_RENDER_FROM(uint) triangle, uint count, uint i) {
    return i < count && triangle[i] != VNDF_MISS ? 1u : 0u;
}

// How many paths of a chunk met something; one item a chunk.
VNDF_RENDER_KERNEL vndf_render_count(VNDF_RENDER_IN(uint) triangle, const uint count, const uint chunks,
                                     VNDF_RENDER_OUT(uint) offset) {
    const uint chunk = VNDF_RENDER_ITEM;
    if (chunk >= chunks) return;
    uint sum = 0;
    for (uint i = VNDF_CHUNK * chunk; i < VNDF_CHUNK * (chunk + 1); ++i)
        sum += vndf_render_met(triangle, count, i);
    offset[chunk] = sum;
}

// Where each chunk's begin, and behind them how many there are; one item.
VNDF_RENDER_KERNEL vndf_render_offsets(const uint chunks, VNDF_RENDER_OUT(uint) offset) {
    if (VNDF_RENDER_ITEM != 0) return;
    uint sum = 0;
    for (uint i = 0; i < chunks; ++i) {
        const uint own = offset[i];
        offset[i] = sum;
        sum += own;
    }
    offset[chunks] = sum;
}

// The numbers of those that met something, from their chunk's place on; one item a chunk.
VNDF_RENDER_KERNEL vndf_render_list(VNDF_RENDER_IN(uint) triangle, const uint count, const uint chunks,
                                    const uint stride, VNDF_RENDER_IN(uint) offset,
                                    VNDF_RENDER_OUT(uint) from) {
    const uint chunk = VNDF_RENDER_ITEM;
    if (chunk >= chunks) return;
    uint to = offset[chunk];
    for (uint i = VNDF_CHUNK * chunk; i < VNDF_CHUNK * (chunk + 1); ++i) {
        const uint met = vndf_render_met(triangle, count, i);
        // The others go where nobody reads.
        from[met ? to : stride - 1] = i;
        to += met;
    }
}

VNDF_RENDER_KERNEL vndf_render_move(VNDF_RENDER_IN(float) path, VNDF_RENDER_IN(uint) slot,
                                    VNDF_RENDER_IN(float) hit, VNDF_RENDER_IN(uint) triangle,
                                    VNDF_RENDER_IN(uint) from, const uint count, const uint stride,
                                    VNDF_RENDER_OUT(float) path_to, VNDF_RENDER_OUT(uint) slot_to,
                                    VNDF_RENDER_OUT(float) hit_to, VNDF_RENDER_OUT(uint) triangle_to) {
    const uint to = VNDF_RENDER_ITEM, i = to < count ? from[to] : 0;
    path_to[VNDF_PATH_X * stride + to] = path[VNDF_PATH_X * stride + i];
    path_to[VNDF_PATH_Y * stride + to] = path[VNDF_PATH_Y * stride + i];
    path_to[VNDF_PATH_Z * stride + to] = path[VNDF_PATH_Z * stride + i];
    path_to[VNDF_PATH_DX * stride + to] = path[VNDF_PATH_DX * stride + i];
    path_to[VNDF_PATH_DY * stride + to] = path[VNDF_PATH_DY * stride + i];
    path_to[VNDF_PATH_DZ * stride + to] = path[VNDF_PATH_DZ * stride + i];
    path_to[VNDF_PATH_RED * stride + to] = path[VNDF_PATH_RED * stride + i];
    path_to[VNDF_PATH_GREEN * stride + to] = path[VNDF_PATH_GREEN * stride + i];
    path_to[VNDF_PATH_BLUE * stride + to] = path[VNDF_PATH_BLUE * stride + i];
    path_to[VNDF_PATH_PDF * stride + to] = path[VNDF_PATH_PDF * stride + i];
#if VNDF_ABSORPTION
    path_to[VNDF_PATH_BODY * stride + to] = path[VNDF_PATH_BODY * stride + i];
#endif
    slot_to[to] = slot[i];
    hit_to[VNDF_HIT_B1 * stride + to] = hit[VNDF_HIT_B1 * stride + i];
    hit_to[VNDF_HIT_B2 * stride + to] = hit[VNDF_HIT_B2 * stride + i];
    triangle_to[to] = triangle[i];
}

#endif
