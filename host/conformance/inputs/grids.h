// Where functions are checked: lobes for the statistics, points for the pointwise comparison. Everything is
// made from the names of a function's scalars, so a newly registered function needs nothing here unless it
// brings a new kind of argument.
#pragma once

#include <cstdint>
#include <vector>

#include "conformance/inputs/points.h"

namespace vndf::conformance {

// Lobes for the statistical checks of a sampler or a density: at least 60 for those that depend on wo (12 when quick),
// each different in the function's own arguments.
std::vector<Point> lobes(const Function& function, bool quick);

// The hard grid of `function`: corners of every argument range (about 30 000 points for a sampler).
std::vector<Point> hard_points(const Function& function);

// Points that guards answer: arguments at and beyond the ends of the domain, and samples next to the silhouette.
std::vector<Point> guard_points(const Function& function);

// `count` random points: log-uniform alpha and grazing angles, uniform and tail values of u.
std::vector<Point> random_points(const Function& function, std::size_t count, std::uint64_t seed);

// Random points as renderers have them, the domain of the promise of fast math: alpha in [1e-3, 10], |wo.z| >= 1e-2 (wo.z >
// 0 for a sampler of domain upper), u with its tails.
std::vector<Point> renderer_points(const Function& function, std::size_t count, std::uint64_t seed);

}  // namespace vndf::conformance
