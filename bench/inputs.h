// The inputs that functions are timed on.
#pragma once

#include "conformance/inputs/points.h"

namespace vndf::bench {

// wo uniform on the upper hemisphere (about n), each alpha log-uniform in [1e-3, 1], n uniform on the sphere, u
// uniform, eta in [1.05, 2.5]; wm a visible normal of the lobe, wi the reflection of wo about it.
std::vector<conformance::Point> points(std::size_t count, bool world_space);

// The one lobe of the compute-bound measurements: cos(theta) = 0.7, alpha = (0.3, 0.2).
conformance::Point lobe(bool world_space);

}  // namespace vndf::bench
