// Fresnel reflectance of a dielectric, and the cosine behind it.
#ifndef VNDF_FRESNEL_DIELECTRIC_H
#define VNDF_FRESNEL_DIELECTRIC_H

#include "impl/fresnel.h"

VNDF_BEGIN

// What both functions share: the clamped cosine c and index; eta^2 - 1, and (eta cos theta_t)^2 = c^2 + eta^2 - 1.
struct vndf_impl_snell {
    VNDF_REAL c, eta, contrast, square;
};
VNDF_FN struct vndf_impl_snell vndf_impl_snell_of(VNDF_REAL cos_theta, VNDF_REAL eta) {
    struct vndf_impl_snell s;
    s.c = vndf_impl_fresnel_cosine(cos_theta);
    s.eta = vndf_impl_min(vndf_impl_max(eta, VNDF_R(1e-3)), VNDF_R(1e3));
    s.contrast = (s.eta - VNDF_R(1.0)) * (s.eta + VNDF_R(1.0));
    s.square = VNDF_FMA(s.c, s.c, s.contrast);
    return s;
}

// The reflectance for unpolarised light of a smooth surface between two dielectrics.
// Source: Born & Wolf, Principles of Optics, Section 1.5.2: with g = eta cos theta_t, c = cos theta, s = sin^2 theta,
//     Rs = ((c - g) / (c + g))^2, Rp = Rs ((c g - s) / (c g + s))^2; the mean of both.
// cos_theta: of the angle between wo and the microfacet normal; clamped to [0, 1].
// eta: index of refraction on the far side over the index on wo's side, clamped to [1e-3, 1e3].
// return: in [0, 1]; 1 where all light is reflected; 0 for eta = 1.
// Accuracy: 16 eps (1 + condition number); double 16.
//     c - g is formed as (1 - eta^2) / (c + g), so that a reflectance near 0 keeps its digits.
VNDF_FN VNDF_REAL vndf_fresnel_dielectric(VNDF_REAL cos_theta, VNDF_REAL eta) {
    struct vndf_impl_snell n = vndf_impl_snell_of(cos_theta, eta);
    int passes = n.square > VNDF_R(0.0);
    VNDF_REAL g = VNDF_SQRT(passes ? n.square : VNDF_R(0.0)), sum = n.c + g;
    VNDF_REAL s = (VNDF_R(1.0) - n.c) * (VNDF_R(1.0) + n.c), cg = n.c * g;
    // For eta = 1 at grazing incidence the sum is 0, and so is what it divides.
    VNDF_REAL sum2 = sum * sum, rs = VNDF_DIVIDE(n.contrast, sum2 > VNDF_R(0.0) ? sum2 : VNDF_R(1.0));
    // c g + s is not 0: cos theta_t = 0 at normal incidence would need eta = 0.
    VNDF_REAL ratio = VNDF_DIVIDE(cg - s, cg + s), rs2 = rs * rs;
    return passes ? vndf_impl_share(VNDF_R(0.5) * VNDF_FMA(rs2 * ratio, ratio, rs2))
                  : (n.contrast < VNDF_R(0.0) ? VNDF_R(1.0) : VNDF_R(0.0));
}

// The cosine of the angle between the refracted direction and the facet's normal.
// Source: Snell's law: sqrt(1 - (1 - cos^2 theta) / eta^2).
// cos_theta, eta: as for vndf_fresnel_dielectric.
// return: in [0, 1]; 0 where all light is reflected; cos_theta for eta = 1.
// Accuracy: 3 eps (1 + condition number); double 3.
VNDF_FN VNDF_REAL vndf_fresnel_cos_theta_t(VNDF_REAL cos_theta, VNDF_REAL eta) {
    struct vndf_impl_snell n = vndf_impl_snell_of(cos_theta, eta);
    VNDF_REAL root = VNDF_SQRT(n.square > VNDF_R(0.0) ? n.square : VNDF_R(0.0));
    return vndf_impl_share(VNDF_DIVIDE(root, n.eta));
}

VNDF_END

#endif
