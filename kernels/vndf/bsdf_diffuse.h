// What a material reflects by the cosine law: Lambert's reflection, in the open or under a dielectric, and what a conductor
// scatters between its facets (VNDF_ENERGY kulla_conty).
#ifndef VNDF_BSDF_DIFFUSE_H
#define VNDF_BSDF_DIFFUSE_H

#include "bsdf_view.h"
#if VNDF_IMPL_DIFFUSE
#include "bsdf_lambert.h"
#endif
#if VNDF_LAMBERT && VNDF_ROUGH_DIFFUSE
#include "bsdf_rough_diffuse.h"
#endif

VNDF_BEGIN

#if VNDF_LAMBERT

#if VNDF_DIELECTRIC

// The reflectance of a smooth interface by its index: all at grazing incidence, whatever rounding leaves there.
VNDF_FN VNDF_REAL vndf_impl_bsdf_smooth_reflectance(VNDF_REAL cosine, VNDF_REAL eta) {
    VNDF_REAL f = vndf_fresnel_dielectric(cosine, eta);
    return cosine > VNDF_R(0.0) || eta == VNDF_R(1.0) ? f : VNDF_R(1.0);
}

// What a diffuse surface under it makes of it. q / (1 + q) is what it reflects of diffuse light inwards by its index.
struct vndf_impl_inwards {
    VNDF_REAL again;  // the same of what it reflects in truth
    VNDF_REAL kept;   // 1 less that, over 1 less what it is by the index
    VNDF_REAL out;    // 1 + q times the part of diffuse light that it lets in
    VNDF_REAL bends;  // the index by which it bends
};
VNDF_FN struct vndf_impl_inwards vndf_impl_inwards_of(struct vndf_impl_interface n, VNDF_REAL q,
                                                      VNDF_REAL dense) {
    struct vndf_impl_inwards w;
#if VNDF_SPECULAR
    VNDF_REAL strength = n.gloss.strength, less = VNDF_R(1.0) - strength, most = n.gloss.most;
    w.kept = VNDF_FMA(less, q, VNDF_FMA(-strength, most, VNDF_R(1.0)));
    w.out = VNDF_FMA(less, VNDF_R(1.0) + q, strength * (VNDF_R(1.0) - most) * (dense * dense));
    // Nothing gets in where all is reflected.
    w.again = VNDF_DIVIDE(strength * (q + most), w.kept > VNDF_R(0.0) ? w.kept : VNDF_R(1.0));
    w.out = w.out > VNDF_R(0.0) ? w.out : VNDF_R(1.0);
    // A weaker one bends less.
    w.bends = VNDF_FMA(strength, dense - VNDF_R(1.0), VNDF_R(1.0));
#else
    (void)n;
    w.again = q;
    w.kept = VNDF_R(1.0);
    w.out = dense * dense;
    w.bends = dense;
#endif
    return w;
}

// The light that gets in at wo leaves diffusely, in part; what is reflected inwards meets the surface again, and so on. White
// paint reflects it all.
// Source: Jakob, Mitsuba renderer, 2010, the smooth plastic: T(wo) T(wi) albedo / (pi eta^2 (1 - albedo R)), T = 1 - F(cos) and
//     R the reflectance from inside, averaged; here a / (1 + (1 - a) q) (1 + q) / eta^2, 1 + q = 1 / (1 - R), q by a fit.
// Accuracy of the fit: 1.4e-3 of 1 + q for eta in [1, 4]. An index below 1 counts as its reciprocal: white paint then loses light.
VNDF_FN struct vndf_impl_bsdf_lobe vndf_impl_bsdf_lambert(struct vndf_impl_bsdf_view v, VNDF_REAL3 i) {
    struct vndf_impl_bsdf_lobe d;
    struct vndf_impl_interface n = v.media;
    VNDF_REAL ior = vndf_impl_bsdf_index(v.b),
              dense = ior < VNDF_R(1.0) ? VNDF_DIVIDE(VNDF_R(1.0), ior) : ior, x = dense - VNDF_R(1.0);
    VNDF_REAL q = x * VNDF_FMA(x, VNDF_FMA(x, VNDF_R(0.22263203), VNDF_R(1.27565832)), VNDF_R(2.267723));
    VNDF_REAL f_o = vndf_impl_bsdf_smooth_reflectance(v.o.z, n.eta),
              lets_in = vndf_impl_interface_passes(n, vndf_impl_interface_likely(n), f_o);
    VNDF_REAL f_i = vndf_impl_bsdf_smooth_reflectance(i.z, n.eta),
              lets_out = vndf_impl_interface_passes(n, vndf_impl_interface_most(n), f_i);
    struct vndf_impl_inwards w = vndf_impl_inwards_of(n, q, dense);
#if VNDF_SPECULAR
    // Under a dark colour more gets in than it is drawn for.
    lets_out *= VNDF_DIVIDE(vndf_impl_interface_passes(n, n.gloss.most, f_o),
                            lets_in > VNDF_R(0.0) ? lets_in : VNDF_R(1.0));
#endif
    VNDF_REAL scale = lets_out * VNDF_DIVIDE(VNDF_R(1.0) + q, w.out);
    d.share = (VNDF_R(1.0) - vndf_impl_bsdf_metal(v.b)) * (VNDF_R(1.0) - n.transmission) * lets_in;
    VNDF_REAL red = VNDF_DIVIDE(v.b.albedo.r, VNDF_FMA(VNDF_R(1.0) - v.b.albedo.r, w.again, VNDF_R(1.0)));
    VNDF_REAL green = VNDF_DIVIDE(v.b.albedo.g, VNDF_FMA(VNDF_R(1.0) - v.b.albedo.g, w.again, VNDF_R(1.0)));
    VNDF_REAL blue = VNDF_DIVIDE(v.b.albedo.b, VNDF_FMA(VNDF_R(1.0) - v.b.albedo.b, w.again, VNDF_R(1.0)));
    d.weight = vndf_impl_rgb(red * scale, green * scale, blue * scale);
#if VNDF_ROUGH_DIFFUSE
    struct vndf_impl_rough_diffuse rough =
        vndf_impl_rough_diffuse_under(vndf_impl_real3(v.o), i, w.bends, v.b.diffuse_roughness);
    d.weight = vndf_impl_rgb_rougher(d.weight, rough, VNDF_DIVIDE(lets_out * w.kept, w.out), v.b.albedo);
#endif
    d.pdf = vndf_lambert_pdf_wi(i);
    return d;
}

