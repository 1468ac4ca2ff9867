// The same bits everywhere: every function over inputs that all machines make alike, as one hash, or compared with the
// host build result by result.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "conformance/inputs/points.h"
#include "runtime/evaluator.h"

namespace vndf::conformance {

inline constexpr std::size_t digest_rows = std::size_t{1} << 20, quick_digest_rows = std::size_t{1} << 12;

// Rows of inputs: the whole hard grid, then random points; or, where `rows` has no room for that, half of the rows
// drawn from the grid. Made by integer arithmetic, + - * / sqrt and scaling by powers of two alone, which have the same
// bits with every compiler and library.
Table digest_inputs(const Function& function, std::size_t rows, runtime::Real real);

struct BitsOptions {
    std::size_t rows = digest_rows;
    runtime::Math math = runtime::Math::strict;
    // The device replaces subnormal numbers by 0: results that this changes are exempt.
    bool flushes = false;
    // Called with what is being done and how much of the run is done (0 to 1).
    std::function<void(const std::string& what, double done)> progress = [](const std::string&, double) {};
};

struct Digest {
    const Function* function = nullptr;
    // FNV-1a (64 bits) over the bits of the results, row by row, lowest byte first; every NaN counts as the same one,
    // -0 and 0 as different. In exempt rows the host build's results stand for the device's.
    std::uint64_t hash = 0;
    std::size_t exempt = 0;
    // The largest change of a result in them, over the largest of the row's results.
    double moved = 0;
};

// The digests of `selected`, in its order.
std::vector<Digest> digests(runtime::Evaluator& evaluator, const std::vector<const Function*>& selected,
                            const BitsOptions& options);

// "NAME HASH", a line for each.
std::string format_digests(const std::vector<Digest>& digests);

// How one function's results differ from those of the host build.
struct BitDifference {
    const Function* function = nullptr;
    std::size_t differing = 0;  // rows
    std::size_t exempt = 0;     // rows, not among the differing
    std::uint64_t ulps = 0;     // the largest difference of a result
    std::string worst;          // its inputs in hex floats
};

// For each of `selected`, in its order.
std::vector<BitDifference> compare_with_host(runtime::Evaluator& evaluator,
                                             const std::vector<const Function*>& selected,
                                             const BitsOptions& options);

// "same bits as the host build: yes (...)", or "no" and a line for each function that differs.
std::string format_differences(const std::vector<BitDifference>& differences, std::size_t rows);

}  // namespace vndf::conformance
