#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <random>

#include <Random123/philox.h>

#include "conformance/judge/pointwise.h"
#include "error.h"
#include "runtime/device_evaluator.h"
#include "support/catch.h"
#include "support/signed_zeros.h"
#include "support/skip.h"

namespace {

using namespace vndf;
using namespace vndf::runtime;
using Catch::Matchers::ContainsSubstring;

// The device that a user would get.
const Device& device() {
    static const Device chosen = choose_device().device;
    return chosen;
}

template <class R>
constexpr Real real_of = sizeof(R) == 4 ? Real::f32 : Real::f64;

template <class R>
using Columns = std::vector<std::vector<R>>;

// Numbers that suit every function: unit vectors above the horizon, u and the rest in (0, 1).
template <class R>
Columns<R> rows(const Function& f, std::size_t n) {
    std::mt19937 bits(1);
    std::uniform_real_distribution<R> uniform(R(0.05), R(0.95));
    Columns<R> columns(f.inputs.size(), std::vector<R>(n));
    for (auto& column : columns)
        for (R& x : column) x = uniform(bits);
    for (std::size_t c = 2; c < columns.size(); ++c) {
        if (!f.inputs[c].ends_with("_z")) continue;
        for (std::size_t i = 0; i < n; ++i) {
            R &x = columns[c - 2][i], &y = columns[c - 1][i], &z = columns[c][i];
            const R length = std::sqrt(x * x + y * y + z * z);
            x /= length, y /= length, z /= length;
        }
    }
    return columns;
}

template <class Out, class In>
Columns<Out> run(Evaluator& evaluator, const Function& f, const Columns<In>& in) {
    const std::size_t n = in.front().size();
    Columns<Out> out(f.outputs.size(), std::vector<Out>(n, Out(-77)));
    std::vector<const void*> inputs;
    std::vector<void*> outputs;
    for (const auto& column : in) inputs.push_back(column.data());
    for (auto& column : out) outputs.push_back(column.data());
    evaluator.run(f, n, inputs, outputs);
    return out;
}

// Rows whose results differ in any bit; NaN equals NaN.
template <class R>
std::size_t differences(const Columns<R>& a, const Columns<R>& b) {
    std::size_t count = 0;
    for (std::size_t c = 0; c < a.size(); ++c) {
        for (std::size_t i = 0; i < a[c].size(); ++i) {
            const bool both_nan = std::isnan(a[c][i]) && std::isnan(b[c][i]);
            count += !both_nan && std::memcmp(&a[c][i], &b[c][i], sizeof(R)) != 0;
        }
    }
    return count;
}

const Function& function(const std::string& name) {
    const Function* found = find_function(name);
    REQUIRE(found != nullptr);
    return *found;
}

Device fake(const std::string& platform, const std::string& name, cl_device_type type) {
    Device d;
    d.platform = platform;
    d.name = name;
    d.type = type;
    return d;
}

// ---------------------------------------------------------------------------------------------- sources

TEST_CASE("an assembled source names each line's file and line") {
    const std::vector<SourceFile> files = {{"a/main.cl", "one\n#include \"../b/part.h\"\nthree\n"},
                                           {"b/part.h", "part 1\n  # include <root.h>\npart 3"},
                                           {"root.h", "root\n"}};
    CHECK(assemble("a/main.cl", {}, files) ==
          "#line 1 \"a/main.cl\"\none\n"
          "#line 1 \"b/part.h\"\npart 1\n"
          "#line 1 \"root.h\"\nroot\n"
          "#line 3 \"b/part.h\"\npart 3\n"
          "#line 3 \"a/main.cl\"\nthree\n");
}

std::size_t count(const std::string& text, const std::string& part) {
    std::size_t n = 0;
    for (std::size_t at = text.find(part); at != text.npos; at = text.find(part, at + 1)) ++n;
    return n;
}

TEST_CASE("a guarded file is taken in once, a file without a guard each time") {
    const std::vector<SourceFile> files = {
        {"main", "#include \"guarded\"\n#include \"guarded\"\n#include \"table\"\n#include \"table\"\n"},
        {"guarded", "// comment\n#ifndef G\n#define G\n#include \"main\"\nbody\n#endif\n"},
        {"table", "row\n"}};
    // main and guarded include each other: the guard ends that as well.
    const std::string text = assemble("guarded", {}, files);
    CHECK(count(text, "body\n") == 1);
    CHECK(count(text, "row\n") == 2);
}

TEST_CASE("a file taken in under a condition is taken in again where it may be needed") {
    const std::vector<SourceFile> files = {
        {"main", "#if A\n#include \"guarded\"\n#endif\n#include \"guarded\"\n#include \"guarded\"\n"},
        {"guarded", "#ifndef G\n#define G\nbody\n#endif\n"}};
    CHECK(count(assemble("main", {}, files), "body\n") == 2);
}

TEST_CASE("includes without end and unknown sources are errors") {
    CHECK_THROWS_AS(assemble("a", {}, {{"a", "#include \"a\"\n"}}), DeviceError);
    CHECK_THROWS_AS(assemble("nothing"), DeviceError);
}

TEST_CASE("a program holds only the functions asked for") {
    Assembly one;
    one.functions = {"vndf_ggx_sample_wm_dupuy2023_with_pdf"};
    const std::string text = assemble("kernels/batch/batch.cl", one);
    CHECK(count(text, "\nVNDF_SAMPLER(vndf_") == 1);
    CHECK(count(text, "\nVNDF_SAMPLER(vndf_ggx_sample_wm_dupuy2023,") == 1);
    CHECK(count(text, "\nVNDF_TERM(vndf_") == 0);
    const std::string all = assemble("kernels/batch/batch.cl");
    CHECK(count(all, "\nVNDF_SAMPLER(vndf_") >= 15);
    // The registry's lines keep their numbers.
    CHECK(count(all, "\n") == count(text, "\n"));
}

TEST_CASE("a substitution puts both texts under VNDF_MUTANT and keeps the line numbers") {
    const std::vector<SourceFile> files = {{"f", "zero\nx = a + b;\ntwo\n"}};
    Assembly assembly;
    assembly.substitutions = {{"f", "a + b", "a - b", 1}, {"f", "b;", "c;", 2}};
    CHECK(assemble("f", assembly, files) ==
          "#line 1 \"f\"\nzero\n"
          "#if VNDF_MUTANT == 1\n#line 2 \"f\"\nx = a - b;\n"
          "#elif VNDF_MUTANT == 2\n#line 2 \"f\"\nx = a + c;\n"
          "#else\n#line 2 \"f\"\nx = a + b;\n#endif\n"
          "#line 3 \"f\"\ntwo\n");
}

TEST_CASE("a substitution in a macro of several lines repeats all of them") {
    const std::vector<SourceFile> files = {{"f", "zero\n#define M(x) \\\n    x(1) \\\n    x(2)\nfour\n"}};
    Assembly assembly;
    assembly.substitutions = {{"f", "x(1)", "x(3)", 1}, {"f", "M(x)", "N(x)", 2}};
    CHECK(assemble("f", assembly, files) ==
          "#line 1 \"f\"\nzero\n"
          "#if VNDF_MUTANT == 1\n#line 2 \"f\"\n#define M(x) \\\n    x(3) \\\n    x(2)\n"
          "#elif VNDF_MUTANT == 2\n#line 2 \"f\"\n#define N(x) \\\n    x(1) \\\n    x(2)\n"
          "#else\n#line 2 \"f\"\n#define M(x) \\\n    x(1) \\\n    x(2)\n#endif\n"
          "#line 5 \"f\"\nfour\n");
}

TEST_CASE("a substitution that does not apply exactly once is an error") {
    const std::vector<SourceFile> files = {{"f", "same\nsame\n#include \"g\"\nfirst\nsecond\n"}};
    const auto attempt = [&](const std::string& file, const std::string& old_text) {
        Assembly assembly;
        assembly.substitutions = {{file, old_text, "new", 1}};
        return assemble("f", assembly, files);
    };
    CHECK_THROWS_WITH(attempt("f", "absent"), ContainsSubstring("text not found: 'absent'"));
    CHECK_THROWS_WITH(attempt("f", "same"), ContainsSubstring("more than once"));
    CHECK_THROWS_WITH(attempt("g", "same"), ContainsSubstring("no such embedded source"));
    CHECK_THROWS_WITH(attempt("f", "\"g\""), ContainsSubstring("directive"));
    CHECK_THAT(attempt("f", "first\nsecond"),
               ContainsSubstring("\nnew\n#else\n#line 4 \"f\"\nfirst\nsecond\n"));
    Assembly overlapping;
    overlapping.substitutions = {{"f", "first\nsecond", "1", 1}, {"f", "second", "2", 2}};
    CHECK_THROWS_WITH(assemble("f", overlapping, files), ContainsSubstring("overlaps"));
}

// ---------------------------------------------------------------------------------------------- devices

TEST_CASE(
    "a device is chosen by a part of its platform's or its own name, the first of several with a note") {
    unsetenv("CLVNDF_DEVICE");
    const std::vector<Device> all = {
        fake("Acme", "gpu-one", CL_DEVICE_TYPE_GPU),
        fake("Portable Computing Language", "gpu-two", CL_DEVICE_TYPE_GPU),
        fake("Portable Computing Language", "pthread-three", CL_DEVICE_TYPE_CPU)};
    CHECK(choose_device(all, "THREE").device.name == "pthread-three");
    CHECK(choose_device(all, "three").note.empty());
    CHECK(choose_device(all, "portable").device.name == "gpu-two");
    CHECK_THAT(choose_device(all, "portable").note,
               ContainsSubstring("2 devices") && ContainsSubstring("Portable Computing Language / gpu-two"));
    CHECK(choose_device(all, "portable#2").device.name == "pthread-three");
    CHECK(choose_device(all, "portable#2").note.empty());
    CHECK(choose_device(all, "#2").device.name == "gpu-two");
    CHECK(choose_device({all[0], fake("Acme", "gpu #1", CL_DEVICE_TYPE_GPU)}, "gpu #1").device.name ==
          "gpu #1");
    for (const char* beyond : {"portable#3", "portable#0", "acme#99999999999999999999"})
        CHECK_THROWS_AS(choose_device(all, beyond), InputError);
    CHECK_THROWS_WITH(choose_device(all, "portable#3"), ContainsSubstring("'portable' matches 2 devices"));
    CHECK(choose_device(all, "").device.name == "pthread-three");
    Device library = all[0];
    library.compiler = false;
    CHECK(choose_device({library, all[1]}, "").device.name == "gpu-two");
    CHECK(choose_device({all[0]}, "").device.name == "gpu-one");

    setenv("CLVNDF_DEVICE", "gpu-two", 1);
    CHECK(choose_device(all, "").device.name == "gpu-two");
    CHECK(choose_device(all, "acme").device.name == "gpu-one");
    setenv("CLVNDF_DEVICE", "absent", 1);
    CHECK_THROWS_WITH(choose_device(all, ""),
                      ContainsSubstring("CLVNDF_DEVICE") && ContainsSubstring("'absent'"));
    unsetenv("CLVNDF_DEVICE");
}

TEST_CASE("the error of a wrong device name lists the devices there are") {
    const std::vector<Device> all = {fake("Acme", "one", CL_DEVICE_TYPE_GPU),
                                     fake("Acme", "two", CL_DEVICE_TYPE_GPU)};
    CHECK_THROWS_AS(choose_device(all, "three"), InputError);
    CHECK_THROWS_WITH(choose_device(all, "three"), ContainsSubstring("'three'") &&
                                                       ContainsSubstring("'Acme / one'") &&
                                                       ContainsSubstring("'Acme / two'"));
    CHECK_THROWS_AS(choose_device({}, ""), DeviceError);
}

TEST_CASE("a device without fp64 does not compute in double") {
    Device single = device();
    single.fp64 = false;
    CHECK_THROWS_AS(DeviceEvaluator(single, Math::strict, Real::f64), InputError);
    CHECK_NOTHROW(require_real(single, Real::f32));
    CHECK_THROWS_AS(DeviceEvaluator(device(), Math::native, Real::f64), InputError);
}

// ------------------------------------------------------------------------------------------- evaluators

TEMPLATE_TEST_CASE("every registered function gives the same bits on the device and on the host", "", float,
                   double) {
    if (sizeof(TestType) == 8 && !device().fp64) VNDF_SKIP("the device has no fp64");
    DeviceEvaluator on_device(device(), Math::strict, real_of<TestType>);
    HostEvaluator on_host(Math::strict, real_of<TestType>);
    for (const Function& f : functions()) {
        CAPTURE(f.name);
        const auto in = rows<TestType>(f, 1000);
        const auto expected = run<TestType>(on_host, f, in);
        CHECK(differences(run<TestType>(on_device, f, in), expected) == 0);
        // Something was computed: results are finite and not all alike.
        std::size_t distinct = 0;
        for (std::size_t i = 0; i < 1000; ++i) {
            CHECK(std::isfinite(expected[0][i]));
            distinct += expected[0][i] != expected[0][0];
        }
        CHECK(distinct > 0);
    }
}

TEMPLATE_TEST_CASE("the reference and the builtin policy agree with the strict one", "", float, double) {
    HostEvaluator strict(Math::strict, real_of<TestType>), builtin(Math::builtin, real_of<TestType>);
    ReferenceEvaluator reference(real_of<TestType>);
    for (const Function& f : functions()) {
        if (f.method == Method::approximate) continue;
        CAPTURE(f.name);
        const auto in = rows<TestType>(f, 200);
        const auto ours = run<TestType>(strict, f, in);
        const auto theirs = run<double>(reference, f, in);
        const auto other = run<TestType>(builtin, f, in);
        for (std::size_t c = 0; c < ours.size(); ++c) {
            for (std::size_t i = 0; i < 200; ++i) {
                CHECK(ours[c][i] == Approx(theirs[c][i]).epsilon(1e-3).margin(1e-4));
                CHECK(ours[c][i] == Approx(other[c][i]).epsilon(1e-3).margin(1e-4));
            }
        }
    }
}

// How many numbers of a and b differ by more than `rounding` of the larger, or of 1.
template <class R>
std::size_t disagreements(const Columns<R>& a, const Columns<R>& b, double rounding) {
    std::size_t count = 0;
    for (std::size_t c = 0; c < a.size(); ++c)
        for (std::size_t i = 0; i < a[c].size(); ++i) {
            const double size = std::max({1.0, double(std::abs(a[c][i])), double(std::abs(b[c][i]))});
            count += !(std::abs(double(a[c][i]) - double(b[c][i])) <= rounding * size);
        }
    return count;
}

TEMPLATE_TEST_CASE("the sign of a zero changes no result, on the device, on the host and in the reference",
                   "", float, double) {
    constexpr Real real = real_of<TestType>;
    if (real == Real::f64 && !device().fp64) VNDF_SKIP("the device has no fp64");
    DeviceEvaluator on_device(device(), Math::strict, real);
    HostEvaluator on_host(Math::strict, real);
    ReferenceEvaluator reference(real);
    for (const Function& f : functions()) {
        CAPTURE(f.name);
        conformance::Table table;
        Columns<TestType> signed_zeros(f.inputs.size()), plain;
        for (const auto& row : rows_with_zeros(f))
            for (std::size_t c = 0; c < row.size(); ++c) signed_zeros[c].push_back(TestType(row[c]));
        for (const auto& column : signed_zeros) {
            table.columns.emplace_back(column.begin(), column.end());
            for (TestType& x : plain.emplace_back(column)) x += TestType(0);  // -0 + 0 = 0
        }
        const auto result = run<TestType>(on_host, f, signed_zeros);
        CHECK(differences(run<TestType>(on_device, f, signed_zeros), result) == 0);
        CHECK(disagreements(result, run<TestType>(on_host, f, plain), 0) == 0);
        // Of caps, normals and corners between axes most are at a jump: a rim through -wo, a round cone whose axes are anyone's
        // choice, two cones of one size, an edge on the horizon.
        const auto has = [&](const char* input) { return conformance::column(f, input) >= 0; };
        if (has("l_x") || has("ng_x") || has("a_x")) continue;
        CHECK(disagreements(run<double>(reference, f, signed_zeros), run<double>(reference, f, plain),
                            1e-12) == 0);
        const auto errors = conformance::pointwise_errors(on_host, f, table);
        // The 99th percentile, which is what the registry's numbers bound for samplers; few rows are at a jump.
        const Bounds& bounds = conformance::bounds_of(f, real);
        CHECK(errors.count() > 0);
        CHECK(errors.percentile(99) <= (f.kind == Kind::sampler ? bounds.sampler.front : bounds.error));
    }
}

TEST_CASE("any number of rows is evaluated, whole groups or not, and more than one launch takes") {
    const Function& f = function("vndf_reflect");
    ProgramOptions only;
    only.functions = {f.name};
    DeviceEvaluator on_device(device(), Math::strict, Real::f32, only);
    HostEvaluator on_host(Math::strict, Real::f32);
    for (std::size_t n : {1, 63, 64, 65, 1000, (1 << 22) + 3}) {
        CAPTURE(n);
        const auto in = rows<float>(f, n);
        CHECK(differences(run<float>(on_device, f, in), run<float>(on_host, f, in)) == 0);
    }
}

TEST_CASE("a function that the program leaves out cannot be run") {
    ProgramOptions only;
    only.functions = {"vndf_reflect"};
    DeviceEvaluator evaluator(device(), Math::strict, Real::f32, only);
    const Function& other = function("vndf_refract");
    CHECK_THROWS_WITH(run<float>(evaluator, other, rows<float>(other, 1)),
                      ContainsSubstring("vndf_refract") && ContainsSubstring("CL_INVALID_KERNEL_NAME"));
}

TEST_CASE("a failed build names device, options, file and line") {
    ProgramOptions broken;
    broken.functions = {"vndf_reflect"};
    broken.substitutions = {
        {"kernels/vndf/ggx_walter2007.h", "VNDF_REAL u1 = ", "VNDF_REAL u1 = alpa + ", 7}};
    CHECK_NOTHROW(DeviceEvaluator(device(), Math::strict, Real::f32, broken));
    broken.mutant = 7;
    try {
        DeviceEvaluator(device(), Math::strict, Real::f32, broken);
        FAIL("built");
    } catch (const DeviceError& error) {
        CHECK(error.exit_status() == 3);
        CHECK_THAT(error.what(), ContainsSubstring(device().name));
        CHECK_THAT(error.what(), ContainsSubstring("-DVNDF_REAL=float -DVNDF_MATH=strict"));
        CHECK_THAT(error.what(), ContainsSubstring("CL_BUILD_PROGRAM_FAILURE"));
        const auto& files = embedded_sources();
        const auto file = std::find_if(files.begin(), files.end(), [](const SourceFile& f) {
            return f.path == "kernels/vndf/ggx_walter2007.h";
        });
        const std::string before(file->text.substr(0, file->text.find("VNDF_REAL u1 = ")));
        const std::size_t line = 1 + count(before, "\n");
        CHECK_THAT(error.what(), ContainsSubstring("kernels/vndf/ggx_walter2007.h:" + std::to_string(line)));
    }
}

TEST_CASE("a seeded mistake changes results where it is switched on, and only there") {
    const Function& f = function("vndf_jacobian_reflect");
    const auto in = rows<float>(f, 64);
    ProgramOptions options;
    options.functions = {f.name};
    DeviceEvaluator plain(device(), Math::strict, Real::f32, options);
    options.substitutions = {{"kernels/batch/entry_point.h", "= result member;", "= -result member;", 3}};
    DeviceEvaluator off(device(), Math::strict, Real::f32, options);
    options.mutant = 3;
    DeviceEvaluator on(device(), Math::strict, Real::f32, options);
    auto expected = run<float>(plain, f, in);
    CHECK(differences(run<float>(off, f, in), expected) == 0);
    for (float& x : expected[0]) x = -x;
    CHECK(differences(run<float>(on, f, in), expected) == 0);
    CHECK_THAT(on.program().build_options(), ContainsSubstring("-DVNDF_MUTANT=3"));
}

// --------------------------------------------------------------------------------------------- uniforms

// What the device should make, from Random123 on the host.
template <class R>
std::pair<R, R> philox(std::uint64_t seed, std::uint64_t stream, std::uint64_t index) {
    const auto low = [](std::uint64_t x) { return static_cast<std::uint32_t>(x); };
    const auto high = [](std::uint64_t x) { return static_cast<std::uint32_t>(x >> 32); };
    r123::Philox4x32::ctr_type counter = {{low(index), high(index), low(stream), high(stream)}};
    r123::Philox4x32::key_type key = {{low(seed), high(seed)}};
    const auto bits = r123::Philox4x32()(counter, key);
    const auto uniform = [](std::uint64_t a, std::uint64_t b) {
        return sizeof(R) == 4 ? R(std::ldexp(double(a >> 8), -24))
                              : R(std::ldexp(double((a << 32 | b) >> 11), -53));
    };
    return {uniform(bits[0], bits[1]), uniform(bits[2], bits[3])};
}

TEST_CASE("Philox 4x32-10 gives its published known answer") {
    // Random123, examples/kat_vectors: counter 0, key 0.
    const auto [u1, u2] = philox<float>(0, 0, 0);
    CHECK(u1 == std::ldexp(float(0x6627e8d5u >> 8), -24));
    CHECK(u2 == std::ldexp(float(0xbc57ac4cu >> 8), -24));
}

TEMPLATE_TEST_CASE("uniforms depend on seed, stream and index alone, in the full resolution of the type", "",
                   float, double) {
    if (sizeof(TestType) == 8 && !device().fp64) VNDF_SKIP("the device has no fp64");
    ProgramOptions only;
    only.functions = {"vndf_reflect"};
    DeviceEvaluator evaluator(device(), Math::strict, real_of<TestType>, only);
    const std::uint64_t seed = 0x123456789abcdef0, stream = 0xfedcba9876543210;
    const std::size_t n = (1 << 22) + 100;  // more than one launch
    std::vector<TestType> u1(n), u2(n);
    evaluator.uniforms(seed, stream, n, u1.data(), u2.data());
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < n; i += i < 100 || i > n - 200 ? 1 : 997) {
        wrong += std::pair(u1[i], u2[i]) != philox<TestType>(seed, stream, i);
    }
    CHECK(wrong == 0);
    const int digits = std::numeric_limits<TestType>::digits;
    bool in_range = true, odd = false;
    for (TestType u : u1) {
        in_range &= u >= 0 && u < 1;
        odd |= std::fmod(std::ldexp(u, digits), TestType(2)) == 1;  // the last bit is used
    }
    CHECK(in_range);
    CHECK(odd);
}

}  // namespace
