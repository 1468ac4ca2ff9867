// What single scattering by rough glass has of the light that scattering between its facets would reflect and let through, and the
// factors that make up for it: VNDF_ENERGY turquin.
//
// Of a dielectric that absorbs nothing the random walk of walk_dielectric.h reflects the part R of the light along a direction and
// lets 1 - R through; the lobes of bsdf_dielectric.h have less, or at grazing angles from inside more, of each. Both parts over
// those of the walk come from one table over the direction, the roughness and the index, seen from either side, with linear
// interpolation: the header that VNDF_ENERGY_GLASS_TABLE names, or that of VNDF_NDF and VNDF_MASKING here, which `clvndf energy
// --of glass` writes. With both lobes over their part all light leaves, in the walk's proportions.
//
// Error of all light, the largest and the root of the mean square, for alpha in [1e-3, 1] and an index from 1.02 to 3 on either
// side, asserted by energy_test.cpp "quadrature finds that glass loses no light with the factors of the table":
//     isotropic 0.08, 0.006; one alpha up to 2 times the other 0.2, 0.018, up to 10 times 0.35, 0.035.
// Nearer to index 1 up to 0.4 stays lost: single scattering hides what facets hardly bend, and index 1 nothing.
//
// Anisotropy is an effective alpha: at grazing angles that along the direction, at normal incidence sqrt((alpha_x^2 + alpha_y^2) /
// 2). An alpha above 1 counts as 1, an index above 3 as 3 and one below 1 / 3 as that.
#ifndef VNDF_ENERGY_GLASS_H
#define VNDF_ENERGY_GLASS_H

#include "effects.h"
#include "energy_place.h"

#if defined(VNDF_ENERGY_GLASS_TABLE)
#include VNDF_ENERGY_GLASS_TABLE
#elif VNDF_CHOSEN(VNDF_NDF, beckmann) && VNDF_CHOSEN(VNDF_MASKING, separable)
#include "energy_glass_beckmann_separable.h"
#elif VNDF_CHOSEN(VNDF_NDF, beckmann)
#include "energy_glass_beckmann_correlated.h"
#elif VNDF_CHOSEN(VNDF_MASKING, separable)
#include "energy_glass_ggx_separable.h"
#else
#include "energy_glass_ggx_correlated.h"
#endif

VNDF_BEGIN

// Factors on the light that one facet reflects, and on what it lets through.
struct vndf_energy_factors {
    VNDF_REAL reflected, refracted;
};

// A cell of the table: where its first number stands, those of reflections and of refractions in turn, and how far in it.
struct vndf_impl_glass_cell {
    int first;
    VNDF_REAL layer, row, column;
};

// The place of an index: the cosine of the angle of total reflection, on the denser side, over that of index 3.
VNDF_FN VNDF_REAL vndf_impl_glass_layer(VNDF_REAL eta) {
    VNDF_REAL square = vndf_impl_abs(eta - VNDF_R(1.0)) * (eta + VNDF_R(1.0));
    return VNDF_DIVIDE(VNDF_SQRT(square), vndf_impl_max(eta, VNDF_R(1.0))) * VNDF_R(1.0606601717798212);
}

