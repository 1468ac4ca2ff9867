// The registry kernels/samplers.def as C++ data: what exists, with which arguments, results and bounds.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace vndf {

enum class Ndf { ggx, beckmann, any };
enum class Kind { sampler, term, density, geometry };
enum class Method { exact, approximate };
enum class Domain { sphere, upper };

struct Function {
    std::string name;       // with the suffix _with_pdf for that form of a sampler
    std::string arguments;  // the registry's token, e.g. "WO_ALPHA_U"
    std::string result;     // "WM", "WI" or "VALUE"
    std::string source;
    Ndf ndf = Ndf::any;
    Kind kind = Kind::term;
    bool with_pdf = false;

    // The scalars in order, as CSV columns: {"wo_x", "wo_y", ...}; {"wm_x", "wm_y", "wm_z"[, "pdf"]} or
    // {"value"}.
    std::vector<std::string> inputs;
    std::vector<std::string> outputs;

    // Samplers only.
    std::string density;  // the registered density of the samples
    Method method = Method::exact;
    Domain domain = Domain::sphere;
    double p99_front = 0;  // units of 2^-24 (1 + condition number)
    double p99_back = 0;   // 0: nothing to bound, no wo is back-facing

    // Other kinds: maximum relative error in units of 2^-24.
    double bound = 0;
};

// Every function, in the registry's order; each sampler is followed by its _with_pdf form.
const std::vector<Function>& functions();

// The function of exactly this name, or nullptr.
const Function* find_function(std::string_view name);

// Up to `count` registered names nearest to `name` (edit distance), nearest first.
std::vector<std::string> nearest_names(std::string_view name, std::size_t count = 3);

std::string_view to_string(Ndf);
std::string_view to_string(Kind);
std::string_view to_string(Method);
std::string_view to_string(Domain);

}  // namespace vndf