#else

// Of the surface in the open.
VNDF_FN struct vndf_impl_bsdf_lobe vndf_impl_bsdf_lambert(struct vndf_impl_bsdf_view v, VNDF_REAL3 i) {
    struct vndf_impl_bsdf_lobe d;
    d.share = VNDF_R(1.0) - vndf_impl_bsdf_metal(v.b);
    d.weight = v.b.albedo;
#if VNDF_ROUGH_DIFFUSE
    VNDF_REAL s = VNDF_FMA(v.o.x, i.x, v.o.y * i.y);
    struct vndf_impl_rough_diffuse rough = vndf_impl_rough_diffuse_of(v.o.z, i.z, s, v.b.diffuse_roughness);
    d.weight = vndf_impl_rgb_rougher(d.weight, rough, VNDF_R(1.0), v.b.albedo);
#endif
    d.pdf = vndf_lambert_pdf_wi(i);
    return d;
}

#endif

#endif

#if VNDF_IMPL_KULLA_CONTY

// Of both parts' light that of one draw.
VNDF_FN struct vndf_impl_bsdf_lobe vndf_impl_bsdf_diffuse(struct vndf_impl_bsdf_view v, VNDF_REAL3 i) {
    struct vndf_impl_bsdf_lobe d;
#if VNDF_LAMBERT
    struct vndf_impl_bsdf_lobe lambert = vndf_impl_bsdf_lambert(v, i);
#else
    struct vndf_impl_bsdf_lobe lambert;
    lambert.share = VNDF_R(0.0);
    lambert.weight = vndf_impl_rgb(VNDF_R(0.0), VNDF_R(0.0), VNDF_R(0.0));
    lambert.pdf = vndf_lambert_pdf_wi(i);
#endif
    d.share = VNDF_FMA(vndf_impl_bsdf_metal(v.b), v.multiple.share, lambert.share);
    VNDF_REAL rcp = VNDF_DIVIDE(VNDF_R(1.0), d.share > VNDF_R(0.0) ? d.share : VNDF_R(1.0));
    // Without a metal the weight is Lambert's, to the bit.
    VNDF_REAL own = d.share == lambert.share ? VNDF_R(1.0) : lambert.share * rcp;
    d.weight = vndf_impl_rgb_scaled(vndf_impl_bsdf_multiple(v.b, v.multiple, i), rcp);
    d.weight = vndf_impl_rgb(VNDF_FMA(own, lambert.weight.r, d.weight.r),
                             VNDF_FMA(own, lambert.weight.g, d.weight.g),
                             VNDF_FMA(own, lambert.weight.b, d.weight.b));
    d.pdf = lambert.pdf;
    return d;
}

#elif VNDF_IMPL_DIFFUSE

VNDF_FN struct vndf_impl_bsdf_lobe vndf_impl_bsdf_diffuse(struct vndf_impl_bsdf_view v, VNDF_REAL3 i) {
    return vndf_impl_bsdf_lambert(v, i);
}

#endif

VNDF_END

#endif
