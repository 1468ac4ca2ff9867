// What a dielectric that light goes through gets back of what scatters between its facets, with VNDF_ENERGY turquin.
#ifndef VNDF_BSDF_ENERGY_GLASS_H
#define VNDF_BSDF_ENERGY_GLASS_H

#include "bsdf_material.h"
#include "energy_glass.h"
#if VNDF_THIN_WALLED
#include "energy.h"
#endif

VNDF_BEGIN

// Source: after Turquin 2019, with a factor for each lobe in the place of one for both, so that light leaves in the proportions of
//     the random walk. Not reciprocal, and not adjoint: for light and for importance along the same path factors are those of
//     different directions.
// transmission: what does not go through meets paint, which gives nothing back.
// body: or else a wall without thickness, whose lobes both lose what a mirror's would.
VNDF_FN struct vndf_energy_factors vndf_impl_bsdf_glass_factors(VNDF_REAL3 wo, VNDF_REAL2 alpha,
                                                                VNDF_REAL eta, VNDF_REAL transmission,
                                                                int body) {
    struct vndf_energy_factors factors = vndf_energy_glass(wo, alpha, eta);
#if VNDF_THIN_WALLED
    // Dependent on the other look-up, so that LLVM's SLP pass does not pack the two; the other choice is never taken.
    VNDF_REAL z = factors.refracted > VNDF_R(0.0) ? wo.z : VNDF_R(1.0);
    VNDF_REAL rest = VNDF_R(1.0) - vndf_energy_loss(VNDF_MAKE3(wo.x, wo.y, z), alpha),
              mirrors = VNDF_R(1.0) / (rest > VNDF_R(0.0) ? rest : VNDF_R(1.0));
    factors.reflected = body ? factors.reflected : mirrors;
    factors.refracted = body ? factors.refracted : mirrors;
#else
    (void)body;
#endif
    factors.reflected = VNDF_FMA(transmission, factors.reflected - VNDF_R(1.0), VNDF_R(1.0));
    return factors;
}

VNDF_END

#endif
