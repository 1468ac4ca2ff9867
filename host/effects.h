// The switches of a material (kernels/effects.def) as C++ data, and the lists of them that users write.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace vndf {

struct EffectChoice {
    std::string name;                 // "fresnel"
    std::vector<std::string> values;  // the default first
};
const std::vector<EffectChoice>& effect_choices();

struct Effect {
    std::string name;        // "back_facing"
    std::string called_for;  // what in a scene calls for it
};
const std::vector<Effect>& effects();

// The macro of an effect or choice: VNDF_BACK_FACING for back_facing.
std::string switch_of(std::string_view name);

// What a program is built with: a value of each choice, and whether each effect is on.
struct Effects {
    std::map<std::string, std::string> choices;
    std::map<std::string, bool> on;
    // "VNDF_NDF=ggx", "VNDF_LAMBERT=0" ..., every switch.
    std::vector<std::string> macros() const;
};

// "all", or names of effects and values of choices, in any order: "conductor,tint,fresnel=f82", "all,ndf=beckmann". What is not
// named is off, or the default. Throws InputError on what there is not, and where no program is left.
Effects parse_effects(std::string_view list);

// The arguments of the entry points of kernels/batch/bsdf.cl that are the material, in their order.
const std::vector<std::string>& material_parameters();
// The place of one among them.
std::size_t material_parameter(std::string_view name);

}  // namespace vndf
