// Random numbers of a path, four at a time, without state: of the pixel, and of what the launch shares.
//
// VNDF_RANDOM sobol: every path of a launch has the same sample number, so that a point of Sobol's sequence is the host's to
// make: each of four dimensions has two words, the coordinate with its bits reversed and a key; the ninth is 0. The bits are scrambled after
// Owen by a hash of the pixel and the key: Laine & Karras, Stratified Sampling for Stochastic Transparency, 2011, with
// Vegdahl's constants (Owen Scrambling Based Hashing, 2021).
// VNDF_RANDOM philox: Philox 4x32-10 of (pixel, sample, quad) with the seed for a key; the words are seed, sample, quad.
#ifndef VNDF_RENDER_RANDOM_H
#define VNDF_RENDER_RANDOM_H

#include "language.h"
#include "queues.h"

#ifndef VNDF_RANDOM
#define VNDF_RANDOM sobol
#endif
#define VNDF_RANDOM_IS_sobol 1
#define VNDF_RANDOM_IS_philox 2

struct vndf_render_quad {
    float a, b, c, d;  // in [0, 1), multiples of 2^-24
};

VNDF_FN float vndf_render_unit(uint bits24) {
    return (float)(int)bits24 * 5.9604644775390625e-08f;
}

VNDF_FN uint vndf_render_hash(uint x) {  // lowbias32, Wellons 2018
    x = (x ^ (x >> 16)) * 0x7feb352du;
    x = (x ^ (x >> 15)) * 0x846ca68bu;
    return x ^ (x >> 16);
}

#if VNDF_CAT(VNDF_RANDOM_IS_, VNDF_RANDOM) == VNDF_RANDOM_IS_philox

#ifndef R123_STATIC_INLINE
#define R123_STATIC_INLINE static inline
#endif
#include <Random123/philox.h>

VNDF_FN struct vndf_render_quad vndf_render_random(VNDF_RENDER_FROM(uint) words, uint pixel) {
    const philox4x32_ctr_t counter = {{pixel, words[2], words[3], 0}};
    const philox4x32_key_t key = {{words[0], words[1]}};
    const philox4x32_ctr_t bits = philox4x32(counter, key);
    struct vndf_render_quad u;
    u.a = vndf_render_unit(bits.v[0] >> 8);
    u.b = vndf_render_unit(bits.v[1] >> 8);
    u.c = vndf_render_unit(bits.v[2] >> 8);
    u.d = vndf_render_unit(bits.v[3] >> 8);
    return u;
}

#else

// The lower 24 bits in reverse, the lowest on top. none: 0, a number that the compiler does not know, which would make an
// instruction of it that Oclgrind lacks.
VNDF_FN uint vndf_render_reversed24(uint x, uint none) {
    x = ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
    x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
    x = (((x >> 4) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4)) ^ none;
    return ((x & 0xffu) << 16) | (x & 0xff00u) | ((x >> 16) & 0xffu);
}

// The upper 24 bits of a coordinate whose bits are `word` from the lowest up.
VNDF_FN uint vndf_render_scrambled(uint word, uint key, uint pixel, uint none) {
    const uint seed = vndf_render_hash(pixel * 0x9e3779b9u + key);
    uint x = word;
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return vndf_render_reversed24(x, none);
}

VNDF_FN struct vndf_render_quad vndf_render_random(VNDF_RENDER_FROM(uint) words, uint pixel) {
    // The last word is 0. It makes each number depend on the one before, for the compiler alone, which would pack them, and PoCL
    // then not vectorise across work-items.
    const uint none = words[8];
    const uint a = vndf_render_scrambled(words[0], words[1], pixel, none);
    const uint b = vndf_render_scrambled(words[2] ^ (a & none), words[3], pixel, none);
    const uint c = vndf_render_scrambled(words[4] ^ (b & none), words[5], pixel, none);
    const uint d = vndf_render_scrambled(words[6] ^ (c & none), words[7], pixel, none);
    struct vndf_render_quad u;
    u.a = vndf_render_unit(a);
    u.b = vndf_render_unit(b);
    u.c = vndf_render_unit(c);
    u.d = vndf_render_unit(d);
    return u;
}

#endif

#endif
