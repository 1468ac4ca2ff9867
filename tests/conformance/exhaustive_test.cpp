// The exhaustion of u finds the one value at which a promise is broken, and names it.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <sstream>

#include "conformance/judge/errors.h"
#include "conformance/runs/check.h"
#include "conformance/runs/exhaustive.h"
#include "support/catch.h"
#include "support/command.h"
#include "support/skip.h"

using namespace vndf;
using namespace vndf::conformance;
using Catch::Matchers::ContainsSubstring;

namespace {

// A mistake for each invariant, in its order, at one value of u1 alone each: 0x1.6a09e{a,8,6,4,2}p-1, multiples of 2^-24
// which no other check would choose. What is not finite has no length either, so it comes last in the walk.
struct Planted {
    std::string file, sampler, replaced, result;
    std::array<std::string, invariant_count> mistakes;
};

std::string planted_u(std::size_t invariant) {
    return std::string("0x1.6a09e") + "a8642"[invariant] + "p-1";
}

const std::vector<Planted>& planted() {
    // A direction without a normal's height that faces away from wo; the reflection whose half vector lies in the plane.
    const std::string away =
        "d.x = at ? -wo.x * length : d.x; d.y = at ? -wo.y * length : d.y; d.z = at ? 0 : d.z;";
    const std::string back = "d.x = at ? wo.x : d.x; d.y = at ? wo.y : d.y; d.z = at ? -wo.z : d.z;";
    const std::string not_finite = "d.y = at ? d.y / (d.y - d.y) : d.y;";
    const std::string longer =
        "d.x = at ? d.x * 1.000001f : d.x; d.y = at ? d.y * 1.000001f : d.y;"
        "d.z = at ? d.z * 1.000001f : d.z;";
    const std::string down = "d.x = at ? 0 : d.x; d.y = at ? 0 : d.y; d.z = at ? -1 : d.z;";
    const std::string no_density = "d.w = at ? -d.w : d.w;";
    static const std::vector<Planted> all{
        {"ggx_dupuy2023.h",
         "vndf_ggx_sample_wm_dupuy2023",
         "return vndf_impl_direction_pdf(vndf_impl_ggx_dupuy2023(vndf_ggx_lobe_of(wo, alpha), u));",
         "vndf_impl_ggx_dupuy2023(vndf_ggx_lobe_of(wo, alpha), u)",
         {not_finite, longer, "d.z = at ? -d.z : d.z;", away, no_density}},
        {"ggx_eto2023.h",
         "vndf_ggx_sample_wi_eto2023",
         "return vndf_impl_direction_pdf(vndf_impl_ggx_eto2023(vndf_ggx_lobe_of(wo, alpha), u));",
         "vndf_impl_ggx_eto2023(vndf_ggx_lobe_of(wo, alpha), u)",
         {not_finite, longer, down, back, no_density}}};
    return all;
}

runtime::ProgramOptions program_with_mistakes(const std::vector<const Function*>& samplers,
                                              bool switched_on) {
    runtime::ProgramOptions program = exhaustive_program(samplers);
    for (const Planted& p : planted()) {
        std::string body = "VNDF_REAL4 d = vndf_impl_direction_pdf(" + p.result +
                           "); VNDF_REAL length = 1 / VNDF_SQRT(wo.x * wo.x + wo.y * wo.y); int at;";
        for (std::size_t i = 0; i < invariant_count; ++i)
            body += "at = u.x == " + planted_u(i) + "f; " + p.mistakes[i];
        program.substitutions.push_back(
            {"kernels/vndf/" + p.file, p.replaced, body + " (void)length; return d;", 1});
    }
    program.mutant = switched_on;
    return program;
}

// Where the walk passes over all u1 at a lobe seen from above, neither narrow nor flat.
Slice one_pass(const Function& sampler) {
    const std::vector<Point> lobes = exhaustive_lobes(sampler);
    for (std::uint32_t i = 1; i < lobes.size(); i += 2) {  // every other lobe begins with u1
        const auto [x, y] = lobes[i].alpha;
        if (lobes[i].cos_theta == 0.5 && std::min(x, y) > 0.1 && std::max(x, y) < 1) return {i, 1u << 31};
    }
    FAIL("no such lobe");
    return {};
}

// One pass for each sampler.
ExhaustiveReport walk(const std::vector<const Function*>& samplers, const runtime::ProgramOptions& program) {
    ExhaustiveWalk walk(samplers, one_pass(*samplers.front()));
    ExhaustiveWalker walker(
        walk, {runtime::choose_device().device, runtime::Math::strict, runtime::Real::f32, program});
    REQUIRE(walk.pieces() == 1);
    walk.take(walker.walk(0));
    return walk.report();
}

// "wo_x=0x1p-1 wo_y=..." as two lines of CSV.
std::string csv_of(const std::string& row) {
    std::istringstream words(row);
    std::string names, values, word;
    while (words >> word) {
        const std::size_t equals = word.find('=');
        names += (names.empty() ? "" : ",") + word.substr(0, equals);
        values += (values.empty() ? "" : ",") + word.substr(equals + 1);
    }
    return names + "\n" + values + "\n";
}

// Every lobe of the walk at each u of ends and quarters and their neighbours: where a map's sums nearly vanish.
Table corners(const Function& sampler) {
    std::vector<Point> points;
    for (Point point : exhaustive_lobes(sampler))
        for (const double u1 : {0., 0.25, 0.5, 0.75, 1.})
            for (const double u2 : {0., 0x1p-24, 0.5, 1 - 0x1p-22, 1 - 0x1p-23, 1 - 0x1p-24}) {
                point.u = {u1, u2};
                points.push_back(point);
            }
    return tabulate(sampler, points, runtime::Real::f32);
}

}  // namespace

