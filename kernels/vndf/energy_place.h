// Tables of energy: how they are declared, and where a number stands in them.
#ifndef VNDF_ENERGY_PLACE_H
#define VNDF_ENERGY_PLACE_H

#include "impl/range.h"

VNDF_BEGIN

// How a table is declared: arrays in program scope. On CUDA and HIP they are there for device code alone.
#ifndef VNDF_CONSTANT
#if defined(__OPENCL_C_VERSION__) || defined(__OPENCL_CPP_VERSION__) || defined(__OPENCL_VERSION__)
#define VNDF_CONSTANT __constant
#elif VNDF_IMPL_GPU
#define VNDF_CONSTANT static __device__ const
#elif defined(__GNUC__)
#define VNDF_CONSTANT static const __attribute__((__unused__))
#else
#define VNDF_CONSTANT static const
#endif
#endif

// Two neighbours in a table and the second one's share.
struct vndf_impl_between {
    int first;
    VNDF_REAL share;
};
// Of a place in [0, 1] among `count` equidistant ones; NaN counts as 0.
VNDF_FN struct vndf_impl_between vndf_impl_between_of(VNDF_REAL place, int count) {
    struct vndf_impl_between b;
    VNDF_REAL bounded = vndf_impl_share(place > VNDF_R(0.0) ? place : VNDF_R(0.0));
    VNDF_REAL scaled = bounded * (VNDF_REAL)(count - 1);
    b.first = (int)scaled;
    b.first = b.first < count - 2 ? b.first : count - 2;
    b.share = scaled - (VNDF_REAL)b.first;
    return b;
}

// The place of a direction above the surface: sqrt(1 - tan(theta / 2)) with theta after the stretch, in which the loss is smooth
// for every alpha: at grazing incidence it is steep in the cosine, at normal incidence linear in the angle.
// l2: the square of its part along the surface.
VNDF_FN VNDF_REAL vndf_impl_energy_place(VNDF_REAL l2, VNDF_REAL cosine) {
    VNDF_REAL z = vndf_impl_max(cosine, VNDF_R(0.0)), l = VNDF_SQRT(l2), r = VNDF_SQRT(VNDF_FMA(z, z, l2));
    // 1 - l / (r + z), without the difference.
    VNDF_REAL both = (r + l) * (r + z);
    return VNDF_SQRT(VNDF_DIVIDE(z * (r + l + z), both > VNDF_IMPL_LEAST ? both : VNDF_R(1.0)));
}

VNDF_END

#endif
