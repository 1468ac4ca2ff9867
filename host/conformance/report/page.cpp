#include "conformance/report/page.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "conformance/inputs/rows.h"
#include "conformance/report/markup.h"
#include "conformance/report/picture.h"

namespace vndf::conformance {
namespace {

constexpr std::string_view style = R"(
:root { color-scheme: light dark; --ink: #1a1a1a; --soft: #555; --rule: #ccc; --band: #e4ecf4; --bad: #a00000; --paper: #fff }
@media (prefers-color-scheme: dark) { :root { --ink: #e6e6e6; --soft: #aaa; --rule: #555; --band: #2b3947; --bad: #ff8a80;
                                              --paper: #16181a } }
body { font: 10pt/1.4 system-ui, sans-serif; max-width: 62rem; margin: 1.5rem auto; padding: 0 1rem; color: var(--ink);
       background: var(--paper) }
h1 { font-size: 16pt; margin: 0 0 .4rem } h2 { font-size: 12.5pt; margin: 1.6rem 0 .3rem; border-top: 2px solid; padding-top: .5rem }
h3 { font-size: 10pt; margin: .9rem 0 .2rem } h1, h2, h3, td, th, p { overflow-wrap: anywhere } p { margin: .35rem 0 }
table { border-collapse: collapse; font-size: 8.5pt; width: 100%; margin: .4rem 0 }
th, td { text-align: left; vertical-align: top; padding: .14rem .7rem .14rem 0; border-bottom: 1px solid var(--rule) }
th { font-weight: 600 } .n { text-align: right; white-space: nowrap; font-variant-numeric: tabular-nums }
.k { white-space: nowrap; overflow-wrap: normal } .f { overflow-wrap: normal }
.small { font-size: 8.5pt; color: var(--soft) } code { font-size: 7.5pt; overflow-wrap: anywhere }
pre { font-size: 7.5pt; white-space: pre-wrap; overflow-wrap: anywhere; margin: .15rem 0; padding: .3rem .5rem; background: var(--band) }
.bad { color: var(--bad); font-weight: 700 } a { color: inherit } figure { margin: 0 0 .6rem; break-inside: avoid }
figcaption { font-size: 8.5pt; break-after: avoid } figcaption b { font-size: 9.5pt } dd { margin: 0 0 .5rem } dt { font-size: 8.5pt; font-weight: 600 }
svg.p { width: 100%; display: block; fill: var(--ink); text-anchor: middle; font: 9.5px system-ui, sans-serif } image { image-rendering: pixelated }
.e { text-anchor: end } .s { text-anchor: start } .t { font-size: 10.5px }
.w { font-weight: 700; fill: var(--bad) } .l { fill: none; stroke: var(--ink); stroke-width: 1.2 }
.d { fill: none; stroke: var(--ink); stroke-width: 5; stroke-linecap: round } .b { fill: var(--band) }
.z { stroke: var(--soft); stroke-width: .7; stroke-dasharray: 2 2; fill: none } .x { fill: none; stroke: var(--soft); stroke-width: .8 }
@media print { :root { color-scheme: light; --ink: #000; --soft: #333; --rule: #bbb; --band: #e8e8e8; --bad: #000; --paper: #fff }
  @page { size: A4; margin: 12mm } body { font-size: 9pt; margin: 0; max-width: none; padding: 0 } a { text-decoration: none }
  * { print-color-adjust: exact; -webkit-print-color-adjust: exact }
  table { font-size: 7.5pt } pre, code { font-size: 6.8pt } .small, figcaption, figcaption b { font-size: 7.5pt } figure { margin: 0 0 .3rem } svg.p { width: 86% }
  thead { display: table-header-group } tr, dd { break-inside: avoid } h2, h3, dt { break-after: avoid } }
)";

std::string cell(const std::string& content, const char* kind = nullptr) {
    return kind ? fmt::format("<td class={}>{}</td>", kind, content) : "<td>" + content + "</td>";
}

std::string marked(const std::string& verdict) {
    return verdict == "FAIL" ? "<span class=bad>FAIL</span>" : verdict;
}

std::string verdict(const Finding& finding) {
    if (finding.passed()) return finding.biased ? "known bias" : "pass";
    return finding.concern == Concern::wrong ? "FAIL" : to_string(finding.concern);
}

std::string limit_of(const Finding& f) {
    const char* const relation = f.biased ? "documented" : f.is_p ? "at least" : "at most";
    return fmt::format("{} {:.4g} {}", relation, f.limit, escaped(f.unit));
}

// "1,000,000"
std::string grouped(double number) {
    std::string digits = fmt::format("{:.0f}", number);
    for (std::size_t i = digits.size(); i > 3; i -= 3) digits.insert(i - 3, 1, ',');
    return digits;
}

// What a run is called, and what it was.
std::string head(const Report& report, const PageOptions& options) {
    std::vector<std::string> failed;
    std::size_t inexact = 0;
    for (const FunctionReport& f : report.functions) {
        if (f.verdict() == Verdict::fail) failed.push_back(f.function->name);
        inexact += f.verdict() == Verdict::inexact;
    }
    const std::size_t all = report.functions.size();
    const std::string title = fmt::format("{} of {} functions pass{}", all - failed.size(), all,
                                          inexact ? fmt::format(", {} of them inexact", inexact) : "");
    std::string out = fmt::format(
        "<!doctype html>\n<html lang=en><meta charset=utf-8><meta name=viewport content='width=device-width'>"
        "<title>clvndf check: {0}</title><style>{1}</style>\n{2}\n<h1>{0}</h1>\n",
        title, style, picture_definitions());
    if (!failed.empty())
        out += fmt::format("<p><span class=bad>FAIL</span>: {}</p>\n",
                           escaped(fmt::format("{}", fmt::join(failed, ", "))));
    const auto fact = [&](const char* name, const std::string& value) {
        out += fmt::format("<tr><td class=k>{}</td><td>{}</td></tr>", name, escaped(value));
    };
    out += "<table>";
    fact("device", report.device);
    fact("build options", report.options);
    fact("arithmetic", report.math + " " + report.real);
    fact("samples",
         fmt::format("{} a lobe, seed {}{}; {} of them in the histograms of directions", report.samples,
                     report.seed, report.quick ? " (quick: fewer lobes, samples and inputs)" : "",
                     report.in_histogram == report.samples ? "all" : fmt::format("{}", report.in_histogram)));
    if (report.tests > 0)
        fact("false alarms",
             fmt::format("{} statistical tests. Were all of it right, chance alone would fail a run like "
                         "this one less "
                         "than once in {}; so one test fails where its probability p is below {:.2g}.",
                         report.tests, grouped(1 / report.family_rate), report.level));
    if (report.bit_rows > 0) fact("bits", format_differences(report.bits, report.bit_rows));
    fact("made by", options.software);
    return out + "</table>\n";
}

bool is_shown(const FunctionReport& f, const PageOptions& options) {
    // A BSDF's sampler has the pictures of lobes where the value or the density fails, too.
    const auto fails = [](const LobePicture& picture) { return !picture.passed(); };
    return options.all || f.verdict() == Verdict::fail || f.verdict() == Verdict::inexact ||
           std::any_of(f.pictures.begin(), f.pictures.end(), fails);
}

// A name that may be broken after each underscore.
std::string breakable(std::string name) {
    for (std::size_t at = 0; (at = name.find('_', at)) != name.npos; at += 6) name.insert(at + 1, "<wbr>");
    return name;
}

std::string summary(const Report& report, const PageOptions& options) {
    std::string out =
        "<table><thead><tr><th>function</th><th class=k>verdict</th><th>worst figure</th><th "
        "class=n>is</th><th>limit</th>"
        "<th>at</th></tr></thead><tbody>\n";
    for (const FunctionReport& f : report.functions) {
        const std::string name = escaped(f.function->name);
        out += "<tr>" +
               cell(is_shown(f, options) ? fmt::format("<a href='#{}'>{}</a>", name, breakable(name))
                                         : breakable(name),
                    "f") +
               cell(marked(to_string(f.verdict())), "k");
        if (const Finding* worst = f.worst())
            out += cell(escaped(worst->check)) + cell(fmt::format("{:.3g}", worst->figure), "n") +
                   cell(limit_of(*worst)) + cell("<code>" + escaped(worst->worst) + "</code>");
        else
            out += "<td colspan=4>nothing checked</td>";
        out += "</tr>\n";
    }
    return out + "</tbody></table>\n";
}

std::string guide(const Report& report) {
    return fmt::format(
        R"(<h2>How to read the pictures</h2>
<p class=small>Each is of one lobe. <b>Directions</b>: azimuth to the right, polar angle upwards, of the normal (of the half
vector for reflections). Cells are cut so that every row and every column expects equally many; of a BSDF they are equal steps of
the angles of wi, over the whole sphere. Dark cells have more, up to the number beside the scale, by square roots. <b>Difference, in σ</b>: measured minus expected in standard deviations of the count;
blue is too few, brown too many. A right sampler shows pale noise without a pattern. <b>Pivots</b>: two numbers that the
reference makes of each direction, uniform and independent if the sampler is right; beside them the histogram of each over what
is expected, with a band of one standard deviation. <b>Means</b>: measured minus expected; dots beyond ±1 fail, bars are one
standard error. χ² (chi2) and Kolmogorov–Smirnov (KS) fail below p = {:.2g}.</p>
)",
        report.level);
}

std::string findings(const FunctionReport& f) {
    std::string out =
        "<table><thead><tr><th>check</th><th></th><th class=n>is</th><th>limit</th><th class=n>inputs or "
        "tests</th><th></th>"
        "</tr></thead><tbody>\n";
    for (const Finding& finding : f.findings)
        out += "<tr>" + cell(escaped(finding.check)) + cell(marked(verdict(finding)), "k") +
               cell(fmt::format("{:.3g}", finding.figure), "n") + cell(limit_of(finding)) +
               cell(std::to_string(finding.count), "n") + cell(escaped(finding.detail)) + "</tr>\n";
    return out + "</tbody></table>\n";
}

std::string worst_inputs(const FunctionReport& f, const std::string& real, const PageOptions& options) {
    std::string out;
    for (const Finding& finding : f.findings) {
        std::string again;
        for (const Repetition& r : repetitions(*f.function, finding, real, options.evaluate))
            again += fmt::format("<pre>{}</pre><span class=small>gives {}</span>\n", escaped(r.command),
                                 escaped(r.gives));
        if (!again.empty()) out += fmt::format("<dt>{}</dt><dd>{}</dd>\n", escaped(finding.check), again);
    }
    if (out.empty()) return out;
    const bool registered = f.function->model == f.function->name;
    return fmt::format(
        "<h3>Worst inputs{}</h3>\n<dl>{}</dl>\n",
        registered ? " (with <code>--on reference</code> instead of a device: the exact value)" : "", out);
}

// "wo_x 0.77, alpha_x 0.5", without the u that samples bring.
std::string lobe_in_words(const Function& function, const std::vector<double>& row) {
    std::string out;
    for (std::size_t i = 0; i < row.size(); ++i)
        if (is_of_lobe(function.inputs[i]))
            out += fmt::format("{}{} {:.4g}", out.empty() ? "" : ", ", function.inputs[i], row[i]);
    const double cosine = RowReader(function).cos_theta_o(row.data());
    return out + fmt::format("; wo {:.3g}° from the normal",
                             std::acos(std::clamp(cosine, -1.0, 1.0)) * 180 / 3.14159265358979);
}

std::string figure(const FunctionReport& f, const LobePicture& picture) {
    std::string tests;
    for (const LobeTest& test : picture.tests) {
        const bool passed = test.passed();
        tests +=
            fmt::format("{}{}{} {}{:.3g} {}{}", tests.empty() ? "" : " · ",
                        passed ? "" : "<span class=bad>FAIL ", escaped(test.name), test.is_p ? "p = " : "",
                        test.figure, test.is_p ? "" : test.unit, passed ? "" : "</span>");
    }
    return fmt::format("<figure><figcaption><b>{}</b><br>{}</figcaption>{}</figure>\n",
                       escaped(lobe_in_words(*f.function, picture.row)), tests, draw(picture));
}

std::string section(const FunctionReport& f, const Report& report, const PageOptions& options) {
    const std::string name = escaped(f.function->name);
    std::string out =
        fmt::format("<section id='{0}'><h2>{0}: {1}</h2>\n", name, marked(to_string(f.verdict())));
    out += fmt::format("<p class=small>Again, alone: <code>{}</code></p>\n",
                       escaped(options.check(*f.function)));
    if (!f.diagnosis.empty()) out += fmt::format("<p><b>{}</b></p>\n", escaped(f.diagnosis));
    if (!f.not_judged.empty())
        out += fmt::format("<p class=small>Not judged: {}</p>\n", escaped(f.not_judged));
    out += findings(f) + worst_inputs(f, report.real, options);
    if (!f.pictures.empty()) {
        out += fmt::format("<h3>{} lobe{}{}</h3>\n", f.pictures.size(), f.pictures.size() == 1 ? "" : "s",
                           options.all ? "" : ", those that fail");
        for (const LobePicture& picture : f.pictures) out += figure(f, picture);
    }
    return out + "</section>\n";
}

}  // namespace

std::string format_page(const Report& report, const PageOptions& options) {
    std::string page = head(report, options) + summary(report, options);
    const auto has_pictures = [](const FunctionReport& f) { return !f.pictures.empty(); };
    if (std::any_of(report.functions.begin(), report.functions.end(), has_pictures)) page += guide(report);
    for (const FunctionReport& f : report.functions)
        if (is_shown(f, options)) page += section(f, report, options);
    return page + "</html>\n";
}

}  // namespace vndf::conformance
