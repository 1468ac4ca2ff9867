// The conformance engine: every registered function on one device against the reference.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "conformance/inputs/grids.h"
#include "conformance/inputs/pointwise_table.h"
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

// A run in pieces that evaluators of one kind judge in any order and anywhere, with the same results: what a function makes of
// single inputs, and its samples some lobes at a time. The options must outlive it.
class CheckRun {
  public:
    CheckRun(runtime::Math math, runtime::Real real, const std::vector<const Function*>& selected,
             const CheckOptions& options);
    ~CheckRun();

    std::size_t pieces() const { return pieces_.size(); }
    // Bytes for take(). Threads may share the run, each with its own evaluator, whose program must hold needed(selected).
    std::string judge(runtime::DeviceEvaluator& evaluator, std::size_t piece) const;
    // Piece by piece, in their order.
    void take(const std::string& judged);
    // Once all are taken.
    Report finish();

  private:
    struct Piece {
        const Function* function;
        std::size_t first, end;  // lobes; none: everything else
        bool is_lobes() const { return first < end; }
    };
    struct Values;
    struct Taking;

    void plan(const Function& function);
    double work(const Piece& piece) const;
    bool compares_bits() const;
    Values judge_values(runtime::DeviceEvaluator& evaluator, const Function& function) const;
    void add_values(runtime::DeviceEvaluator& evaluator, const Function& function, Finding& finding) const;
    template <class T>
    std::vector<LobePicture> draw(runtime::DeviceEvaluator& evaluator, const Piece& piece) const;
    void finish_function();

    runtime::Math math_;
    runtime::Real real_;
    const CheckOptions& options_;
    PointwiseOptions pointwise_;
    std::vector<Piece> pieces_;
    Report report_;
    std::unique_ptr<Taking> taking_;
    std::size_t taken_ = 0;
    double work_total_ = 0, work_done_ = 0;
    std::chrono::steady_clock::time_point start_;
};

// Checks the functions. The evaluator's program must hold needed(selected).
Report check(runtime::DeviceEvaluator& evaluator, runtime::Math math,
             const std::vector<const Function*>& selected, const CheckOptions& options);

}  // namespace vndf::conformance
