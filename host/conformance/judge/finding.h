// One judged figure of a function.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "registry.h"

namespace vndf::conformance {

// What it means that a figure is beyond its limit: a mistake, lost precision, or nothing, since it was measured where the
// function is not claimed to be defined. Of registered functions each is a mistake.
enum class Concern { wrong, inexact, outside };
std::string to_string(Concern);

// "pointwise, front" 1.2 of 2.
struct Finding {
    std::string check;  // "chi2 of the pivots", "pointwise, front", ...
    double figure = 0;  // worst over the inputs
    double limit = 0;   // passes if figure <= limit (p-values: figure >= limit)
    std::string unit;   // "eps (1 + cond)", "p", ...
    bool is_p = false;  // a p-value: small is bad
    Concern concern = Concern::wrong;
    bool biased = false;    // a documented bias, measured: passes within 10 % of `limit`, what is documented
    std::string detail;     // further figures: "p50 0.4, max 31"
    std::string worst;      // worst input row in hex floats, "wo_x=0x1.8p-1 ..."
    std::size_t count = 0;  // inputs or tests behind the figure
    double p50 = 0, p99 = 0, max = 0;  // of the errors behind a pointwise figure
    // Of a pointwise figure: the worst inputs, and what the function and the reference make of them (if asked for).
    std::vector<double> row, result, exact;
    // What the figure compares the result with: other values of the user's functions.
    struct Value {
        const Function* function;
        std::vector<double> row, result;
    };
    std::vector<Value> beside = {};

    bool passed() const;
    // How near to the limit: above 1 is a failure. Comparable between kinds of figures.
    double severity() const;
};

}  // namespace vndf::conformance
