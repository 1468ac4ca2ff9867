// Exhaustion: every value of u at a fixed set of hard lobes. The device judges its own results
// (kernels/batch/exhaustive.cl) and returns counts alone.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "conformance/inputs/points.h"
#include "runtime/program.h"

namespace vndf::conformance {

// What every result of a sampler promises, in the order of the kernels' tallies.
inline constexpr std::size_t invariant_count = 5;

// A part of the walk: number `index` of `count` equal ones.
struct Slice {
    std::uint32_t index = 0, count = 1;
};

struct ExhaustiveOptions {
    double seconds = std::numeric_limits<double>::infinity();  // ends after the launch that exceeds it
    Slice slice;
    // Called with the sampler and how much of the run is done (0 to 1), between launches. False ends the run.
    std::function<bool(const std::string& what, double done)> proceed = [](const std::string&, double) {
        return true;
    };
};

// The inputs at which a sampler breaks one of its promises.
struct Offenders {
    std::string invariant;
    std::uint64_t count = 0;
    std::string first;  // the first found, in hex floats: "wo_x=0x1.8p-1 ... u2=0x1p-1"
};

struct Exhausted {
    const Function* sampler = nullptr;
    std::uint64_t inputs = 0;
    double seconds = 0;  // of the device
    std::vector<Offenders> offenders;
};

struct ExhaustiveReport {
    std::vector<Exhausted> samplers;
    std::string device, options, math;  // as they describe themselves
    std::uint64_t inputs = 0;           // walked
    std::uint64_t whole = 0;            // of the whole walk, all slices
    double seconds = 0;

    bool passed() const;
};

// The samplers among these functions, each once and without its _with_pdf form.
std::vector<const Function*> samplers_of(const std::vector<const Function*>& selected);

// The hard lobes of a sampler, u left out, in an order whose beginning is as varied as the whole.
std::vector<Point> exhaustive_lobes(const Function& sampler);

// In how many slices the walk can be parted so that none is empty.
std::uint32_t exhaustive_parts(const std::vector<const Function*>& samplers);

// A program for exhaust().
runtime::ProgramOptions exhaustive_program(const std::vector<const Function*>& samplers);

// Walks the samplers, in turns: in each pass over a lobe one u takes all multiples of 2^-24 in [0, 1), while the
// other is fixed at an end or a quarter of its range, or takes all of them too, in the order of a lattice. The
// program, of floats, must be made of exhaustive_program(samplers).
ExhaustiveReport exhaust(const runtime::Program& program, const std::vector<const Function*>& samplers,
                         const ExhaustiveOptions& options);

// One row a sampler: inputs, inputs a second, verdict; then the offenders and a summary.
std::string format_table(const ExhaustiveReport&);

}  // namespace vndf::conformance
