// On PoCL's CPU device every entry point is turned into vector code across work-items. One innocent edit can undo that
// and cost a factor of five, with every result still right; so this reads what the vectoriser says.
//
// POCL_VECTORIZER_REMARKS prints remarks while a kernel is compiled, none from a warm cache, and is read once when PoCL
// starts: a child process compiles everything with an empty cache. Remarks on loops name no kernel, but those of the
// inliner before them do, and kernels are compiled one after the other.
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <unistd.h>

#include "bench/sources.h"
#include "effects.h"
#include "runtime/device_evaluator.h"
#include "support/bsdf_program.h"
#include "support/catch.h"
#include "support/skip.h"

namespace {

using namespace vndf;

const std::string own_root = "kernels/batch/batch.cl", published_root = "bench/published/batch.cl",
                  material_root = "kernels/batch/bsdf.cl";

// Functions whose entry points are not vectorised on PoCL 3.1, each with the reason.
const std::map<std::string, std::string> exceptions = {};

struct Remarks {
    int vectorised = 0;
    std::vector<std::string> failures;
};

// By the name of the function: what was said about the loops of its entry point.
std::map<std::string, Remarks> parse(const std::string& text) {
    constexpr std::string_view kernel = "inlined into 'vndf_batch_",
                               success = "vectorized loop (vectorization width: ",
                               failure = "loop not vectorized: ";
    std::map<std::string, Remarks> all;
    Remarks* current = nullptr;
    for (std::size_t at = 0; at < text.size(); ++at) {
        const std::string_view rest = std::string_view(text).substr(at);
        if (rest.starts_with(kernel)) {
            const std::size_t begin = kernel.size();
            current = &all[std::string(rest.substr(begin, rest.find('\'', begin) - begin))];
        } else if (current && rest.starts_with(success)) {
            ++current->vectorised;
        } else if (current && rest.starts_with(failure)) {
            current->failures.emplace_back(rest.substr(0, rest.find('<')));
        }
    }
    return all;
}

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

// Everything that such a process prints.
std::string remarks(const Compilation& compilation) {
    std::string folder = (std::filesystem::temp_directory_path() / "clvndf-remarks-XXXXXX").string();
    REQUIRE(mkdtemp(folder.data()));
    const std::string command =
        "POCL_VECTORIZER_REMARKS=1 POCL_CACHE_DIR='" + folder + "' CLVNDF_REMARKS_ROOT='" + compilation.root +
        "' CLVNDF_REMARKS_REAL=" + std::string(to_string(compilation.real)) +
        " CLVNDF_REMARKS_MUTANT=" + (compilation.mutant ? "1" : "0") + " CLVNDF_REMARKS_SWITCHES='" +
        compilation.switches + "' '" + std::filesystem::read_symlink("/proc/self/exe").string() +
        "' 'compiles every entry point' >'" + folder + "/remarks' 2>&1";
    const int status = std::system(command.c_str());
    std::ifstream file(folder + "/remarks", std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(file), {}};
    std::filesystem::remove_all(folder);
    INFO(text.substr(text.size() - std::min<std::size_t>(text.size(), 2000)));
    REQUIRE(status == 0);
    return text;
}

bool on_pocl() {
    return runtime::choose_device().device.platform == "Portable Computing Language";
}
constexpr const char* not_pocl = "the vectoriser's remarks are PoCL's, and the chosen device is another's";

bool vectorised(const Remarks& remarks) {
    return remarks.vectorised > 0 && remarks.failures.empty();
}

// The functions whose entry points are not vectorised, one a line, with the first reason given.
std::string not_vectorised(const std::map<std::string, Remarks>& all) {
    std::string names;
    for (const auto& [name, remarks] : all) {
        if (vectorised(remarks)) continue;
        names += name + ": " + (remarks.failures.empty() ? "no remark on a loop" : remarks.failures.front()) +
                 "\n";
    }
    return names;
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
    auto all = parse(remarks({own_root}));
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
    auto all = parse(remarks({own_root, runtime::Real::f64}));
    std::erase_if(all, [](const auto& entry) {
        const Function* function = find_function(entry.first);
        return !function || function->kind != Kind::sampler;
    });
    for (const Function& function : functions())
        if (function.kind == Kind::sampler) all[function.name];
    CHECK(not_vectorised(all) == "");

    auto mistaken = parse(remarks({own_root, runtime::Real::f64, true}));
    INFO("a call for each work-item is not vectorised, and the test sees it");
    CHECK_FALSE(vectorised(mistaken[mutant_function]));
}

TEST_CASE("the published listings, ported line by line, are not vectorised, and the test sees it") {
    if (!on_pocl()) VNDF_SKIP(not_pocl);
    const auto all = parse(remarks({published_root}));
    CHECK(all.size() >= 6);  // seven; one is too long to be inlined, without which there is no remark
    for (const auto& [name, remarks] : all) {
        INFO(name);
        CHECK_FALSE(vectorised(remarks));
        CHECK_FALSE(remarks.failures.empty());
    }
}

namespace {

// What is not vectorised of materials with these effects and choices, as clvndf emit --effects takes them.
std::string not_vectorised_with(const std::string& list) {
    std::string switches;
    for (const std::string& macro : parse_effects(list).macros())
        switches += macro.substr(sizeof "VNDF_" - 1) + ' ';
    auto all = parse(remarks({material_root, runtime::Real::f32, false, switches}));
    all["bsdf_eval_pdf"], all["bsdf_sample"];  // without remarks: not vectorised
    const std::string names = not_vectorised(all);
    return names.empty() ? names : list + ":\n" + names;
}

}  // namespace

TEST_CASE("materials are vectorised across work-items on PoCL") {
    if (!on_pocl()) VNDF_SKIP(not_pocl);
    for (const char* list :
         {"all", "conductor", "lambert", "dielectric", "dielectric,back_facing,sampling=plain",
          "conductor,dielectric,transport=importance", "dielectric,lambert,ndf=beckmann",
          "all,fresnel=conductor,masking=separable", "all,sampling=conic,fresnel=f82",
          "all,ndf=beckmann,fresnel=conductor", "all,energy=turquin",
          "all,energy=kulla_conty,fresnel=conductor", "lambert,rough_diffuse", "lambert,coat",
          "conductor,coat", "dielectric,coat,ndf=beckmann"})
        CHECK(not_vectorised_with(list) == "");
}

// By hand: every choice, with everything on, each effect off, and the conductor alone.
TEST_CASE("materials of every choice are vectorised", "[.bsdf-vectorised]") {
    std::vector<std::string> lists{"all", "conductor", "dielectric"};
    for (const Effect& off : effects()) {
        std::string list;
        for (const Effect& on : effects())
            if (on.name != off.name) list += (list.empty() ? "" : ",") + on.name;
        lists.push_back(list);
    }
    for (const char* model :
         {"ndf=ggx,sampling=plain", "ndf=ggx,sampling=bounded", "ndf=ggx,sampling=conic", "ndf=beckmann"})
        for (const char* fresnel : {"none", "conductor", "schlick", "f82"})
            for (const char* masking : {"correlated", "separable"})
                for (const char* energy : {"none", "turquin", "kulla_conty"})
                    for (const std::string& list : lists)
                        CHECK(not_vectorised_with(list + ',' + model + ",fresnel=" + fresnel +
                                                  ",masking=" + masking + ",energy=" + energy) == "");
}
