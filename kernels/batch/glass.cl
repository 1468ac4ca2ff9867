// The entry point behind the tables of energy_glass.h: directional albedos of a dielectric that absorbs nothing, the single
// scattering of bsdf_dielectric.h by midpoints over the unit square of the plain sampler, and that of the random walk.
//
//   vndf_batch_glass   wo, alpha, eta -> the parts reflected and refracted by one facet, and the part that walks reflect
#include "../vndf/bsdf_dielectric.h"
#include "../vndf/walk_dielectric.h"
#include "midpoints.h"

#ifndef VNDF_GLASS_WALKS
#define VNDF_GLASS_WALKS 65536
#endif

// With heights that are correlated, whatever VNDF_MASKING: what the walk reflects by its first facet.
VNDF_FN VNDF_REAL vndf_batch_correlated(struct vndf_impl_facets c, VNDF_REAL3 wi) {
#if VNDF_CHOSEN(VNDF_NDF, beckmann)
    return vndf_beckmann_weight_lobe(c.lobe, wi);
#else
    return vndf_ggx_weight_lobe(c.lobe, wi);
#endif
}

__kernel void vndf_batch_glass(
    __global const VNDF_REAL* restrict in_wo_x, __global const VNDF_REAL* restrict in_wo_y,
    __global const VNDF_REAL* restrict in_wo_z, __global const VNDF_REAL* restrict in_alpha_x,
    __global const VNDF_REAL* restrict in_alpha_y, __global const VNDF_REAL* restrict in_eta,
    __global VNDF_REAL* restrict out_reflected, __global VNDF_REAL* restrict out_through,
    __global VNDF_REAL* restrict out_walk) {
    const size_t i = get_global_id(0);
    const VNDF_REAL3 wo = VNDF_MAKE3(in_wo_x[i], in_wo_y[i], in_wo_z[i]);
    const VNDF_REAL2 alpha = VNDF_MAKE2(in_alpha_x[i], in_alpha_y[i]);
    const VNDF_REAL eta = in_eta[i], step = VNDF_R(1.0) / VNDF_ALBEDO_POINTS;
    const struct vndf_impl_facets c =
        vndf_impl_facets_of(wo, alpha, VNDF_MAKE3(VNDF_R(0.0), VNDF_R(0.0), VNDF_R(1.0)));
    VNDF_REAL reflected = VNDF_R(0.0), through = VNDF_R(0.0), first = VNDF_R(0.0);
    for (int j = 0; j < VNDF_ALBEDO_POINTS; ++j) {
        const struct vndf_batch_point x = vndf_batch_point_of(((VNDF_REAL)j + VNDF_R(0.5)) * step);
        // Sums of their own, which round less.
        VNDF_REAL row_reflected = VNDF_R(0.0), row_through = VNDF_R(0.0), row_first = VNDF_R(0.0);
        for (int k = 0; k < VNDF_ALBEDO_POINTS; ++k) {
            const struct vndf_batch_point y = vndf_batch_point_of(((VNDF_REAL)k + VNDF_R(0.5)) * step);
            const struct vndf_impl_facets_pair both = vndf_impl_facets_both(c, VNDF_MAKE2(x.u, y.u), 0);
            const VNDF_REAL cosine =
                VNDF_FMA(wo.x, both.normal.x, VNDF_FMA(wo.y, both.normal.y, wo.z * both.normal.z));
            const VNDF_REAL f = vndf_fresnel_dielectric(cosine, eta);
            const VNDF_REAL3 mirrored = VNDF_MAKE3(both.mirrored.x, both.mirrored.y, both.mirrored.z);
            const VNDF_REAL back = mirrored.z > VNDF_R(0.0) ? y.weight * f : VNDF_R(0.0);
            const struct vndf_impl_sample t = vndf_impl_refracted(wo, both.normal, eta);
            const VNDF_REAL in = t.z < VNDF_R(0.0) ? y.weight * (VNDF_R(1.0) - f) : VNDF_R(0.0);
            row_reflected += back * vndf_impl_facets_weight(c, mirrored);
            row_first += back * vndf_batch_correlated(c, mirrored);
            row_through += in * vndf_impl_facets_shadowing(c, VNDF_MAKE3(t.x, t.y, vndf_impl_abs(t.z)));
        }
        reflected += x.weight * (row_reflected * step);
        through += x.weight * (row_through * step);
        first += x.weight * (row_first * step);
    }
    // Beyond the first facet by walks, the same for every view; or what they let through, where that is the lesser part.
    int again = 0, below = 0;
    for (unsigned walk = 0; walk < VNDF_GLASS_WALKS; ++walk) {
        const struct vndf_walk_direction d =
            vndf_walk_dielectric_sample(wo, alpha, eta, vndf_walk_random_of(walk, 0u));
        again += d.facets > 1 && d.wi_z > VNDF_R(0.0) ? 1 : 0;
        below += d.wi_z < VNDF_R(0.0) ? 1 : 0;
    }
    const VNDF_REAL share = VNDF_R(1.0) / VNDF_GLASS_WALKS;
    out_reflected[i] = reflected * step;
    out_through[i] = through * step;
    out_walk[i] = 2 * below < VNDF_GLASS_WALKS ? VNDF_R(1.0) - (VNDF_REAL)below * share
                                               : VNDF_FMA(first, step, (VNDF_REAL)again * share);
}
