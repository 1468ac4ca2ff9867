// The host build under fast math (fast_math_build.cpp) against the one without.
#pragma once

#include "conformance/runs/fast_math.h"
#include "runtime/host_build.h"

namespace vndf::runtime {

HostFunction find_fast_math_function_float(const char* name);

class FastMathEvaluator final : public Evaluator {
  public:
    void run(const Function& function, std::size_t n, const std::vector<const void*>& inputs,
             const std::vector<void*>& outputs) override {
        find_fast_math_function_float(function.name.c_str())(inputs.data(), outputs.data(), n);
    }
    Real input_real() const override { return Real::f32; }
    Real output_real() const override { return Real::f32; }
    std::string describe() const override { return "host build, fast math"; }
};

}  // namespace vndf::runtime

namespace vndf::conformance {

inline FastMathReport measure_host_fast_math(const std::string& name,
                                             const std::vector<const Function*>& selected,
                                             const CheckOptions& options) {
    runtime::HostEvaluator strict(Math::strict, Real::f32);
    runtime::FastMathEvaluator fast;
    FastMathReport report;
    report.device = "the host";
    report.seed = options.seed;
    report.quick = options.quick;
    report.entries = {{name, name, {}}};
    for (const Function* function : selected)
        report.entries[0].functions.push_back(
            fast_math_figures(fast, fast_math_rows(strict, *function, options)));
    return report;
}

}  // namespace vndf::conformance
