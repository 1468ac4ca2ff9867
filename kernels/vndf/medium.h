// Between surfaces: what a medium leaves of light, and its index for a colour.
#ifndef VNDF_MEDIUM_H
#define VNDF_MEDIUM_H

#include "impl/math.h"

VNDF_BEGIN

// What is left of light after a way through a medium that absorbs, of one channel.
// Source: Beer's law: exp(-sigma distance).
// distance: >= 0; others count as 0. Of light that never arrives anywhere any large number.
// sigma: what a unit of length absorbs, >= 0; others count as 0. In glTF's words (KHR_materials_volume) -log(attenuationColor) /
//     attenuationDistance.
// return: in [0, 1]; 1 for distance or sigma 0; 0 where it would be no normal number.
// Accuracy: 1.25 eps (1 + condition number); double 1.25.
VNDF_FN VNDF_REAL vndf_transmittance(VNDF_REAL distance, VNDF_REAL sigma) {
    // Of factors beyond 1e15 only 0 times any is not past the end of exp, and with these the product is a number.
    VNDF_REAL way = vndf_impl_min(vndf_impl_max(distance, VNDF_R(0.0)), VNDF_R(1e18)),
              depth = way * vndf_impl_min(vndf_impl_max(sigma, VNDF_R(0.0)), VNDF_R(1e18));
    return vndf_impl_exp(-depth);
}

// The index of refraction for light of a wavelength.
// Source: KHR_materials_dispersion, the first two terms of Cauchy's formula:
//     eta + (eta - 1) (dispersion / 20) (1 / wavelength^2 - 1 / d^2) / (1 / F^2 - 1 / C^2), Fraunhofer's lines C, d and F at 656.27,
//     587.56 and 486.13 nm; dispersion / 20 is 1 over Abbe's number.
// eta: the index at d; clamped to [1e-3, 1e3].
// dispersion: 20 over Abbe's number, >= 0; clamped to [0, 100]. 0: the index is eta, to the bit.
// wavelength: in nanometres, clamped to [300, 1000].
// return: in [1e-3, 1e3].
// Accuracy: 0.8 eps (1 + condition number); double 1.1.
VNDF_FN VNDF_REAL vndf_eta_dispersed(VNDF_REAL eta, VNDF_REAL dispersion, VNDF_REAL wavelength) {
    VNDF_REAL n = vndf_impl_min(vndf_impl_max(eta, VNDF_R(1e-3)), VNDF_R(1e3)),
              v = vndf_impl_min(vndf_impl_max(dispersion, VNDF_R(0.0)), VNDF_R(100.0)),
              w = vndf_impl_min(vndf_impl_max(wavelength, VNDF_R(300.0)), VNDF_R(1000.0));
    // 1 / w^2 - 1 / d^2 without cancellation, over 1 / F^2 - 1 / C^2 and 20 d^2: 1 / (20 d^2 (1 / F^2 - 1 / C^2)).
    VNDF_REAL rcp = VNDF_DIVIDE(VNDF_R(1.0), w),
              place = (VNDF_R(587.56) - w) * (VNDF_R(587.56) + w) * (rcp * rcp);
    VNDF_REAL part = VNDF_R(0.075842193807827282784) * v * place;
    return vndf_impl_min(vndf_impl_max(VNDF_FMA(n - VNDF_R(1.0), part, n), VNDF_R(1e-3)), VNDF_R(1e3));
}

VNDF_END

#endif
