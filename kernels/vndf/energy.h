// What single scattering loses of the light that falls on a rough conductor, and two ways to give it back: VNDF_ENERGY.
//
// The loss is 1 - E of a perfect mirror's facets, E the directional albedo. It comes from a table over the direction and the
// roughness, with linear interpolation: the header that VNDF_ENERGY_TABLE names, or that of VNDF_NDF and VNDF_MASKING here, which
// `clvndf energy` writes. Error of the loss, asserted by energy_test.cpp "the tables' losses are those by quadrature":
//     alpha in [1e-3, 2]: isotropic 3.5e-3 (GGX 1.6e-3), one alpha up to 2 times the other 0.065, up to 10 times 0.13.
// Anisotropy is an effective alpha, sqrt((alpha_x^2 + alpha_y^2) / 2), with the direction stretched by both. alpha above 2 counts
// as 2.
//
// Ground truth is walk_conductor.h; kernels/README.md says how far off the two are.
#ifndef VNDF_ENERGY_H
#define VNDF_ENERGY_H

#include "effects.h"
#include "energy_place.h"
#include "fresnel.h"
#include "impl/fresnel.h"

#if defined(VNDF_ENERGY_TABLE)
#include VNDF_ENERGY_TABLE
#elif VNDF_CHOSEN(VNDF_NDF, beckmann) && VNDF_CHOSEN(VNDF_MASKING, separable)
#include "energy_beckmann_separable.h"
#elif VNDF_CHOSEN(VNDF_NDF, beckmann)
#include "energy_beckmann_correlated.h"
#elif VNDF_CHOSEN(VNDF_MASKING, separable)
#include "energy_ggx_separable.h"
#else
#include "energy_ggx_correlated.h"
#endif

VNDF_BEGIN

// The place of a roughness: sqrt(alpha / 2), where small alphas are apart.
VNDF_FN VNDF_REAL vndf_impl_energy_row(VNDF_REAL2 alpha) {
    VNDF_REAL x = vndf_impl_alpha(alpha.x), y = vndf_impl_alpha_y(alpha.y);
    VNDF_REAL effective = VNDF_SQRT(VNDF_R(0.5) * VNDF_FMA(x, x, y * y));
    return vndf_impl_share(VNDF_SQRT(VNDF_R(0.5) * effective));
}

// The place of a direction, stretched by the roughness.
VNDF_FN VNDF_REAL vndf_impl_energy_column(VNDF_REAL3 w, VNDF_REAL2 alpha) {
    VNDF_REAL x = vndf_impl_alpha(alpha.x) * w.x, y = vndf_impl_alpha_y(alpha.y) * w.y;
    return vndf_impl_energy_place(VNDF_FMA(x, x, y * y), w.z);
}

// The loss 1 - E(w) of a conductor that reflects everything, by the table.
// w: unit vector, local frame. alpha: the table ends at 2.
// return: in [0, 1]; below the horizon as at it.
VNDF_FN VNDF_REAL vndf_energy_loss(VNDF_REAL3 w, VNDF_REAL2 alpha) {
    struct vndf_impl_between row = vndf_impl_between_of(vndf_impl_energy_row(alpha), VNDF_ENERGY_ROWS);
    // Made dependent on the row, and the second row's value on the first's, so that LLVM's SLP pass does not pack what is alike; the
    // other choices are never taken.
    VNDF_REAL place = row.share >= VNDF_R(0.0) ? vndf_impl_energy_column(w, alpha) : VNDF_R(0.0);
    struct vndf_impl_between column = vndf_impl_between_of(place, VNDF_ENERGY_COLUMNS);
    int cell = row.first * VNDF_ENERGY_COLUMNS + column.first;
    VNDF_REAL a = vndf_energy_losses[cell], b = vndf_energy_losses[cell + 1];
    VNDF_REAL low = VNDF_FMA(column.share, b - a, a);
    int next = low >= VNDF_R(0.0) ? cell + VNDF_ENERGY_COLUMNS : 0;
    VNDF_REAL c = vndf_energy_losses[next], d = vndf_energy_losses[next + 1];
    VNDF_REAL high = VNDF_FMA(column.share, d - c, c);
    return VNDF_FMA(row.share, high - low, low);
}

// The mean by the cosine law of what vndf_energy_loss gives, 1 - E_avg.
VNDF_FN VNDF_REAL vndf_energy_average_loss(VNDF_REAL2 alpha) {
    VNDF_REAL place = vndf_impl_energy_row(alpha);
    struct vndf_impl_between row = vndf_impl_between_of(place, VNDF_ENERGY_AVERAGES);
    VNDF_REAL a = vndf_energy_averages[row.first], b = vndf_energy_averages[row.first + 1];
    // The table has it over alpha / 2.
    return place * place * VNDF_FMA(row.share, b - a, a);
}

