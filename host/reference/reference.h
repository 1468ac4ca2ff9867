// The independent reference: every registered function in C++, derived from the definitions.
//
// Nothing here is taken from kernels/. The distributions are stated once in stretched space (stretched.h):
// the visible normals of the unit hemisphere (GGX) or of the unit Gaussian (Beckmann) have a density that is
// a product in two angles (or slopes); every sampler is the root of an integral of that density. The same
// templates run in double, long double and dual numbers, so that one text gives values, judge for double
// kernels, and condition numbers.
#pragma once

#include <cstddef>
#include <string_view>

namespace vndf::reference {

// Whose domain holds: u is clamped to [2^-33, 1 - 2^-24] (f32) or [2^-65, 1 - 2^-53] (f64), poles give the
// largest finite number of that format. Each alpha below 1e-8 counts as 1e-8 for both.
enum class Precision { f32, f64 };

// One function of the registry on its scalars, `in` and `out` in the registry's order.
template <class R>
using Evaluation = void (*)(const R* in, R* out, Precision);

// The evaluation of a registered name, also of the _with_pdf forms; nullptr if there is none.
// R is double or long double.
template <class R>
Evaluation<R> find_evaluation(std::string_view name);

// The condition number of a sampler's direction at `in`,
//   sum over the inputs x_j of |x_j| * |d direction / d x_j|  +  |d direction / d (rotation of the stretched
//   azimuth)|.
// The derivatives are exact (dual numbers). At a switch between the branches of a map they are those of the
// branch taken.
using ConditionFunction = double (*)(const double* in, Precision);

// For a sampler's name, with or without _with_pdf; nullptr for other names.
ConditionFunction find_condition(std::string_view sampler);

// The same by name; throws std::invalid_argument if `sampler` is no sampler.
double condition(std::string_view sampler, const double* in, Precision precision);

// How far inside its cap the direction wi lies for a density of a bounded cap, vndf_ggx_pdf_wi_eto2023 or
// vndf_ggx_pdf_wi_eto2023_polygon, whose scalars `in` are:
// o_z + k i_z in stretched space over the change of o_z that one unit in the last place of wi (2^-24 or
// 2^-53) can make. The density is 0 below -8; a comparison should leave out -64 ... 64. Back-facing wo
// have no bound beyond the horizon of normals, other densities no cap: infinity.
double cap_margin(std::string_view density, const double* in, Precision precision);

// How far -wo is from the rim of a region whose area runs through normals below the surface, vndf_ggx_cap_mass and, from behind
// the surface, vndf_ggx_sigma_tilted: cos(beta) + wo . l. There the rim swings around -wo, and rounding decides where it is cut.
// Other regions: infinity.
double rim_margin(std::string_view name, const double* in, Precision precision);

}  // namespace vndf::reference
