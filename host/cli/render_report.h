// What `clvndf render --report` says of a rendering, as JSON.
#pragma once

#include <string>

#include "cli/render_scene.h"
#include "render/effects.h"
#include "render/wavefront.h"

namespace vndf::cli {

// What a run has done by itself, beside what a checkpoint had, and what there is now.
struct Traced {
    double first = 0;  // seconds until every pixel had a sample
    double samples_per_second = 0;
    render::Image image = {};
    std::string device = {};
    render::Wavefront::Memory memory = {};  // of one device
    std::uint32_t lamps = 0;
};

struct Reported {
    const SceneOptions& options;
    const ShownScene& shown;
    const std::vector<render::Effect>& effects;
    const render::Choices& choices;
    const render::Switches& switches;
    const render::Settings& settings;
    const Traced& traced;
    std::string math;
    double seconds, first;  // since the command began: now, and when every pixel had a sample
    double stops;           // of the PNG
};

std::string render_report(const Reported& r);

}  // namespace vndf::cli