#if VNDF_CONDUCTOR && VNDF_CHOSEN(VNDF_ENERGY, turquin)

// The weight of single scattering, raised. Not reciprocal.
// Source: Turquin, Practical Multiple Scattering Compensation for Microfacet Models, 2019, Equation 16: 1 + F0 (1 - E) / E.
VNDF_FN struct vndf_rgb vndf_impl_turquin(struct vndf_rgb weight, struct vndf_rgb f0, VNDF_REAL loss) {
    VNDF_REAL rest = VNDF_R(1.0) - loss, raised = VNDF_DIVIDE(loss, rest > VNDF_R(0.0) ? rest : VNDF_R(1.0));
    // Each channel depends on the last, so that LLVM's SLP pass does not pack them; the other choice is never taken.
    VNDF_REAL red = weight.r * VNDF_FMA(f0.r, raised, VNDF_R(1.0));
    VNDF_REAL green = (red >= VNDF_R(0.0) ? weight.g : red) * VNDF_FMA(f0.g, raised, VNDF_R(1.0));
    VNDF_REAL blue = (green >= VNDF_R(0.0) ? weight.b : green) * VNDF_FMA(f0.b, raised, VNDF_R(1.0));
    return vndf_impl_rgb(red, green, blue);
}

#elif VNDF_CONDUCTOR && VNDF_CHOSEN(VNDF_ENERGY, kulla_conty)

// A diffuse lobe of one view direction: BSDF times cos(theta_i) is scale * loss(wi) times the density of the cosine law.
// Source: Kulla & Conty, Revisiting Physically Based Shading at Imageworks, 2017: (1 - E(wo)) (1 - E(wi)) / (pi (1 - E_avg)) times
//     F_avg^2 E_avg / (1 - F_avg (1 - E_avg)). Reciprocal.
struct vndf_impl_kulla_conty {
    struct vndf_rgb scale;
    VNDF_REAL share;  // of the light of a white conductor that it has, and the chance that it is drawn
};

// A lesser average counts as this, alpha = 0.02: what a smoother surface loses, it loses at grazing incidence alone, where the
// cosine law hardly ever draws; few samples of a weight beyond any bound would give it back.
#define VNDF_IMPL_LEAST_AVERAGE VNDF_R(0.001953125)

VNDF_FN VNDF_REAL vndf_impl_kulla_conty_factor(VNDF_REAL f, VNDF_REAL average) {
    VNDF_REAL bounded = vndf_impl_reflectance(f), rest = VNDF_FMA(-bounded, average, VNDF_R(1.0));
    return VNDF_DIVIDE(bounded * bounded * (VNDF_R(1.0) - average), rest > VNDF_R(0.0) ? rest : VNDF_R(1.0));
}
// f: the mean of the reflectance by the cosine law.
VNDF_FN struct vndf_impl_kulla_conty vndf_impl_kulla_conty_of(struct vndf_rgb f, VNDF_REAL loss,
                                                              VNDF_REAL average) {
    struct vndf_impl_kulla_conty lobe;
    VNDF_REAL ratio = VNDF_DIVIDE(loss, vndf_impl_max(average, VNDF_IMPL_LEAST_AVERAGE));
    // Each channel depends on the last, so that LLVM's SLP pass does not pack them; the other choice is never taken.
    VNDF_REAL red = vndf_impl_kulla_conty_factor(f.r, average);
    VNDF_REAL green = vndf_impl_kulla_conty_factor(red >= VNDF_R(0.0) ? f.g : VNDF_R(1.0), average);
    VNDF_REAL blue = vndf_impl_kulla_conty_factor(green >= VNDF_R(0.0) ? f.b : VNDF_R(1.0), average);
    lobe.scale = vndf_impl_rgb(ratio * red, ratio * green, ratio * blue);
    // Of the brightest channel, against what its single scattering has.
    VNDF_REAL most = vndf_impl_max(vndf_impl_max(f.r, f.g), f.b),
              factor = vndf_impl_max(vndf_impl_max(red, green), blue);
    VNDF_REAL own = loss * factor, whole = VNDF_FMA(most, VNDF_R(1.0) - loss, own);
    lobe.share = VNDF_DIVIDE(own, whole > VNDF_R(0.0) ? whole : VNDF_R(1.0));
    return lobe;
}
#undef VNDF_IMPL_LEAST_AVERAGE

#endif

VNDF_END

#endif
