// What the Python package calls; clvndf/_library.py declares it again. Text that is returned lasts until the thread's
// next call. A null pointer stands for a failure, which clvndf_error() tells.
#include <string>
#include <vector>

#include "emit/emit.h"
#include "error.h"
#include "registry_json.h"
#include "runtime/evaluator.h"
#include "runtime/sources.h"

namespace {

using namespace vndf;

thread_local std::string text, error;

template <class Body>
const char* text_of(Body body) {
    try {
        text = body();
        return text.c_str();
    } catch (const std::exception& e) {
        error = e.what();
        return nullptr;
    }
}

}  // namespace

#define CLVNDF_PYTHON extern "C" __attribute__((visibility("default")))

CLVNDF_PYTHON const char* clvndf_error() {
    return error.c_str();
}

CLVNDF_PYTHON const char* clvndf_version() {
    return CLVNDF_VERSION;
}

CLVNDF_PYTHON const char* clvndf_registry() {
    return text_of(registry_json);
}

CLVNDF_PYTHON const char* clvndf_text() {
    return text_of([] { return runtime::assemble("kernels/vndf/vndf.h"); });
}

CLVNDF_PYTHON const char* clvndf_options(int math, int real, bool fma, bool correct_divide_sqrt) {
    return text_of([&] {
        const auto policy = static_cast<runtime::Math>(math);
        const auto type = static_cast<runtime::Real>(real);
        runtime::require_policy(policy, type);
        return runtime::build_options(
            policy, type, fma,
            correct_divide_sqrt ? runtime::Division::hardware : runtime::Division::software);
    });
}

CLVNDF_PYTHON const char* clvndf_resolve(const char* name) {
    return text_of([&] { return emit::resolve(name); });
}

CLVNDF_PYTHON const char* clvndf_emit(const char* const* names, std::size_t count, int language, int math,
                                      int real, const char* prefix, const char* effects, bool selftest) {
    return text_of([&] {
        emit::Options options;
        for (std::size_t i = 0; i < count; ++i) options.functions.push_back(emit::resolve(names[i]));
        options.language = static_cast<emit::Language>(language);
        options.math = static_cast<runtime::Math>(math);
        options.real = static_cast<runtime::Real>(real);
        options.prefix = prefix;
        options.effects = effects;
        options.selftest = selftest;
        return emit::emit(options);
    });
}

// The registered function of exactly this name on n rows: an array for each of its scalars, strict or builtin.
CLVNDF_PYTHON void clvndf_evaluate(const char* name, int math, int real, std::size_t n,
                                   const void* const* inputs, void* const* outputs) {
    const Function& function = *find_function(name);
    const std::vector<const void*> in(inputs, inputs + function.inputs.size());
    const std::vector<void*> out(outputs, outputs + function.outputs.size());
    runtime::HostEvaluator(static_cast<runtime::Math>(math), static_cast<runtime::Real>(real))
        .run(function, n, in, out);
}
