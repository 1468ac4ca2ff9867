#include "energy/table.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>

#include <fmt/format.h>

#include "error.h"
#include "hash.h"
#include "text.h"

namespace vndf::energy {
namespace {

// To be raised with every change of what a table holds.
constexpr int version = 1;

std::string first_line(const Surface& surface, std::string_view numbers) {
    return fmt::format("clvndf energy table {} {} {} {} {} {:016x}\n", version, surface.ndf, surface.masking,
                       Table::rows, Table::columns, fnv1a(numbers));
}

std::string array(const std::string& name, const std::vector<float>& values) {
    std::string text = fmt::format("VNDF_CONSTANT float {}[{}] = {{", name, values.size());
    for (std::size_t i = 0; i < values.size(); ++i)
        text += fmt::format("{}{:.5f}f,", i % 12 == 0 ? "\n    " : " ", values[i]);
    text.pop_back();
    return text + "};\n";
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

double cosine_of(double column, double alpha) {
    const double place = column / (Table::columns - 1), t = (1 - place) * (1 + place);  // tan(theta / 2)
    const double x = (1 - t) * (1 + t) / (1 + t * t), sine = 2 * t / (1 + t * t);
    return x * alpha / std::hypot(x * alpha, sine);
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
    std::string numbers;
    for (const float x : table.losses) numbers += fmt::format("{:.9g}\n", x);
    return first_line(table.surface, numbers) + numbers;
}

Table read_kept(const Surface& surface, std::string_view text, const std::string& path) {
    const std::size_t end = text.find('\n');
    const std::string_view numbers = end == text.npos ? std::string_view() : text.substr(end + 1);
    const std::string wanted = first_line(surface, numbers);
    if (end == text.npos || text.substr(0, end + 1) != wanted)
        throw InputError(fmt::format("{}:1: no table of {} {}, or it is damaged: '{}' is wanted", path,
                                     surface.ndf, surface.masking, wanted.substr(0, wanted.size() - 1)));
    std::vector<float> values;
    for (const char *at = numbers.data(), *last = at + numbers.size(); at < last; ++at) {
        float value = 0;
        const auto [next, error] = std::from_chars(at, last, value);
        if (error != std::errc() || !(value >= 0)) break;
        values.push_back(value);
        at = next;
    }
    constexpr std::size_t count = Table::rows * Table::columns;
    if (values.size() != count)
        throw InputError(fmt::format("{}: {} numbers, not {}", path, values.size(), count));
    return {surface, values};
}

}  // namespace vndf::energy
