// The promise of fast math (conformance/runs/fast_math.h): kept in renderers' builds, and no check of it is idle. All pairs of
// flags, all functions and other compilers: fast_math.sh.
#include <nlohmann/json.hpp>

#include "support/command.h"
#include "support/fast_math.h"

using namespace vndf;
using namespace vndf::conformance;
using Catch::Matchers::ContainsSubstring;
using Names = std::vector<std::string>;

namespace {

// One of each body: the plain form of a sampler and that of a lobe compute what the form with the density does.
std::vector<const Function*> bodies() {
    std::vector<const Function*> some;
    for (const Function& function : functions())
        if (!is_plain_sampler(function) && function.lobe.empty()) some.push_back(&function);
    return some;
}

FastMathReport measured(const std::string& flags, const std::vector<const Function*>& selected) {
    CheckOptions options;
    options.quick = true;
    return measure_fast_math(runtime::choose_device().device, runtime::parse_flag_sets(flags), selected,
                             options);
}

// What each of the functions breaks.
std::vector<Names> broken(const std::string& flags, const Names& names) {
    std::vector<const Function*> selected;
    for (const std::string& name : names) selected.push_back(find_function(name));
    std::vector<Names> all;
    const FastMathReport report = measured(flags, selected);
    for (const FastMathFigures& f : report.entries.at(0).functions) all.push_back(f.broken());
    return all;
}

// Strict results, but for those of row 7, to which `spoil` is done.
template <class Spoil>
Names broken_by(const std::string& name, Spoil spoil) {
    struct Spoilt final : runtime::Evaluator {
        runtime::HostEvaluator host{Math::strict, Real::f32};
        Spoil spoil;
        explicit Spoilt(Spoil s) : spoil(s) {}
        void run(const Function& function, std::size_t n, const std::vector<const void*>& inputs,
                 const std::vector<void*>& outputs) override {
            host.run(function, n, inputs, outputs);
            for (std::size_t row = 0; row < n; ++row)
                for (std::size_t c = 0; c < outputs.size(); ++c)
                    spoil(static_cast<float*>(outputs[c])[row], row, c);
        }
        Real input_real() const override { return Real::f32; }
        Real output_real() const override { return Real::f32; }
        std::string describe() const override { return "spoilt"; }
    } spoilt(spoil);
    CheckOptions options;
    options.quick = true;
    runtime::HostEvaluator strict(Math::strict, Real::f32);
    return fast_math_figures(spoilt, fast_math_rows(strict, *find_function(name), options)).broken();
}

}  // namespace

TEST_CASE("renderers' flags keep the promise of fast math") {
    const std::vector<const Function*> selected = bodies();
    REQUIRE(selected.size() > 40);
    const auto sets = runtime::distinct(runtime::renderer_flags());
    REQUIRE(sets.size() == 4);
    CheckOptions options;
    options.quick = true;
    const FastMathReport report = measure_fast_math(runtime::choose_device().device, sets, selected, options);
    INFO(format_table(report));
    CHECK(report.passed());
    for (const auto& entry : report.entries) {
        REQUIRE(entry.functions.size() == selected.size());
        for (const FastMathFigures& f : entry.functions) {
            CHECK(f.inside == 1 << 14);
            // Of areas few alphas of the hard grid are judged.
            CHECK(f.everywhere > (f.function->unit == Unit::area ? 1000 : 4000));
            CHECK((f.value.count() > 0 || f.direction.count() > 0));
        }
    }
}

TEST_CASE("without what the headers switch off the promise is broken") {
    const Names names{"vndf_beckmann_sample_wm_walter2007", "vndf_jacobian_refract",
                      "vndf_ggx_sample_wm_heitz2018_with_pdf", "vndf_beckmann_slope_cdf_inverse"};
    CHECK(broken("cycles -DVNDF_IMPL_PRECISE=0", names) ==
          std::vector<Names>{{"direction"}, {"value"}, {}, {"value"}});
    // Where reassociation alone is switched off.
    CHECK(broken("cycles -DVNDF_IMPL_PRECISE=1", names) == std::vector<Names>{{}, {}, {}, {"value"}});
}

