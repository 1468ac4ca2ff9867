// The inputs that functions are timed on.
#pragma once

#include <string>

#include "conformance/inputs/points.h"

namespace vndf::bench {

// Where wo lies: above the surface, below it, or in turn.
enum class Side { front, back, both };

using conformance::AlphaRange;

// wo uniform on the hemisphere (about n), each alpha log-uniform in its range, n uniform on the sphere, u uniform, eta in
// [1.05, 2.5]; for wo above the surface wm a visible normal of the lobe, wi the reflection of wo about it.
std::vector<conformance::Point> points(std::size_t count, bool world_space, Side side = Side::front,
                                       AlphaRange alpha = {});

// In words, for reports.
std::string describe_inputs(AlphaRange alpha);

// The one lobe of the compute-bound measurements: cos(theta) = 0.7, alpha = (0.3, 0.2).
conformance::Point lobe(bool world_space);

}  // namespace vndf::bench
