#include "energy/glass.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "energy/kept.h"
#include "text.h"

namespace vndf::energy {
namespace {

// To be raised with every change of what a table holds.
constexpr int version = 1;

std::string title(const Surface& surface) {
    return fmt::format("clvndf energy glass table {} {} {} {} {} {}", version, surface.ndf, surface.masking,
                       GlassTable::layers, GlassTable::rows, GlassTable::columns);
}

}  // namespace

double glass_eta_of(int layer) {
    // The first layer stands for index 1, where there is a limit: it is measured a quarter of a layer from there.
    const int place = layer % GlassTable::layers;
    const double cosine = std::sqrt(8. / 9) * std::max<double>(place, .25) / (GlassTable::layers - 1),
                 dense = 1 / std::sqrt((1 - cosine) * (1 + cosine));
    return layer < GlassTable::layers ? dense : 1 / dense;
}

double glass_alpha_of(double row) {
    const double place = row / (GlassTable::rows - 1);
    return place * place;
}

double glass_cosine_of(double column, double alpha) {
    return stretched_cosine_of(column / (GlassTable::columns - 1), std::sqrt(alpha));
}

std::vector<float> glass_parts_of(const GlassAlbedo& a) {
    constexpr double least = 1e-3;
    const double through = 1 - a.walk;
    double reflected = (a.reflected + least) / (a.walk + least),
           refracted = (a.refracted + least) / (std::max(through, 0.) + least);
    if (a.refracted < a.reflected)
        reflected = a.reflected / (1 - a.refracted / refracted);
    else
        refracted = a.refracted / (1 - a.reflected / reflected);
    const auto number = [](double part) {
        return static_cast<float>(std::round(std::clamp(part * GlassTable::one, 1., 65535.)));
    };
    return {number(reflected), number(refracted)};
}

std::string header(const GlassTable& table) {
    std::vector<std::string> numbers;
    for (const float x : table.parts) numbers.push_back(fmt::format("{}", static_cast<int>(x)));
    const std::string guard =
        upper(fmt::format("vndf_energy_glass_{}_{}_h", table.surface.ndf, table.surface.masking));
    return fmt::format(
               R"(// What single scattering of {0} glass has of what walks reflect and refract, {1} masking, as energy_glass.h
// reads it. Written by
//     clvndf energy --of glass --ndf {0} --masking {1}
#ifndef {2}
#define {2}

#define VNDF_ENERGY_GLASS_LAYERS {3}
#define VNDF_ENERGY_GLASS_ROWS {4}
#define VNDF_ENERGY_GLASS_COLUMNS {5}
#define VNDF_ENERGY_GLASS_ONE {6}
// clang-format off
)",
               table.surface.ndf, table.surface.masking, guard, GlassTable::layers, GlassTable::rows,
               GlassTable::columns, GlassTable::one) +
           array_text("unsigned short", "vndf_energy_glass_parts", numbers) +
           "// clang-format on\n\n#endif\n";
}

std::string kept(const GlassTable& table) {
    return kept_text(title(table.surface), table.parts);
}

GlassTable read_kept_glass(const Surface& surface, std::string_view text, const std::string& path) {
    return {surface, read_kept_text(title(surface), GlassTable::numbers, text, path)};
}

}  // namespace vndf::energy
