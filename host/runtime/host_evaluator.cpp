#include <fmt/format.h>

#include "error.h"
#include "runtime/evaluator.h"
#include "runtime/host_build.h"

namespace vndf::runtime {

void require_host_policy(Math math) {
    if (math == Math::native) {
        throw InputError(
            "--math native: the host build has no native functions; strict or builtin are allowed");
    }
}

void require_policy(Math math, Real real) {
    if (math == Math::native && real == Real::f64) {
        throw InputError(
            "--math native --real double: native functions are float only; strict or builtin are allowed");
    }
}

void HostEvaluator::run(const Function& function, std::size_t n, const std::vector<const void*>& inputs,
                        const std::vector<void*>& outputs) {
    const bool strict = math_ == Math::strict;
    const auto find = real_ == Real::f32
                          ? (strict ? find_host_function_float_strict : find_host_function_float_builtin)
                          : (strict ? find_host_function_double_strict : find_host_function_double_builtin);
    find(function.name.c_str())(inputs.data(), outputs.data(), n);
}

std::string HostEvaluator::describe() const {
    return fmt::format("host build, {} {}", to_string(math_), to_string(real_));
}

}  // namespace vndf::runtime
