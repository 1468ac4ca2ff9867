#include "conformance/report/report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "conformance/report/markup.h"
#include "text.h"

namespace vndf::conformance {

Verdict FunctionReport::verdict() const {
    const auto any = [&](auto predicate) { return std::any_of(findings.begin(), findings.end(), predicate); };
    // No finding is no evidence.
    const auto failed = [&](Concern concern) {
        return any([=](const Finding& f) { return f.concern == concern && !f.passed(); });
    };
    if (findings.empty() || failed(Concern::wrong)) return Verdict::fail;
    if (failed(Concern::inexact)) return Verdict::inexact;
    return any([](const Finding& f) { return f.biased; }) ? Verdict::known_bias : Verdict::pass;
}

const Finding* FunctionReport::worst() const {
    // Mistakes before lost precision, and what was measured outside of the domain last of all.
    const auto key = [](const Finding& f) {
        const int concern = f.passed() ? 3 : static_cast<int>(f.concern);
        return std::tuple(f.concern != Concern::outside, -concern, f.biased ? 1e9 : f.severity());
    };
    const auto found = std::max_element(findings.begin(), findings.end(),
                                        [&](const Finding& a, const Finding& b) { return key(a) < key(b); });
    return found == findings.end() ? nullptr : &*found;
}

bool Report::passed() const {
    return !functions.empty() && std::all_of(functions.begin(), functions.end(), [](const auto& function) {
        return function.verdict() != Verdict::fail;
    });
}

std::string to_string(Verdict verdict) {
    switch (verdict) {
        case Verdict::pass:
            return "pass";
        case Verdict::fail:
            return "FAIL";
        case Verdict::known_bias:
            return "known bias";
        case Verdict::inexact:
            return "inexact";
    }
    return {};
}

namespace {

std::string figure_text(const Finding& f) {
    const char* const relation = f.biased ? "documented:" : f.is_p ? "at least" : "at most";
    return fmt::format("{} {:.3g} ({} {:.4g}{}{})", f.check, f.figure, relation, f.limit,
                       f.unit.empty() ? "" : " ", f.unit);
}

std::string headline(const Finding& finding) {
    if (finding.passed()) return "known bias";
    return finding.concern == Concern::wrong ? "FAILED" : to_string(finding.concern);
}

std::string values(const Function& function, const std::vector<double>& numbers, bool in_float) {
    std::string out;
    for (std::size_t k = 0; k < numbers.size(); ++k)
        out += (k ? ", " : "") + function.outputs[k] + "=" +
               (in_float ? fmt::format("{}", static_cast<float>(numbers[k])) : fmt::format("{}", numbers[k]));
    return out;
}

std::string eval_command(const Function& function, const std::vector<double>& row,
                         const CommandOf& evaluate) {
    std::vector<std::string> cells;
    for (const double x : row) cells.push_back(hex_number(x));
    return fmt::format("printf '%s\\n' {} {} | {}", fmt::join(function.inputs, ","), fmt::join(cells, ","),
                       evaluate(function));
}

}  // namespace

std::vector<Repetition> repetitions(const Function& function, const Finding& finding, const std::string& real,
                                    const CommandOf& evaluate) {
    if (finding.result.empty() || finding.figure == 0) return {};
    std::vector<Repetition> all;
    const auto add = [&](const Function& f, const std::vector<double>& row,
                         const std::vector<double>& result) {
        all.push_back({eval_command(f, row, evaluate), values(f, result, real == "float")});
    };
    add(function, finding.row, finding.result);
    if (!finding.exact.empty()) all.back().gives += "; exact " + values(function, finding.exact, false);
    for (const Finding::Value& value : finding.beside) add(*value.function, value.row, value.result);
    return all;
}

std::string format_table(const Report& report, const CommandOf& evaluate) {
    std::size_t width = 8, figure_width = 12;
    for (const FunctionReport& f : report.functions) {
        width = std::max(width, f.function->name.size());
        if (const Finding* worst = f.worst())
            figure_width = std::max(figure_width, figure_text(*worst).size());
    }
    std::string text = fmt::format("{:<{}}  {:<10}  {:<{}}  {}\n", "function", width, "verdict",
                                   "worst figure", figure_width, "at");
    for (const FunctionReport& f : report.functions) {
        const Finding* worst = f.worst();
        text += fmt::format("{:<{}}  {:<10}  {:<{}}  {}\n", f.function->name, width, to_string(f.verdict()),
                            worst ? figure_text(*worst) : "nothing checked", figure_width,
                            worst ? worst->worst : "");
    }
    for (const FunctionReport& f : report.functions) {
        const Finding* before = nullptr;
        for (const Finding& finding : f.findings) {
            if (finding.passed() && !finding.biased) continue;
            text += fmt::format("\n{} {}: {}{}{}\n  at {}\n", headline(finding), f.function->name,
                                figure_text(finding), finding.detail.empty() ? "" : "; ", finding.detail,
                                finding.worst);
            // Percentiles of the same errors have the same worst input: once is enough.
            const bool again = before && before->row == finding.row;
            before = &finding;
            if (!evaluate || finding.passed() || again) continue;
            for (const Repetition& r : repetitions(*f.function, finding, report.real, evaluate))
                text += fmt::format("  again: {}\n  gives {}\n", r.command, r.gives);
        }
    }
    for (const FunctionReport& f : report.functions) {
        if (!f.diagnosis.empty()) text += fmt::format("\n{}: {}\n", f.function->name, f.diagnosis);
        if (!f.not_judged.empty())
            text += fmt::format("\n{}: not judged: {}\n", f.function->name, f.not_judged);
    }
    const auto count = [&](Verdict verdict) {
        return std::count_if(report.functions.begin(), report.functions.end(),
                             [&](const FunctionReport& f) { return f.verdict() == verdict; });
    };
    text += fmt::format("\n{} on {}\n  {}\n", report.math + " " + report.real, report.device, report.options);
    text += fmt::format(
        "{} functions: {} pass, {} known bias{}, {} fail; {:.0f} s, seed {}\n"
        "{} statistical tests, {} samples a lobe; false alarms in the whole run below {:g} (Sidak: {:.3g} a "
        "test)\n",
        report.functions.size(), count(Verdict::pass), count(Verdict::known_bias),
        count(Verdict::inexact) ? fmt::format(", {} inexact", count(Verdict::inexact)) : "",
        count(Verdict::fail), report.seconds, report.seed, report.tests, report.samples, report.family_rate,
        report.level);
    if (report.bit_rows > 0) text += format_differences(report.bits, report.bit_rows);
    return text;
}

std::string format_json(const Report& report) {
    nlohmann::ordered_json functions = nlohmann::ordered_json::array();
    for (const FunctionReport& f : report.functions) {
        nlohmann::ordered_json findings = nlohmann::ordered_json::array();
        for (const Finding& finding : f.findings)
            findings.push_back({{"check", finding.check},
                                {"passed", finding.passed()},
                                {"known_bias", finding.biased},
                                {"concern", to_string(finding.concern)},
                                {"figure", finding.figure},
                                {"limit", finding.limit},
                                {"limit_is", finding.is_p ? "minimum" : "maximum"},
                                {"unit", finding.unit},
                                {"count", finding.count},
                                {"detail", finding.detail},
                                {"worst_input", finding.worst}});
        functions.push_back({{"name", f.function->name},
                             {"kind", std::string(to_string(f.function->kind))},
                             {"verdict", to_string(f.verdict())},
                             {"diagnosis", f.diagnosis},
                             {"not_judged", f.not_judged},
                             {"findings", std::move(findings)}});
    }
    nlohmann::ordered_json bits = nlohmann::ordered_json::array();
    for (const BitDifference& d : report.bits)
        if (d.differing > 0 || d.exempt > 0)
            bits.push_back({{"name", d.function->name},
                            {"differing", d.differing},
                            {"exempt", d.exempt},
                            {"ulps", d.ulps},
                            {"worst_input", d.worst}});
    const nlohmann::ordered_json document{{"passed", report.passed()},
                                          {"device", report.device},
                                          {"build_options", report.options},
                                          {"math", report.math},
                                          {"real", report.real},
                                          {"seed", report.seed},
                                          {"quick", report.quick},
                                          {"samples_per_lobe", report.samples},
                                          {"statistical_tests", report.tests},
                                          {"family_false_alarm_rate", report.family_rate},
                                          {"level_per_test", report.level},
                                          {"seconds", report.seconds},
                                          {"bits_compared_with_host_build", report.bit_rows},
                                          {"bits_different_or_exempt", std::move(bits)},
                                          {"functions", std::move(functions)}};
    return document.dump(2) + "\n";
}

std::string format_junit(const Report& report) {
    std::size_t tests = 0, failures = 0;
    std::string cases;
    for (const FunctionReport& f : report.functions)
        for (const Finding& finding : f.findings) {
            ++tests;
            cases += fmt::format("    <testcase classname=\"{}\" name=\"{}\">", escaped(f.function->name),
                                 escaped(finding.check));
            const std::string text =
                escaped(figure_text(finding) + "\n" + finding.detail + "\n" + finding.worst);
            if (finding.passed() || finding.concern != Concern::wrong) {
                const std::string word = finding.passed() ? "" : to_string(finding.concern) + ": ";
                cases += fmt::format("<system-out>{}{}</system-out>", finding.biased ? "known bias: " : word,
                                     text);
            } else {
                ++failures;
                cases +=
                    fmt::format("<failure message=\"{}\">{}</failure>", escaped(figure_text(finding)), text);
            }
            cases += "</testcase>\n";
        }
    return fmt::format(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
        "<testsuites name=\"clvndf check\" tests=\"{0}\" failures=\"{1}\" time=\"{2:.3f}\">\n"
        "  <testsuite name=\"{3}\" tests=\"{0}\" failures=\"{1}\" time=\"{2:.3f}\">\n{4}  </testsuite>\n"
        "</testsuites>\n",
        tests, failures, report.seconds, escaped(report.math + " " + report.real + " on " + report.device),
        cases);
}

}  // namespace vndf::conformance
