#include "kernels.h"

#include <map>

#include <fmt/format.h>

#include "runtime/sources.h"

namespace vndf::bench {

bool is_lobe(const std::string& scalar) {
    for (const std::string_view prefix : {"wo_", "l_", "n_", "alpha"})
        if (scalar.starts_with(prefix)) return true;
    return scalar == "eta" || scalar == "cos_theta" || scalar == "one_minus_cos";
}

namespace {

std::string kernel_source(const std::string& name, const Function& function, const std::string& callee,
                          std::size_t groups, bool one_lobe) {
    const std::string result = function.result + (function.with_pdf ? "_PDF" : "");
    std::string parameters, loads;
    for (const std::string& scalar : function.inputs) {
        if (one_lobe && is_lobe(scalar)) {
            parameters += fmt::format("const VNDF_REAL {}, ", scalar);
        } else {
            parameters += fmt::format("__global const VNDF_REAL *restrict in_{}, ", scalar);
            loads += fmt::format("    const VNDF_REAL {0} = in_{0}[i];\n", scalar);
        }
    }
    for (const std::string& scalar : function.outputs)
        parameters += fmt::format("__global VNDF_REAL *restrict out_{}, ", scalar);
    parameters.resize(parameters.size() - 2);
    return fmt::format(
        "\n#line 1 \"{0}\"\n"
        "__kernel void {0}({1}) {{\n"
        "    const size_t i = (get_group_id(0) % {2}) * get_local_size(0) + get_local_id(0);\n"
        "{3}    const VNDF_TYPE_{4} result = {5}(VNDF_CALL_{6});\n"
        "    VNDF_RESULTS_{4}(VNDF_BATCH_STORE)\n"
        "}}\n",
        name, parameters, groups, loads, result, callee, function.arguments);
}

}  // namespace

std::string cached_source(const Function& function, const std::string& callee) {
    return kernel_source("vndf_compute", function, callee, compute_groups, true) +
           kernel_source("vndf_cached", function, callee, cached_groups, false);
}

std::string foreign_source(const Function& function, runtime::Real real) {
    std::string text = fmt::format("#define VNDF_REAL {}\n", to_string(real));
    for (int n = 2; n <= 4; ++n) text += fmt::format("#define VNDF_REAL{0} {1}{0}\n", n, to_string(real));
    text +=
        "#define VNDF_MAKE2(x, y) ((VNDF_REAL2)(x, y))\n"
        "#define VNDF_MAKE3(x, y, z) ((VNDF_REAL3)(x, y, z))\n"
        "#define VNDF_BATCH_STORE(v, member) out_##v[i] = result member;\n";
    for (const runtime::SourceFile& file : runtime::embedded_sources())
        if (file.path == "kernels/batch/shapes.h") text += file.text;
    text += cached_source(function, function.name);
    // By names that are nobody's.
    const std::string ours = "VNDF_", own = "CLVNDF_BENCH_";
    for (std::size_t at = 0; (at = text.find(ours, at)) != text.npos; at += own.size())
        text.replace(at, ours.size(), own);
    return text;
}

std::string to_string(Copy copy) {
    return copy == Copy::scalar ? "scalar" : copy == Copy::vector ? "vector" : "streaming";
}

std::size_t items_per_work_item(Copy copy, runtime::Real real) {
    return copy == Copy::scalar ? 1 : 32 / size_of(real);
}

std::string copy_source(Copy copy, std::size_t reads, std::size_t writes, runtime::Real real) {
    const std::size_t width = items_per_work_item(copy, real);
    const std::string type = fmt::format("{}{}", to_string(real), width == 1 ? "" : std::to_string(width));
    std::string parameters, body;
    for (std::size_t i = 0; i < reads; ++i)
        parameters += fmt::format("__global const {} *restrict in{}, ", type, i);
    for (std::size_t k = 0; k < writes; ++k) {
        parameters += fmt::format("__global {} *restrict out{}, ", type, k);
        std::string sum = fmt::format("in{}[i]", k % reads);
        for (std::size_t i = writes + k; i < reads; i += writes) sum += fmt::format(" + in{}[i]", i);
        body += copy == Copy::streaming ? fmt::format("    VNDF_STREAM(out{}, {});\n", k, sum)
                                        : fmt::format("    out{}[i] = {};\n", k, sum);
    }
    return fmt::format(
        "\n#line 1 \"copy\"\n"
        "#define VNDF_STREAM(array, value) array[i] = value\n"
        "#ifdef __has_builtin\n"
        "#if __has_builtin(__builtin_nontemporal_store)\n"  // past the cache: a write need not read the line first
        "#undef VNDF_STREAM\n"
        "#define VNDF_STREAM(array, value) __builtin_nontemporal_store(value, array + i)\n"
        "#endif\n"
        "#endif\n"
        "__kernel void vndf_copy({}const uint count) {{\n"
        "    const size_t i = get_global_id(0);\n"
        "{}}}\n",
        parameters, body);
}

std::string arithmetic_source() {
    std::string set, step, sum;
    for (int i = 0; i < 8; ++i) {
        set += fmt::format("    float8 a{} = (float8)(0.{}f + x);\n", i, i + 1);
        step += fmt::format(" a{0} = fma(a{0}, m, m);", i);
        sum += fmt::format("{}a{}", i ? " + " : "", i);
    }
    return fmt::format(
        "\n#line 1 \"arithmetic\"\n"
        "__kernel void vndf_arithmetic(__global float *out, const float x) {{\n"
        "{}    const float8 m = (float8)(x);\n"
        "    for (int k = 0; k < 4096; ++k) {{{} }}\n"
        "    const float8 sum = {};\n"
        "    out[get_global_id(0)] = sum.s0 + sum.s1 + sum.s2 + sum.s3 + sum.s4 + sum.s5 + sum.s6 + sum.s7;\n"
        "}}\n",
        set, step, sum);
}

double operations(const Function& function) {
    static const std::map<std::string, double> counts = {
#define VNDF_OPERATIONS(name, count) {#name, count},
#include "operations.def"
#undef VNDF_OPERATIONS
    };
    const auto found = counts.find(function.name);
    return found == counts.end() ? 0 : found->second;
}

}  // namespace vndf::bench
