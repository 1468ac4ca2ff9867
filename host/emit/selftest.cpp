#include "emit/selftest.h"

#include <cmath>
#include <functional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "conformance/inputs/points.h"
#include "error.h"
#include "registry.h"

namespace vndf::emit {
namespace {

using runtime::Real;

constexpr std::size_t rows = 16;

bool is_opencl(const Options& options) {
    return options.language == Language::opencl || options.language == Language::string;
}

std::vector<const Function*> tested(const Options& options) {
    std::vector<const Function*> found;
    for (const std::string& name : options.functions)
        if (const Function* function = find_function(name)) found.push_back(function);
    return found;
}

// Lobes in front and behind, of moderate roughness, where flags that loosen arithmetic change little.
conformance::Table inputs(const Function& function, Real real) {
    std::vector<conformance::Point> points;
    for (std::size_t i = 0; i < rows; ++i) {
        const auto part = [i](double step) { return std::fmod(0.5 + static_cast<double>(i) * step, 1.0); };
        const double z = 0.2 + 0.75 * part(0.6180339887);
        points.push_back(conformance::make_point(
            conformance::direction(i % 4 == 3 ? -z : z, 6.28 * part(0.7548776662)),
            {0.05 + 0.9 * part(0.5698402910), 0.05 + 0.9 * part(0.8191725134)},
            {0.3 + 0.6 * part(0.6710436067), 6.28 * part(0.5497004779)},
            conformance::direction(0.1 + 0.8 * part(0.3819660113), 6.28 * part(0.4142135624)),
            {0.05 + 0.9 * part(0.7320508076), 0.05 + 0.9 * part(0.2360679775)}, 1.5));
    }
    return conformance::tabulate(function, points, real);
}

template <class T>
std::vector<std::vector<double>> answers(const Function& function, const conformance::Table& table,
                                         const Options& options) {
    std::vector<std::vector<T>> in, out(function.outputs.size(), std::vector<T>(rows));
    for (const auto& column : table.columns) in.emplace_back(column.begin(), column.end());
    std::vector<const void*> in_data;
    std::vector<void*> out_data;
    for (const auto& column : in) in_data.push_back(column.data());
    for (auto& column : out) out_data.push_back(column.data());
    const runtime::Math math = options.math == runtime::Math::native ? runtime::Math::strict : options.math;
    runtime::HostEvaluator(math, options.real).run(function, rows, in_data, out_data);
    std::vector<std::vector<double>> columns;
    for (const auto& column : out) columns.emplace_back(column.begin(), column.end());
    return columns;
}

std::string literal(double x, Real real) {
    std::string text = real == Real::f32 ? fmt::format("{:.9g}", x) : fmt::format("{:.17g}", x);
    if (text.find_first_of(".e") == text.npos) text += ".0";
    return real == Real::f32 ? text + 'f' : text;
}

std::string vector(const Options& options, const std::string& members, int size) {
    const std::string real(to_string(options.real));
    if (is_opencl(options)) return fmt::format("({}{})({})", real, size, members);
    const std::string type = fmt::format("vndf_{}{}", real, size);
    return fmt::format("{}{{{}}}", options.language == Language::c ? '(' + type + ')' : type, members);
}

std::string lobe_signature(const Function& function) {
    for (const LobeFunction& lobe : lobe_functions())
        if (lobe.name == function.lobe) return lobe.signature;
    return "";
}

// The call's arguments, out of the row a.
std::string arguments(const Function& function, const Options& options) {
    const auto named = [&](const std::string& name) {
        const std::size_t size = conformance::column(function, name + "_z") >= 0 ? 3
                                 : name == "u" || name == "slope" ||
                                         (name == "alpha" && conformance::column(function, "alpha") < 0)
                                     ? 2
                                     : 1;
        const int first = conformance::column(function, size == 1 ? name : name == "u" ? "u1" : name + "_x");
        std::string members = fmt::format("a[{}]", first);
        for (std::size_t i = 1; i < size; ++i) members += fmt::format(", a[{}]", first + static_cast<int>(i));
        return size == 1 ? members : vector(options, members, static_cast<int>(size));
    };
    const std::function<std::string(std::string)> all = [&](std::string rest) {
        std::string text;
        while (!rest.empty()) {
            const std::string name = rest.substr(0, rest.find(','));
            rest = name.size() == rest.size() ? "" : rest.substr(name.size() + 2);
            if (!text.empty()) text += ", ";
            text += name == "lobe" ? fmt::format("{}({})", function.lobe, all(lobe_signature(function)))
                                   : named(name);
        }
        return text;
    };
    return all(function.signature);
}

std::string table_of(const Function& function, std::size_t index, const Options& options) {
    const conformance::Table table = inputs(function, options.real);
    auto columns = table.columns;
    const auto results = options.real == Real::f32 ? answers<float>(function, table, options)
                                                   : answers<double>(function, table, options);
    columns.insert(columns.end(), results.begin(), results.end());
    const std::string_view words = is_opencl(options)                   ? "constant"
                                   : options.language == Language::cuda ? "static __constant__ const"
                                                                        : "static const volatile";
    std::string text = fmt::format("// {}; results\n{} {} vndf_selftest_{}[] = {{\n",
                                   fmt::join(function.inputs, ", "), words, to_string(options.real), index);
    for (std::size_t row = 0; row < rows; ++row) {
        std::string line = "   ";
        for (const auto& column : columns) {
            const std::string number = literal(column[row], options.real);
            if (line.size() + number.size() + 2 > 110) {
                text += line + '\n';
                line = "       ";
            }
            line += ' ' + number + ',';
        }
        text += line + '\n';
    }
    return text + "};\n";
}

std::string comparisons(const Function& function, const std::string& judge) {
    static const std::string members = "xyzw";
    std::string text;
    for (std::size_t i = 0; i < function.outputs.size(); ++i) {
        const std::string result = function.outputs.size() == 1 ? "r" : std::string("r.") + members[i];
        text +=
            fmt::format("{}{}({}, a[{}])", i == 0 ? "" : " + ", judge, result, function.inputs.size() + i);
    }
    return text;
}

std::string loop(const Function& function, std::size_t index, const Options& options) {
    const std::size_t outputs = function.outputs.size();
    std::string type(to_string(options.real));
    if (outputs > 1) type = fmt::format("{}{}{}", is_opencl(options) ? "" : "vndf_", type, outputs);
    const std::string_view words = is_opencl(options)                   ? "constant "
                                   : options.language == Language::cuda ? "const "
                                                                        : "const volatile ";
    return fmt::format(
        "    for (i = 0; i < {}; ++i) {{\n        {}{}* a = vndf_selftest_{} + {} * i;\n        {} r = "
        "{}({});\n"
        "        bits += {};\n        off += {};\n    }}\n",
        rows, words, to_string(options.real), index, function.inputs.size() + outputs, type, function.name,
        arguments(function, options), comparisons(function, "vndf_selftest_bits"),
        comparisons(function, "vndf_selftest_off"));
}

}  // namespace

std::set<std::string> selftest_needs(const Options& options) {
    std::set<std::string> names;
    if (!is_opencl(options)) names.insert("vndf_impl_as_int");
    for (const Function* function : tested(options))
        if (!function->lobe.empty()) names.insert(function->lobe);
    return names;
}

std::string selftest(const Options& options) {
    const std::vector<const Function*> functions = tested(options);
    if (functions.empty())
        throw InputError(fmt::format("--selftest: {} returns no numbers: name a function that does",
                                     fmt::join(options.functions, ", ")));
    const bool single = options.real == Real::f32;
    const std::string_view real = to_string(options.real);
    const std::string as_int = is_opencl(options) ? (single ? "as_int" : "as_long") : "vndf_impl_as_int";
    std::string text =
        "// Known answers. vndf_selftest, by one work-item, counts results with other bits in wrong[0], "
        "which flags that change\n"
        "// arithmetic allow, and in wrong[1] those that are not finite or off by more than 1e-3 max(1, "
        "|result|).\n";
    text += fmt::format("VNDF_FN int vndf_selftest_bits({0} a, {0} b) {{\n    return {1}(a) != {1}(b);\n}}\n",
                        real, as_int);
    text += fmt::format(
        "VNDF_FN int vndf_selftest_off({0} a, {0} b) {{\n    {0} size = b < 0 ? -b : b, error = a < b ? b - "
        "a : a - b;\n"
        "    return ({1}(a) & {2}) == {2} || error > {3} * (size > 1 ? size : 1);\n}}\n",
        real, as_int, single ? "0x7f800000" : "0x7ff0000000000000", single ? "1e-3f" : "1e-3");
    for (std::size_t i = 0; i < functions.size(); ++i) text += table_of(*functions[i], i, options);
    text += is_opencl(options)                   ? "kernel void vndf_selftest(global int* wrong)"
            : options.language == Language::cuda ? "extern \"C\" __global__ void vndf_selftest(int* wrong)"
                                                 : "VNDF_FN void vndf_selftest(int* wrong)";
    text += " {\n    int i, bits = 0, off = 0;\n";
    for (std::size_t i = 0; i < functions.size(); ++i) text += loop(*functions[i], i, options);
    return text + "    wrong[0] = bits;\n    wrong[1] = off;\n}\n";
}

}  // namespace vndf::emit
