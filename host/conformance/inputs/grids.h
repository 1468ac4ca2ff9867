// Where functions are checked: lobes for the statistics, points for the pointwise comparison. Everything is
// made from the names of a function's scalars, so a newly registered function needs nothing here unless it
// brings a new kind of argument.
#pragma once

#include <cstdint>
#include <vector>

#include "conformance/inputs/points.h"

namespace vndf::conformance {

// Where a user's function is judged.
struct Scope {
    Domain domain = Domain::upper;  // wo.z >= 0, or every wo
    AlphaRange alpha;
    bool isotropic = false;  // alpha.x = alpha.y alone
};

// Lobes for the statistical checks of a sampler or a density: at least 60 for those that depend on wo (12 when quick),
// each different in the function's own arguments.
std::vector<Point> lobes(const Function& function, bool quick);

// The same lobes with their alphas moved into the scope's range.
std::vector<Point> lobes(const Function& function, const Scope& scope, bool quick);

// The hard grid of `function`: corners of every argument range (about 30 000 points for a sampler).
std::vector<Point> hard_points(const Function& function);

// Points that guards answer: arguments at and beyond the ends of the domain, and samples next to the silhouette.
std::vector<Point> guard_points(const Function& function);

// `count` random points: log-uniform alpha and grazing angles, uniform and tail values of u.
std::vector<Point> random_points(const Function& function, std::size_t count, std::uint64_t seed);

// Random points as renderers have them, the domain of the promise of fast math: alpha in [1e-3, 10], |wo.z| >= 1e-2 (wo.z >
// 0 for a sampler of domain upper), u with its tails.
std::vector<Point> renderer_points(const Function& function, std::size_t count, std::uint64_t seed);

// `count` random points in a scope: wo from grazing (a thousandth) to the normal, microfacet normals and u as samplers meet them;
// and behind them the corners: views along the axes, the ends of the range of alpha, u at 0 and next to 1.
std::vector<Point> scoped_points(const Function& function, const Scope& scope, std::size_t count,
                                 std::uint64_t seed);

}  // namespace vndf::conformance
