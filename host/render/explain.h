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

// A table: effect, what in the scene calls for it, its switch, what it costs: by how much the stages that know materials
// (surface, connect, scatter) take longer with it. Below it each effect that is off although the scene calls for it, with the
// error that this makes. Both from small renderings of the scene.
std::string explanation(Explained what);

}  // namespace vndf::render
