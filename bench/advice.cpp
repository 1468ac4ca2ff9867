#include "advice.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "accuracy.h"

namespace vndf::bench {
namespace {

double counter(const Result& result, const std::string& name) {
    const auto found = result.counters.find(name);
    return found == result.counters.end() ? 0 : found->second;
}

std::string what_of(const Function& function) {
    return fmt::format("{} {}", function.ndf == Ndf::ggx ? "GGX" : "Beckmann",
                       function.result == "WI" ? "reflections" : "visible normals");
}

// Visible normals for (wo, alpha, u): other arguments are other tasks, and approximations are no answer to an error.
bool is_candidate(const Function& function) {
    return is_plain_sampler(function) && function.method == Method::exact &&
           function.arguments == "WO_ALPHA_U";
}

}  // namespace

std::vector<Advice> advise(const std::vector<Result>& results, const Demand& demand) {
    std::map<std::string, Advice> by_task;
    const bool sphere = demand.domain == Domain::sphere;
    for (const Result& result : results) {
        const EntryName name = split(result.name);
        const Function* function = find_function(name.function);
        if (!function || !is_candidate(*function) || (sphere && function->domain != Domain::sphere)) continue;
        const std::string wanted = sphere || !has_back(*function) ? "cached" : "cached_front";
        if (name.mode != wanted || name.form.find("_again") != std::string::npos ||
            !result.counters.contains("angle_max"))
            continue;
        Candidate candidate{function, name.form, result.best_ns, counter(result, "angle_max")};
        if (sphere) candidate.error = std::max(candidate.error, counter(result, "angle_back_max"));
        candidate.sound = counter(result, "nonfinite") == 0 && counter(result, "below") == 0;
        by_task[what_of(*function)].candidates.push_back(candidate);
    }
    std::vector<Advice> all;
    for (auto& [what, advice] : by_task) {
        advice.what = what;
        std::sort(advice.candidates.begin(), advice.candidates.end(),
                  [](const Candidate& a, const Candidate& b) { return a.ns < b.ns; });
        const auto good = std::find_if(
            advice.candidates.begin(), advice.candidates.end(),
            [&](const Candidate& candidate) { return candidate.sound && candidate.error <= demand.error; });
        if (good != advice.candidates.end()) advice.best = *good;
        all.push_back(advice);
    }
    return all;
}

}  // namespace vndf::bench
