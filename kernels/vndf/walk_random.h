// Random numbers of a walk on the microsurface (walk_conductor.h, walk_dielectric.h), which needs as many as it takes.
#ifndef VNDF_WALK_RANDOM_H
#define VNDF_WALK_RANDOM_H

#include "impl/shim.h"

VNDF_BEGIN

// Two words that name the walk, such as pixel and sample, and how many times numbers were drawn: begin at 0. Walks of other
// words have independent numbers. Functions take it by value and return it in their result, ready for the next.
struct vndf_walk_random {
    unsigned first, second, drawn;
};

VNDF_FN struct vndf_walk_random vndf_walk_random_of(unsigned first, unsigned second) {
    struct vndf_walk_random random;
    random.first = first;
    random.second = second;
    random.drawn = 0u;
    return random;
}

// Four numbers in (0, 1].
struct vndf_impl_quad {
    VNDF_REAL a, b, c, d;
};

// A multiple of 2^-24 above 0, so that its logarithm is finite.
VNDF_FN VNDF_REAL vndf_impl_walk_unit(unsigned bits) {
    return (VNDF_REAL)((int)(bits >> 8) + 1) * VNDF_R(5.9604644775390625e-08);
}

// Source: Jarzynski & Olano, Hash Functions for GPU Rendering, 2020, pcg4d.
VNDF_FN struct vndf_impl_quad vndf_impl_walk_quad(struct vndf_walk_random random) {
    unsigned x = random.first * 1664525u + 1013904223u, y = random.second * 1664525u + 1013904223u,
             z = random.drawn * 1664525u + 1013904223u, w = 1013904223u;
    struct vndf_impl_quad four;
    for (int round = 0; round < 2; ++round) {
        x += y * w;
        y += z * x;
        z += x * y;
        w += y * z;
        if (round == 0) {
            x ^= x >> 16;
            y ^= y >> 16;
            z ^= z >> 16;
            w ^= w >> 16;
        }
    }
    four.a = vndf_impl_walk_unit(x);
    four.b = vndf_impl_walk_unit(y);
    four.c = vndf_impl_walk_unit(z);
    four.d = vndf_impl_walk_unit(w);
    return four;
}

VNDF_END

#endif
