// The documented bias of the one approximate sampler, measured anew.
#pragma once

#include <vector>

#include "conformance/judge/errors.h"
#include "conformance/judge/lobes.h"

namespace vndf::conformance {

// What the statistical tests of the sampler must allow for; zero for exact samplers. An approximate sampler
// without a documented bias also gets zero: it has to pass as exact.
KnownBias known_bias(const Function& sampler);

// The measured bias beside the documented one; nothing for exact samplers.
std::vector<Finding> measure_bias(runtime::Evaluator& evaluator, const Function& sampler);

}  // namespace vndf::conformance
