// The entry point of what energy.h looks up.
//
//   vndf_batch_energy   w, alpha -> the loss along w, the mean loss
#include "../vndf/energy.h"

__kernel void vndf_batch_energy(__global const VNDF_REAL* restrict in_w_x,
                                __global const VNDF_REAL* restrict in_w_y,
                                __global const VNDF_REAL* restrict in_w_z,
                                __global const VNDF_REAL* restrict in_alpha_x,
                                __global const VNDF_REAL* restrict in_alpha_y,
                                __global VNDF_REAL* restrict out_loss,
                                __global VNDF_REAL* restrict out_average) {
    const size_t i = get_global_id(0);
    const VNDF_REAL2 alpha = VNDF_MAKE2(in_alpha_x[i], in_alpha_y[i]);
    out_loss[i] = vndf_energy_loss(VNDF_MAKE3(in_w_x[i], in_w_y[i], in_w_z[i]), alpha);
    out_average[i] = vndf_energy_average_loss(alpha);
}
