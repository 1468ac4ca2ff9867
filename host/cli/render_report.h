// What `clvndf render --report` says of a rendering, as JSON.
#pragma once

#include <string>

#include "cli/render_scene.h"
#include "render/effects.h"
#include "render/wavefront.h"

namespace vndf::cli {

struct Reported {
    const SceneOptions& options;
    const ShownScene& shown;
    const std::vector<render::Effect>& effects;
    const render::Choices& choices;
    const render::Switches& switches;
    const render::Settings& settings;
    const render::Wavefront& wavefront;
    const render::Image& image;
    std::string device, math;
    double seconds, first;  // since the command began: now, and when every pixel had a sample
    double stops;           // of the PNG
    double samples_per_second;
};

std::string render_report(const Reported& r);

}  // namespace vndf::cli
