// Stages: paths that go on move to the front, in their order, without atomics: rank counts within chunks, offsets adds the
// chunks up, move writes.
#ifndef VNDF_RENDER_COMPACT_H
#define VNDF_RENDER_COMPACT_H

#include "../vndf/effects.h"
#include "language.h"
#include "queues.h"

// For each path of a chunk, how many of the chunk's before it go on; one item a chunk.
VNDF_RENDER_KERNEL vndf_render_rank(VNDF_RENDER_IN(uint) alive, const uint chunks, VNDF_RENDER_OUT(uint) rank,
                                    VNDF_RENDER_OUT(uint) offset) {
    const uint chunk = VNDF_RENDER_ITEM;
    if (chunk >= chunks) return;
    uint sum = 0;
    for (uint i = VNDF_CHUNK * chunk; i < VNDF_CHUNK * (chunk + 1); ++i) {
        rank[i] = sum;
        sum += alive[i];
    }
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

VNDF_RENDER_KERNEL vndf_render_move(VNDF_RENDER_IN(float) path, VNDF_RENDER_IN(uint) slot,
                                    VNDF_RENDER_IN(uint) alive, VNDF_RENDER_IN(uint) rank,
                                    VNDF_RENDER_IN(uint) offset, const uint stride,
                                    VNDF_RENDER_OUT(float) path_to, VNDF_RENDER_OUT(uint) slot_to) {
    const uint i = VNDF_RENDER_ITEM;
    // A path that ends goes where nobody reads.
    const uint to = alive[i] ? offset[i / VNDF_CHUNK] + rank[i] : stride - 1;
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
}

#endif
