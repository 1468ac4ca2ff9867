#include "conformance/runs/fast_math.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <bit>
#include <chrono>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "conformance/inputs/grids.h"

namespace vndf::conformance {
namespace {

using Columns = std::vector<std::vector<double>>;

// By its bits: a comparison may be folded by whoever compiles with fast math.
bool finite(double x) {
    constexpr std::uint64_t exponent = 0x7ff0000000000000;
    return (std::bit_cast<std::uint64_t>(x) & exponent) != exponent;
}
bool finite(const Columns& results, std::size_t row) {
    return std::all_of(results.begin(), results.end(),
                       [&](const auto& column) { return finite(column[row]); });
}

bool is_direction(const Function& function) {
    return function.result == "WM" || function.result == "WI";
}

double length_of(const Columns& results, std::size_t row) {
    return std::hypot(results[0][row], results[1][row], results[2][row]);
}
double distance(const Columns& a, const Columns& b, std::size_t row) {
    return std::hypot(a[0][row] - b[0][row], a[1][row] - b[1][row], a[2][row] - b[2][row]);
}
double relative_error(double value, double strict) {
    if (value == strict) return 0;
    return std::abs(value - strict) / std::max(std::abs(value), std::abs(strict));
}

void count_non_finite(FastMathFigures& figures, const Table& table, const Columns& strict,
                      const Columns& fast) {
    for (std::size_t i = 0; i < table.rows(); ++i) {
        if (!finite(strict, i) || finite(fast, i)) continue;
        if (figures.non_finite++ == 0) figures.worst_non_finite = hex_row(*figures.function, table.row(i));
    }
}

}  // namespace

std::vector<std::string> FastMathFigures::broken() const {
    std::vector<std::string> names;
    if (non_finite != 0) names.push_back("finite");
    if (!(unit <= fast_math_limits.unit)) names.push_back("unit");
    if (!(value.max() <= fast_math_limits.value)) names.push_back("value");
    if (!(direction.percentile(99.9) <= fast_math_limits.direction &&
          direction.max() <= fast_math_limits.direction_max))
        names.push_back("direction");
    return names;
}

bool FastMathReport::Entry::passed() const {
    return !functions.empty() &&
           std::all_of(functions.begin(), functions.end(), [](const auto& f) { return f.broken().empty(); });
}

bool FastMathReport::passed() const {
    return !entries.empty() &&
           std::all_of(entries.begin(), entries.end(), [](const Entry& entry) { return entry.passed(); });
}

FastMathRows fast_math_rows(runtime::Evaluator& strict, const Function& function,
                            const CheckOptions& options) {
    PointwiseOptions everywhere;
    everywhere.seed = options.seed;
    everywhere.random_points = std::size_t{1} << (options.quick ? 12 : 15);
    everywhere.hard_stride = options.quick ? 7 : 1;
    FastMathRows rows;
    rows.function = &function;
    const std::size_t inside = std::size_t{1} << (options.quick ? 14 : 17);
    rows.inside = tabulate(function, renderer_points(function, inside, options.seed), Real::f32);
    rows.everywhere = pointwise_table(function, Real::f32, everywhere);
    rows.strict_inside = evaluate(strict, function, rows.inside);
    rows.strict_everywhere = evaluate(strict, function, rows.everywhere);
    return rows;
}

FastMathFigures fast_math_figures(runtime::Evaluator& fast, const FastMathRows& rows) {
    const Function& function = *rows.function;
    FastMathFigures figures;
    figures.function = &function;
    figures.inside = rows.inside.rows();
    figures.everywhere = rows.everywhere.rows();
    const Columns inside = evaluate(fast, function, rows.inside);
    count_non_finite(figures, rows.inside, rows.strict_inside, inside);
    count_non_finite(figures, rows.everywhere, rows.strict_everywhere,
                     evaluate(fast, function, rows.everywhere));
    const std::size_t directions = is_direction(function) ? 3 : 0;
    for (std::size_t i = 0; i < rows.inside.rows(); ++i) {
        if (!finite(inside, i)) continue;
        if (directions != 0) figures.direction.add(distance(inside, rows.strict_inside, i), i);
        const double length = function.kind == Kind::sampler ? length_of(inside, i) : 1;
        if (length > 0 || !may_miss(function))
            figures.unit = std::max(figures.unit, std::abs(length - 1) / epsilon(Real::f32));
        for (std::size_t c = directions; c < inside.size(); ++c)
            figures.value.add(relative_error(inside[c][i], rows.strict_inside[c][i]), i);
    }
    if (figures.value.count() != 0)
        figures.worst_value = hex_row(function, rows.inside.row(figures.value.worst_row()));
    if (figures.direction.count() != 0)
        figures.worst_direction = hex_row(function, rows.inside.row(figures.direction.worst_row()));
    return figures;
}

FastMathReport measure_fast_math(const runtime::Device& device, const std::vector<runtime::FlagSet>& sets,
                                 const std::vector<const Function*>& selected, const CheckOptions& options) {
    const auto start = std::chrono::steady_clock::now();
    FastMathReport report;
    report.device = device.label();
    report.seed = options.seed;
    report.quick = options.quick;
    runtime::ProgramOptions program;
    program.functions = needed(selected);
    options.progress("building strict", 0);
    runtime::DeviceEvaluator strict(device, Math::strict, Real::f32, program);
    std::vector<FastMathRows> rows;
    for (const Function* function : selected) rows.push_back(fast_math_rows(strict, *function, options));
    program.correct_divide_sqrt = false;
    const double steps = static_cast<double>(sets.size() * selected.size());
    std::size_t step = 0;
    for (const runtime::FlagSet& set : sets) {
        program.build_options = set.flags;
        runtime::DeviceEvaluator fast(device, Math::strict, Real::f32, program);
        FastMathReport::Entry entry{set.name, fast.program().build_options(), {}};
        for (const FastMathRows& r : rows) {
            options.progress(r.function->name + ", " + set.name, static_cast<double>(step++) / steps);
            entry.functions.push_back(fast_math_figures(fast, r));
        }
        report.entries.push_back(std::move(entry));
    }
    options.progress("", 1);
    report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return report;
}

std::string format_table(const FastMathReport& report) {
    std::size_t width = 8;
    for (const auto& entry : report.entries)
        for (const FastMathFigures& f : entry.functions) width = std::max(width, f.function->name.size());
    std::string text;
    for (const auto& entry : report.entries) {
        text += fmt::format("{}\n{:{}}  {:>10} {:>8}  {:>8} {:>8}  {:>8} {:>8}\n", entry.name, "function",
                            width, "non-finite", "unit", "value", "max", "angle", "max");
        for (const FastMathFigures& f : entry.functions) {
            const std::vector<std::string> broken = f.broken();
            text += fmt::format("{:{}}  {:10} {:8.3g}  {:8.2g} {:8.2g}  {:8.2g} {:8.2g}{}{}\n",
                                f.function->name, width, f.non_finite, f.unit, f.value.percentile(99.9),
                                f.value.max(), f.direction.percentile(99.9), f.direction.max(),
                                broken.empty() ? "" : "  BREAKS ", fmt::join(broken, ", "));
        }
        text += fmt::format("{}\n\n", entry.passed() ? "keeps the promise" : "BREAKS the promise");
    }
    return text + fmt::format(
                      "Against strict at equal arguments, on {}, seed {}, {:.0f} s. value, angle: the 99.9th "
                      "percentile\nand the largest; unit in 2^-24.\n",
                      report.device, report.seed, report.seconds);
}

std::string format_json(const FastMathReport& report) {
    using Json = nlohmann::ordered_json;
    Json all = Json::array();
    for (const auto& entry : report.entries) {
        Json functions = Json::array();
        for (const FastMathFigures& f : entry.functions)
            functions.push_back({{"name", f.function->name},
                                 {"rows", f.inside + f.everywhere},
                                 {"non_finite", f.non_finite},
                                 {"unit", f.unit},
                                 {"value_p999", f.value.percentile(99.9)},
                                 {"value_max", f.value.max()},
                                 {"direction_p999", f.direction.percentile(99.9)},
                                 {"direction_max", f.direction.max()},
                                 {"broken", f.broken()},
                                 {"worst_non_finite", f.worst_non_finite},
                                 {"worst_value", f.worst_value},
                                 {"worst_direction", f.worst_direction}});
        all.push_back({{"name", entry.name},
                       {"build_options", entry.options},
                       {"passed", entry.passed()},
                       {"functions", std::move(functions)}});
    }
    const Json document{{"passed", report.passed()}, {"device", report.device},   {"seed", report.seed},
                        {"quick", report.quick},     {"seconds", report.seconds}, {"builds", std::move(all)}};
    return document.dump(2) + "\n";
}

}  // namespace vndf::conformance
