// The registry kernels/registry.def as C++ data: what exists, with which arguments, results and bounds.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace vndf {

enum class Ndf { ggx, beckmann, any };
enum class Kind { sampler, density, term, pair, inverse, geometry };
enum class Method { exact, approximate };
enum class Domain { sphere, upper };
// What a relative error is counted in, beside epsilon: 1, 1 + 2 q with the exponent q of a Beckmann function, or 1 + the
// condition number; of an error, not a relative one: |alpha wo| + the condition number of the value.
enum class Unit { plain, exponent, condition, area };
enum class Support { upper, visible, mirrored, cap, above, lune };

// What `strict` promises, in units of 2^-24 (float) or 2^-53 (double); registry.def says of what.
struct SamplerBounds {
    double front = 0,
           back = 0;  // angle over 1 + condition number, 99th percentile; back 0: not defined there
    double core = 0, core_max = 0;  // 99.9th percentile, maximum
    double pdf = 0, pdf_core_max = 0;
    double agreement = 0;
};
struct Bounds {
    SamplerBounds sampler;
    double error = 0;  // of other kinds
};

// Of every sampler, in those units: how far the length of a "WM" or "WI" is from 1, and how far a normal is on the wrong side.
double length_bound(std::string_view result);
double side_bound();
// Of frames: the length of a tangent and its cosine with n; the sine of the angle to n in local space, relative, and the way
// there and back.
double tangent_bound();
double frame_bound();

struct Function {
    std::string name;   // with the suffix _with_pdf for that form of a sampler
    std::string plain;  // without it
    std::string
        model;  // whose reference it is compared with: itself, but of a user's function; empty: any map will do
    std::string arguments;  // the registry's token, e.g. "WO_ALPHA_U"
    std::string signature;  // "wo, alpha, u"
    std::string lobe;       // of one that takes a lobe, what sets it up
    std::string result;     // "WM", "WI", "VALUE", "PDF_BOTH", "EVAL_PDF" or "U"
    std::string source;
    Ndf ndf = Ndf::any;
    Kind kind = Kind::term;
    bool with_pdf = false;

    // The scalars in order, as CSV columns: {"wo_x", "wo_y", ...}; {"wm_x", "wm_y", "wm_z"[, "pdf"]} or
    // {"value"}.
    std::vector<std::string> inputs;
    std::vector<std::string> outputs;

    std::string density;  // of a sampler: the registered density of the samples
    Method method = Method::exact;
    Domain domain = Domain::sphere;
    Support support = Support::upper;  // of a density
    std::string sampler;               // of an inverse: whose directions it takes

    Bounds float_bounds, double_bounds;
    Unit unit = Unit::plain;
};

// Every function, in the registry's order; each sampler is followed by its _with_pdf form.
const std::vector<Function>& functions();

// What sets up a lobe for functions that take one: no function of numbers alone.
struct LobeFunction {
    std::string name, signature, type, source;
    Ndf ndf = Ndf::any;
};
const std::vector<LobeFunction>& lobe_functions();

// A function of a material (kernels/vndf/bsdf.h), which has the choices and effects of its program: what is promised for each
// of them.
struct BsdfFunction {
    std::string name, signature, source;
    double float_bound = 0, double_bound = 0;
};
const std::vector<BsdfFunction>& bsdf_functions();

// The function of exactly this name, or nullptr.
const Function* find_function(std::string_view name);

// Up to `count` registered names nearest to `name` (edit distance), nearest first.
std::vector<std::string> nearest_names(std::string_view name, std::size_t count = 3);

// A sampler in the form that returns the direction alone.
inline bool is_plain_sampler(const Function& function) {
    return function.kind == Kind::sampler && !function.with_pdf;
}

// Whether samples may be lost, a zero vector with density 0: where that density has not all of the samplers' region.
bool may_miss(const Function& sampler);

// Whether the distribution is exponential in the slopes, so that errors grow with the exponent.
bool has_exponent(Ndf);

std::string_view to_string(Ndf);
std::string_view to_string(Kind);
std::string_view to_string(Method);
std::string_view to_string(Domain);
std::string_view to_string(Support);
std::string_view to_string(Unit);  // "eps (1 + 2 q)"

}  // namespace vndf
