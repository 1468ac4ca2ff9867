// What a conformance run found, and its forms: table, JSON, JUnit XML.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "conformance/judge/digest.h"
#include "registry.h"

namespace vndf::conformance {

// One judged figure of a function: "pointwise, front" 1.2 of 2.
struct Finding {
    std::string check;      // "chi2 of the pivots", "pointwise, front", ...
    double figure = 0;      // worst over the inputs
    double limit = 0;       // passes if figure <= limit (p-values: figure >= limit)
    std::string unit;       // "eps (1 + cond)", "p", ...
    bool is_p = false;      // a p-value: small is bad
    bool biased = false;    // a documented bias, measured: passes within 10 % of `limit`, what is documented
    std::string detail;     // further figures: "p50 0.4, max 31"
    std::string worst;      // worst input row in hex floats, "wo_x=0x1.8p-1 ..."
    std::size_t count = 0;  // inputs or tests behind the figure
    double p50 = 0, p99 = 0, max = 0;  // of the errors behind a pointwise figure

    bool passed() const;
    // How near to the limit: above 1 is a failure. Comparable between kinds of figures.
    double severity() const;
};

enum class Verdict { pass, fail, known_bias };

struct FunctionReport {
    const Function* function = nullptr;
    std::vector<Finding> findings;

    Verdict verdict() const;
    const Finding* worst() const;  // the finding of greatest severity; nullptr if there is none
};

struct Report {
    std::vector<FunctionReport> functions;
    std::string device, options;  // as they describe themselves
    std::string math, real;
    // Strict: how the results differ from the host build's, whose bits are promised; bit_rows inputs a function.
    // Stated, not judged: a device without correctly rounded division cannot keep them.
    std::vector<BitDifference> bits;
    std::size_t bit_rows = 0;
    std::uint64_t seed = 0;
    bool quick = false;
    std::size_t samples = 0;  // for each lobe
    std::size_t tests = 0;    // statistical tests in the run
    double family_rate = 0;   // of false alarms over all of them
    double level = 0;         // for each of them, after Sidak
    double seconds = 0;

    bool passed() const;
};

std::string to_string(Verdict);

// One row a function: verdict, worst figure, its limit, worst input; then the failures in full and a summary.
std::string format_table(const Report&);
std::string format_json(const Report&);
std::string format_junit(const Report&);

}  // namespace vndf::conformance
