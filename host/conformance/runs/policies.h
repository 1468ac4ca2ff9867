// The policies of elementary functions and the build options that loosen arithmetic, told apart: the errors each
// makes, and the promises it breaks.
#pragma once

#include <string>
#include <vector>

#include "conformance/runs/check.h"
#include "conformance/inputs/pointwise_table.h"

namespace vndf::conformance {

// A way to build the kernels.
struct Build {
    Math math = Math::strict;
    std::string flag;  // a build option, or empty

    std::string name() const;  // "native", "strict -cl-mad-enable"
    // Held to the registry's bounds (builtin: 4 times). The others are measured against those of their policy.
    bool promised() const { return flag.empty() && math != Math::native; }
};

// strict first; double has no native_* functions.
std::vector<Build> builds(Real real);

// What one function does in one build.
struct Behaviour {
    const Function* function = nullptr;
    std::vector<Finding> findings;  // pointwise, judged as in every check
    std::size_t rows = 0;           // evaluated for the counts below
    std::size_t non_finite = 0;     // rows with a number that is NaN or infinite by its bits
    std::size_t different = 0;      // rows with other bits than strict without flags

    // The promises broken, by the names of the checks; "finite" and "same bits" (of strict) among them.
    std::vector<std::string> broken(const Build& build) const;
};

// `strict`: the results of strict without flags at the same rows, [output][row]; if empty, those of this
// evaluator, which are stored there.
Behaviour behaviour_of(runtime::Evaluator& evaluator, const Function& function,
                       const PointwiseOptions& options, std::vector<std::vector<double>>& strict);

struct PolicyReport {
    struct Entry {
        Build build;
        std::string options;  // as the device got them
        std::vector<Behaviour> functions;
    };
    std::vector<Entry> entries;
    std::string device, real;
    std::uint64_t seed = 0;
    bool quick = false;
    double seconds = 0;

    bool passed() const;  // the builds that promise keep their promise
};

// Runs the pointwise checks of the functions in every build. Evaluates no statistics.
PolicyReport measure_policies(const runtime::Device& device, Real real,
                              const std::vector<const Function*>& selected, const CheckOptions& options);

// A line for each function, build and accuracy; then, for each build, what it breaks.
std::string format_table(const PolicyReport&);
std::string format_json(const PolicyReport&);

}  // namespace vndf::conformance
