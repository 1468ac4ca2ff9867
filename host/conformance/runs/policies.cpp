#include "conformance/runs/policies.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <bit>
#include <chrono>
#include <cmath>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "conformance/judge/pointwise.h"

namespace vndf::conformance {
namespace {

using Columns = std::vector<std::vector<double>>;

// By its bits: a comparison may be folded by whoever compiles with fast math.
bool non_finite(double x) {
    constexpr std::uint64_t exponent = 0x7ff0000000000000;
    return (std::bit_cast<std::uint64_t>(x) & exponent) == exponent;
}

// Any NaN is the same as any other.
bool same_bits(double a, double b) {
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b) ||
           (std::isnan(a) && std::isnan(b));
}

template <class Predicate>
std::size_t count_rows(std::size_t rows, std::size_t columns, Predicate predicate) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < rows; ++i) {
        bool any = false;
        for (std::size_t c = 0; c < columns; ++c) any = any || predicate(c, i);
        count += any;
    }
    return count;
}

// The part of the inputs whose errors a finding tells; empty for findings about anything else.
std::string accuracy_of(const Finding& finding) {
    static const std::map<std::string, std::string> names{{"pointwise, front, p99", "front"},
                                                          {"pointwise, back, p99", "back"},
                                                          {"pointwise, maximum", "value"},
                                                          {"density of the exact sample, p99", "density"}};
    const auto found = names.find(finding.check);
    return found == names.end() ? "" : found->second;
}

}  // namespace

std::string Build::name() const {
    return fmt::format("{}{}{}", to_string(math), flag.empty() ? "" : " ", flag);
}

std::vector<Build> builds(Real real) {
    std::vector<Build> all{{Math::strict, ""}, {Math::builtin, ""}};
    if (real == Real::f32) all.push_back({Math::native, ""});
    for (const char* flag : {"-cl-mad-enable", "-cl-fast-relaxed-math", "-cl-denorms-are-zero"})
        all.push_back({Math::strict, flag});
    return all;
}

std::vector<std::string> Behaviour::broken(const Build& build) const {
    std::vector<std::string> names;
    for (const Finding& finding : findings)
        if (!finding.passed()) names.push_back(finding.check);
    if (non_finite != 0 && std::find(names.begin(), names.end(), "finite") == names.end())
        names.push_back("finite");
    if (build.math == Math::strict && different != 0) names.push_back("same bits");
    return names;
}

bool PolicyReport::passed() const {
    for (const Entry& entry : entries)
        for (const Behaviour& behaviour : entry.functions)
            if (entry.build.promised() && !behaviour.broken(entry.build).empty()) return false;
    return !entries.empty() && !entries.front().functions.empty();
}

Behaviour behaviour_of(runtime::Evaluator& evaluator, const Function& function,
                       const PointwiseOptions& options, Columns& strict) {
    const Table table = pointwise_table(function, evaluator.input_real(), options);
    const Columns results = evaluate(evaluator, function, table);
    if (strict.empty()) strict = results;
    Behaviour behaviour{&function, check_pointwise(evaluator, function, options), table.rows()};
    behaviour.non_finite = count_rows(table.rows(), results.size(), [&](std::size_t c, std::size_t i) {
        return non_finite(results[c][i]);
    });
    behaviour.different = count_rows(table.rows(), results.size(), [&](std::size_t c, std::size_t i) {
        return !same_bits(results[c][i], strict[c][i]);
    });
    return behaviour;
}

PolicyReport measure_policies(const runtime::Device& device, Real real,
                              const std::vector<const Function*>& selected, const CheckOptions& options) {
    const auto start = std::chrono::steady_clock::now();
    PolicyReport report;
    report.device = device.label();
    report.real = to_string(real);
    report.seed = options.seed;
    report.quick = options.quick;
    std::vector<std::unique_ptr<runtime::DeviceEvaluator>> evaluators;
    for (const Build& build : builds(real)) {
        options.progress("building " + build.name(), 0);
        runtime::ProgramOptions program;
        program.functions = needed(selected);
        program.build_options = build.flag;
        evaluators.push_back(std::make_unique<runtime::DeviceEvaluator>(device, build.math, real, program));
        report.entries.push_back({build, evaluators.back()->program().build_options(), {}});
    }
    PointwiseOptions pointwise;
    pointwise.seed = options.seed;
    pointwise.random_points = std::size_t{1} << (options.quick ? 12 : 14);
    pointwise.hard_stride = options.quick ? 29 : 3;
    pointwise.guard_stride = options.quick ? 29 : 1;
    pointwise.quick = options.quick;
    const double steps = static_cast<double>(selected.size() * evaluators.size());
    std::size_t step = 0;
    for (const Function* function : selected) {
        Columns strict;
        for (std::size_t b = 0; b < evaluators.size(); ++b) {
            PolicyReport::Entry& entry = report.entries[b];
            options.progress(function->name + ", " + entry.build.name(), static_cast<double>(step++) / steps);
            pointwise.math = entry.build.math;
            entry.functions.push_back(behaviour_of(*evaluators[b], *function, pointwise, strict));
        }
    }
    options.progress("", 1);
    report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return report;
}

