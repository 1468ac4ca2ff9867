// What a dielectric that light goes through gets back of what scatters between its facets, with VNDF_ENERGY turquin.
#ifndef VNDF_BSDF_ENERGY_GLASS_H
#define VNDF_BSDF_ENERGY_GLASS_H

#include "bsdf_material.h"
#include "energy_glass.h"
#if VNDF_CONDUCTOR || VNDF_THIN_WALLED
#include "energy.h"
#endif

VNDF_BEGIN

// Source: after Turquin 2019, with a factor for each lobe in the place of one for both, so that light leaves in the proportions of
//     the random walk. Not reciprocal, and not adjoint: for light and for importance along the same path factors are those of
//     different directions.
// counts: the part of what scattering adds to reflections; of what meets paint none.
// body: or else a wall without thickness, whose lobes both lose what a mirror's would.
VNDF_FN struct vndf_energy_factors vndf_impl_bsdf_glass_factors(VNDF_REAL3 wo, VNDF_REAL2 alpha,
                                                                VNDF_REAL eta, VNDF_REAL counts, int body) {
#if VNDF_CONDUCTOR || VNDF_THIN_WALLED
    // After the conductor's look-up, on which the other is made dependent, so that LLVM's SLP pass does not pack the two; the other
    // choices are never taken.
    VNDF_REAL loss = vndf_energy_loss(wo, alpha), one = VNDF_R(1.0);
    int known = loss >= VNDF_R(0.0);
    struct vndf_energy_factors factors =
        vndf_energy_glass(VNDF_MAKE3(wo.x, wo.y, known ? wo.z : one),
                          VNDF_MAKE2(known ? alpha.x : one, known ? alpha.y : one), eta);
#else
    struct vndf_energy_factors factors = vndf_energy_glass(wo, alpha, eta);
#endif
#if VNDF_THIN_WALLED
    VNDF_REAL rest = one - loss, mirrors = VNDF_DIVIDE(one, rest > VNDF_R(0.0) ? rest : one);
    factors.reflected = body ? factors.reflected : mirrors;
    factors.refracted = body ? factors.refracted : mirrors;
#else
    (void)body;
#endif
    factors.reflected = VNDF_FMA(counts, factors.reflected - VNDF_R(1.0), VNDF_R(1.0));
    return factors;
}

VNDF_END

#endif
