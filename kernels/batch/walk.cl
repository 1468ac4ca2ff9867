// Entry points of the walks on the microsurface, with the arrays of bsdf.cl: tests and measurements take them as ground truth.
// A row's walk has the random numbers of `walk`, a whole number below 2^24, and of `sequence`, another.
//
//   vndf_batch_walk_conductor_sample   wo, walk, sequence, the material -> wi, the weight for each channel, facets
//   vndf_batch_walk_conductor_eval     wo, wi, walk, sequence, the material -> f for each channel
#include "bsdf.cl"
#include "../vndf/walk_conductor.h"
#include "../vndf/walk_dielectric.h"

#define VNDF_WALK_RANDOM vndf_walk_random_of((unsigned)in_walk[i], (unsigned)in_sequence[i])

#define VNDF_WALK_STORE                   \
    out_wi_x[i] = d.wi_x;                 \
    out_wi_y[i] = d.wi_y;                 \
    out_wi_z[i] = d.wi_z;                 \
    VNDF_BSDF_STORE_RGB(weight, d.weight) \
    out_facets[i] = (VNDF_REAL)d.facets;

#if VNDF_CONDUCTOR

__kernel void vndf_batch_walk_conductor_sample(VNDF_BSDF_XYZ(VNDF_BSDF_IN, wo) VNDF_BSDF_IN(walk)
                                                   VNDF_BSDF_IN(sequence) VNDF_BSDF_PARAMETERS(VNDF_BSDF_IN)
                                                       VNDF_BSDF_XYZ(VNDF_BSDF_OUT, wi)
                                                           VNDF_BSDF_RGB(VNDF_BSDF_OUT, weight)
                                                               __global VNDF_REAL* restrict out_facets) {
    const size_t i = get_global_id(0);
    struct vndf_bsdf b;
    VNDF_BSDF_LOAD
    const struct vndf_walk_direction d =
        vndf_walk_conductor_sample(VNDF_MAKE3(in_wo_x[i], in_wo_y[i], in_wo_z[i]), b, VNDF_WALK_RANDOM);
    VNDF_WALK_STORE
}

__kernel void vndf_batch_walk_conductor_eval(VNDF_BSDF_XYZ(VNDF_BSDF_IN, wo) VNDF_BSDF_XYZ(VNDF_BSDF_IN, wi)
                                                 VNDF_BSDF_IN(walk) VNDF_BSDF_IN(sequence)
                                                     VNDF_BSDF_PARAMETERS(VNDF_BSDF_IN)
                                                         __global VNDF_REAL* restrict out_f_r,
                                             __global VNDF_REAL* restrict out_f_g,
                                             __global VNDF_REAL* restrict out_f_b) {
    const size_t i = get_global_id(0);
    struct vndf_bsdf b;
    VNDF_BSDF_LOAD
    const struct vndf_walk_value value =
        vndf_walk_conductor_eval(VNDF_MAKE3(in_wo_x[i], in_wo_y[i], in_wo_z[i]),
                                 VNDF_MAKE3(in_wi_x[i], in_wi_y[i], in_wi_z[i]), b, VNDF_WALK_RANDOM);
    VNDF_BSDF_STORE_RGB(f, value.f)
}

#endif

//   vndf_batch_walk_dielectric_sample   as of a conductor; the material's first channel of `first` is eta
//   vndf_batch_walk_dielectric_eval
__kernel void vndf_batch_walk_dielectric_sample(VNDF_BSDF_XYZ(VNDF_BSDF_IN, wo) VNDF_BSDF_IN(walk)
                                                    VNDF_BSDF_IN(sequence) VNDF_BSDF_PARAMETERS(VNDF_BSDF_IN)
                                                        VNDF_BSDF_XYZ(VNDF_BSDF_OUT, wi)
                                                            VNDF_BSDF_RGB(VNDF_BSDF_OUT, weight)
                                                                __global VNDF_REAL* restrict out_facets) {
    const size_t i = get_global_id(0);
    const struct vndf_walk_direction d = vndf_walk_dielectric_sample(
        VNDF_MAKE3(in_wo_x[i], in_wo_y[i], in_wo_z[i]), VNDF_MAKE2(in_alpha_x[i], in_alpha_y[i]),
        in_first_r[i], VNDF_WALK_RANDOM);
    VNDF_WALK_STORE
}

__kernel void vndf_batch_walk_dielectric_eval(VNDF_BSDF_XYZ(VNDF_BSDF_IN, wo) VNDF_BSDF_XYZ(VNDF_BSDF_IN, wi)
                                                  VNDF_BSDF_IN(walk) VNDF_BSDF_IN(sequence)
                                                      VNDF_BSDF_PARAMETERS(VNDF_BSDF_IN)
                                                          __global VNDF_REAL* restrict out_f_r,
                                              __global VNDF_REAL* restrict out_f_g,
                                              __global VNDF_REAL* restrict out_f_b) {
    const size_t i = get_global_id(0);
    const struct vndf_walk_value value = vndf_walk_dielectric_eval(
        VNDF_MAKE3(in_wo_x[i], in_wo_y[i], in_wo_z[i]), VNDF_MAKE3(in_wi_x[i], in_wi_y[i], in_wi_z[i]),
        VNDF_MAKE2(in_alpha_x[i], in_alpha_y[i]), in_first_r[i], VNDF_WALK_RANDOM);
    VNDF_BSDF_STORE_RGB(f, value.f)
}