TEST_CASE("the host build under -ffast-math keeps the promise") {
    std::vector<const Function*> all;
    for (const Function& function : functions()) all.push_back(&function);
    CheckOptions options;
    options.quick = true;
    const FastMathReport report = measure_host_fast_math("-ffast-math", all, options);
    INFO(format_table(report));
    CHECK(report.passed());
}

TEST_CASE("each part of the promise is judged") {
    const std::string sampler = "vndf_ggx_sample_wm_dupuy2023_with_pdf";
    CHECK(broken_by(sampler, [](float&, std::size_t, std::size_t) {}).empty());
    CHECK(broken_by(sampler, [](float& x, std::size_t row, std::size_t) {
              if (row == 7) x = HUGE_VALF;
          }) == Names{"finite"});
    CHECK(broken_by(sampler, [](float& x, std::size_t row, std::size_t c) {
              if (row == 7 && c < 3) x *= 1 + 12 * 0x1p-24F;
          }) == Names{"unit"});
    CHECK(broken_by(sampler, [](float& x, std::size_t row, std::size_t c) {
              if (row == 7 && c == 3) x *= 1.0002F;
          }) == Names{"value"});
    // Turned about z: one by more than the maximum allowed, all by more than the percentile.
    const auto turned = [&](float angle, std::size_t last) {
        return broken_by(sampler, [angle, last, x = 0.0F](float& v, std::size_t row, std::size_t c) mutable {
            if (row > last) return;
            if (c == 0) x = v;
            if (c == 1) v += angle * x;
        });
    };
    CHECK(turned(1e-7F, 1 << 20).empty());
    CHECK_FALSE(turned(2e-5F, 1 << 20).empty());
    CHECK_FALSE(turned(1e-3F, 7).empty());
    CHECK_FALSE(FastMathReport{}.passed());  // nothing measured is no evidence
}

TEST_CASE("sets of flags are named") {
    using namespace runtime;
    CHECK(flag_pairs().size() == 7 * 8 / 2);
    const auto sets = parse_flag_sets("luxcore,-cl-mad-enable  -cl-denorms-are-zero,cycles -DX=1");
    REQUIRE(sets.size() == 3);
    CHECK(sets[0].flags == "-cl-fast-relaxed-math -cl-mad-enable");
    CHECK(sets[1].flags == "-cl-mad-enable -cl-denorms-are-zero");
    CHECK(sets[2].name == "cycles -DX=1");
    CHECK(sets[2].flags == "-cl-fast-relaxed-math -DX=1");
    CHECK(parse_flag_sets("renderers,pairs").size() == 5 + 28);
    for (const char* wrong : {"", "luxcore,", "lux", "-cl-fast", "-D", "pairs cycles"})
        CHECK_THROWS_AS(parse_flag_sets(wrong), InputError);
}

TEST_CASE("the command policies --flags writes a table and JSON") {
    const Folder folder;
    CHECK(
        shell(folder,
              "\"$clvndf\" policies --flags luxcore,cycles --quick --only vndf_reflect --json a.json >out") ==
        0);
    CHECK_THAT(folder.read("out"),
               ContainsSubstring("luxcore\nfunction") && ContainsSubstring("keeps the promise"));
    const auto json = nlohmann::json::parse(folder.read("a.json"));
    REQUIRE(json["builds"].size() == 2);
    CHECK(json["builds"][0]["functions"][0]["direction_max"] <= 1e-4);
    CHECK_THAT(std::string(json["builds"][1]["build_options"]), ContainsSubstring("-cl-fast-relaxed-math"));
    const Outcome breaks = clvndf(
        "policies --flags 'cycles -DVNDF_IMPL_PRECISE=0' --quick --only vndf_beckmann_sample_wm_walter2007");
    CHECK(breaks.status == 1);
    CHECK_THAT(breaks.out, ContainsSubstring("BREAKS direction") && ContainsSubstring("BREAKS the promise"));
    for (const char* wrong : {"policies --flags fast", "policies --flags list", "policies --flags ''",
                              "policies --flags cycles --real double"}) {
        INFO(wrong);
        const Outcome outcome = clvndf(wrong);
        CHECK(outcome.status == 2);
        CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
        CHECK_THAT(outcome.err, ContainsSubstring("--flags"));
    }
}
