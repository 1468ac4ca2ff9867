// Diffuse reflection of a rough surface, which loses nothing: what it has beyond Lambert's, nothing for a roughness of 0.
#ifndef VNDF_BSDF_ROUGH_DIFFUSE_H
#define VNDF_BSDF_ROUGH_DIFFUSE_H

#include "fresnel.h"
#include "impl/fresnel.h"
#if VNDF_DIELECTRIC
#include "fresnel_dielectric.h"
#endif

VNDF_BEGIN

// For a pair of directions and a roughness r: a surface of this albedo has BSDF times pi = albedo + excess (albedo single + a
// multiple), a = albedo^2 average / (1 - albedo (1 - average)).
//
// Source: Portsmouth, Kutz & Hill, EON: A Practical Energy-Preserving Rough Diffuse BRDF, 2025: albedo A (1 + r s / t) +
//     a (1 - E(wo)) (1 - E(wi)) / (1 - average), A = 1 / (1 + c1 r), c1 = 1/2 - 2 / (3 pi), s = wo . wi - wo.z wi.z, t = max(wo.z,
//     wi.z) for s > 0 and 1 otherwise, average = A (1 + c2 r), c2 = 2/3 - 28 / (15 pi). Here with 1 - E = r A h, so that nothing
//     cancels as r goes to 0.
struct vndf_impl_rough_diffuse {
    VNDF_REAL excess, single, multiple, average;
};

// h of a cosine z, with s = sin: c1 - (s (acos z - s z) + 2/3 s (z (1 + s + s^2) / (1 + s) - 1)) / pi. Error of the fit: 2.6e-5.
VNDF_FN VNDF_REAL vndf_impl_rough_diffuse_loss(VNDF_REAL cosine) {
    VNDF_REAL z = vndf_impl_fresnel_cosine(cosine);
    VNDF_REAL s = VNDF_SQRT((VNDF_R(1.0) - z) * (VNDF_R(1.0) + z));
    VNDF_REAL p = VNDF_FMA(z, VNDF_FMA(z, VNDF_R(0.07417089), VNDF_R(-0.23334412)), VNDF_R(0.41361677));
    p = VNDF_FMA(z, p, VNDF_R(-0.25498611));
    return z * VNDF_FMA(s, p, VNDF_FMA(z, VNDF_R(-0.28665327), VNDF_R(0.57447239)));
}

// z_o, z_i: the cosines. s: wo . wi - z_o z_i.
VNDF_FN struct vndf_impl_rough_diffuse vndf_impl_rough_diffuse_of(VNDF_REAL z_o, VNDF_REAL z_i, VNDF_REAL s,
                                                                  VNDF_REAL roughness) {
    struct vndf_impl_rough_diffuse d;
    VNDF_REAL r = vndf_impl_reflectance(roughness), c1 = VNDF_R(0.28779340921080621);
    VNDF_REAL a = VNDF_DIVIDE(VNDF_R(1.0), VNDF_FMA(c1, r, VNDF_R(1.0)));
    // Both directions at the horizon, where the density is 0, leave nothing to divide by.
    VNDF_REAL t = vndf_impl_max(vndf_impl_max(z_o, z_i), VNDF_IMPL_LEAST);
    d.single = (s > VNDF_R(0.0) ? VNDF_DIVIDE(s, t) : s) - c1;
    VNDF_REAL loss_o = vndf_impl_rough_diffuse_loss(z_o);
    // Dependent on the loss along wo, so that LLVM's SLP pass does not pack the two; the other choice is never taken.
    VNDF_REAL loss_i = vndf_impl_rough_diffuse_loss(loss_o <= VNDF_R(1.0) ? z_i : VNDF_R(1.0));
    // 1 / (c1 - c2)
    d.multiple = VNDF_R(4.6445697320678745) * loss_o * loss_i;
    d.excess = r * a;
    d.average = a * VNDF_FMA(VNDF_R(0.072488212456923937), r, VNDF_R(1.0));
    return d;
}

// Lambert's weight of one channel, and `scale` times what is beyond it. Rounding may leave a little less than nothing.
VNDF_FN VNDF_REAL vndf_impl_rougher(VNDF_REAL weight, struct vndf_impl_rough_diffuse d, VNDF_REAL scale,
                                    VNDF_REAL albedo) {
    VNDF_REAL again =
        VNDF_DIVIDE(albedo * albedo * d.average, VNDF_FMA(-albedo, VNDF_R(1.0) - d.average, VNDF_R(1.0)));
    VNDF_REAL beyond = VNDF_FMA(albedo, d.single, again * d.multiple);
    return vndf_impl_max(VNDF_FMA(scale * d.excess, beyond, weight), VNDF_R(0.0));
}
VNDF_FN struct vndf_rgb vndf_impl_rgb_rougher(struct vndf_rgb weight, struct vndf_impl_rough_diffuse d,
                                              VNDF_REAL scale, struct vndf_rgb albedo) {
    VNDF_REAL red = vndf_impl_rougher(weight.r, d, scale, albedo.r);
    VNDF_REAL green = vndf_impl_rougher(weight.g, d, scale, vndf_impl_next_channel(albedo.g, red));
    VNDF_REAL blue = vndf_impl_rougher(weight.b, d, scale, vndf_impl_next_channel(albedo.b, green));
    return vndf_impl_rgb(red, green, blue);
}

#if VNDF_DIELECTRIC

// What a smooth interface with an index >= 1 over the surface makes of it: both directions are bent before they meet it. What of
// the single reflection the interface would keep inside less or more than of Lambert's is added to it, by k(z_o) + k(z_i), so
// that nothing is lost. Light that comes back from the interface is reflected by Lambert's law.
// k: a fit over the index in [1, 3], with the cosines behind the interface. Error of all reflected light: 0.7 %.
VNDF_FN struct vndf_impl_rough_diffuse vndf_impl_rough_diffuse_under(VNDF_REAL3 o, VNDF_REAL3 i,
                                                                     VNDF_REAL dense, VNDF_REAL roughness) {
    VNDF_REAL rcp = VNDF_DIVIDE(VNDF_R(1.0), dense), s = VNDF_FMA(o.x, i.x, o.y * i.y) * (rcp * rcp);
    int none = dense == VNDF_R(1.0);
    VNDF_REAL bent_o = vndf_fresnel_cos_theta_t(o.z, dense), z_o = none ? o.z : bent_o;
    // Dependent on the other, so that LLVM's SLP pass does not pack the two; the other choice is never taken.
    VNDF_REAL bent_i = vndf_fresnel_cos_theta_t(bent_o <= VNDF_R(1.0) ? i.z : VNDF_R(1.0), dense),
              z_i = none ? i.z : bent_i;
    struct vndf_impl_rough_diffuse d = vndf_impl_rough_diffuse_of(z_o, z_i, s, roughness);
    // The cosine at which light is reflected inwards altogether; 0 for index 1.
    VNDF_REAL m = VNDF_SQRT((dense - VNDF_R(1.0)) * (dense + VNDF_R(1.0))) * rcp;
    VNDF_REAL both = VNDF_FMA(m, VNDF_FMA(m, VNDF_R(-0.128104), VNDF_R(-1.159202)), VNDF_R(-0.589116));
    both = VNDF_FMA(z_o + z_i, VNDF_FMA(m, VNDF_R(0.725367), VNDF_R(1.03267)), both);
    both = VNDF_FMA(VNDF_FMA(z_o, z_o, z_i * z_i), VNDF_R(-0.737286), both);
    d.single = VNDF_FMA(-m, both, d.single);
    return d;
}

#endif

VNDF_END

#endif
