// On PoCL's CPU device every entry point is turned into vector code across work-items. One innocent edit can undo that
// and cost a factor of five, with every result still right; so this reads what the vectoriser says.
// The remarks of a process that compiles everything are read (support/vectoriser.h).
#include <cstdlib>
#include <map>
#include <string>
#include <vector>

#include "bench/sources.h"
#include "runtime/device_evaluator.h"
#include "support/bsdf_program.h"
#include "support/catch.h"
#include "support/shard.h"
#include "support/skip.h"
#include "support/vectoriser.h"

namespace {

using namespace vndf;

const std::string own_root = "kernels/batch/batch.cl", published_root = "bench/published/batch.cl",
                  material_root = "kernels/batch/bsdf.cl";

// Functions whose entry points are not vectorised on PoCL 3.1, each with the reason.
const std::map<std::string, std::string> exceptions = {
    {"vndf_ggx_sigma_tilted", "a loop over arcs"},
    {"vndf_ggx_triangle_mass", "likewise"},
    {"vndf_ggx_quad_mass", "likewise"},
    {"vndf_ggx_cap_mass", "LLVM packs what the ends of an arc have alike"},
};

// A mistake that keeps the cap from being vectorised: a builtin that PoCL calls once for each work-item.
const std::string mutant_function = "vndf_ggx_sample_wm_dupuy2023";
const runtime::Substitution scalar_call{"kernels/vndf/impl/lobe.h", "radius * vndf_impl_circle_cos(u1)",
                                        "radius * pow(u1, radius)", 1};

// What a process compiles that is started to print remarks, by its environment: the program at CLVNDF_REMARKS_ROOT, in
// CLVNDF_REMARKS_REAL, with CLVNDF_REMARKS_MUTANT 1 of the mistake alone the functions of the cap; of materials, with
// CLVNDF_REMARKS_SWITCHES.
struct Compilation {
    std::string root;
    runtime::Real real = runtime::Real::f32;
    bool mutant = false;
    std::string switches = "";
};

// What it prints, by entry point.
std::map<std::string, Remarks> remarks(const Compilation& compilation) {
    return remarks_in(remarks_of("compiles every entry point",
                                 "CLVNDF_REMARKS_ROOT='" + compilation.root +
                                     "' CLVNDF_REMARKS_REAL=" + std::string(to_string(compilation.real)) +
                                     " CLVNDF_REMARKS_MUTANT=" + (compilation.mutant ? "1" : "0") +
                                     " CLVNDF_REMARKS_SWITCHES='" + compilation.switches + "'",
                                 "cache"),
                      "vndf_batch_");
}

}  // namespace

TEST_CASE("compiles every entry point", "[.]") {
    const char* root = std::getenv("CLVNDF_REMARKS_ROOT");
    if (!root) return;  // not the child process of remarks()
    if (root == material_root) {
        const BsdfProgram program(std::getenv("CLVNDF_REMARKS_SWITCHES"));
        const Columns halves(6 + bsdf_parameters.size(), std::vector<double>(64, 0.5));
        program.eval_pdf(halves), program.sample(halves);
        return;
    }
    const bool in_double = std::getenv("CLVNDF_REMARKS_REAL") == to_string(runtime::Real::f64);
    runtime::ProgramOptions options;
    options.root = root;
    options.more_files = bench::sources();
    if (std::getenv("CLVNDF_REMARKS_MUTANT") == std::string("1")) {
        options.functions = {mutant_function};
        options.substitutions = {scalar_call};
        options.mutant = 1;
    }
    runtime::DeviceEvaluator evaluator(runtime::choose_device().device, runtime::Math::strict,
                                       in_double ? runtime::Real::f64 : runtime::Real::f32, options);
    for (const Function& function : functions()) {
        if (!evaluator.program().has_kernel("vndf_batch_" + function.name)) continue;
        // Numbers of the larger type: what they are does not matter.
        std::vector<std::vector<double>> arrays(function.inputs.size() + function.outputs.size(),
                                                std::vector<double>(64, 0.5));
        std::vector<const void*> inputs;
        std::vector<void*> outputs;
        for (std::size_t i = 0; i < arrays.size(); ++i)
            i < function.inputs.size() ? inputs.push_back(arrays[i].data())
                                       : outputs.push_back(arrays[i].data());
        evaluator.run(function, 64, inputs, outputs);
    }
}

