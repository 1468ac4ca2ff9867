// clvndf list
#include <algorithm>
#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "cli/streams.h"
#include "registry.h"

namespace vndf::cli {
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

void print_json() {
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
    put("{}\n", all.dump(2));
}

void print_table() {
    std::size_t widest = 0;
    for (const Function& f : functions()) widest = std::max(widest, f.name.size());
    for (const Function& f : functions()) {
        put("{:{}}  {:8}  {} -> {}\n", f.name, widest, to_string(f.kind), fmt::join(f.inputs, ","),
            fmt::join(f.outputs, ","));
    }
}

}  // namespace

void add_list(CLI::App& app, Common& common) {
    CLI::App* command = app.add_subcommand("list", "the functions, with their arguments and results");
    const auto json = std::make_shared<bool>(false);
    command->add_flag("--json", *json, "everything that the registry knows, as JSON");
    command->callback([json, &common] { common.action = [json] { *json ? print_json() : print_table(); }; });
}

}  // namespace vndf::cli
