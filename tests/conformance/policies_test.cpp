// Policies and build options told apart: what is promised holds, and what breaks a promise is named.
#include <nlohmann/json.hpp>

#include "conformance/runs/policies.h"
#include "conformance/judge/samplers.h"
#include "support/command.h"

using namespace vndf;
using namespace vndf::conformance;
using Catch::Matchers::ContainsSubstring;

namespace {

PolicyReport measured(const std::string& only) {
    CheckOptions options;
    options.quick = true;
    return measure_policies(runtime::choose_device().device, Real::f32, select(only), options);
}

const PolicyReport::Entry& entry(const PolicyReport& report, const std::string& name) {
    for (const auto& e : report.entries)
        if (e.build.name() == name) return e;
    FAIL("no build " + name);
    return report.entries.front();
}

}  // namespace

TEST_CASE("strict and builtin keep their promises, and every build is measured") {
    const PolicyReport report = measured("vndf_ggx_sample_wm_dupuy2023*");
    INFO(format_table(report));
    CHECK(report.passed());
    REQUIRE(report.entries.size() == 6);
    for (const auto& e : report.entries) {
        INFO(e.build.name());
        CHECK(e.build.promised() == (e.build.name() == "strict" || e.build.name() == "builtin"));
        CHECK_THAT(e.options, ContainsSubstring(e.build.flag));
        REQUIRE(e.functions.size() == 4);  // both forms, and those of a lobe
        for (const Behaviour& f : e.functions) {
            CHECK(f.rows > 4000);
            // Fast math loses what guards the ends of the domain.
            if (e.build.promised()) CHECK(f.non_finite == 0);
            REQUIRE(!f.findings.empty());
            const Finding& finding = f.findings.front();
            if (f.function->with_pdf) continue;  // its first finding counts rows
            CHECK(finding.p50 > 0);
            CHECK(finding.p50 <= finding.p99);
            CHECK(finding.p99 <= finding.max);
        }
    }
    const auto& strict = report.entries.front();
    CHECK(strict.functions.front().different == 0);
    // Other elementary functions and contraction show in the bits, or nothing was switched.
    CHECK(entry(report, "builtin").functions.front().different > 0);
    CHECK(entry(report, "native").functions.front().different > 0);
}

TEST_CASE("double has no native policy") {
    for (const Build& build : builds(Real::f64)) CHECK(build.math != Math::native);
}

TEST_CASE("a build that loosens arithmetic is told by what it breaks") {
    Behaviour behaviour;
    behaviour.function = find_function("vndf_reflect");
    behaviour.rows = 100;
    Finding good, bad;
    good.check = "unit length", good.figure = 1, good.limit = 2;
    bad.check = "pointwise, maximum", bad.figure = 3, bad.limit = 2;
    behaviour.findings = {good};
    const Build strict{Math::strict, ""}, fast{Math::strict, "-cl-fast-relaxed-math"},
        native{Math::native, ""};
    CHECK(behaviour.broken(strict).empty());
    behaviour.findings = {good, bad};
    CHECK(behaviour.broken(strict) == std::vector<std::string>{"pointwise, maximum"});
    behaviour.non_finite = 1, behaviour.different = 7;
    CHECK(behaviour.broken(fast) == std::vector<std::string>{"pointwise, maximum", "finite", "same bits"});
    CHECK(behaviour.broken(native) == std::vector<std::string>{"pointwise, maximum", "finite"});

    PolicyReport report;
    CHECK_FALSE(report.passed());  // nothing measured is no evidence
    Behaviour sound = behaviour;
    sound.findings = {good}, sound.non_finite = 0, sound.different = 0;
    report.entries = {{strict, "", {sound}}, {fast, "", {behaviour}}};
    CHECK(report.passed());
    CHECK_THAT(format_table(report), ContainsSubstring("strict -cl-fast-relaxed-math breaks:\n  finite: ") &&
                                         ContainsSubstring("strict keeps every promise\n"));
    report.entries = {{strict, "", {behaviour}}};
    CHECK_FALSE(report.passed());
    CHECK_THAT(format_table(report), ContainsSubstring("strict BREAKS its promises:\n  finite: "));
}

TEST_CASE("numbers that are not finite are counted in each build") {
    struct Broken final : runtime::Evaluator {
        void run(const Function& f, std::size_t n, const std::vector<const void*>&,
                 const std::vector<void*>& outputs) override {
            for (std::size_t c = 0; c < f.outputs.size(); ++c)
                for (std::size_t i = 0; i < n; ++i)
                    static_cast<float*>(outputs[c])[i] = i % 10 == c   ? std::nanf("")
                                                         : i % 10 == 5 ? HUGE_VALF
                                                                       : 1;
        }
        Real input_real() const override { return Real::f32; }
        Real output_real() const override { return Real::f32; }
        std::string describe() const override { return "broken"; }
    } broken;
    const Function& reflect = *find_function("vndf_reflect");
    PointwiseOptions options;
    options.random_points = 100, options.hard_stride = 1 << 20;
    const Table table = pointwise_table(reflect, Real::f32, options);
    std::vector<std::vector<double>> strict;
    const Behaviour behaviour = behaviour_of(broken, reflect, options, strict);
    std::size_t expected = 0;
    for (std::size_t i = 0; i < table.rows(); ++i) expected += i % 10 <= 2 || i % 10 == 5;
    CHECK(behaviour.rows == table.rows());
    CHECK(behaviour.non_finite == expected);
}

TEST_CASE("the quick form finds that strict and builtin keep their promises, densities of samples too") {
    CHECK(clvndf("policies --quick --only heitz2017").status == 0);
}

TEST_CASE("the command policies writes a table and JSON") {
    const Folder folder;
    CHECK(shell(folder, "\"$clvndf\" policies --quick --only vndf_ggx_lambda --json a.json >out") == 0);
    CHECK_THAT(folder.read("out"),
               ContainsSubstring("non-finite") && ContainsSubstring("strict keeps every promise"));
    const auto json = nlohmann::json::parse(folder.read("a.json"));
    REQUIRE(json["builds"].size() == 6);
    CHECK(json["passed"] == true);
    CHECK(json["builds"][4]["flag"] == "-cl-fast-relaxed-math");
    CHECK(json["builds"][0]["functions"][0]["findings"][0]["p99"] > 0);
    const Outcome wrong = clvndf("policies --only vndf_nothing");
    CHECK(wrong.status == 2);
    CHECK(std::count(wrong.err.begin(), wrong.err.end(), '\n') == 1);
}
