// What a conformance run found, and its forms: table, JSON, JUnit XML.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "conformance/judge/digest.h"
#include "conformance/judge/finding.h"
#include "conformance/judge/lobes.h"
#include "registry.h"

namespace vndf::conformance {

enum class Verdict { pass, fail, known_bias, inexact };  // inexact: not wrong, but less precise than ours

struct FunctionReport {
    const Function* function = nullptr;
    std::vector<Finding> findings;
    // Of a user's function: the likeliest known mistake and what speaks for it, and what was not judged; or empty.
    std::string diagnosis = {}, not_judged = {};
    std::vector<LobePicture> pictures = {};  // of the lobes that CheckOptions asks for

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
    std::size_t samples = 0;       // for each lobe
    std::size_t in_histogram = 0;  // of these, in the histogram of directions
    std::size_t tests = 0;         // statistical tests in the run
    double family_rate = 0;        // of false alarms over all of them
    double level = 0;              // for each of them, after Sidak
    double seconds = 0;

    bool passed() const;
};

std::string to_string(Verdict);

using CommandOf = std::function<std::string(const Function&)>;

// A command that evaluates the worst inputs of a finding again, and what it gives.
struct Repetition {
    std::string command, gives;
};
// None if no input is worse than others, or its values were not asked for. real: the report's. `evaluate` is as in PageOptions.
std::vector<Repetition> repetitions(const Function& function, const Finding& finding, const std::string& real,
                                    const CommandOf& evaluate);

// One row a function: verdict, worst figure, its limit, worst input; then the failures in full, with the commands that evaluate
// them again if `evaluate` makes them, and a summary.
std::string format_table(const Report&, const CommandOf& evaluate = {});
std::string format_json(const Report&);
std::string format_junit(const Report&);

}  // namespace vndf::conformance