std::string format_table(const PolicyReport& report) {
    if (report.entries.empty()) return {};
    std::size_t width = 8, build_width = 5;
    for (const Behaviour& f : report.entries.front().functions)
        width = std::max(width, f.function->name.size());
    for (const auto& entry : report.entries) build_width = std::max(build_width, entry.build.name().size());
    std::string text = fmt::format("{:{}}  {:7}  {:{}}  {:>8} {:>8} {:>8} {:>6}  {:>10} {:>10}  {}\n",
                                   "function", width, "where", "build", build_width, "p50", "p99", "max",
                                   "limit", "non-finite", "other bits", "of");
    for (std::size_t i = 0; i < report.entries.front().functions.size(); ++i)
        for (std::size_t k = 0; k < report.entries.front().functions[i].findings.size(); ++k)
            for (const auto& entry : report.entries) {
                const Behaviour& f = entry.functions[i];
                const Finding& finding = f.findings.at(k);
                const std::string where = accuracy_of(finding);
                if (where.empty()) continue;
                text +=
                    fmt::format("{:{}}  {:7}  {:{}}  {:8.3g} {:8.3g} {:8.3g} {:6.3g}  {:10} {:10}  {}\n",
                                f.function->name, width, where, entry.build.name(), build_width, finding.p50,
                                finding.p99, finding.max, finding.limit, f.non_finite, f.different, f.rows);
            }
    text += fmt::format(
        "\nErrors in 2^-{} of what each function is judged by (--json names it); limit: of the "
        "p99, "
        "for values of the\nmaximum. other bits: rows that differ from strict without flags.\n\n",
        report.real == "float" ? 24 : 53);
    for (const auto& entry : report.entries) {
        std::map<std::string, std::vector<std::string>> broken;
        for (const Behaviour& f : entry.functions)
            for (const std::string& claim : f.broken(entry.build)) broken[claim].push_back(f.function->name);
        if (broken.empty()) {
            text += fmt::format("{} keeps every promise{}\n", entry.build.name(),
                                entry.build.promised() ? "" : " here, without being held to it");
            continue;
        }
        text += fmt::format("{} {}:\n", entry.build.name(),
                            entry.build.promised() ? "BREAKS its promises" : "breaks");
        for (const auto& [claim, names] : broken) {
            constexpr std::size_t listed = 12;
            text += fmt::format("  {}: {}\n", claim,
                                names.size() <= listed ? fmt::format("{}", fmt::join(names, ", "))
                                                       : fmt::format("{} of {} functions", names.size(),
                                                                     entry.functions.size()));
        }
    }
    return text + fmt::format("\n{} on {}, seed {}, {:.0f} s\n", report.real, report.device, report.seed,
                              report.seconds);
}

std::string format_json(const PolicyReport& report) {
    using Json = nlohmann::ordered_json;
    Json all = Json::array();
    for (const auto& entry : report.entries) {
        Json functions = Json::array();
        for (const Behaviour& f : entry.functions) {
            Json findings = Json::array();
            for (const Finding& finding : f.findings)
                findings.push_back({{"check", finding.check},
                                    {"passed", finding.passed()},
                                    {"p50", finding.p50},
                                    {"p99", finding.p99},
                                    {"max", finding.max},
                                    {"figure", finding.figure},
                                    {"limit", finding.limit},
                                    {"unit", finding.unit},
                                    {"count", finding.count},
                                    {"worst_input", finding.worst}});
            functions.push_back({{"name", f.function->name},
                                 {"rows", f.rows},
                                 {"non_finite", f.non_finite},
                                 {"other_bits", f.different},
                                 {"broken", f.broken(entry.build)},
                                 {"findings", std::move(findings)}});
        }
        all.push_back({{"name", entry.build.name()},
                       {"math", std::string(to_string(entry.build.math))},
                       {"flag", entry.build.flag},
                       {"build_options", entry.options},
                       {"promised", entry.build.promised()},
                       {"functions", std::move(functions)}});
    }
    const Json document{{"passed", report.passed()}, {"device", report.device}, {"real", report.real},
                        {"seed", report.seed},       {"quick", report.quick},   {"seconds", report.seconds},
                        {"builds", std::move(all)}};
    return document.dump(2) + "\n";
}

}  // namespace vndf::conformance
