// The rough dielectric: microfacets (bsdf_facets.h) between two media, that reflect and refract.
//
// Of the light that meets a facet it reflects F and refracts 1 - F. A direction is drawn from a side: reflections count above
// the surface alone and refractions below it alone; the others are lost, have the weight 0 and are no part of the density.
//
// Source: Walter, Marschner, Li & Torrance, Microfacet Models for Refraction through Rough Surfaces, 2007, Equations 16, 17
//     and 21, eta_i = 1 and eta_o = eta for the direction that is known (i there, wo here); visible normals for their
//     sampling, and with them their separable G: of a refraction the weight is (1 - F) G1(wi). (The height-correlated one of
//     refractions is the Beta function B(1 + Lambda(wo), 1 + Lambda(wi)).)
#ifndef VNDF_BSDF_DIELECTRIC_H
#define VNDF_BSDF_DIELECTRIC_H

#include "bsdf_facets.h"
#include "fresnel_dielectric.h"

VNDF_BEGIN

// The facet between two directions: h = wo + wi, or where light crosses wo + eta wi, turned to wo's side: it points to the
// denser medium.
VNDF_FN struct vndf_impl_facing vndf_impl_facing_of(VNDF_REAL3 wo, VNDF_REAL3 wi, VNDF_REAL eta,
                                                    int crosses) {
    struct vndf_impl_facing f;
    VNDF_REAL scale = crosses ? eta : VNDF_R(1.0),
              turn = crosses && eta > VNDF_R(1.0) ? VNDF_R(-1.0) : VNDF_R(1.0);
    // Each component is rounded once, so that h keeps its direction as eta goes to 1.
    f.x = turn * VNDF_FMA(scale, wi.x, wo.x);
    f.y = turn * VNDF_FMA(scale, wi.y, wo.y);
    f.z = turn * VNDF_FMA(scale, wi.z, wo.z);
    VNDF_REAL h2 = VNDF_FMA(f.x, f.x, VNDF_FMA(f.y, f.y, f.z * f.z)), length = VNDF_SQRT(h2);
    VNDF_REAL rcp = VNDF_DIVIDE(VNDF_R(1.0), h2 > VNDF_R(0.0) ? length : VNDF_R(1.0));
    f.wo_h = VNDF_FMA(wo.x, f.x, VNDF_FMA(wo.y, f.y, wo.z * f.z));
    // Made dependent on the other cosine, so that LLVM's SLP pass does not pack the two; the other choice is never taken.
    VNDF_REAL z = f.wo_h <= VNDF_REAL_MAX ? f.z : VNDF_R(1.0);
    VNDF_REAL wi_h = -VNDF_FMA(wi.x, f.x, VNDF_FMA(wi.y, f.y, wi.z * z)),
              turned = VNDF_R(2.0) * eta * rcp * rcp;
    int faces = f.wo_h > VNDF_R(0.0) && wi_h > VNDF_R(0.0) && eta != VNDF_R(1.0);
    f.cos_o = crosses ? f.wo_h * rcp : VNDF_R(0.5) * length;
    f.spread = faces ? (turned * f.wo_h) * (turned * wi_h) : VNDF_R(0.0);
    f.crosses = crosses;
    return f;
}

// The refraction of wo at a visible normal, with its density: that of the normal times |d wm / d wi| = cos_t / k^2, wi = k wm
// - wo / eta. For eta = 1 it is -wo with the largest finite density, for a delta. Where all is reflected, -wm with density 0.
VNDF_FN struct vndf_impl_sample vndf_impl_refracted(VNDF_REAL3 wo, struct vndf_impl_sample m, VNDF_REAL eta) {
    struct vndf_impl_sample o;
    VNDF_REAL rcp_eta = VNDF_DIVIDE(VNDF_R(1.0), eta),
              contrast = (eta - VNDF_R(1.0)) * (eta + VNDF_R(1.0)) * rcp_eta;
    VNDF_REAL cos_o = VNDF_FMA(wo.x, m.x, VNDF_FMA(wo.y, m.y, wo.z * m.z)),
              cos_t = vndf_fresnel_cos_theta_t(cos_o, eta);
    int passes = cos_o > VNDF_R(0.0) && cos_t > VNDF_R(0.0), straight = eta == VNDF_R(1.0);
    // cos_o / eta - cos_t without cancellation.
    VNDF_REAL sum = VNDF_FMA(eta, cos_t, cos_o), k = VNDF_DIVIDE(-contrast, passes ? sum : VNDF_R(1.0));
    o.x = VNDF_FMA(k, m.x, -wo.x * rcp_eta);
    o.y = VNDF_FMA(k, m.y, -wo.y * rcp_eta);
    o.z = VNDF_FMA(k, m.z, -wo.z * rcp_eta);
    VNDF_REAL o2 = VNDF_FMA(o.x, o.x, VNDF_FMA(o.y, o.y, o.z * o.z));
    // What rounding made of the length; of -wo nothing.
    VNDF_REAL rcp =
        straight ? VNDF_R(1.0) : VNDF_DIVIDE(VNDF_R(1.0), VNDF_SQRT(o2 > VNDF_R(0.0) ? o2 : VNDF_R(1.0)));
    o.x = passes ? o.x * rcp : -m.x;
    o.y = passes ? o.y * rcp : -m.y;
    o.z = passes ? o.z * rcp : -m.z;
    VNDF_REAL rcp_k = VNDF_DIVIDE(sum, straight ? VNDF_R(1.0) : contrast),
              pdf = (m.pdf * cos_t) * (rcp_k * rcp_k);
    o.pdf = passes ? (straight ? VNDF_REAL_MAX : vndf_impl_finite(pdf)) : VNDF_R(0.0);
    return o;
}

#if VNDF_CHOSEN(VNDF_SAMPLING, plain)
#define VNDF_IMPL_CHOICE_BY_NORMAL 1
#else
#define VNDF_IMPL_CHOICE_BY_NORMAL 0

// What a lobe that is chosen before the normal takes for the share of reflections: the reflectance at the mean visible normal
// (of the cap's half vectors), less a part for the normals that transmit where that one does not.
VNDF_FN VNDF_REAL vndf_impl_expected_reflectance(VNDF_REAL3 wo, VNDF_REAL2 alpha, VNDF_REAL eta) {
    VNDF_REAL ax = vndf_impl_alpha(alpha.x), ay = vndf_impl_alpha_y(alpha.y),
              z = vndf_impl_max(wo.z, VNDF_R(0.0));
    VNDF_REAL vx = ax * wo.x, vy = ay * wo.y, l2 = VNDF_FMA(vx, vx, vy * vy);
    // (2 alpha v, |v| + z), v = alpha wo, and its cosine with wo.
    VNDF_REAL sum = VNDF_SQRT(VNDF_FMA(z, z, l2)) + z, gx = VNDF_R(2.0) * ax * vx, gy = VNDF_R(2.0) * ay * vy;
    VNDF_REAL g2 = VNDF_FMA(gx, gx, VNDF_FMA(gy, gy, sum * sum));
    VNDF_REAL cosine =
        VNDF_DIVIDE(VNDF_FMA(z, sum, VNDF_R(2.0) * l2), VNDF_SQRT(g2 > VNDF_R(0.0) ? g2 : VNDF_R(1.0)));
    VNDF_REAL rough = vndf_impl_max(ax, ay), spread = VNDF_DIVIDE(rough, VNDF_R(2.0) + VNDF_R(2.0) * rough);
    return vndf_fresnel_dielectric(cosine, eta) * (VNDF_R(0.984375) - spread);
}
#endif

VNDF_END

#endif
