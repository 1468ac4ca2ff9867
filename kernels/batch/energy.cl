// The entry points of what energy.h and energy_glass.h look up.
//
//   vndf_batch_energy   w, alpha -> the loss along w, the mean loss
//   vndf_batch_energy_glass   w, alpha, eta -> the factors on what is reflected and refracted
#include "../vndf/energy.h"
#include "../vndf/energy_glass.h"

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

__kernel void vndf_batch_energy_glass(
    __global const VNDF_REAL* restrict in_w_x, __global const VNDF_REAL* restrict in_w_y,
    __global const VNDF_REAL* restrict in_w_z, __global const VNDF_REAL* restrict in_alpha_x,
    __global const VNDF_REAL* restrict in_alpha_y, __global const VNDF_REAL* restrict in_eta,
    __global VNDF_REAL* restrict out_reflected, __global VNDF_REAL* restrict out_refracted) {
    const size_t i = get_global_id(0);
    const struct vndf_energy_factors factors = vndf_energy_glass(
        VNDF_MAKE3(in_w_x[i], in_w_y[i], in_w_z[i]), VNDF_MAKE2(in_alpha_x[i], in_alpha_y[i]), in_eta[i]);
    out_reflected[i] = factors.reflected;
    out_refracted[i] = factors.refracted;
}