TEST_CASE("every entry point is vectorised across work-items on PoCL") {
    if (!on_pocl()) VNDF_SKIP(not_pocl);
    auto all = remarks({own_root});
    for (const Function& function : functions()) all[function.name];  // without remarks: not vectorised
    for (const auto& [name, reason] : exceptions) {
        INFO(name << " is an exception: " << reason);
        REQUIRE(find_function(name));
        CHECK_FALSE(vectorised(all[name]));
        all.erase(name);
    }
    CHECK(not_vectorised(all) == "");
}

TEST_CASE("in double every sampler is vectorised across work-items on PoCL") {
    if (!on_pocl()) VNDF_SKIP(not_pocl);
    if (!runtime::choose_device().device.fp64) VNDF_SKIP("the chosen device has no double");
    auto all = remarks({own_root, runtime::Real::f64});
    std::erase_if(all, [](const auto& entry) {
        const Function* function = find_function(entry.first);
        return !function || function->kind != Kind::sampler;
    });
    for (const Function& function : functions())
        if (function.kind == Kind::sampler) all[function.name];
    CHECK(not_vectorised(all) == "");

    auto mistaken = remarks({own_root, runtime::Real::f64, true});
    INFO("a call for each work-item is not vectorised, and the test sees it");
    CHECK_FALSE(vectorised(mistaken[mutant_function]));
}

TEST_CASE("the published listings, ported line by line, are not vectorised, and the test sees it") {
    if (!on_pocl()) VNDF_SKIP(not_pocl);
    const auto all = remarks({published_root});
    CHECK(all.size() >= 6);  // seven; one is too long to be inlined, without which there is no remark
    for (const auto& [name, remarks] : all) {
        INFO(name);
        CHECK_FALSE(vectorised(remarks));
        CHECK_FALSE(remarks.failures.empty());
    }
}

namespace {

// What is not vectorised of a material with these effects and choices.
std::string not_vectorised_with(const Effects& material) {
    std::string switches;
    for (const std::string& macro : material.macros()) switches += macro.substr(sizeof "VNDF_" - 1) + ' ';
    auto all = remarks({material_root, runtime::Real::f32, false, switches});
    all["bsdf_eval_pdf"], all["bsdf_sample"];  // without remarks: not vectorised
    const std::string names = not_vectorised(all);
    return names.empty() ? names : switches + ":\n" + names;
}

}  // namespace

TEST_CASE("materials are vectorised across work-items on PoCL") {
    if (!on_pocl()) VNDF_SKIP(not_pocl);
    for (const char* list : {"all",
                             "conductor",
                             "lambert",
                             "dielectric",
                             "dielectric,back_facing,sampling=plain",
                             "conductor,dielectric,transport=importance",
                             "dielectric,lambert,ndf=beckmann",
                             "all,fresnel=conductor,masking=separable",
                             "all,sampling=conic,fresnel=f82",
                             "all,ndf=beckmann,fresnel=conductor",
                             "all,sampling=tilted",
                             "conductor,shading_normal,sampling=tilted",
                             "all,energy=turquin",
                             "all,energy=kulla_conty,fresnel=conductor",
                             "all,energy=kulla_conty,sampling=conic",
                             "all,energy=kulla_conty,sampling=conic,fresnel=conductor",
                             "all,energy=kulla_conty,sampling=conic,masking=separable,fresnel=f82",
                             "lambert,rough_diffuse",
                             "lambert,coat",
                             "conductor,coat",
                             "dielectric,coat,ndf=beckmann",
                             "dielectric,specular",
                             "dielectric,thin_walled,sampling=conic",
                             "dielectric,lambert,specular,thin_walled,ndf=beckmann",
                             "conductor,dielectric,energy=kulla_conty",
                             "conductor,dielectric,energy=turquin,ndf=beckmann"})
        CHECK(not_vectorised_with(parse_effects(list)) == "");
}

// By hand.
TEST_CASE("materials of every choice are vectorised", "[.bsdf-vectorised]") {
    const std::vector<Effects> all = materials_of_every_choice();
    const auto [part, parts] = shard();
    for (std::size_t i = part; i < all.size(); i += parts) CHECK(not_vectorised_with(all[i]) == "");
}
