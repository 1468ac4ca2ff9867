// Somebody else's functions: right ones pass, wrong ones are caught, and the mistake is named.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "conformance/judge/bsdf.h"
#include "conformance/judge/mistakes.h"
#include "conformance/runs/user_check.h"
#include "support/catch.h"
#include "support/command.h"

using namespace vndf;
using namespace vndf::conformance;
using Catch::Matchers::ContainsSubstring;

namespace {

const std::string folder = CLVNDF_SOURCE_DIR "/tests/judge/";

UserOptions asked(const std::string& file, const std::string& function, const std::string& as,
                  const std::string& options = {}, const Scope& scope = {}) {
    UserOptions user;
    user.file = folder + file, user.function = function, user.as = as, user.options = options,
    user.scope = scope;
    return user;
}

Mistake mistake_in(const UserOptions& user) {
    const UserKernel kernel(user);
    runtime::DeviceEvaluator evaluator = kernel.evaluator(runtime::choose_device().device);
    return kernel.function().kind == Kind::sampler
               ? mistake_of_sampler(evaluator, kernel.function(), user.scope, 1)
               : mistake_of_value(evaluator, kernel.function(), user.scope, 1);
}

Report judged(const UserKernel& kernel, std::size_t points = 4096) {
    runtime::DeviceEvaluator evaluator = kernel.evaluator(runtime::choose_device().device);
    CheckOptions options;
    options.quick = true, options.random_points = points;
    return check_user_kernel(kernel, evaluator, options);
}

const Finding& finding(const FunctionReport& report, const std::string& check) {
    for (const Finding& f : report.findings)
        if (f.check.starts_with(check)) return f;
    throw std::logic_error("no finding " + check);
}

struct Case {
    std::string macro, function, as, said;
};

// Those that the quick form has, and the others.
const std::vector<Case>& known_cases(bool quick) {
    static const std::vector<Case> first{
        {"EXCHANGED", "ggx_cap", "ggx_sample_wm", "alpha.x and alpha.y are exchanged"},
        {"SQUARED", "ggx_cap", "ggx_sample_wm", "alpha is squared once more"},
        {"T2_FLIPPED", "ggx_section", "ggx_sample_wm", "T2 points the wrong way"},
        {"HALF_AZIMUTH", "ggx_cap", "ggx_sample_wm", "half of a lobe is left out"},
        {"TO_SURFACE", "ggx_cap", "ggx_sample_wm", "wo is taken to point to the surface"},
        {"NONE", "ggx_whatever_the_view", "ggx_sample_wm", "visibility (G1) is left out"},
        {"NONE", "ggx_cap", "beckmann_sample_wm", "draws from the distribution of GGX"},
        {"NO_JACOBIAN", "ggx_pdf_of_reflection", "ggx_pdf_wi",
         "the Jacobian of the reflection, 1 / (4 wo.wm), is missing"},
        {"NO_G1", "ggx_pdf", "ggx_pdf_wm", "visibility (G1) is left out"},
        {"OF_REFLECTION", "ggx_pdf", "ggx_pdf_wm", "it is a density of wi, not of wm"}};
    static const std::vector<Case> rest{
        {"ROOT", "ggx_cap", "ggx_sample_wm", "the square root of alpha"},
        {"ISOTROPIC", "ggx_cap", "ggx_sample_wm", "alpha.y is not used"},
        {"TURNED", "ggx_cap", "ggx_sample_wm", "x and y have the wrong sign"},
        {"Y_UP", "ggx_cap", "ggx_sample_wm", "y is taken for up"},
        {"INTO_SURFACE", "ggx_cap", "ggx_sample_wm", "points into the surface"},
        {"REFLECTED", "ggx_cap", "ggx_sample_wm", "the reflected direction is returned"},
        {"VIEW_NOT_STRETCHED", "ggx_cap", "ggx_sample_wm", "wo is not stretched"},
        {"NOT_STRETCHED_BACK", "ggx_cap", "ggx_sample_wm", "not stretched back"},
        {"VIEW_FOR_SAMPLE", "ggx_cap", "ggx_sample_wm", "do not depend on u"},
        {"ONE_NUMBER", "ggx_cap", "ggx_sample_wm", "one random number is used for both"},
        {"NO_ROOT", "ggx_section", "ggx_sample_wm", "lacks its square root"},
        {"HALF_AZIMUTH", "ggx_section", "ggx_sample_wm", "half of a lobe is left out"},
        {"ONE_DISK", "ggx_disks", "ggx_sample_wm", "one of the two half disks"},
        {"T2_FLIPPED", "ggx_disks", "ggx_sample_wm", "T2 points the wrong way"},
        {"PRECEDENCE", "ggx_disks", "ggx_sample_wm", "?: takes the whole product"},
        {"EXCHANGED", "ggx_reflection", "ggx_sample_wi", "alpha.x and alpha.y are exchanged"},
        {"NONE", "ggx_cap", "ggx_sample_wi", "the normal is returned"},
        {"NONE", "ggx_reflection", "ggx_sample_wi_eto2023", "not from a bounded cap"},
        {"HALF_AZIMUTH", "ggx_all", "ggx_sample_ndf", "half of a lobe is left out"},
        {"SQUARED", "ggx_all", "ggx_sample_ndf", "alpha is squared once more"},
        {"NONE", "beckmann_all", "ggx_sample_ndf", "draws from Beckmann's distribution"},
        {"NONE", "beckmann_whatever_the_view", "beckmann_sample_wm", "visibility (G1) is left out"},
        {"EXCHANGED", "ggx_pdf", "ggx_pdf_wm", "alpha.x and alpha.y are exchanged"},
        {"SQUARED", "ggx_pdf", "ggx_pdf_wm", "alpha is squared once more"},
        {"ROOT", "ggx_pdf", "ggx_pdf_wm", "the square root of alpha"},
        {"ISOTROPIC", "ggx_pdf", "ggx_pdf_wm", "alpha.y is not used"},
        {"TO_SURFACE", "ggx_pdf", "ggx_pdf_wm", "as if wo pointed to the surface"},
        {"TURNED", "ggx_pdf", "ggx_pdf_wm", "x and y have the wrong sign"},
        {"NO_G1_ALONE", "ggx_pdf", "ggx_pdf_wm", "G1 is left out"},
        {"ONLY_D", "ggx_pdf", "ggx_pdf_wm", "it is D, without"},
        {"NO_COSINE", "ggx_pdf", "ggx_pdf_wm", "division by the cosine of wo"},
        {"HALVED", "ggx_pdf", "ggx_pdf_wm", "it is 1/2 times"},
        {"NONE", "ggx_pdf", "beckmann_pdf_wm", "of the distribution of GGX"},
        {"OTHER_COSINE", "ggx_pdf_of_reflection", "ggx_pdf_wi", "wm.n in place of wo.wm"},
        {"WEIGHT", "ggx_pdf_of_reflection", "ggx_pdf_wi", "it is the weight of a sample"},
        {"BRDF", "ggx_pdf_of_reflection", "ggx_pdf_wi", "it is the value of the BRDF"},
        {"NO_G1", "ggx_pdf_of_reflection", "ggx_pdf_wi", "visibility (G1) is left out"},
        {"ONLY_D", "beckmann_pdf_of_all", "beckmann_pdf_wm_walter2007", "it is D"},
        {"NONE", "beckmann_d", "ggx_ndf", "it is Beckmann's"},
        {"SQUARED", "beckmann_pdf_of_all", "beckmann_pdf_wm_walter2007", "alpha is squared once more"}};
    return quick ? first : rest;
}

void require_recognised(const std::vector<Case>& cases) {
    for (const Case& c : cases) {
        CAPTURE(c.macro, c.function, c.as);
        const Mistake found = mistake_in(asked("mistakes.cl", c.function, c.as, "-D" + c.macro));
        CHECK_THAT(found.what, ContainsSubstring(c.said));
    }
}

// Functions of that file that are right, in which no mistake is found.
const std::vector<Case> right_cases{{"NONE", "ggx_cap", "ggx_sample_wm", {}},
                                    {"NONE", "ggx_section", "ggx_sample_wm", {}},
                                    {"NONE", "ggx_disks", "ggx_sample_wm", {}},
                                    {"NONE", "ggx_reflection", "ggx_sample_wi", {}},
                                    {"NONE", "ggx_all", "ggx_sample_ndf", {}},
                                    {"NONE", "beckmann_all", "beckmann_sample_ndf", {}},
                                    {"NONE", "ggx_pdf", "ggx_pdf_wm", {}},
                                    {"NONE", "ggx_pdf_of_reflection", "ggx_pdf_wi", {}},
                                    {"NONE", "ggx_g1", "ggx_g1", {}},
                                    {"NONE", "ggx_g2", "ggx_g2", {}},
                                    {"NONE", "beckmann_pdf_of_all", "beckmann_pdf_wm_walter2007", {}}};

void require_right(const std::vector<Case>& cases) {
    for (const Case& c : cases) {
        CAPTURE(c.function, c.as);
        CHECK(mistake_in(asked("mistakes.cl", c.function, c.as, "-D" + c.macro)).none);
    }
}

struct Adapter {
    std::string file, as;
    Scope scope = {};
};
const std::vector<Adapter>& adapters() {
    static const std::vector<Adapter> all{{"argument_order", "ggx_sample_wm"},
                                          {"angles", "ggx_sample_wm", {Domain::upper, {.05, 1}, true}},
                                          {"roughness", "ggx_sample_wm", {Domain::upper, {}, true}},
                                          {"y_up", "ggx_sample_wm"},
                                          {"random_numbers", "ggx_sample_wm"},
                                          {"to_surface", "ggx_sample_wi"},
                                          {"unnormalised", "ggx_sample_wm"},
                                          {"weight", "ggx_sample_wi"}};
    return all;
}

std::string bsdf_mistake(const std::string& macro) {
    UserOptions user = asked("bsdf.cl", "my_value", "bsdf", "-D" + macro);
    user.pdf = "my_pdf", user.sample = "my_sample";
    const UserKernel kernel(user);
    const Report report = judged(kernel);
    REQUIRE(report.functions.size() == 3);
    return report.passed() ? "passed" : report.functions.front().diagnosis;
}

}  // namespace

