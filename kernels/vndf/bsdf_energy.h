// What the conductor of a material scatters between its facets, with VNDF_ENERGY, for one view direction.
#ifndef VNDF_BSDF_ENERGY_H
#define VNDF_BSDF_ENERGY_H

#include "bsdf_material.h"
#include "energy.h"

VNDF_BEGIN

#if VNDF_CHOSEN(VNDF_ENERGY, turquin)

// The reflectance at normal incidence. last: of the other angle, on which it is made dependent, so that LLVM's SLP pass does not
// pack the two; the other choice is never taken.
VNDF_FN struct vndf_rgb vndf_impl_bsdf_upright_reflectance(struct vndf_bsdf b, VNDF_REAL last) {
#if VNDF_CHOSEN(VNDF_FRESNEL, schlick) || VNDF_CHOSEN(VNDF_FRESNEL, f82)
    struct vndf_rgb f = vndf_impl_rgb(vndf_impl_reflectance(b.f0.r), vndf_impl_reflectance(b.f0.g),
                                      vndf_impl_reflectance(b.f0.b));
    (void)last;
#if VNDF_TINT
    f = vndf_impl_rgb_product(f, b.tint);
#endif
    return f;
#else
    return vndf_impl_bsdf_reflectance(b, last >= VNDF_R(0.0) ? VNDF_R(1.0) : last);
#endif
}
// The weight of single scattering, raised.
VNDF_FN struct vndf_rgb vndf_impl_bsdf_raised(struct vndf_bsdf b, struct vndf_rgb weight, VNDF_REAL3 wo) {
    VNDF_REAL loss = vndf_energy_loss(wo, vndf_impl_bsdf_alpha(b));
    return vndf_impl_turquin(weight, vndf_impl_bsdf_upright_reflectance(b, weight.b), loss);
}

#elif VNDF_CHOSEN(VNDF_ENERGY, kulla_conty)

// The mean of the reflectance by the cosine law: Gauss and Jacobi's rule of four cosines, exact for schlick and f82, and within
// 7e-4 for metals of eta in [0.05, 5] and k in [0.5, 10].
VNDF_FN struct vndf_rgb vndf_impl_bsdf_average_and(struct vndf_rgb sum, struct vndf_bsdf b, VNDF_REAL cosine,
                                                   VNDF_REAL share) {
    // Dependent on the sum before, so that LLVM's SLP pass does not pack the nodes; the other choice is never taken.
    struct vndf_rgb f = vndf_impl_bsdf_reflectance(b, sum.b >= VNDF_R(0.0) ? cosine : VNDF_R(1.0));
    return vndf_impl_rgb(VNDF_FMA(share, f.r, sum.r), VNDF_FMA(share, f.g, sum.g),
                         VNDF_FMA(share, f.b, sum.b));
}
VNDF_FN struct vndf_rgb vndf_impl_bsdf_average_reflectance(struct vndf_bsdf b) {
    struct vndf_rgb sum = vndf_impl_rgb(VNDF_R(0.0), VNDF_R(0.0), VNDF_R(0.0));
    sum = vndf_impl_bsdf_average_and(sum, b, VNDF_R(0.13975986434378057), VNDF_R(0.062361941900016114));
    sum = vndf_impl_bsdf_average_and(sum, b, VNDF_R(0.41640956763108317), VNDF_R(0.259695095216465));
    sum = vndf_impl_bsdf_average_and(sum, b, VNDF_R(0.7231569863618762), VNDF_R(0.40692913602054293));
    return vndf_impl_bsdf_average_and(sum, b, VNDF_R(0.94289580388548233), VNDF_R(0.27101382686297598));
}

VNDF_FN struct vndf_impl_kulla_conty vndf_impl_bsdf_kulla_conty(struct vndf_bsdf b, VNDF_REAL3 wo) {
    VNDF_REAL2 alpha = vndf_impl_bsdf_alpha(b);
    return vndf_impl_kulla_conty_of(vndf_impl_bsdf_average_reflectance(b), vndf_energy_loss(wo, alpha),
                                    vndf_energy_average_loss(alpha));
}

// The light of the lobe at wi, over the density of the cosine law, times the conductor's share.
VNDF_FN struct vndf_rgb vndf_impl_bsdf_multiple(struct vndf_bsdf b, struct vndf_impl_kulla_conty m,
                                                VNDF_REAL3 wi) {
    // Made dependent on the look-up of wo, so that LLVM's SLP pass does not pack the two; the other choice is never taken.
    VNDF_REAL z = m.share >= VNDF_R(0.0) ? wi.z : VNDF_R(1.0);
    VNDF_REAL loss =
        vndf_impl_bsdf_metal(b) * vndf_energy_loss(VNDF_MAKE3(wi.x, wi.y, z), vndf_impl_bsdf_alpha(b));
    return vndf_impl_rgb_scaled(m.scale, loss);
}

#endif

VNDF_END

#endif
