// Fresnel reflectance of a conductor.
#ifndef VNDF_FRESNEL_CONDUCTOR_H
#define VNDF_FRESNEL_CONDUCTOR_H

#include "impl/fresnel.h"

VNDF_BEGIN

// The reflectance for unpolarised light of a smooth surface between a dielectric and a metal.
// Source: Born & Wolf, Principles of Optics, Section 14.2 (n = eta, n k = k here): with (a + i b)^2 = (eta + i k)^2 - sin^2,
//     Rs = ((a - c)^2 + b^2) / ((a + c)^2 + b^2), Rp = Rs ((a c - s)^2 + (b c)^2) / ((a c + s)^2 + (b c)^2), c = cos theta,
//     s = sin^2 theta; the mean of both.
// cos_theta: of the angle between wo and the microfacet normal; clamped to [0, 1].
// eta, k: real and imaginary part of the index of refraction over the index on wo's side, clamped to [1e-3, 1e3] and
//     [0, 1e3]; a k below 1e-8 counts as 0: a dielectric.
// return: in [0, 1].
// Accuracy: 24 eps (1 + condition number); double 24.
//     a - c is formed without cancellation, so that a reflectance near 0 (eta near 1, small k) keeps its digits.
VNDF_FN VNDF_REAL vndf_fresnel_conductor(VNDF_REAL cos_theta, VNDF_REAL eta, VNDF_REAL k) {
    VNDF_REAL c = vndf_impl_fresnel_cosine(cos_theta), rest = VNDF_R(1.0) - c;
    VNDF_REAL n = vndf_impl_min(vndf_impl_max(eta, VNDF_R(1e-3)), VNDF_R(1e3));
    VNDF_REAL most = k < VNDF_R(1e3) ? k : VNDF_R(1e3), absorbed = most > VNDF_R(1e-8) ? most : VNDF_R(0.0);
    VNDF_REAL s = rest * (VNDF_R(1.0) + c), contrast = (n - VNDF_R(1.0)) * (n + VNDF_R(1.0));
    // a^2 - b^2, a b, and the larger and the smaller of a and b.
    VNDF_REAL k2 = absorbed * absorbed, product = n * absorbed;
    VNDF_REAL difference = VNDF_FMA(c, c, contrast) - k2, size = vndf_impl_abs(difference);
    VNDF_REAL sum = VNDF_SQRT(VNDF_FMA(difference, difference, VNDF_R(4.0) * product * product));
    VNDF_REAL larger = VNDF_SQRT(VNDF_R(0.5) * (sum + size));
    VNDF_REAL smaller = VNDF_DIVIDE(product, larger > VNDF_R(0.0) ? larger : VNDF_R(1.0));
    int sees_through = difference > VNDF_R(0.0);
    VNDF_REAL a = sees_through ? larger : smaller, b = sees_through ? smaller : larger, b2 = b * b;
    // a - c = (a^2 - c^2) / (a + c). At grazing incidence on a = 0 both are 0.
    VNDF_REAL together = a + c,
              apart = VNDF_DIVIDE(contrast - k2 + b2, together > VNDF_R(0.0) ? together : VNDF_R(1.0));
    VNDF_REAL rs = VNDF_DIVIDE(VNDF_FMA(apart, apart, b2), VNDF_FMA(together, together, b2));
    VNDF_REAL ac = a * c, bc = b * c, bc2 = bc * bc, less = ac - s, more = ac + s;
    VNDF_REAL whole = VNDF_FMA(more, more, bc2);
    // Both are 0 at normal incidence on a mirror without a and b alone, where Rp = Rs.
    VNDF_REAL ratio = VNDF_DIVIDE(VNDF_FMA(less, less, bc2), whole > VNDF_R(0.0) ? whole : VNDF_R(1.0));
    return vndf_impl_share(VNDF_R(0.5) * VNDF_FMA(rs, ratio, rs));
}

VNDF_END

#endif
