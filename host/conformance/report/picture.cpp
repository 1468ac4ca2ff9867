#include "conformance/report/picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "conformance/report/cells.h"

namespace vndf::conformance {
namespace {

constexpr std::size_t cells = LobePicture::cells;              // of the pivots, either way
constexpr int side = 128;                                      // of a histogram, in units of the SVG
constexpr int columns[] = {44, 212, 380}, rows[] = {16, 188};  // where histograms begin
constexpr int means_left = 596, means_width = 160, means_step = 23;
constexpr int scale_below = side + 17;  // a scale of colours, below its histogram
constexpr double degree = 180 / 3.14159265358979323846;

std::string text(double x, double y, const std::string& words, const char* kind = nullptr) {
    return kind ? fmt::format("<text x='{:g}' y='{:g}' class={}>{}</text>", x, y, kind, words)
                : fmt::format("<text x='{:g}' y='{:g}'>{}</text>", x, y, words);
}

struct Size {
    std::size_t rows, columns;
};

// Colours of cells [row][column], the first row at the bottom.
template <class Colour>
std::string image(int x, int y, const Size& size, Colour colour, const Palette& palette) {
    std::vector<std::uint8_t> colours;
    for (std::size_t row = size.rows; row-- > 0;)
        for (std::size_t column = 0; column < size.columns; ++column)
            colours.push_back(static_cast<std::uint8_t>(colour(row * size.columns + column)));
    const std::string stretched =
        size.rows == size.columns ? "" : fmt::format(" height='{}' preserveAspectRatio='none'", side);
    return fmt::format("<image x='{}' y='{}' width='{}'{} href='{}'/>", x, y, side, stretched,
                       image_of_cells(size.columns, colours, palette));
}

std::string residual_image(int x, int y, const Size& size, const CellCounts& counts) {
    return image(
        x, y, size,
        [&](std::size_t i) {
            return std::clamp(std::lround(deviations(counts.observed[i], counts.expected[i])), -7L, 7L) + 7;
        },
        residuals());
}

// Labels at the beginning, the middle and the end of an axis.
using Labels = std::array<std::string, 3>;

std::string labels_below(int x, int y, const Labels& labels) {
    y += side + 11;
    return text(x, y, labels[0], "s") + text(x + side / 2, y, labels[1]) + text(x + side, y, labels[2], "e");
}
std::string labels_beside(int x, int y, const Labels& labels) {
    x -= 4;
    return text(x, y + side, labels[0], "e") + text(x, y + side / 2 + 3, labels[1], "e") +
           text(x, y + 7, labels[2], "e");
}

// Of the edges of cells.
template <class Format>
Labels angles(const std::vector<double>& edges, Format format) {
    return {format(edges.front() * degree), format(edges[edges.size() / 2] * degree),
            format(edges.back() * degree)};
}
std::string polar(double angle) {
    return fmt::format("{:.3g}°", angle);
}
std::string azimuth(double angle) {
    return fmt::format("{:.0f}°", std::remainder(angle, 360));
}

std::string directions(const LobePicture& picture) {
    const CellCounts& counts = picture.directions;
    const Size size{picture.bins.theta.size() - 1, picture.bins.phi.size() - 1};
    const std::size_t all = size.rows * size.columns;
    const double total = std::accumulate(counts.expected.begin(), counts.expected.end(), 0.0);
    double most = 0;
    for (std::size_t i = 0; i < all; ++i)
        most = std::max({most, static_cast<double>(counts.observed[i]), counts.expected[i]});
    const auto amount = [&](double count) { return std::lround(15 * std::sqrt(count / most)); };
    const int y = rows[0];
    std::string out;
    out += image(
        columns[0], y, size, [&](std::size_t i) { return amount(counts.observed[i]); }, amounts());
    out += image(
        columns[1], y, size, [&](std::size_t i) { return amount(counts.expected[i]); }, amounts());
    out += residual_image(columns[2], y, size, counts);
    for (const int x : columns) out += labels_below(x, y, angles(picture.bins.phi, azimuth));
    out += labels_beside(columns[0], y, angles(picture.bins.theta, polar));
    out += text(columns[0] + 100, y + scale_below + 7,
                fmt::format("{:.3g} × the average cell", most / total * static_cast<double>(all)), "s");
    if (counts.observed.back() > 0)
        out += text(columns[1] + 60, y + scale_below + 7,
                    fmt::format("{} in no cell", counts.observed.back()), "s");
    return out;
}

// The histogram of one pivot over its expectation, which is 1.
std::string marginal(int x, int y, const CellCounts& counts, bool second) {
    std::vector<double> ratio(cells);
    const double expected = counts.expected[0] * cells, sigma = 1 / std::sqrt(expected);
    for (std::size_t i = 0; i < cells * cells; ++i)
        ratio[second ? i % cells : i / cells] += counts.observed[i] / expected;
    double range = 5 * sigma;
    for (const double r : ratio) range = std::max(range, 1.1 * std::abs(r - 1));
    const double low = std::max(0.0, 1 - range), high = 1 + range;
    const auto height = [&](double r) { return side * (high - r) / (high - low); };
    std::string path = fmt::format("M0 {:.1f}", height(ratio[0]));
    for (const double r : ratio) path += fmt::format("V{:.1f}h{}", height(r), side / static_cast<int>(cells));
    const std::string plot = fmt::format(
        "<g transform='translate({} {})'><rect y='{:.1f}' width='{}' height='{:.1f}' class=b />"
        "<path d='M0 {:.1f}h{}' class=z /><path d='{}' class=l /></g>",
        x, y, height(1 + sigma), side, height(1 - sigma) - height(1 + sigma), height(1), side, path);
    return plot +
           labels_beside(x, y, {fmt::format("{:.3g}", low), low > 0 ? "1" : "", fmt::format("{:.3g}", high)});
}

std::string pivots(const LobePicture& picture) {
    return residual_image(columns[0], rows[1], {cells, cells}, picture.pivots) +
           marginal(columns[1], rows[1], picture.pivots, false) +
           marginal(columns[2], rows[1], picture.pivots, true);
}

// Measured minus expected, in tolerances; bars are the standard error of the mean.
std::string means(const std::vector<MeanTest>& tests, const std::vector<std::string>& notes) {
    const int left = means_left, width = means_width, middle = left + width / 2, top = rows[0];
    const int height = means_step * static_cast<int>(tests.size());
    const auto at = [&](double tolerances) { return middle + width * std::clamp(tolerances, -1.9, 1.9) / 4; };
    std::string bars, dots, names, figures;
    double y = top - means_step / 2.0;
    for (const MeanTest& test : tests) {
        y += means_step;
        const double figure = test.difference / test.tolerance, error = test.error / test.tolerance;
        if (std::isfinite(figure)) {
            bars += fmt::format("M{:.1f} {:g}H{:.1f}", at(figure - error), y, at(figure + error));
            dots += fmt::format("M{:.1f} {:g}h0", at(figure), y);
        }
        names += text(left - 6, y + 3, test.name);
        if (!(std::abs(figure) <= 1))  // on the side that the dot leaves free
            figures += text(figure > 0 ? left + 3 : left + width - 3, y + 3, fmt::format("{:+.3g}", figure),
                            figure > 0 ? "'s w'" : "'e w'");
    }
    for (std::size_t i = 0; i < notes.size(); ++i)
        figures += text(left - 40, top + height + 34 + 14 * static_cast<int>(i), notes[i], "s");
    return fmt::format("<rect x='{}' y='{}' width='{}' height='{}' class=b />", left + width / 4, top,
                       width / 2, height) +
           fmt::format("<rect x='{}' y='{}' width='{}' height='{}' class=x />", left, top, width, height) +
           fmt::format("<path d='M{} {}v{}' class=z /><path d='{}' class=l /><path d='{}' class=d />", middle,
                       top, height, bars, dots) +
           "<g class=e>" + names + "</g>" + figures + text(middle, top - 5, "means, in tolerances", "t") +
           text(left + width / 4, top + height + 11, "−1") + text(middle, top + height + 11, "0") +
           text(left + 3 * width / 4, top + height + 11, "1");
}

std::string scale(int x, int y, const Palette& palette, const std::string& first) {
    std::string out = text(x - 4, y + scale_below + 7, first, "e");
    for (std::size_t i = 0; i < palette.size(); ++i)
        out += fmt::format("<rect x='{}' y='{}' width='6' height='7' fill='#{:06x}'/>",
                           x + 6 * static_cast<int>(i), y + scale_below, palette[i]);
    return out;
}

std::string frames(int y, const std::array<const char*, 3>& names) {
    std::string out;
    for (int i = 0; i < 3; ++i) {
        out += fmt::format("<rect x='{0}' y='{1}' width='{2}' height='{2}' class=x />", columns[i], y, side);
        out += text(columns[i] + side / 2, y - 5, names[i], "t");
    }
    return out;
}

std::string scale_of_residuals(int x, int y) {
    return scale(x, y, residuals(), "−7") + text(x + 94, y + scale_below + 7, "+7", "s");
}

// What the histograms of all lobes have in common.
std::string histograms_of_directions() {
    return frames(rows[0], {"directions, measured", "directions, expected", "difference, in σ"}) +
           scale(columns[0], rows[0], amounts(), "0") + scale_of_residuals(columns[2], rows[0]);
}
std::string histograms_of_pivots() {
    std::string out =
        frames(rows[1], {"pivots, difference in σ", "pivot 1 over expected", "pivot 2 over expected"}) +
        scale_of_residuals(columns[0], rows[1]) + labels_below(columns[0], rows[1], {"0", "pivot 2", "1"}) +
        labels_beside(columns[0], rows[1], {"0", "pivot 1", "1"});
    for (int i = 1; i < 3; ++i) out += labels_below(columns[i], rows[1], {"0", "½", "1"});
    return out;
}

}  // namespace

double deviations(double count, double expected) {
    return 2 * (std::sqrt(count + 0.375) - std::sqrt(expected + 0.375));  // Anscombe
}

std::string picture_definitions() {
    return "<svg width='0' height='0' style='position:absolute' aria-hidden=true><defs><g id=directions>" +
           histograms_of_directions() + "</g><g id=pivots>" + histograms_of_pivots() + "</g></defs></svg>";
}

std::string draw(const LobePicture& picture) {
    const bool has_directions = !picture.directions.observed.empty(),
               has_pivots = !picture.pivots.observed.empty();
    std::string out =
        fmt::format("<svg viewBox='0 0 760 {}' class=p role=img aria-label='histograms and means of a lobe'>",
                    has_directions && !has_pivots ? 176 : 345);
    if (!has_directions)
        out += text(columns[0], rows[0] + 20,
                    "Directions rounded to this type lie too far apart for histograms", "s") +
               text(columns[0], rows[0] + 34, "of this lobe: it is judged pointwise, and by its means.", "s");
    if (has_directions) out += directions(picture) + "<use href='#directions'/>";
    if (has_pivots) out += pivots(picture) + "<use href='#pivots'/>";
    return out + means(picture.means, picture.notes) + "</svg>\n";
}

}  // namespace vndf::conformance
