#include "registry.h"

#include <algorithm>
#include <numeric>
#include <unordered_map>

#include "../kernels/batch/shapes.h"

namespace vndf {
namespace {

constexpr Ndf GGX = Ndf::ggx, BECKMANN = Ndf::beckmann, ANY = Ndf::any;
constexpr Method EXACT = Method::exact, APPROXIMATE = Method::approximate;
constexpr Domain SPHERE = Domain::sphere, UPPER = Domain::upper;
constexpr double NONE = 0;
constexpr Kind TERM = Kind::term, DENSITY = Kind::density, GEOMETRY = Kind::geometry;

Function with_pdf(Function sampler) {
    sampler.name += "_with_pdf";
    sampler.outputs.push_back("pdf");
    sampler.with_pdf = true;
    return sampler;
}

std::vector<Function> read_registry() {
    std::vector<Function> all;
#define VNDF_NAME(scalar) #scalar,
#define VNDF_RESULT_NAME(scalar, member) #scalar,
#define VNDF_COMMON(name_, ndf_, arguments_, result_, source_)                                         \
    Function f;                                                                                        \
    f.name = #name_, f.arguments = #arguments_, f.result = #result_, f.source = source_, f.ndf = ndf_; \
    f.inputs = {VNDF_SCALARS_##arguments_(VNDF_NAME)};                                                 \
    f.outputs = {VNDF_RESULTS_##result_(VNDF_RESULT_NAME)};
#define VNDF_SAMPLER(name, ndf, arguments, result, density_, method_, domain_, front, back, source) \
    {                                                                                               \
        VNDF_COMMON(name, ndf, arguments, result, source)                                           \
        f.kind = Kind::sampler, f.density = #density_, f.method = method_, f.domain = domain_;      \
        f.p99_front = front, f.p99_back = back;                                                     \
        all.push_back(f), all.push_back(with_pdf(f));                                               \
    }
#define VNDF_FUNCTION(name, ndf, arguments, result, kind_, bound_, source) \
    {                                                                      \
        VNDF_COMMON(name, ndf, arguments, result, source)                  \
        f.kind = kind_, f.bound = bound_;                                  \
        all.push_back(f);                                                  \
    }
#include "../kernels/samplers.def"
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
    static const std::vector<Function> all = read_registry();
    return all;
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

std::string_view to_string(Ndf ndf) {
    return ndf == Ndf::ggx ? "ggx" : ndf == Ndf::beckmann ? "beckmann" : "any";
}

std::string_view to_string(Kind kind) {
    switch (kind) {
        case Kind::sampler:
            return "sampler";
        case Kind::term:
            return "term";
        case Kind::density:
            return "density";
        default:
            return "geometry";
    }
}

std::string_view to_string(Method method) {
    return method == Method::exact ? "exact" : "approximate";
}

std::string_view to_string(Domain domain) {
    return domain == Domain::sphere ? "sphere" : "upper";
}

}  // namespace vndf
