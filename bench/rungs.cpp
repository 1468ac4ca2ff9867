#include "rungs.h"

#include <set>

#include <fmt/format.h>

#include "runtime/flag_sets.h"

namespace vndf::bench {
namespace {

using runtime::Math, runtime::Real;

const std::vector<Mode> memory_and_one_lobe = {Mode::stream, Mode::compute};

bool has_factored(const Function& function) {
    static const std::set<std::string> caps = {
        "vndf_ggx_sample_wm_dupuy2023", "vndf_ggx_sample_wm_benyoub2024", "vndf_ggx_sample_wi_eto2023"};
    return caps.contains(function.name);
}

// Kernels whose second, identical build tells what the noise of a ratio is.
bool is_built_again(const Function& function) {
    static const std::set<std::string> names = {"vndf_ggx_sample_wm_dupuy2023", "vndf_ggx_sample_wi_eto2023",
                                                "vndf_ggx_sample_wi_conic2026",
                                                "vndf_beckmann_sample_wm_heitz_deon2014"};
    return names.contains(function.name);
}

bool has_layouts(const Function& function) {
    static const std::set<std::string> names = {"vndf_ggx_sample_wm_dupuy2023", "vndf_ggx_sample_wi_eto2023",
                                                "vndf_beckmann_sample_wm_heitz_deon2014"};
    return names.contains(function.name);
}

std::vector<Mode> all_modes(const Function& function) {
    std::vector<Mode> modes = {Mode::stream, Mode::compute, Mode::cached};
    bool has_wo = false;
    for (const std::string& input : function.inputs) has_wo = has_wo || input == "wo_x";
    if (is_plain_sampler(function) && function.domain == Domain::sphere && has_wo)
        modes.push_back(Mode::cached_front);
    return modes;
}

// What the isotropic sampler competes with: a basis about n, the cap in it and back; ours and the listing. Azimuths are those
// of the basis: the distribution is the same, the map is another.
void add_basis(const Function& function, std::vector<Rung>& all) {
    if (function.name != "vndf_ggx_sample_wm_benyoub2024") return;
    const std::string root = "bench/cap_with_basis.cl";
    all.push_back({.name = "basis",
                   .modes = memory_and_one_lobe,
                   .callee = "vndf_bench_cap_with_basis",
                   .root = root,
                   .same_map = false});
    all.push_back({.name = "published_basis",
                   .modes = memory_and_one_lobe,
                   .math = Math::builtin,
                   .callee = "published_cap_with_basis",
                   .root = root,
                   .same_map = false});
}

// What the sampler of reflections into a cap competes with where a light fills it (bench/caps.py).
void add_caps(const Function& function, std::vector<Rung>& all) {
    if (function.name != "vndf_ggx_sample_wi_cone2026_with_pdf") return;
    for (const char* name : {"evenly", "both"})
        all.push_back({.name = name,
                       .modes = memory_and_one_lobe,
                       .callee = fmt::format("vndf_bench_cap_{}", name),
                       .root = fmt::format("bench/cap_{}.cl", name),
                       .same_map = false});
}

void add_listings(const Function& function, std::vector<Rung>& all) {
    if (!is_published(function)) return;
    const std::string name = function.name.substr(5);  // without vndf_
    const std::vector<Mode> modes = all_modes(function);
    all.push_back({.name = "published",
                   .modes = modes,
                   .math = Math::builtin,
                   .callee = "published_" + name,
                   .root = "bench/published/batch.cl"});
    all.push_back({.name = "lean", .modes = modes, .callee = "lean_" + name, .root = "bench/lean/batch.cl"});
    if (has_factored(function))
        all.push_back(
            {.name = "factored", .modes = modes, .callee = "lean_" + name, .root = "bench/lean/factored.cl"});
}

void add_layouts(const Function& function, std::vector<Rung>& all) {
    if (!has_layouts(function)) return;
    for (const char* layout : {"aos_vload3", "aos_float4", "aos_struct", "aos_stride", "aos_one"})
        all.push_back({.name = layout,
                       .modes = {Mode::stream, Mode::cached},
                       .callee = function.name,
                       .root = "bench/layouts.cl",
                       .layout = layout});
    if (function.name == "vndf_ggx_sample_wm_dupuy2023")
        all.push_back({.name = "readme",
                       .modes = {Mode::stream},
                       .callee = function.name,
                       .layout = "readme",
                       .same_map = false});
}

}  // namespace

std::string to_string(Mode mode) {
    switch (mode) {
        case Mode::stream:
            return "stream";
        case Mode::compute:
            return "compute";
        case Mode::cached:
            return "cached";
        default:
            return "cached_front";
    }
}

std::string entry_name(const Function& function, const std::string& form, Mode mode) {
    return fmt::format("{}/{}/{}", function.name, form, to_string(mode));
}

EntryName split(const std::string& entry) {
    const std::size_t first = entry.find('/'), last = entry.rfind('/');
    return {entry.substr(0, first), first == last ? std::string() : entry.substr(first + 1, last - first - 1),
            entry.substr(last + 1)};
}

bool is_published(const Function& function) {
    static const std::set<std::string> listings = {
        "vndf_ggx_sample_wm_heitz_deon2014",     "vndf_ggx_sample_wm_heitz2017",
        "vndf_ggx_sample_wm_heitz2018",          "vndf_ggx_sample_wm_dupuy2023",
        "vndf_ggx_sample_wm_benyoub2024",        "vndf_ggx_sample_wi_eto2023",
        "vndf_beckmann_sample_wm_heitz_deon2014"};
    return listings.contains(function.name);
}

bool is_quick(const Rung& rung) {
    return rung.real == Real::f32 && (rung.name == "strict" || rung.name.starts_with("strict_again") ||
                                      rung.name == "lean" || rung.name == "factored");
}

Rung again(const Function& function, std::size_t number) {
    return {
        .name = fmt::format("strict_again{}", number), .modes = all_modes(function), .callee = function.name};
}

int batch_of(const Rung& rung) {
    if (!rung.layout.empty() || !rung.flags.empty()) return 3;
    if (rung.real == Real::f64) return 2;
    return rung.name == "builtin" || rung.name == "native" ? 1 : 0;
}

std::vector<Rung> rungs(const Function& function, const runtime::Device& device) {
    std::vector<Rung> all;
    // A function of a lobe that is set up on the spot is the plain one, bit for bit: its time is all there is to know.
    if (function.arguments.find("LOBE") != std::string::npos)
        return {{.name = "strict", .modes = all_modes(function), .callee = function.name}};
    for (const Real real : {Real::f32, Real::f64}) {
        if (real == Real::f64 && !device.fp64) continue;
        for (const Math math : {Math::strict, Math::builtin, Math::native}) {
            if (real == Real::f64 && math == Math::native) continue;  // native means float
            all.push_back({.name = std::string(to_string(math)),
                           .modes = all_modes(function),
                           .math = math,
                           .real = real,
                           .callee = function.name});
        }
    }
    if (is_built_again(function)) all.push_back(again(function, 1));
    // What devices take whose own division is not correctly rounded.
    if (is_plain_sampler(function))
        all.push_back({.name = "strict_div",
                       .modes = {Mode::cached},
                       .callee = function.name,
                       .flags = "-cl-fp32-correctly-rounded-divide-sqrt -DVNDF_SOFTWARE_DIVIDE=1"});
    add_listings(function, all);
    add_basis(function, all);
    add_caps(function, all);
    add_layouts(function, all);
    if (is_plain_sampler(function))
        for (const runtime::FlagSet& set : runtime::distinct(runtime::renderer_flags()))
            all.push_back(
                {.name = set.name, .modes = {Mode::cached}, .callee = function.name, .flags = set.flags});
    all.push_back({.name = "cpp", .modes = memory_and_one_lobe, .callee = function.name, .on_device = false});
    return all;
}

}  // namespace vndf::bench
