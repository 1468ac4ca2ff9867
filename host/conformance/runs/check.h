// The conformance engine: every registered function on one device against the reference.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "conformance/inputs/grids.h"
#include "conformance/report/report.h"
#include "runtime/device_evaluator.h"

namespace vndf::conformance {

// Of which lobes a report keeps what was counted, to be drawn; and of which findings, beside those that fail, the values at
// the worst inputs.
enum class Pictures { none, failed, all };

struct CheckOptions {
    std::uint64_t seed = 1;
    std::size_t more_tests = 0;     // statistical ones that the caller adds, at the report's level
    std::size_t random_points = 0;  // of the pointwise comparison, beside the hard grid; 0: 2^16, quick 2^14
    bool quick = false;  // 12 lobes instead of 60 or more, 2^18 samples instead of 2^20, fewer points
    const Scope* scope = nullptr;  // of a user's functions (user_kernel.h)
    Pictures pictures = Pictures::none;
    bool draws(bool passed) const {
        return pictures == Pictures::all || (pictures == Pictures::failed && !passed);
    }
    // Called with what is being done and how much of the run is done (0 to 1).
    std::function<void(const std::string& what, double done)> progress = [](const std::string&, double) {};
};

// The registered functions whose names contain `pattern`, or match it as a glob (* and ?), in the registry's
// order. The empty pattern is every function.
std::vector<const Function*> select(const std::string& pattern);

// The names that the device's program needs to check these functions: their own, plain forms and densities.
std::vector<std::string> needed(const std::vector<const Function*>& selected);

// Checks the functions. The evaluator's program must hold needed(selected).
Report check(runtime::DeviceEvaluator& evaluator, runtime::Math math,
             const std::vector<const Function*>& selected, const CheckOptions& options);

}  // namespace vndf::conformance