TEST_CASE(
    "a right sampler passes, a subtly wrong one fails, and of one that does not compile its own line is "
    "shown") {
    const std::string check = "--quiet check --quick --points 4096 --kernel " + folder;
    const Outcome right = clvndf(check + "right.cl --function my_sample --as ggx_sample_wm --pdf my_pdf");
    CAPTURE(right.out, right.err);
    CHECK(right.status == 0);
    CHECK_THAT(right.out, ContainsSubstring("my_sample: not judged: views from behind the surface"));
    CHECK_THAT(right.out, ContainsSubstring("0 fail"));
    const Outcome subtle = clvndf(check + "subtle.cl --function my_sample --as ggx_sample_wm --json -");
    CAPTURE(subtle.out, subtle.err);
    CHECK(subtle.status == 1);
    const auto json = nlohmann::json::parse(subtle.out).at("functions").at(0);
    CHECK(json.at("verdict") == "FAIL");
    CHECK_THAT(json.at("diagnosis").get<std::string>(), ContainsSubstring("a small bias"));
    CHECK(json.at("findings").at(0).contains("concern"));
    const Outcome broken = clvndf(check + "broken.cl --function my_sample --as ggx_sample_wm");
    CHECK(broken.status == 2);
    CHECK(broken.out.empty());
    CHECK_THAT(broken.err, ContainsSubstring("broken.cl:4:"));
    CHECK_THAT(broken.err, ContainsSubstring("alpa"));
}

