// The tier of fast math: what the kernels promise where arithmetic is loosened by build options, against strict at equal
// arguments. Inside its domain, alpha in [1e-3, 10] and |wo.z| >= 1e-2, results are close to those of strict; everywhere they
// are finite where those are.
#pragma once

#include <string>
#include <vector>

#include "conformance/inputs/pointwise_table.h"
#include "conformance/judge/errors.h"
#include "conformance/runs/check.h"
#include "runtime/flag_sets.h"

namespace vndf::conformance {

// The promise, inside the domain.
struct FastMathLimits {
    double unit = 8;              // how far the length of a sample is from 1, in 2^-24
    double value = 1e-4;          // relative: densities, those of samplers among them, and other values
    double direction = 1e-5;      // the distance of two unit vectors, 99.9th percentile
    double direction_max = 1e-4;  // and maximum
};
inline constexpr FastMathLimits fast_math_limits;

// What one function does in one build.
struct FastMathFigures {
    const Function* function = nullptr;
    std::size_t inside = 0, everywhere = 0;  // rows
    std::size_t non_finite = 0;              // of both, by their bits, where strict is finite
    double unit = 0;
    Errors value, direction;
    std::string worst_value, worst_direction, worst_non_finite;  // rows

    std::vector<std::string> broken() const;  // "finite", "unit", "value", "direction"
};

// The rows of a function and what strict makes of them.
struct FastMathRows {
    const Function* function = nullptr;
    Table inside, everywhere;
    std::vector<std::vector<double>> strict_inside, strict_everywhere;  // [output][row]
};
FastMathRows fast_math_rows(runtime::Evaluator& strict, const Function& function,
                            const CheckOptions& options);
FastMathFigures fast_math_figures(runtime::Evaluator& fast, const FastMathRows& rows);

struct FastMathReport {
    struct Entry {
        std::string name, options;  // as asked for and as the compiler got them
        std::vector<FastMathFigures> functions;
        bool passed() const;
    };
    std::vector<Entry> entries;
    std::string device;
    std::uint64_t seed = 0;
    bool quick = false;
    double seconds = 0;

    bool passed() const;
};

// The functions in float in every set of flags: as renderers build, without correctly rounded division.
FastMathReport measure_fast_math(const runtime::Device& device, const std::vector<runtime::FlagSet>& sets,
                                 const std::vector<const Function*>& selected, const CheckOptions& options);

std::string format_table(const FastMathReport&);
std::string format_json(const FastMathReport&);

}  // namespace vndf::conformance
