// The library conforms: what `clvndf check` checks, in its quick form, and the command itself.
#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>
#include <nlohmann/json.hpp>
#include <algorithm>
#include <set>
#include <sstream>

#include "conformance/runs/check.h"
#include "conformance/inputs/grids.h"
#include "conformance/judge/lobes.h"
#include "conformance/judge/pointwise.h"
#include "support/catch.h"
#include "support/command.h"
#include "support/part_of_all.h"
#include "support/skip.h"

using namespace vndf;
using namespace vndf::conformance;
using Catch::Matchers::ContainsSubstring;

namespace {

Report quick_check(runtime::Math math, runtime::Real real, const std::vector<const Function*>& selected) {
    runtime::ProgramOptions program;
    program.functions = needed(selected);
    runtime::DeviceEvaluator evaluator(runtime::choose_device().device, math, real, program);
    CheckOptions options;
    options.quick = true;
    return check(evaluator, math, selected, options);
}

// Strict float, run once for all that is asked of it.
const Report& strict_float() {
    static const Report report = quick_check(runtime::Math::strict, runtime::Real::f32, select({}));
    return report;
}

void require_conformance(const Report& report) {
    INFO(format_table(report));
    CHECK(report.passed());
}

}  // namespace

TEST_CASE("every function conforms in strict float") {
    REQUIRE(strict_float().functions.size() == functions().size());
    require_conformance(strict_float());
}

TEST_CASE("every function conforms in builtin float") {
    require_conformance(quick_check(runtime::Math::builtin, runtime::Real::f32, part_of_all(0)));
}

TEST_CASE("every function conforms in strict double") {
    if (!runtime::choose_device().device.fp64) VNDF_SKIP("the device has no fp64");
    require_conformance(quick_check(runtime::Math::strict, runtime::Real::f64, part_of_all(1)));
}

TEST_CASE("every kind of check is applied to every function that it fits") {
    for (const FunctionReport& f : strict_float().functions) {
        INFO(f.function->name);
        std::set<std::string> kinds;
        for (const Finding& finding : f.findings) {
            INFO(finding.check);
            CHECK(finding.count > 0);
            kinds.insert(finding.check.substr(0, finding.check.find(',')));
        }
        if (f.function->kind != Kind::sampler) {
            CHECK(kinds.count("pointwise"));
            CHECK(kinds.count("integral") == (f.function->kind == Kind::density));
        } else if (f.function->with_pdf) {
            CHECK(kinds.count("same direction as the plain form"));
            CHECK(kinds.count("density of the exact sample"));
        } else {
            for (const char* kind : {"pointwise", "finite", "unit length", "chi2 of the pivots",
                                     "KS of pivot 1", "KS of pivot 2", "chi2 of the directions", "means"})
                CHECK(kinds.count(kind));
        }
    }
}

// The numbers that bound this form of the function.
std::vector<double*> numbers(Function& f, Real real) {
    Bounds& bounds = real == Real::f32 ? f.float_bounds : f.double_bounds;
    SamplerBounds& s = bounds.sampler;
    if (f.kind != Kind::sampler) return {&bounds.error};
    if (f.with_pdf) return {&s.pdf, &s.pdf_core_max, &s.agreement};
    return {&s.front, &s.back, &s.core, &s.core_max};
}

TEST_CASE("check asserts every number of the registry, for float and for double") {
    for (const Real real : {Real::f32, Real::f64}) {
        runtime::HostEvaluator host(runtime::Math::strict, real);
        PointwiseOptions few;
        few.random_points = 512, few.hard_stride = 211;
        for (const Function* function : part_of_all(real == Real::f32 ? 2 : 3)) {
            const Function& f = *function;
            CAPTURE(f.name, runtime::to_string(real));
            const auto failed = [&](const Function& g) {
                std::set<std::string> names;
                for (const Finding& finding : check_pointwise(host, g, few))
                    if (!finding.passed()) names.insert(finding.check);
                return names;
            };
            // Few points, most of them hard, say little about percentiles: whether these pass is a full run's question. But
            // a finding fails with a number that is 2^-20 of what it is, and not with one that is 2^20 times that.
            Function changed = f;
            for (double* number : numbers(changed, real)) {
                const double promised = *number;
                if (promised == 0) continue;  // NONE
                CAPTURE(promised);
                *number = promised * 0x1p20;
                const std::size_t loose = failed(changed).size();
                *number = promised * 0x1p-20;
                if (real == Real::f32 || loose == 0) CHECK(failed(changed).size() > loose);
                *number = promised;
            }
        }
    }
}

