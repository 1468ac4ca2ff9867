// A user's functions judged: the run of conformance in their scope, their own density, and what the likeliest mistake is.
#pragma once

#include "conformance/runs/check.h"
#include "conformance/runs/user_kernel.h"

namespace vndf::conformance {

// The kernel must outlive the report, whose functions it has.
Report check_user_kernel(const UserKernel& kernel, runtime::DeviceEvaluator& evaluator, CheckOptions options);

}  // namespace vndf::conformance