// The place of a roughness is its root, and that of a direction as in energy.h, stretched by the root of the roughness: the loss
// is steep at grazing angles, but what is reflected totally is not.
VNDF_FN struct vndf_impl_glass_cell vndf_impl_glass_cell_of(VNDF_REAL3 w, VNDF_REAL2 alpha, VNDF_REAL eta) {
    struct vndf_impl_glass_cell cell;
    VNDF_REAL ax = vndf_impl_share(vndf_impl_alpha(alpha.x)),
              ay = vndf_impl_share(vndf_impl_alpha_y(alpha.y));
    VNDF_REAL x = ax * w.x, y = ay * w.y, z = vndf_impl_max(w.z, VNDF_R(0.0)), l2 = VNDF_FMA(x, x, y * y);
    VNDF_REAL effective = VNDF_SQRT(VNDF_FMA(VNDF_R(0.5) * z * z, VNDF_FMA(ax, ax, ay * ay), l2));
    struct vndf_impl_between row = vndf_impl_between_of(VNDF_SQRT(effective), VNDF_ENERGY_GLASS_ROWS);
    // Each place depends on the last, so that LLVM's SLP pass does not pack them; the other choices are never taken. At -z nothing
    // is left of either.
    l2 = row.share >= VNDF_R(0.0) ? VNDF_DIVIDE(l2, effective > VNDF_R(0.0) ? effective : VNDF_R(1.0))
                                  : VNDF_R(0.0);
    struct vndf_impl_between column =
        vndf_impl_between_of(vndf_impl_energy_place(l2, z), VNDF_ENERGY_GLASS_COLUMNS);
    VNDF_REAL place = column.share >= VNDF_R(0.0) ? vndf_impl_glass_layer(eta) : VNDF_R(0.0);
    struct vndf_impl_between layer = vndf_impl_between_of(place, VNDF_ENERGY_GLASS_LAYERS);
    int whole = layer.first + (eta < VNDF_R(1.0) ? VNDF_ENERGY_GLASS_LAYERS : 0);
    cell.first =
        2 * ((whole * VNDF_ENERGY_GLASS_ROWS + row.first) * VNDF_ENERGY_GLASS_COLUMNS + column.first);
    cell.layer = layer.share;
    cell.row = row.share;
    cell.column = column.share;
    return cell;
}

// The part at a place of the table, from there along one axis, along two, along all; in units of 1 / VNDF_ENERGY_GLASS_ONE. Each
// second number is looked up after the first, so that LLVM's SLP pass does not pack them; place 0 is never taken for it.
VNDF_FN VNDF_REAL vndf_impl_glass_on_line(struct vndf_impl_glass_cell cell, int first) {
    VNDF_REAL a = (VNDF_REAL)vndf_energy_glass_parts[first],
              b = (VNDF_REAL)vndf_energy_glass_parts[first + 2];
    return VNDF_FMA(cell.column, b - a, a);
}
VNDF_FN VNDF_REAL vndf_impl_glass_on_plane(struct vndf_impl_glass_cell cell, int first) {
    VNDF_REAL low = vndf_impl_glass_on_line(cell, first);
    int next = low >= VNDF_R(0.0) ? first + 2 * VNDF_ENERGY_GLASS_COLUMNS : 0;
    return VNDF_FMA(cell.row, vndf_impl_glass_on_line(cell, next) - low, low);
}
VNDF_FN VNDF_REAL vndf_impl_glass_part(struct vndf_impl_glass_cell cell, int first) {
    VNDF_REAL low = vndf_impl_glass_on_plane(cell, first);
    int next = low >= VNDF_R(0.0) ? first + 2 * VNDF_ENERGY_GLASS_ROWS * VNDF_ENERGY_GLASS_COLUMNS : 0;
    return VNDF_FMA(cell.layer, vndf_impl_glass_on_plane(cell, next) - low, low);
}

// The factors for light along w, by the table.
// w: unit vector, local frame; below the horizon as at it.
// eta: index behind the surface over that in front, > 0.
// return: in (0, 1e4]; 1 for eta = 1, which nothing scatters.
VNDF_FN struct vndf_energy_factors vndf_energy_glass(VNDF_REAL3 w, VNDF_REAL2 alpha, VNDF_REAL eta) {
    struct vndf_energy_factors factors;
    struct vndf_impl_glass_cell cell = vndf_impl_glass_cell_of(w, alpha, eta);
    VNDF_REAL one = VNDF_ENERGY_GLASS_ONE, back = VNDF_DIVIDE(one, vndf_impl_glass_part(cell, cell.first));
    int other = back > VNDF_R(0.0) ? cell.first + 1 : 0;
    VNDF_REAL through = VNDF_DIVIDE(one, vndf_impl_glass_part(cell, other));
    factors.reflected = eta == VNDF_R(1.0) ? VNDF_R(1.0) : back;
    factors.refracted = eta == VNDF_R(1.0) ? VNDF_R(1.0) : through;
    return factors;
}

VNDF_END

#endif
