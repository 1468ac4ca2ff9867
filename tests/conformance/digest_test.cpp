// Strict float has the same bits on every device and in every host build: digests of tests/data, made by
//   clvndf check --digest --on host >tests/data/digests.txt
//   clvndf check --digest --on host --quick >tests/data/digests_quick.txt
//   clvndf check --digest --on host --answers >tests/data/answers.csv
// Compilers and options: same_bits.sh. Other devices: oclgrind.sh, rusticl.sh.
#include <cstdio>
#include <fstream>
#include <set>
#include <sstream>

#include "conformance/runs/check.h"
#include "conformance/judge/digest.h"
#include "conformance/inputs/grids.h"
#include "runtime/device_evaluator.h"
#include "support/catch.h"
#include "support/command.h"
#include "support/part_of_all.h"
#include "support/skip.h"

namespace vndf {
namespace {

std::string committed(const std::string& name) {
    std::ifstream file(CLVNDF_SOURCE_DIR "/tests/data/" + name, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

// The names whose lines differ, or stand in one of them alone.
std::set<std::string> differing(const std::string& a, const std::string& b) {
    std::set<std::string> names;
    const auto add_missing = [&](const std::string& from, const std::string& in) {
        std::istringstream lines(from);
        for (std::string line; std::getline(lines, line);)
            if (("\n" + in).find("\n" + line + "\n") == std::string::npos)
                names.insert(line.substr(0, line.find(' ')));
    };
    add_missing(a, b), add_missing(b, a);
    return names;
}

conformance::BitsOptions bits_of(std::size_t rows) {
    conformance::BitsOptions options;
    options.rows = rows;
    return options;
}

const conformance::BitsOptions quick = bits_of(conformance::quick_digest_rows);

// With VNDF_SOFTWARE_DIVIDE, on a device whose quotients and roots are off by 3 ulp to either side.
std::set<std::string> differing_with_own_division(const std::vector<std::string>& names) {
    runtime::ProgramOptions program;
    program.functions = names;
    program.build_options =
        "-DVNDF_SOFTWARE_DIVIDE=1 "
        "-DVNDF_IMPL_ROUGH_QUOTIENT(a,b)=as_float(as_int((a)/(b))+3-6*(as_int(b)&1)) "
        "-DVNDF_IMPL_ROUGH_ROOT(x)=as_float(as_int(sqrt(x))+3-6*(as_int(x)&1))";
    runtime::DeviceEvaluator device(runtime::choose_device().device, runtime::Math::strict,
                                    runtime::Real::f32, program);
    runtime::HostEvaluator host(runtime::Math::strict, runtime::Real::f32);
    std::vector<const Function*> selected;
    for (const std::string& name : names) selected.push_back(find_function(name));
    const auto of = [&](runtime::Evaluator& evaluator) {
        return conformance::format_digests(conformance::digests(evaluator, selected, quick));
    };
    return differing(of(device), of(host));
}

}  // namespace

TEST_CASE("whatever the device's quotients and roots are, with those of our own the bits are the same") {
    CHECK(differing_with_own_division({"vndf_ggx_sample_wm_dupuy2023_with_pdf", "vndf_ggx_sample_wi_eto2023",
                                       "vndf_ggx_sample_wm_heitz2018",
                                       "vndf_beckmann_sample_wm_heitz_deon2014", "vndf_ggx_weight",
                                       "vndf_fresnel_conductor"}) == std::set<std::string>());
}

// Minutes, most of them of PoCL's compiler.
TEST_CASE("the same for every function", "[.divide-full]") {
    std::vector<std::string> names;
    for (const Function& function : functions()) names.push_back(function.name);
    CHECK(differing_with_own_division(names) == std::set<std::string>());
}

TEST_CASE("the device has the committed digests") {
    const Outcome run = clvndf("check --digest --quick");
    CHECK(run.status == 0);
    CHECK(run.err == "");
    CHECK(differing(run.out, committed("digests_quick.txt")) == std::set<std::string>());
}

// Of all inputs a part of the functions. All: clvndf check --digest | diff tests/data/digests.txt -
TEST_CASE("of all inputs the device has the committed digests") {
    runtime::DeviceEvaluator device(runtime::choose_device().device, runtime::Math::strict,
                                    runtime::Real::f32);
    std::istringstream lines(
        format_digests(conformance::digests(device, part_of_all(0), bits_of(conformance::digest_rows))));
    for (std::string line; std::getline(lines, line);)
        CHECK_THAT(committed("digests.txt"), Catch::Matchers::ContainsSubstring(line + "\n"));
}

TEST_CASE("the device and the host build give the committed answers") {
    CHECK(clvndf("check --digest --answers").out == committed("answers.csv"));
    CHECK(clvndf("check --digest --answers --on host").out == committed("answers.csv"));
}

// All inputs of the host build take a minute: clvndf check --digest --on host | diff tests/data/digests.txt -
TEST_CASE("the host build has the committed digests") {
    CHECK(differing(clvndf("check --digest --on host --quick").out, committed("digests_quick.txt")) ==
          std::set<std::string>());
}

TEST_CASE("a digest is a line of name and hash for each function asked for, in the registry's order") {
    std::istringstream lines(committed("digests.txt"));
    for (const Function& function : functions()) {
        std::string name, hash;
        lines >> name >> hash;
        CHECK(name == function.name);
        CHECK(hash.size() == 16);
    }
    const Outcome one = clvndf("check --digest --quick --only vndf_reflect");
    CHECK(one.out.find("vndf_reflect ") == 0);
    CHECK(committed("digests_quick.txt").find(one.out) != std::string::npos);
    CHECK(clvndf("check --digest --quick --real double --only vndf_reflect").out != one.out);
    CHECK(clvndf("check --digest --json -").status == 2);
    CHECK(clvndf("check --on host").status == 2);
    CHECK(clvndf("check --digest --on host --math native").status == 2);
}

TEST_CASE("the double precision device has the host build's bits") {
    if (!runtime::choose_device().device.fp64) VNDF_SKIP("the device has no fp64");
    const std::vector<const Function*> part = part_of_all(1);
    runtime::ProgramOptions program;
    program.functions = conformance::needed(part);
    runtime::DeviceEvaluator device(runtime::choose_device().device, runtime::Math::strict,
                                    runtime::Real::f64, program);
    runtime::HostEvaluator host(runtime::Math::strict, runtime::Real::f64);
    CHECK(format_digests(conformance::digests(device, part, quick)) ==
          format_digests(conformance::digests(host, part, quick)));
}

TEST_CASE("the inputs of a digest are 2^20 rows with the whole hard grid") {
    const Function& sampler = *find_function("vndf_ggx_sample_wm_dupuy2023");
    const conformance::Table table =
        conformance::digest_inputs(sampler, conformance::digest_rows, runtime::Real::f32);
    CHECK(table.rows() == std::size_t{1} << 20);
    const conformance::Table hard =
        conformance::tabulate(sampler, conformance::hard_points(sampler), runtime::Real::f32);
    for (std::size_t i = 0; i < hard.rows(); i += 97) CHECK(table.row(i) == hard.row(i));
}

TEST_CASE("one rounding more changes the digest and is told apart") {
    const std::string name = "vndf_ggx_sample_wm_dupuy2023";
    runtime::ProgramOptions program;
    program.functions = {name};
    program.substitutions = {{"kernels/vndf/impl/lobe.h", "VNDF_FMA(rest, h2, l2)", "(rest * h2 + l2)", 1}};
    program.mutant = 1;
    runtime::DeviceEvaluator device(runtime::choose_device().device, runtime::Math::strict,
                                    runtime::Real::f32, program);
    const std::vector<const Function*> selected{find_function(name)};
    const std::string slipped = format_digests(conformance::digests(device, selected, quick));
    CHECK(committed("digests_quick.txt").find(slipped) == std::string::npos);

    const auto differences = conformance::compare_with_host(device, selected, quick);
    REQUIRE(differences.size() == 1);
    CHECK(differences[0].differing > 0);
    const std::string text = conformance::format_differences(differences, quick.rows);
    CHECK_THAT(text, Catch::Matchers::ContainsSubstring("same bits as the host build: no"));
    CHECK_THAT(text, Catch::Matchers::ContainsSubstring(name + " differs in "));
}

// Runs under Oclgrind as well (oclgrind.sh), which sees every access to memory.
TEST_CASE("items beyond the last whole group have the host build's bits", "[tail]") {
    runtime::DeviceEvaluator device(runtime::choose_device().device, runtime::Math::strict,
                                    runtime::Real::f32);
    const std::size_t items = 130;  // two groups of 64, and 2
    for (const auto& d : conformance::compare_with_host(device, conformance::select(""), bits_of(items))) {
        CAPTURE(d.function->name, d.ulps, d.worst);
        CHECK(d.differing == 0);
    }
    std::vector<float> u1(items), u2(items);
    device.uniforms(1, 0, items, u1.data(), u2.data());
    CHECK(u1.back() != u2.back());
}

// Only for oclgrind.sh: what it must see.
TEST_CASE("a kernel with an invalid access and a data race", "[.planted]") {
    runtime::ProgramOptions options;
    options.root = "kernels/vndf/impl/shim.h";
    options.more_source =
        "__kernel void planted(__global float *a) { a[get_global_id(0) + 1] = a[0]; a[1] = get_global_id(0); "
        "}";
    const runtime::Program program(runtime::choose_device().device, runtime::Math::strict, runtime::Real::f32,
                                   options);
    cl::Kernel kernel = program.kernel("planted");
    const cl::Buffer buffer = program.buffer(std::size_t{4 * 64});
    kernel.setArg(0, buffer);
    program.launch(kernel, 64);
    program.queue().finish();
}

TEST_CASE(
    "a device that flushes subnormal numbers has the same bits, and next to nothing to be excused for") {
    // The host build stands for a device that flushes: exempt rows take its results, whatever the device returns.
    conformance::BitsOptions options = quick;
    runtime::HostEvaluator host(runtime::Math::strict, runtime::Real::f32);
    const std::vector<const Function*> all = conformance::select({});
    const auto strict = conformance::digests(host, all, options);
    options.flushes = true;
    const auto flushing = conformance::digests(host, all, options);
    for (std::size_t i = 0; i < all.size(); ++i) {
        const Function& function = *all[i];
        CAPTURE(function.name);
        CHECK(strict[i].hash == flushing[i].hash);
        // Lambda of directions beside n is no normal number itself; fourth powers of alpha are not in the cone of a cap.
        const auto is = [&](const char* part) { return function.name.find(part) != std::string::npos; };
        const bool excused =
            is("conic2026") || is("tilted") || is("cap_mass") || function.name == "vndf_ggx_lambda_world";
        CHECK(flushing[i].exempt <= (is("cone2026") ? 10 : excused ? 2 : 0));
    }
}

TEST_CASE("what a device that flushes subnormal numbers may differ in, at all inputs of the digest",
          "[.flush-full]") {
    conformance::BitsOptions all;
    all.flushes = true;
    runtime::HostEvaluator host(runtime::Math::strict, runtime::Real::f32);
    for (const Function& function : functions()) {
        const conformance::Digest digest = conformance::digests(host, {&function}, all)[0];
        if (digest.exempt > 0)
            std::printf("%-45s %8zu of %zu, by up to %.2g\n", function.name.c_str(), digest.exempt, all.rows,
                        digest.moved);
    }
}

}  // namespace vndf
