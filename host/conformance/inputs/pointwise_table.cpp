#include "conformance/inputs/pointwise_table.h"

#include "conformance/inputs/rows.h"

namespace vndf::conformance {
namespace {

// Whether something comes from here: a value that is 0, or of a reflection below the horizon, which renderers drop, is nobody's
// concern.
bool is_met(const Function& function, const Point& point, Real real) {
    if (function.kind != Kind::density && function.kind != Kind::term) return true;
    if (function.support == Support::mirrored && !(point.wi[2] > 0)) return false;
    const std::vector<double> row = tabulate(function, {point}, real).row(0);
    double exact = 0;
    reference::find_evaluation<double>(function.model)(row.data(), &exact, precision(real));
    return exact != 0;
}

Table scoped_table(const Function& function, Real real, const PointwiseOptions& options) {
    std::vector<Point> points = scoped_points(function, *options.scope, options.random_points, options.seed);
    std::erase_if(points, [&](const Point& point) { return !is_met(function, point, real); });
    return tabulate(function, points, real);
}

}  // namespace

std::vector<Point> lobes(const Function& function, const PointwiseOptions& options) {
    return options.scope ? lobes(function, *options.scope, options.quick) : lobes(function, options.quick);
}

Table pointwise_table(const Function& function, Real real, const PointwiseOptions& options) {
    if (options.scope) return scoped_table(function, real, options);
    // Of areas between arcs each takes the reference a hundred times as long, and its condition thirty of those.
    const std::size_t share = function.unit == Unit::area ? 16 : 1;
    std::vector<Point> points = random_points(function, options.random_points / share, options.seed);
    const std::vector<Point> hard = hard_points(function);
    for (std::size_t i = 0; i < hard.size(); i += options.hard_stride * share) points.push_back(hard[i]);
    const std::vector<Point> guards = guard_points(function);
    for (std::size_t i = 0; i < guards.size(); i += options.guard_stride) points.push_back(guards[i]);
    return tabulate(function, points, real);
}

}  // namespace vndf::conformance