TEST_CASE("every sampler with an outgoing direction is tested in at least 60 lobes") {
    for (const Function& f : functions()) {
        if (f.kind != Kind::sampler || column(f, "wo_x") < 0) continue;
        INFO(f.name);
        const std::vector<Point> all = lobes(f, false);
        CHECK(all.size() >= 60);
        double narrowest = 1, widest = 0, aspect = 1, lowest = 1;
        for (const Point& lobe : all) {
            const auto [x, y] = lobe.alpha;
            narrowest = std::min({narrowest, x, y}), widest = std::max({widest, x, y});
            if (column(f, "alpha_y") >= 0) aspect = std::max({aspect, x / y, y / x});
            lowest = std::min(lowest, lobe.cos_theta);
        }
        CHECK(narrowest == 1e-4);
        CHECK(widest == 2);
        CHECK((aspect >= 999 || column(f, "alpha_y") < 0));
        CHECK(lowest == (f.domain == Domain::sphere ? -0.5 : 0.001));
    }
}

TEST_CASE("the pointwise grid reaches the corners of every argument") {
    const Function& cap = *find_function("vndf_ggx_sample_wm_dupuy2023");
    const std::vector<Point> hard = hard_points(cap);
    CHECK(hard.size() >= 15000);
    const auto count = [&](auto predicate) { return std::count_if(hard.begin(), hard.end(), predicate); };
    CHECK(count([](const Point& p) { return p.alpha[0] == 1e-8 && p.cos_theta < 0; }) > 0);
    CHECK(count([](const Point& p) { return p.u[1] == 1 - 0x1p-24 && p.cos_theta == 1; }) > 0);
    CHECK(count([](const Point& p) { return p.cos_theta == 0; }) > 0);
}

TEST_CASE("the fit of 2014 is reported as a known bias, with what was measured") {
    const auto& all = strict_float().functions;
    const auto fit = std::find_if(all.begin(), all.end(), [](const FunctionReport& f) {
        return f.function->name == "vndf_ggx_sample_wm_heitz_deon2014";
    });
    REQUIRE(fit != all.end());
    CHECK(fit->verdict() == Verdict::known_bias);
    CHECK_THAT(format_table(strict_float()),
               ContainsSubstring("known bias") && ContainsSubstring("fit: CDF error"));
}

TEST_CASE("a finding with a bias other than the documented one fails") {
    Finding finding;
    finding.biased = true, finding.limit = 1e-3;
    for (const auto& [figure, passes] :
         {std::pair(1.05e-3, true), {0.95e-3, true}, {1.2e-3, false}, {0.0, false}}) {
        finding.figure = figure;
        CHECK(finding.passed() == passes);
    }
}

TEST_CASE("a function without findings does not pass") {
    FunctionReport nothing;
    CHECK(nothing.verdict() == Verdict::fail);
    CHECK_FALSE(Report{}.passed());
}

TEST_CASE("check writes a table, JSON and JUnit, and exits with 0") {
    const Folder folder;
    CHECK(
        shell(folder,
              "\"$clvndf\" check --quick --only 'vndf_*reflect' --seed 3 --json a.json --junit a.xml >out") ==
        0);
    CHECK_THAT(folder.read("out"), ContainsSubstring("vndf_jacobian_reflect") &&
                                       ContainsSubstring("seed 3") && ContainsSubstring("Sidak"));
    const auto json = nlohmann::json::parse(folder.read("a.json"));
    CHECK(json["passed"] == true);
    CHECK(json["seed"] == 3);
    REQUIRE(json["functions"].size() == 2);
    CHECK(json["functions"][0]["findings"][0]["worst_input"].get<std::string>().starts_with("wo_x="));
    boost::property_tree::ptree xml;
    std::istringstream text(folder.read("a.xml"));
    boost::property_tree::read_xml(text, xml);
    CHECK(xml.get<int>("testsuites.testsuite.<xmlattr>.tests") > 0);
    CHECK(xml.get<int>("testsuites.testsuite.<xmlattr>.failures") == 0);
}

TEST_CASE("check puts JSON alone on the standard output") {
    const Outcome outcome = clvndf("check --quick --only vndf_reflect --json -");
    CHECK(outcome.status == 0);
    CHECK(nlohmann::json::parse(outcome.out)["functions"].size() == 1);
    CHECK(outcome.err.empty());  // no progress where there is no terminal
}

TEST_CASE("check rejects what it cannot use, in one line") {
    for (const char* arguments : {"check --only vndf_ggx_sample_wm_dupuy", "check --only 'vndf_nothing*'",
                                  "check --device nothing", "check --only vndf_reflect --json - --junit -",
                                  "check --only vndf_reflect --json /nowhere/a.json", "check --math fast"}) {
        INFO(arguments);
        const bool substring = std::string(arguments).ends_with("dupuy");
        const Outcome outcome = substring ? clvndf(std::string(arguments) + "X") : clvndf(arguments);
        CHECK(outcome.status == 2);
        CHECK(outcome.out.empty());
        CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
    }
}
