// A user's samples against the density that the user says they have.
#pragma once

#include <cstdint>

#include "conformance/inputs/grids.h"
#include "conformance/judge/finding.h"
#include "runtime/device_evaluator.h"

namespace vndf::conformance {

// The histogram of samples in lobes of the scope against the density's integrals over its cells, by quadrature of the evaluator's
// values; its worst lobe, at a rate of false alarms of `family_rate` for all lobes.
Finding check_own_density(runtime::DeviceEvaluator& evaluator, const Function& sampler,
                          const Function& density, const Scope& scope, std::uint64_t seed,
                          double family_rate);

}  // namespace vndf::conformance
