// A user's samples against the density that the user says they have.
#pragma once

#include <cstdint>
#include <vector>

#include "conformance/inputs/grids.h"
#include "conformance/judge/finding.h"
#include "runtime/device_evaluator.h"

namespace vndf::conformance {

// The lobes in which that is tested, each once.
std::vector<Point> own_density_lobes(const Function& sampler, const Scope& scope);

// The histogram of samples in each of these lobes against the density's integrals over its cells, by quadrature of the evaluator's
// values; the worst of them. `level`: the rate of false alarms of one.
Finding check_own_density(runtime::DeviceEvaluator& evaluator, const Function& sampler,
                          const Function& density, const Scope& scope, std::uint64_t seed, double level);

}  // namespace vndf::conformance
