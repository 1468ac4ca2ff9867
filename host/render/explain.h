// Why a program has the effects that it has, and what each costs.
#pragma once

#include <string>
#include <vector>

#include "render/effects.h"
#include "render/wavefront.h"

namespace vndf::render {

struct Explained {
    const runtime::Device& device;
    runtime::Math math;
    const Scene& scene;
    const Tree& tree;
    const std::vector<Effect>& effects;
    const Choices& choices;
    Settings settings;
};

// A table: effect, what in the scene calls for it, its switch, what it costs: by how much the stages that know what the scene holds
// (surface, dress, lights, connect, scatter) take longer with it. Below it each effect that is off although the scene calls for
// it, with the error that this makes. From small renderings of the scene.
std::string explanation(const Explained& what);

// A table: of each effect its share of the time and of the image's squared error on this scene, and what leaving it out changes.
std::string effect_costs(const Explained& what);

}  // namespace vndf::render
