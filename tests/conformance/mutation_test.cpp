// Seeded mistakes: `clvndf check` notices every one, and every kind of check notices one.
#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <set>

#include "conformance/runs/check.h"
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "conformance/runs/check.h"
#include "mutants.h"
#include "support/catch.h"
#include "support/shard.h"

using namespace vndf;
using namespace vndf::conformance;

namespace {

std::vector<runtime::Substitution> substitutions() {
    std::vector<runtime::Substitution> all;
    for (const Mutant& mutant : mutants())
        all.push_back({"kernels/vndf/" + mutant.file, mutant.old_text, mutant.new_text,
                       static_cast<int>(all.size()) + 1});
    return all;
}

// The check of these functions with one of the substitutions switched in.
Report check_with(const std::vector<runtime::Substitution>& substitutions, int id,
                  const std::vector<const Function*>& selected, runtime::Real real, bool quick,
                  runtime::Math math = runtime::Math::strict) {
    runtime::ProgramOptions program;
    program.functions = needed(selected);
    program.substitutions = substitutions;
    program.mutant = id;
    runtime::DeviceEvaluator evaluator(runtime::choose_device().device, math, real, program);
    CheckOptions options;
    options.quick = quick;
    return check(evaluator, math, selected, options);
}

// The quick check of the mutant's functions with the mistake switched in; 0: none.
Report check_mutant(int id, const std::string& only, runtime::Real real = runtime::Real::f32) {
    return check_with(substitutions(), id, select(only), real, true);
}

std::set<std::string> failed_checks(const Report& report) {
    std::set<std::string> names;
    for (const FunctionReport& function : report.functions)
        for (const Finding& finding : function.findings)
            if (!finding.passed()) names.insert(finding.check);
    return names;
}

bool any_begins(const std::set<std::string>& names, const std::string& beginning) {
    return std::any_of(names.begin(), names.end(), [&](const std::string& name) {
        return name.compare(0, beginning.size(), beginning) == 0;
    });
}

}  // namespace

TEST_CASE("check notices every seeded mistake") {
    const auto [part, parts] = shard();
    for (std::size_t i = part; i < mutants().size(); i += parts) {
        const Mutant& mutant = mutants()[i];
        INFO(mutant.mistake);
        const Report report = check_mutant(static_cast<int>(i) + 1, mutant.only, mutant.real);
        CHECK_FALSE(report.passed());
        const std::set<std::string> failed = failed_checks(report);
        std::string noticed = "noticed by:";
        for (const std::string& name : failed) noticed += " [" + name + "]";
        INFO(noticed);
        for (const std::string& check : mutant.noticed_by) {
            INFO(check);
            CHECK(any_begins(failed, check));
        }
    }
}

TEST_CASE("without a mistake switched in, the same sources pass") {
    for (const char* only : {"vndf_ggx_sample_wm_heitz2017", "vndf_ggx_pdf_w?"}) {
        const Report report = check_mutant(0, only);
        INFO(format_table(report));
        CHECK(report.passed());
    }
}

TEST_CASE("every kind of check notices a seeded mistake") {
    for (const char* kind : {"pointwise, front",
                             "pointwise, back",
                             "pointwise, core",
                             "pointwise, maximum",
                             "finite",
                             "unit length",
                             "finite for finite arguments",
                             "unit length for any length of wo",
                             "as documented at wo = -n",
                             "normal above the surface",
                             "normal faces wo",
                             "chi2 of the pivots",
                             "KS of pivot 1",
                             "KS of pivot 2",
                             "chi2 of the directions",
                             "means",
                             "integral",
                             "same direction as the plain form",
                             "density of the exact sample",
                             "density finite",
                             "density 0 outside",
                             "documented direction outside the domain",
                             "separate density positive at the samples",
                             "agrees with the separate density",
                             "fit: "}) {
        INFO(kind);
        CHECK(std::any_of(mutants().begin(), mutants().end(), [&](const Mutant& mutant) {
            return std::any_of(mutant.noticed_by.begin(), mutant.noticed_by.end(),
                               [&](const std::string& check) {
                                   return check.compare(0, std::string(kind).size(), kind) == 0;
                               });
        }));
    }
}

// Only for random_mutants.py: the JSON file CLVNDF_MUTANT is a mutant and says how to check it. Prints "caught ..." or
// "survived".
TEST_CASE("a mutant from outside", "[.outside]") {
    const char* path = std::getenv("CLVNDF_MUTANT");
    REQUIRE(path);
    const auto task = nlohmann::json::parse(std::ifstream(path));
    const std::vector<runtime::Substitution> mutant{
        {"kernels/vndf/" + task["file"].get<std::string>(), task["old_text"], task["new_text"], 1}};
    const runtime::Real real = task["real"] == "double" ? runtime::Real::f64 : runtime::Real::f32;
    const runtime::Math math = task["math"] == "builtin" ? runtime::Math::builtin : runtime::Math::strict;
    for (const std::string name : task["functions"]) {
        const Report report = check_with(mutant, 1, {find_function(name)}, real, task["quick"], math);
        for (const std::string& check : failed_checks(report)) fmt::print("caught {}: {}\n", name, check);
        if (!report.passed()) return;
    }
    fmt::print("survived\n");
}
