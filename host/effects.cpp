#include "effects.h"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "../kernels/batch/bsdf_parameters.h"
#include "error.h"
#include "text.h"

namespace vndf {
namespace {

InputError unknown(std::string_view word) {
    std::vector<std::string> allowed{"all"};
    for (const Effect& effect : effects()) allowed.push_back(effect.name);
    for (const EffectChoice& choice : effect_choices())
        allowed.push_back(fmt::format("{}={}", choice.name, fmt::join(choice.values, "|")));
    return InputError(fmt::format("--effects: unknown '{}'; allowed are {}", word, fmt::join(allowed, ", ")));
}

void choose(Effects& chosen, const std::string& word) {
    const std::size_t equals = word.find('=');
    const std::string name = word.substr(0, equals), value = word.substr(equals + 1);
    for (const EffectChoice& choice : effect_choices()) {
        if (choice.name != name) continue;
        if (!std::count(choice.values.begin(), choice.values.end(), value))
            throw InputError(fmt::format("--effects: unknown '{}'; allowed are {}={}", word, name,
                                         fmt::join(choice.values, "|")));
        chosen.choices[name] = value;
        return;
    }
    throw unknown(word);
}

}  // namespace

const std::vector<EffectChoice>& effect_choices() {
    static const std::vector<EffectChoice> all{
#define VNDF_CHOICE(name, values) {lower(#name), split(values, ' ')},
#include "../kernels/effects.def"
    };
    return all;
}

const std::vector<Effect>& effects() {
    static const std::vector<Effect> all{
#define VNDF_EFFECT(name, called_for, marks) {lower(#name), called_for},
#include "../kernels/effects.def"
    };
    return all;
}

std::string switch_of(std::string_view name) {
    return "VNDF_" + upper(std::string(name));
}

std::vector<std::string> Effects::macros() const {
    std::vector<std::string> all;
    for (const auto& [name, value] : choices) all.push_back(fmt::format("{}={}", switch_of(name), value));
    for (const auto& [name, is_on] : on) all.push_back(fmt::format("{}={:d}", switch_of(name), is_on));
    return all;
}

Effects parse_effects(std::string_view list) {
    Effects chosen;
    for (const Effect& effect : effects()) chosen.on[effect.name] = false;
    for (const std::string& word : split(list, ',')) {
        if (word.find('=') != word.npos)
            choose(chosen, word);
        else if (word == "all")
            for (auto& [name, is_on] : chosen.on) is_on = true;
        else if (const auto found = chosen.on.find(word); found != chosen.on.end())
            found->second = true;
        else
            throw unknown(word);
    }
    const bool beckmann = chosen.choices.contains("ndf") && chosen.choices.at("ndf") == "beckmann";
    const bool sampling = chosen.choices.contains("sampling");
    if (beckmann && sampling && chosen.choices.at("sampling") != "plain")
        throw InputError(fmt::format("--effects: sampling={} with ndf=beckmann; plain is allowed",
                                     chosen.choices.at("sampling")));
    for (const EffectChoice& choice : effect_choices()) chosen.choices.emplace(choice.name, choice.values[0]);
    if (beckmann) chosen.choices["sampling"] = "plain";
    if (!chosen.on.at("conductor") && !chosen.on.at("dielectric") && !chosen.on.at("lambert"))
        throw InputError(fmt::format(
            "--effects '{}': nothing is left of a material; it needs conductor, dielectric or lambert",
            list));
    return chosen;
}

const std::vector<std::string>& material_parameters() {
#define VNDF_NAME(parameter) #parameter,
    static const std::vector<std::string> all{VNDF_BSDF_PARAMETERS(VNDF_NAME)};
#undef VNDF_NAME
    return all;
}

std::size_t material_parameter(std::string_view name) {
    const std::vector<std::string>& all = material_parameters();
    const auto found = std::find(all.begin(), all.end(), name);
    if (found == all.end()) throw std::invalid_argument(fmt::format("no parameter {}", name));
    return static_cast<std::size_t>(found - all.begin());
}

}  // namespace vndf
