// Which effects of kernels/effects.def and kernels/render/effects.def a scene calls for, and the program with those alone.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "render/scene.h"
#include "render/stages.h"

namespace vndf::render {

struct Effect {
    std::string name;       // "anisotropic"
    std::string macro;      // "VNDF_ANISOTROPIC"
    std::string called_by;  // what in the scene calls for it; empty: nothing does
    bool on = true;
};

// Of the models that results depend on, one each.
struct Choices {
    std::string ndf = "ggx", sampler = "bounded", masking = "correlated", energy = "none", random = "sobol",
                lights_by = "mis";
};

// How directions are drawn: the samplers of kernels/vndf/bsdf_facets.h, and two to compare with (kernels/render/material.h).
const std::vector<std::string>& samplers();

// How lights that fill a cap of directions are sampled: VNDF_LIGHTS_BY (kernels/render/effects.h).
const std::vector<std::string>& lights_by();

// Each effect, on or off. asked: "auto", what the scene calls for; "all"; or names with commas between them, and light
// from all around as the scene has it.
// Throws InputError at other names, or if nothing is left of the materials.
std::vector<Effect> effects_for(const Scene& scene, std::string_view asked);

// How many surfaces a path need visit, `asked` at most: none where no material sends light on.
unsigned useful_bounces(const Scene& scene, unsigned asked);

// Throws InputError if the choices contradict each other.
Switches switches(const Scene& scene, const std::vector<Effect>& effects, const Choices& choices);

}  // namespace vndf::render
