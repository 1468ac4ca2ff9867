#include "conformance/inputs/pointwise_table.h"

#include "conformance/inputs/grids.h"

namespace vndf::conformance {

Table pointwise_table(const Function& function, Real real, const PointwiseOptions& options) {
    std::vector<Point> points = random_points(function, options.random_points, options.seed);
    const std::vector<Point> hard = hard_points(function);
    for (std::size_t i = 0; i < hard.size(); i += options.hard_stride) points.push_back(hard[i]);
    const std::vector<Point> guards = guard_points(function);
    for (std::size_t i = 0; i < guards.size(); i += options.guard_stride) points.push_back(guards[i]);
    return tabulate(function, points, real);
}

}  // namespace vndf::conformance
