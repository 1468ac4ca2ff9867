// Tables of energy, measured by the samplers of the kernels on a device.
#pragma once

#include <vector>

#include "energy/glass.h"
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

// The albedos of glass for each view and index, by as many midpoints and by `walks` walks.
std::vector<GlassAlbedo> glass_albedos(const runtime::Device& device, const Surface& surface,
                                       const std::vector<View>& views, const std::vector<double>& etas,
                                       int points = 128, int walks = 65536);

// The views and indices of a table, in the order of its numbers.
struct GlassViews {
    std::vector<View> views;
    std::vector<double> etas;
};
GlassViews glass_views();

GlassTable measured_glass(const runtime::Device& device, const Surface& surface);

}  // namespace vndf::energy