TEST_CASE("the known mistakes in samplers and densities are named") {
    require_recognised(known_cases(true));
}

TEST_CASE("every known mistake is named, and none is found in what is right", "[.judge-full]") {
    require_recognised(known_cases(false));
    require_right(right_cases);
}

TEST_CASE("adapters of a few lines make any signature one that can be judged") {
    for (const Adapter& adapter : adapters()) {
        CAPTURE(adapter.file);
        const Mistake found =
            mistake_in(asked("adapters/" + adapter.file + ".cl", "adapted", adapter.as, {}, adapter.scope));
        CAPTURE(found.what);
        CHECK(found.none);
    }
}

TEST_CASE("what adapters make of a right sampler passes the whole check", "[.judge-full]") {
    for (const Adapter& adapter : adapters()) {
        CAPTURE(adapter.file);
        UserOptions user =
            asked("adapters/" + adapter.file + ".cl", "adapted", adapter.as, {}, adapter.scope);
        if (adapter.file == "weight") user.pdf = "adapted_pdf";
        const UserKernel kernel(user);
        const Report report = judged(kernel);
        INFO(format_table(report));
        CHECK(report.passed());
    }
}

TEST_CASE("a BSDF is judged by its value, its density and its samples") {
    CHECK(bsdf_mistake("NONE") == "passed");
    CHECK_THAT(bsdf_mistake("NO_COSINE"), ContainsSubstring("the value lacks the cosine of wi"));
    CHECK_THAT(bsdf_mistake("OTHER_PDF"), ContainsSubstring("the samples do not follow my_pdf"));
    CHECK_THAT(bsdf_mistake("NO_DIRECTION"), ContainsSubstring("my_sample gives what is no number"));
}

TEST_CASE("every mistake in a BSDF is named", "[.judge-full]") {
    CHECK_THAT(bsdf_mistake("ONE_SIDED"), ContainsSubstring("G1 in place of G2"));
    CHECK_THAT(bsdf_mistake("NO_G"), ContainsSubstring("more light is reflected than there is"));
    CHECK_THAT(bsdf_mistake("BRIGHT"), ContainsSubstring("more light is reflected than there is"));
    CHECK_THAT(bsdf_mistake("DOUBLED"), ContainsSubstring("weights are 2 times value over density"));
    CHECK_THAT(bsdf_mistake("WEIGHT_WITH_COSINE"), ContainsSubstring("a cosine of wi that the value lacks"));
}

