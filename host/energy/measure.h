// Tables of energy, measured by the samplers of the kernels on a device.
#pragma once

#include <vector>

#include "energy/table.h"
#include "runtime/devices.h"

namespace vndf::energy {

struct View {
    double x, y, z, alpha_x, alpha_y;  // wo, and the roughness
};

// 1 - E for each view, by `points` squared midpoints.
std::vector<double> losses(const runtime::Device& device, const Surface& surface,
                           const std::vector<View>& views, int points = 128);

Table measured(const runtime::Device& device, const Surface& surface);

}  // namespace vndf::energy
