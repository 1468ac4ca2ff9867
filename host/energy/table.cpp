#include "energy/table.h"

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
    return fmt::format("clvndf energy table {} {} {} {} {}", version, surface.ndf, surface.masking,
                       Table::rows, Table::columns);
}

std::string array(const std::string& name, const std::vector<float>& values) {
    std::vector<std::string> numbers;
    for (const float x : values) numbers.push_back(fmt::format("{:.5f}f", x));
    return array_text("float", name, numbers);
}

// The value between the nodes around a row and a column.
double between(const std::vector<double>& losses, double row, double column) {
    const int r = std::min(static_cast<int>(row), Table::rows - 2),
              c = std::min(static_cast<int>(column), Table::columns - 2);
    const double* at = losses.data() + r * Table::columns + c;
    const auto along = [&](const double* a) { return a[0] + (column - c) * (a[1] - a[0]); };
    return along(at) + (row - r) * (along(at + Table::columns) - along(at));
}

double column_of(double cosine, double alpha) {
    const double l = alpha * std::sqrt((1 - cosine) * (1 + cosine)), r = std::hypot(l, cosine);
    return std::sqrt(cosine * (1 + cosine / (r + l)) / (r + cosine)) * (Table::columns - 1);
}

// As headers have it.
std::vector<double> rounded(const std::vector<float>& values) {
    std::vector<double> all;
    for (const float x : values) all.push_back(std::round(x * 1e5) / 1e5);
    return all;
}

double average(const std::vector<double>& losses, double alpha) {
    constexpr int nodes = 1000;
    // The integral of 2 cosine d cosine: up to alpha, over which the loss rises, and beyond in the logarithm.
    const double row = std::sqrt(alpha / 2) * (Table::rows - 1), edge = std::min(alpha, 1.),
                 span = -std::log(edge);
    double sum = 0;
    for (int i = 0; i < nodes; ++i) {
        const double v = (i + .5) / nodes, low = edge * v, high = edge * std::exp(span * v);
        sum += 2 * low * edge * between(losses, row, column_of(low, alpha));
        sum += 2 * high * high * span * between(losses, row, column_of(high, alpha));
    }
    return sum / nodes;
}

}  // namespace

double alpha_of(double row) {
    const double place = row / (Table::rows - 1);
    return 2 * place * place;
}

double stretched_cosine_of(double place, double stretch) {
    const double t = (1 - place) * (1 + place);  // tan(theta / 2)
    const double x = (1 - t) * (1 + t) / (1 + t * t), sine = 2 * t / (1 + t * t);
    return x * stretch / std::hypot(x * stretch, sine);
}

double cosine_of(double column, double alpha) {
    return stretched_cosine_of(column / (Table::columns - 1), alpha);
}

double average(const Table& table, double alpha) {
    return average(rounded(table.losses), alpha);
}

std::string header(const Table& table) {
    constexpr int count = 256;
    std::vector<float> averages;
    const std::vector<double> losses = rounded(table.losses);
    for (int i = 0; i < count; ++i) {
        const double place = std::max(i, 1) / (count - 1.);  // at 0 as next to it
        averages.push_back(static_cast<float>(average(losses, 2 * place * place) / (place * place)));
    }
    const std::string guard =
        upper(fmt::format("vndf_energy_{}_{}_h", table.surface.ndf, table.surface.masking));
    return fmt::format(R"(// The losses of a {0} conductor, {1} masking, as energy.h reads them. Written by
//     clvndf energy --ndf {0} --masking {1}
#ifndef {2}
#define {2}

#define VNDF_ENERGY_ROWS {3}
#define VNDF_ENERGY_COLUMNS {4}
#define VNDF_ENERGY_AVERAGES {5}
// clang-format off
)",
                       table.surface.ndf, table.surface.masking, guard, Table::rows, Table::columns, count) +
           array("vndf_energy_losses", table.losses) + array("vndf_energy_averages", averages) +
           "// clang-format on\n\n#endif\n";
}

std::string kept(const Table& table) {
    return kept_text(title(table.surface), table.losses);
}

Table read_kept(const Surface& surface, std::string_view text, const std::string& path) {
    return {surface, read_kept_text(title(surface), Table::rows * Table::columns, text, path)};
}

}  // namespace vndf::energy
