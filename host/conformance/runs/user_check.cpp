#include "conformance/runs/user_check.h"

#include <algorithm>
#include <chrono>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "conformance/judge/bsdf.h"
#include "conformance/judge/mistakes.h"
#include "conformance/judge/own_density.h"
#include "conformance/judge/statistics.h"

namespace vndf::conformance {
namespace {

bool fails(const FunctionReport& judged) {
    return judged.verdict() == Verdict::fail;
}

std::string not_judged(const Function& function, const Scope& scope) {
    std::vector<std::string> parts;
    const bool has_wo = std::any_of(function.inputs.begin(), function.inputs.end(),
                                    [](const std::string& name) { return name == "wo_x" || name == "w_x"; });
    if (has_wo && scope.domain == Domain::upper)
        parts.push_back("views from behind the surface (--domain sphere)");
    parts.push_back(fmt::format("alpha outside of {}:{} (--alpha)", scope.alpha.low, scope.alpha.high));
    if (scope.isotropic) parts.push_back("two different alphas (--isotropic)");
    return fmt::format("{}", fmt::join(parts, "; "));
}

// The same with doubles for floats, if it has floats now.
std::optional<runtime::DeviceEvaluator> in_double(const UserKernel& kernel,
                                                  const runtime::DeviceEvaluator& evaluator) {
    if (evaluator.input_real() != runtime::Real::f32) return std::nullopt;
    return kernel.in_double(evaluator.program().device());
}

// With as many samples: fewer would see less.
bool passes_in_double(const UserKernel& kernel, const runtime::DeviceEvaluator& evaluator,
                      const Function& function, CheckOptions options) {
    std::optional<runtime::DeviceEvaluator> precise = in_double(kernel, evaluator);
    return precise && check(*precise, runtime::Math::strict, {&function}, options).passed();
}

constexpr const char* only_rounding =
    "likeliest mistake: none but rounding: the same text with doubles for floats passes; narrow lobes "
    "(--alpha), or formulas "
    "that subtract what is nearly equal";

std::string in_words(const Mistake& mistake) {
    if (mistake) return fmt::format("likeliest mistake: {} ({})", mistake.what, mistake.evidence);
    if (mistake.none)
        return "no known mistake: moderate roughness seen from the front looks right, to some ten thousand "
               "samples or a "
               "thousandth; what fails is a small bias, a special case or rounding, at the inputs above";
    return "no known mistake explains it";
}

// The report but for the words on what fails, and these if it is no rounding.
std::pair<Report, std::string> bsdf_report(const UserKernel& kernel, runtime::DeviceEvaluator& evaluator,
                                           const CheckOptions& options) {
    Report report = check(evaluator, runtime::Math::strict, {}, options);
    const Function &value = kernel.function(), &density = *kernel.pdf(), &sample = *kernel.sample();
    const std::size_t rows =
        options.random_points ? options.random_points : std::size_t{1} << (options.quick ? 14 : 16);
    BsdfFindings found = check_bsdf(evaluator, value, density, sample, *options.scope, options.quick, rows,
                                    options.seed, report.family_rate);
    const auto add = [&](const Function& function, std::vector<Finding>& findings) {
        FunctionReport& judged = report.functions.emplace_back();
        judged.function = &function, judged.findings = std::move(findings);
    };
    add(value, found.value), add(density, found.density), add(sample, found.sample);
    for (LobePicture& picture : found.pictures)
        if (options.draws(picture.passed())) report.functions.back().pictures.push_back(std::move(picture));
    report.tests = found.tests, report.level = sidak(report.family_rate, found.tests);
    report.samples = report.in_histogram = bsdf_samples;
    return {std::move(report), std::move(found.diagnosis)};
}

Report judged_bsdf(const UserKernel& kernel, runtime::DeviceEvaluator& evaluator,
                   const CheckOptions& options) {
    options.progress(kernel.function().name, 0);
    auto [report, mistake] = bsdf_report(kernel, evaluator, options);
    FunctionReport& first = report.functions.front();
    first.not_judged = not_judged(*first.function, *options.scope);
    if (!report.passed()) {
        std::optional<runtime::DeviceEvaluator> precise = in_double(kernel, evaluator);
        const bool rounding = precise && bsdf_report(kernel, *precise, options).first.passed();
        first.diagnosis = rounding          ? only_rounding
                          : mistake.empty() ? "no known mistake explains it"
                                            : "likeliest mistake: " + mistake;
    }
    options.progress("", 1);
    return std::move(report);
}

Report judged(const UserKernel& kernel, runtime::DeviceEvaluator& evaluator, CheckOptions options) {
    const Scope& scope = kernel.options().scope;
    options.scope = &scope;
    std::vector<const Function*> selected;
    for (const Function& function : kernel.functions()) selected.push_back(&function);
    if (kernel.is_bsdf()) return judged_bsdf(kernel, evaluator, options);
    if (kernel.pdf()) options.more_tests = own_density_lobes(kernel.function(), scope).size();
    Report report = check(evaluator, runtime::Math::strict, selected, options);
    // Of the samples the reference is the judge: it is their density that does not fit them.
    if (const Function* density = kernel.pdf())
        report.functions.back().findings.push_back(
            check_own_density(evaluator, kernel.function(), *density, scope, options.seed, report.level));
    for (FunctionReport& judged : report.functions) {
        judged.not_judged = not_judged(*judged.function, scope);
        if (!fails(judged)) continue;
        options.progress("looking for the mistake in " + judged.function->name, 1);
        const Mistake mistake = judged.function->kind == Kind::sampler
                                    ? mistake_of_sampler(evaluator, *judged.function, scope, options.seed)
                                    : mistake_of_value(evaluator, *judged.function, scope, options.seed);
        const bool rounding = !mistake && passes_in_double(kernel, evaluator, *judged.function, options);
        judged.diagnosis = rounding ? only_rounding : in_words(mistake);
    }
    return report;
}

}  // namespace

Report check_user_kernel(const UserKernel& kernel, runtime::DeviceEvaluator& evaluator,
                         CheckOptions options) {
    const auto start = std::chrono::steady_clock::now();
    Report report = judged(kernel, evaluator, options);
    report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return report;
}

}  // namespace vndf::conformance
