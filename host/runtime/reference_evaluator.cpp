#include <fmt/format.h>

#include "reference/reference.h"
#include "runtime/evaluator.h"

namespace vndf::runtime {
namespace {

template <class T>
void evaluate(const Function& function, std::size_t n, const std::vector<const void*>& inputs,
              const std::vector<void*>& outputs) {
    const auto precision = sizeof(T) == 4 ? reference::Precision::f32 : reference::Precision::f64;
    const auto evaluation = reference::find_evaluation<double>(function.name);
    std::vector<double> in(inputs.size()), out(outputs.size());
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t c = 0; c < in.size(); ++c) in[c] = static_cast<const T*>(inputs[c])[i];
        evaluation(in.data(), out.data(), precision);
        for (std::size_t c = 0; c < out.size(); ++c) static_cast<double*>(outputs[c])[i] = out[c];
    }
}

}  // namespace

void ReferenceEvaluator::run(const Function& function, std::size_t n, const std::vector<const void*>& inputs,
                             const std::vector<void*>& outputs) {
    (real_ == Real::f32 ? evaluate<float> : evaluate<double>)(function, n, inputs, outputs);
}

std::string ReferenceEvaluator::describe() const {
    return fmt::format("reference, inputs and clamps of {}", to_string(real_));
}

}  // namespace vndf::runtime
