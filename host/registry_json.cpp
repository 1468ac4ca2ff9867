#include "registry_json.h"

#include <nlohmann/json.hpp>

#include "registry.h"

namespace vndf {
namespace {

nlohmann::ordered_json bounds(const Function& f, const Bounds& b) {
    if (f.kind != Kind::sampler) return {{"error", b.error}};
    const SamplerBounds& s = b.sampler;
    nlohmann::ordered_json json = {
        {"front", s.front},        {"back", s.back}, {"core", s.core},
        {"core_max", s.core_max},  {"pdf", s.pdf},   {"pdf_core_max", s.pdf_core_max},
        {"agreement", s.agreement}};
    if (s.back == 0) json["back"] = nullptr;
    return json;
}

nlohmann::ordered_json to_json(const Function& f) {
    nlohmann::ordered_json json = {
        {"name", f.name},           {"ndf", to_string(f.ndf)}, {"kind", to_string(f.kind)},
        {"signature", f.signature}, {"inputs", f.inputs},      {"outputs", f.outputs},
        {"source", f.source}};
    if (f.kind == Kind::sampler) {
        json["density"] = f.density;
        json["method"] = to_string(f.method);
        json["domain"] = to_string(f.domain);
    }
    if (f.kind == Kind::density) json["support"] = to_string(f.support);
    if (f.kind == Kind::inverse) json["sampler"] = f.sampler;
    if (f.kind != Kind::sampler) json["unit"] = to_string(f.unit);
    json["bounds"] = {{"float", bounds(f, f.float_bounds)}, {"double", bounds(f, f.double_bounds)}};
    return json;
}

}  // namespace

std::string registry_json() {
    nlohmann::ordered_json all = nlohmann::ordered_json::array();
    for (const Function& f : functions()) all.push_back(to_json(f));
    for (const LobeFunction& lobe : lobe_functions())
        all.push_back({{"name", lobe.name},
                       {"ndf", to_string(lobe.ndf)},
                       {"kind", "lobe"},
                       {"signature", lobe.signature},
                       {"type", lobe.type},
                       {"source", lobe.source}});
    for (const BsdfFunction& bsdf : bsdf_functions())
        all.push_back(
            {{"name", bsdf.name},
             {"ndf", to_string(Ndf::any)},
             {"kind", "material"},
             {"signature", bsdf.signature},
             {"source", bsdf.source},
             {"unit", to_string(Unit::plain)},
             {"bounds",
              {{"float", {{"error", bsdf.float_bound}}}, {"double", {{"error", bsdf.double_bound}}}}}});
    return all.dump(2);
}

}  // namespace vndf
