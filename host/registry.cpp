#include "registry.h"

#include <algorithm>
#include <numeric>
#include <unordered_map>

#include "../kernels/batch/shapes.h"

namespace vndf {
namespace {

constexpr Ndf GGX = Ndf::ggx, BECKMANN = Ndf::beckmann, ANY = Ndf::any;
constexpr Method EXACT = Method::exact, APPROXIMATE = Method::approximate;
constexpr Domain SPHERE = Domain::sphere;
constexpr double NONE = 0;
constexpr Unit PLAIN = Unit::plain, EXPONENT = Unit::exponent, CONDITION = Unit::condition, AREA = Unit::area;
constexpr auto VISIBLE = Support::visible, MIRRORED = Support::mirrored, CAP = Support::cap,
               ABOVE = Support::above, LUNE = Support::lune;
// UPPER is a domain and a support.
constexpr struct {
    operator Domain() const { return Domain::upper; }
    operator Support() const { return Support::upper; }
} UPPER;

// Of a call whose first argument is set up on the spot, by what.
std::string lobe_of(std::string_view call) {
    return call.starts_with("vndf_") ? std::string(call.substr(0, call.find('('))) : std::string();
}

Function with_pdf(Function sampler) {
    sampler.model = sampler.name += "_with_pdf";
    sampler.outputs.push_back("pdf");
    sampler.with_pdf = true;
    return sampler;
}

std::vector<Function> read_functions() {
    std::vector<Function> all;
#define VNDF_NAME(scalar) #scalar,
#define VNDF_TEXT(...) #__VA_ARGS__
#define VNDF_TEXT_OF(...) VNDF_TEXT(__VA_ARGS__)
#define VNDF_RESULT_NAME(scalar, member) #scalar,
#define VNDF_TUPLE(...) \
    { __VA_ARGS__ }
#define VNDF_ROW(kind_, name_, ndf_, arguments_, result_, source_)        \
    Function f;                                                           \
    f.name = f.plain = f.model = #name_, f.source = source_;              \
    f.arguments = #arguments_, f.signature = VNDF_ARGUMENTS_##arguments_; \
    f.lobe = lobe_of(VNDF_TEXT_OF(VNDF_CALL_##arguments_));               \
    f.result = #result_, f.kind = kind_, f.ndf = ndf_;                    \
    f.inputs = {VNDF_SCALARS_##arguments_(VNDF_NAME)};                    \
    f.outputs = {VNDF_RESULTS_##result_(VNDF_RESULT_NAME)};
#define VNDF_ERRORS(unit_, in_float, in_double) \
    f.unit = unit_, f.float_bounds.error = in_float, f.double_bounds.error = in_double;
#define VNDF_SAMPLER(name, ndf, arguments, result, density_, method_, domain_, in_float, in_double, source) \
    {                                                                                                       \
        VNDF_ROW(Kind::sampler, name, ndf, arguments, result, source)                                       \
        f.density = #density_, f.method = method_, f.domain = domain_;                                      \
        f.float_bounds.sampler = VNDF_TUPLE in_float;                                                       \
        f.double_bounds.sampler = VNDF_TUPLE in_double;                                                     \
        all.push_back(f), all.push_back(with_pdf(f));                                                       \
    }
#define VNDF_DENSITY(name, ndf, arguments, support_, unit, in_float, in_double, source) \
    {                                                                                   \
        VNDF_ROW(Kind::density, name, ndf, arguments, VALUE, source)                    \
        VNDF_ERRORS(unit, in_float, in_double)                                          \
        f.support = support_, all.push_back(f);                                         \
    }
#define VNDF_TERM(name, ndf, arguments, unit, in_float, in_double, source) \
    {                                                                      \
        VNDF_ROW(Kind::term, name, ndf, arguments, VALUE, source)          \
        VNDF_ERRORS(unit, in_float, in_double)                             \
        all.push_back(f);                                                  \
    }
#define VNDF_PAIR(name, ndf, arguments, result, unit, in_float, in_double, source) \
    {                                                                              \
        VNDF_ROW(Kind::pair, name, ndf, arguments, result, source)                 \
        VNDF_ERRORS(unit, in_float, in_double)                                     \
        all.push_back(f);                                                          \
    }
#define VNDF_INVERSE(name, ndf, arguments, sampler_, unit, in_float, in_double, source) \
    {                                                                                   \
        VNDF_ROW(Kind::inverse, name, ndf, arguments, U, source)                        \
        VNDF_ERRORS(unit, in_float, in_double)                                          \
        f.sampler = #sampler_, all.push_back(f);                                        \
    }
#define VNDF_GEOMETRY(name, ndf, arguments, result, unit, in_float, in_double, source) \
    {                                                                                  \
        VNDF_ROW(Kind::geometry, name, ndf, arguments, result, source)                 \
        VNDF_ERRORS(unit, in_float, in_double)                                         \
        all.push_back(f);                                                              \
    }
#include "../kernels/registry.def"
    return all;
}

std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i + 1;
        for (std::size_t j = 0; j < b.size(); ++j) {
            const std::size_t above = row[j + 1];
            row[j + 1] = std::min({above + 1, row[j] + 1, diagonal + (a[i] != b[j])});
            diagonal = above;
        }
    }
    return row.back();
}

}  // namespace

const std::vector<Function>& functions() {
    static const std::vector<Function> all = read_functions();
    return all;
}

const std::vector<LobeFunction>& lobe_functions() {
    static const std::vector<LobeFunction> all = {
#define VNDF_LOBE(name, ndf, arguments, type, source) {#name, VNDF_ARGUMENTS_##arguments, type, source, ndf},
#include "../kernels/registry.def"
    };
    return all;
}

const std::vector<BsdfFunction>& bsdf_functions() {
    static const std::vector<BsdfFunction> all = {
#define VNDF_BSDF(name, arguments, in_float, in_double, source) \
    {#name, arguments, source, in_float, in_double},
#include "../kernels/registry.def"
    };
    return all;
}

double length_bound(std::string_view result) {
    return result == "WI" ? VNDF_BOUND_LENGTH_WI : VNDF_BOUND_LENGTH_WM;
}

double side_bound() {
    return VNDF_BOUND_SIDE;
}

double tangent_bound() {
    return VNDF_BOUND_TANGENT;
}

double frame_bound() {
    return VNDF_BOUND_FRAME;
}

const Function* find_function(std::string_view name) {
    static const auto by_name = [] {
        std::unordered_map<std::string_view, const Function*> map;
        for (const Function& f : functions()) map.emplace(f.name, &f);
        return map;
    }();
    const auto found = by_name.find(name);
    return found == by_name.end() ? nullptr : found->second;
}

std::vector<std::string> nearest_names(std::string_view name, std::size_t count) {
    std::vector<std::pair<std::size_t, std::string>> ranked;
    for (const Function& f : functions()) ranked.emplace_back(edit_distance(name, f.name), f.name);
    count = std::min(count, ranked.size());
    std::partial_sort(ranked.begin(), ranked.begin() + count, ranked.end());
    std::vector<std::string> names;
    for (std::size_t i = 0; i < count; ++i) names.push_back(ranked[i].second);
    return names;
}

bool may_miss(const Function& sampler) {
    const Function* density = find_function(sampler.density);
    return density && density->support == Support::lune;
}

bool has_exponent(Ndf ndf) {
    switch (ndf) {
        case Ndf::beckmann:
            return true;
        case Ndf::ggx:
        case Ndf::any:
            return false;
    }
    return false;
}

std::string_view to_string(Ndf ndf) {
    switch (ndf) {
        case Ndf::ggx:
            return "ggx";
        case Ndf::beckmann:
            return "beckmann";
        case Ndf::any:
            return "any";
    }
    return {};
}

std::string_view to_string(Kind kind) {
    switch (kind) {
        case Kind::sampler:
            return "sampler";
        case Kind::density:
            return "density";
        case Kind::term:
            return "term";
        case Kind::pair:
            return "pair";
        case Kind::inverse:
            return "inverse";
        case Kind::geometry:
            return "geometry";
    }
    return {};
}

std::string_view to_string(Unit unit) {
    switch (unit) {
        case Unit::plain:
            return "eps";
        case Unit::exponent:
            return "eps (1 + 2 q)";
        case Unit::condition:
            return "eps (1 + condition number)";
        case Unit::area:
            return "eps (|alpha wo| + condition number)";
    }
    return {};
}

std::string_view to_string(Method method) {
    return method == Method::exact ? "exact" : "approximate";
}

std::string_view to_string(Domain domain) {
    return domain == Domain::sphere ? "sphere" : "upper";
}

std::string_view to_string(Support support) {
    switch (support) {
        case Support::upper:
            return "upper";
        case Support::visible:
            return "visible";
        case Support::mirrored:
            return "mirrored";
        case Support::cap:
            return "cap";
        case Support::above:
            return "above";
        case Support::lune:
            return "lune";
    }
    return {};
}

}  // namespace vndf
