// The entry point behind the tables of energy.h: directional albedos of a conductor that reflects everything, by midpoints over
// the unit square of the sampler that is chosen.
//
//   vndf_batch_albedo   wo, alpha -> the loss 1 - E(wo), with VNDF_ALBEDO_POINTS squared midpoints
#include "../vndf/bsdf_facets.h"
#include "midpoints.h"

__kernel void vndf_batch_albedo(__global const VNDF_REAL* restrict in_wo_x,
                                __global const VNDF_REAL* restrict in_wo_y,
                                __global const VNDF_REAL* restrict in_wo_z,
                                __global const VNDF_REAL* restrict in_alpha_x,
                                __global const VNDF_REAL* restrict in_alpha_y,
                                __global VNDF_REAL* restrict out_loss) {
    const size_t i = get_global_id(0);
    const struct vndf_impl_facets c = vndf_impl_facets_of(VNDF_MAKE3(in_wo_x[i], in_wo_y[i], in_wo_z[i]),
                                                          VNDF_MAKE2(in_alpha_x[i], in_alpha_y[i]),
                                                          VNDF_MAKE3(VNDF_R(0.0), VNDF_R(0.0), VNDF_R(1.0)));
    const VNDF_REAL step = VNDF_R(1.0) / VNDF_ALBEDO_POINTS;
    VNDF_REAL loss = VNDF_R(0.0);
    for (int j = 0; j < VNDF_ALBEDO_POINTS; ++j) {
        const struct vndf_batch_point x = vndf_batch_point_of(((VNDF_REAL)j + VNDF_R(0.5)) * step);
        VNDF_REAL row = VNDF_R(0.0);  // a sum of its own, which rounds less
        for (int k = 0; k < VNDF_ALBEDO_POINTS; ++k) {
            const struct vndf_batch_point y = vndf_batch_point_of(((VNDF_REAL)k + VNDF_R(0.5)) * step);
            const struct vndf_impl_sample s = vndf_impl_facets_sample(c, VNDF_MAKE2(x.u, y.u));
            row += y.weight * (VNDF_R(1.0) - vndf_impl_facets_weight(c, VNDF_MAKE3(s.x, s.y, s.z)));
        }
        loss += x.weight * (row * step);
    }
    out_loss[i] = loss * step;
}
