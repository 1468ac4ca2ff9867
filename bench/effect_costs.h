// What each effect of a material costs on a device: time and build time of programs with and without it.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "runtime/devices.h"

namespace vndf::bench {

struct EffectCost {
    std::string program;  // "all", "all without tint", "conductor alone", "conductor and tint"
    std::vector<std::string> macros;
    double sample_ns = 0, eval_pdf_ns = 0;  // an item, best of the repetitions
    double build_s = 0;                     // of both kernels, from an empty cache
};

// GGX by bounded sampling with Schlick's reflectance and correlated masking: everything on, each effect off, the smallest
// program, and each effect added to it. All programs in turn, so that a disturbance meets all alike.
std::vector<EffectCost> effect_costs(const runtime::Device& device, int repetitions,
                                     const std::function<void(double done)>& progress);

}  // namespace vndf::bench
