// What each effect of a material costs on a device: time and build time of programs with and without it, beside what
// effects.py has counted of them.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "runtime/devices.h"

namespace vndf::bench {

// Of bench/results/effects.json; 0: not counted.
struct EffectCounts {
    int llvm = 0, sm_80_slots = 0, sm_80_registers = 0;
};

struct EffectCost {
    std::string program;  // "all", "all without tint", "conductor alone", "conductor and tint"
    std::vector<std::string> macros;
    double sample_ns = 0, eval_pdf_ns = 0;  // an item, best of the repetitions
    double build_s = 0;                     // of both kernels, from an empty cache
    EffectCounts sample, eval_pdf;
};

// GGX by bounded sampling with Schlick's reflectance and correlated masking: everything on, each effect off, the smallest
// program, each effect added to it, and each other choice. Counted, and not yet measured.
std::vector<EffectCost> effect_programs();

// Measured: all programs in turn, so that a disturbance meets all alike.
std::vector<EffectCost> effect_costs(const runtime::Device& device, std::vector<EffectCost> programs,
                                     int repetitions, const std::function<void(double done)>& progress);

// The same as JSON, with this context.
std::string effects_json(const std::vector<EffectCost>& costs,
                         const std::vector<std::pair<std::string, std::string>>& context);

}  // namespace vndf::bench