TEST_CASE("at the corners of u normals face the viewer, in every lobe of the walk") {
    runtime::HostEvaluator host(runtime::Math::strict, runtime::Real::f32);
    std::vector<const Function*> all;
    for (const Function& function : functions()) all.push_back(&function);
    for (const Function* sampler : samplers_of(all)) {
        const int wo = column(*sampler, "wo_x");
        if (sampler->result != "WM" || wo < 0 || sampler->domain == Domain::upper) continue;
        const Table table = corners(*sampler);
        const auto wm = evaluate(host, *sampler, table);
        double worst = 0;
        std::string at;
        for (std::size_t i = 0; i < table.rows(); ++i) {
            double facing = 0;
            for (int k = 0; k < 3; ++k) facing += table.columns[wo + k][i] * wm[k][i];
            if (-facing > worst) worst = -facing, at = hex_row(*sampler, table.row(i));
        }
        CAPTURE(sampler->name, worst * 0x1p24, at);
        CHECK(worst <= side_bound() * 0x1p-24);
    }
}

TEST_CASE("at the corners of u reflections into caps have a density, in every lobe of the walk") {
    runtime::HostEvaluator host(runtime::Math::strict, runtime::Real::f32);
    for (const std::string name : {"vndf_ggx_sample_wi_cone2026", "vndf_ggx_sample_wi_cone2026_lobe"}) {
        const Function& sampler = *find_function(name + "_with_pdf");
        const Table table = corners(*find_function(sampler.plain));
        const std::vector<double> density = evaluate(host, sampler, table).back();
        REQUIRE(density.size() > 5000);
        const auto lost = std::find_if(density.begin(), density.end(), [](double d) { return !(d > 0); });
        const auto row = static_cast<std::size_t>(lost - density.begin());
        INFO(name << " at " << (lost == density.end() ? "" : hex_row(sampler, table.row(row))));
        CHECK(lost == density.end());
    }
}

TEST_CASE("the exhaustion finds the one u at which a promise is broken, for each promise, and names it") {
    std::vector<const Function*> samplers;
    for (const Planted& p : planted()) samplers.push_back(find_function(p.sampler));
    const ExhaustiveReport sound = walk(samplers, program_with_mistakes(samplers, false));
    CHECK(sound.passed());
    CHECK(sound.inputs == samplers.size() << 24);

    const ExhaustiveReport report = walk(samplers, program_with_mistakes(samplers, true));
    CHECK_FALSE(report.passed());
    REQUIRE(report.samplers.size() == planted().size());
    const std::string table = format_table(report);
    CAPTURE(table);
    for (const Exhausted& sampler : report.samplers) {
        CAPTURE(sampler.sampler->name);
        REQUIRE(sampler.offenders.size() == invariant_count);
        for (std::size_t i = 0; i < invariant_count; ++i) {
            const Offenders& offenders = sampler.offenders[i];
            CAPTURE(offenders.invariant, offenders.first);
            CHECK(offenders.count >= 1);
            CHECK(offenders.count <= invariant_count);
            CHECK_THAT(offenders.first, ContainsSubstring("u1=" + planted_u(i) + " "));
            CHECK_THAT(table,
                       ContainsSubstring("FAILED " + sampler.sampler->name + ": " + offenders.invariant) &&
                           ContainsSubstring("at " + offenders.first));
        }
    }
}

TEST_CASE("check --exhaustive exits with 1 for an offender, and prints an input that reproduces it") {
    if (runtime::choose_device().device.platform != "Portable Computing Language")
        VNDF_SKIP("the planted mistake goes in by a variable of PoCL's");
    const std::string walk = "check --exhaustive --only vndf_ggx_sample_wm_heitz2018 --minutes 0.001";
    const Outcome sound = clvndf(walk);
    CHECK(sound.status == 0);
    CHECK_THAT(sound.out, ContainsSubstring("none bad"));

    const Folder folder;
    // Every square root is its argument.
    const std::string planted = "POCL_EXTRA_BUILD_FLAGS=-D_cl_sqrt=_cl_fabs \"$clvndf\" ";
    CHECK(shell(folder, planted + walk + " >out 2>err") == 1);
    const std::string out = folder.read("out"), at = "\n  at ";
    CAPTURE(out);
    REQUIRE_THAT(
        out, ContainsSubstring("FAILED vndf_ggx_sample_wm_heitz2018: unit length") && ContainsSubstring(at));
    const std::size_t begin = out.find(at) + at.size();
    folder.write("row.csv", csv_of(out.substr(begin, out.find('\n', begin) - begin)));
    const auto is_unit = [&](const std::string& command) {
        CHECK(shell(folder,
                    command + "eval vndf_ggx_sample_wm_heitz2018 --hex --input row.csv >result 2>err") == 0);
        double x = 0, y = 0, z = 0;
        const std::string result = folder.read("result");
        CHECK(std::sscanf(result.substr(result.find('\n')).c_str(), "%la,%la,%la", &x, &y, &z) == 3);
        return std::abs(x * x + y * y + z * z - 1) <= 8 * 0x1p-24;
    };
    CHECK(is_unit("\"$clvndf\" "));
    CHECK_FALSE(is_unit(planted));
}
