#include "accuracy.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include <fmt/format.h>

#include "conformance/inputs/rows.h"
#include "conformance/judge/known_bias.h"
#include "conformance/judge/pointwise.h"
#include "conformance/judge/samplers.h"

namespace vndf::bench {
namespace {

using conformance::Direction, conformance::Point, conformance::Table;

struct Rows {
    std::vector<Point> points;
    Table table;
    conformance::ExactMap exact;  // of samplers
};

// Inputs, and what is exact for them: the same for every form of a function, and slow to compute.
const Rows& rows_of(const Function& function, runtime::Real real, std::size_t count, Side side,
                    AlphaRange alpha) {
    static std::map<std::string, Rows> known;
    const std::string key = fmt::format("{} {} {} {} {} {}", function.name, to_string(real), count,
                                        static_cast<int>(side), alpha.low, alpha.high);
    const std::string function_key = function.name + ' ';
    // Functions come one after the other: what belongs to earlier ones is not needed again.
    std::erase_if(known, [&](const auto& entry) { return !entry.first.starts_with(function_key); });
    auto [found, missing] = known.try_emplace(key);
    Rows& rows = found->second;
    if (!missing) return rows;
    rows.points = points(count, in_world_space(function), side, alpha);
    rows.table = conformance::tabulate(function, rows.points, real);
    if (function.kind == Kind::sampler) rows.exact = conformance::exact_map(function, rows.table, real);
    return rows;
}

// Normals below the horizon, of reflections half vectors, by more than the rounding of a unit vector.
bool is_below(const Function& function, const Point& point, const Direction& d) {
    const double height = conformance::dot(d, point.n);
    return (function.result == "WI" ? height + conformance::dot(point.wo, point.n) : height) < -0x1p-22;
}

void count_bad(const Function& function, const Rows& rows, const std::vector<std::vector<double>>& results,
               std::map<std::string, double>& figures) {
    for (std::size_t i = 0; i < rows.points.size(); ++i) {
        bool finite = true;
        for (const auto& column : results) finite = finite && std::isfinite(column[i]);
        figures["nonfinite"] += !finite;
        if (function.kind == Kind::sampler && finite)
            figures["below"] +=
                is_below(function, rows.points[i], {results[0][i], results[1][i], results[2][i]});
    }
}

// The part of a sampler's directions that are reflections above the surface.
double useful_part(const Function& function, const Rows& rows,
                   const std::vector<std::vector<double>>& results) {
    std::size_t useful = 0;
    for (std::size_t i = 0; i < rows.points.size(); ++i) {
        const Direction d{results[0][i], results[1][i], results[2][i]};
        const Point& point = rows.points[i];
        const double cosine = conformance::dot(point.wo, d), height = conformance::dot(d, point.n);
        useful += function.result == "WI"
                      ? height > 0
                      : cosine > 0 && 2 * cosine * height > conformance::dot(point.wo, point.n);
    }
    return static_cast<double>(useful) / static_cast<double>(rows.points.size());
}

void add_errors(const std::string& prefix, const conformance::Errors& errors, runtime::Real real,
                std::map<std::string, double>& figures) {
    // JSON has no infinity: half a turn is the largest angle.
    const double most = std::numbers::pi / conformance::epsilon(real);
    figures[prefix + "_p50"] = std::min(errors.percentile(50), most);
    figures[prefix + "_p99"] = std::min(errors.percentile(99), most);
    figures[prefix + "_p9999"] = std::min(errors.percentile(99.99), most);
    figures[prefix + "_max"] = std::min(errors.max(), most);
}

}  // namespace

bool in_world_space(const Function& function) {
    return conformance::column(function, "n_x") >= 0;
}

bool has_back(const Function& function) {
    return is_plain_sampler(function) && function.domain == Domain::sphere &&
           conformance::column(function, "wo_x") >= 0;
}

Accuracy accuracy(runtime::Evaluator& evaluator, const Function& function, std::size_t rows, AlphaRange alpha,
                  bool same_map) {
    Accuracy known;
    auto& figures = known.figures = {{"nonfinite", 0}};
    if (function.kind == Kind::sampler) figures["below"] = 0;
    for (const Side side : {Side::front, Side::back}) {
        if (side == Side::back && !has_back(function)) continue;
        const Rows& judged = rows_of(function, evaluator.input_real(), rows, side, alpha);
        const auto results = conformance::evaluate(evaluator, function, judged.table);
        count_bad(function, judged, results, figures);
        if (side == Side::front && function.kind == Kind::sampler)
            known.useful = useful_part(function, judged, results);
        if (!same_map) continue;
        const std::string of = side == Side::front ? "" : "_back";
        if (function.kind != Kind::sampler) {
            add_errors("err", conformance::pointwise_errors(evaluator, function, judged.table),
                       evaluator.input_real(), figures);
            continue;
        }
        const conformance::SamplerErrors errors =
            conformance::sampler_errors(judged.exact, results, evaluator.input_real());
        add_errors("err" + of, errors.over_condition, evaluator.input_real(), figures);
        add_errors("angle" + of, errors.angle, evaluator.input_real(), figures);
    }
    if (!same_map) return known;
    // An approximate sampler is judged against its own map above: here its distribution against the exact one.
    for (const conformance::Finding& finding : conformance::measure_bias(evaluator, function))
        if (finding.check.find("CDF error") != std::string::npos)
            figures["bias"] = std::max(figures["bias"], finding.figure);
    return known;
}

}  // namespace vndf::bench