TEST_CASE("what is wrong, inexact and outside of the domain are told apart") {
    // D from the height alone loses its digits at small alpha: inexact where few are lost, wrong where all are.
    const auto found = [](const Scope& scope) {
        const UserKernel kernel(asked("inexact.cl", "my_pdf", "ggx_pdf_wm", {}, scope));
        const FunctionReport report = judged(kernel).functions.front();
        return std::pair(report.verdict(), report.diagnosis);
    };
    CHECK(found({Domain::upper, {.1, 1}, true}).first == Verdict::inexact);
    const auto [verdict, diagnosis] = found({Domain::upper, {1e-4, 1e-3}, true});
    CHECK(verdict == Verdict::fail);
    if (runtime::choose_device().device.fp64) CHECK_THAT(diagnosis, ContainsSubstring("none but rounding"));
    // Behind the surface it is no density, in double neither.
    const auto [behind, why] = found({Domain::sphere, {.1, 1}, true});
    CHECK(behind == Verdict::fail);
    CHECK_THAT(why, ContainsSubstring("a special case"));
}

TEST_CASE(
    "a user's file may include the library and files of its own, and is built with options of its own") {
    const UserKernel kernel(
        asked("with_library.cl", "my_sample", "vndf_ggx_sample_wm_dupuy2023", "-cl-std=CL3.0 -DMINE=1"));
    const Report report = judged(kernel);
    INFO(format_table(report));
    const FunctionReport& f = report.functions.front();
    CHECK(f.verdict() == Verdict::pass);
    CHECK(finding(f, "map, p99").figure < 1);
    CHECK_THAT(report.options, ContainsSubstring("-cl-std=CL3.0"));
    CHECK_THAT(report.options, !ContainsSubstring("-cl-std=CL1.2"));
}

TEST_CASE("what cannot be judged is refused in one line") {
    const std::string right = "check --kernel " + folder + "right.cl ";
    const std::vector<std::pair<std::string, std::string>> cases{
        {"check --kernel nosuch.cl --function f --as ggx_sample_wm", "nosuch.cl: there is no such file"},
        {"check --kernel " + folder + " --function f --as ggx_sample_wm", "is no file"},
        {right + "--function my_sample", "--as"},
        {right + "--as ggx_sample_wm", "--function"},
        {right + "--function my_sample --as phong", "--as 'phong': allowed are ggx_sample_wm, ggx_sample_wi"},
        {right + "--function my_sample --as ggx_sample_wm_dupuy2023_lobe", "that take no lobe"},
        {right + "--function 'my sample' --as ggx_sample_wm",
         "--function 'my sample': expected the name of a function"},
        {right + "--function my_sample --as ggx_sample_wm --pdf my_sample",
         "'my_sample' is given as two functions"},
        {right + "--function my_pdf --as ggx_pdf_wm --pdf other", "--pdf 'other': of a sampler or a bsdf"},
        {right + "--function my_pdf --as bsdf --pdf other", "--as bsdf: --function names its value"},
        {right + "--function my_sample --as ggx_sample_wm --sample s", "--sample 's': of --as bsdf alone"},
        {right + "--function my_pdf --as bsdf_pdf",
         "--as bsdf_pdf: of clvndf eval; check judges the three functions of a bsdf together"},
        {"eval my_sample --as bsdf --kernel " + folder + "bsdf.cl",
         "--as bsdf: eval takes one function at a time: --as bsdf_value, bsdf_pdf, bsdf_sample"},
        {right + "--function my_sample --as ggx_sample_wm --alpha 1:0.1",
         "--alpha: '1:0.1' is no range LO:HI"},
        {right + "--function my_sample --as ggx_sample_wm --only vndf_reflect", "--only"},
        {"check --domain front", "--domain requires --kernel"}};
    for (const auto& [arguments, said] : cases) {
        CAPTURE(arguments);
        const Outcome run = clvndf(arguments);
        CAPTURE(run.err);
        CHECK(run.status == 2);
        CHECK(run.out.empty());
        CHECK_THAT(run.err, ContainsSubstring(said));
        CHECK(std::count(run.err.begin(), run.err.end(), '\n') == 1);
    }
    // After the compiler has had its say.
    for (const auto& [function, said] :
         {std::pair{"nosuch", "there is no function 'nosuch' in it; there are my_sample, my_pdf"},
          {"my_pdf", "'my_pdf' is no function float3 my_pdf(float3 wo, float2 alpha, float2 u)"}}) {
        const UserKernel kernel(asked("right.cl", function, "ggx_sample_wm"));
        CHECK_THROWS_WITH(kernel.evaluator(runtime::choose_device().device), ContainsSubstring(said));
    }
}
