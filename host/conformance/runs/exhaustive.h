// Exhaustion: every value of u at a fixed set of hard lobes. The device judges its own results
// (kernels/batch/exhaustive.cl) and returns counts alone.
#pragma once

#include <cstdint>
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
    std::vector<Exhausted> samplers = {};
    std::string device, options, math;  // as they describe themselves
    std::uint64_t inputs = 0;           // walked
    std::uint64_t whole = 0;            // of the whole walk, all slices
    double seconds = 0;                 // that it took

    bool passed() const;
};

// The samplers among these functions, each once and without its _with_pdf form.
std::vector<const Function*> samplers_of(const std::vector<const Function*>& selected);

// The hard lobes of a sampler, u left out, in an order whose beginning is as varied as the whole.
std::vector<Point> exhaustive_lobes(const Function& sampler);

// In how many slices the walk can be parted so that none is empty.
std::uint32_t exhaustive_parts(const std::vector<const Function*>& samplers);

// A program for ExhaustiveWalker.
runtime::ProgramOptions exhaustive_program(const std::vector<const Function*>& samplers);

// A walk in pieces that any devices of one kind do in any order: in each, every sampler passes over one of its lobes. In a pass
// one u takes all multiples of 2^-24 in [0, 1), while the other is fixed at an end or a quarter of its range, or takes all of
// them too, in the order of a lattice.
class ExhaustiveWalk {
  public:
    explicit ExhaustiveWalk(const std::vector<const Function*>& samplers, Slice slice = {});

    std::uint32_t pieces() const;
    std::uint32_t taken() const { return taken_; }
    // What an ExhaustiveWalker returned, piece by piece in their order.
    void take(const std::string& walked);
    // Of the pieces taken; the caller adds the time.
    const ExhaustiveReport& report() const { return report_; }

    // Goes on behind the first `taken` pieces, of which this was reported.
    void resume(std::uint32_t taken, ExhaustiveReport report);
    // The inputs of a sampler in the first pieces.
    std::uint64_t inputs(std::size_t sampler, std::uint32_t pieces) const;

  private:
    friend class ExhaustiveWalker;
    struct Place {
        std::uint32_t round, lobe;
    };
    Place place(std::uint32_t piece) const;

    std::vector<const Function*> samplers_;
    std::vector<std::uint32_t> lobes_;  // of each sampler
    std::uint32_t most_lobes_ = 0;
    Slice slice_;
    std::uint32_t taken_ = 0;
    ExhaustiveReport report_;
};

// Walks on a device. The program, of floats, must be made of exhaustive_program(samplers).
class ExhaustiveWalker {
  public:
    ExhaustiveWalker(const ExhaustiveWalk& walk, runtime::Program program);
    ~ExhaustiveWalker();

    // Bytes for take().
    std::string walk(std::uint32_t piece);

  private:
    class OneSampler;

    const ExhaustiveWalk& walk_;
    runtime::Program program_;
    cl::Buffer tally_;
    std::vector<OneSampler> samplers_;
};

// One row a sampler: inputs, inputs a second, verdict; then the offenders and a summary.
std::string format_table(const ExhaustiveReport&);

}  // namespace vndf::conformance
