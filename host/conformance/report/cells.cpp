#include "conformance/report/cells.h"

#include <array>
#include <cmath>

#include "base64.h"
#include "png_file.h"

namespace vndf::conformance {
namespace {

// `count` colours along a line through the anchors.
Palette through(const std::vector<std::uint32_t>& anchors, std::size_t count) {
    Palette palette;
    for (std::size_t i = 0; i < count; ++i) {
        const double at = static_cast<double>(i * (anchors.size() - 1)) / static_cast<double>(count - 1);
        const auto below = std::min(static_cast<std::size_t>(at), anchors.size() - 2);
        std::uint32_t colour = 0;
        for (int shift = 16; shift >= 0; shift -= 8) {
            const double a = anchors[below] >> shift & 255, b = anchors[below + 1] >> shift & 255;
            colour |= static_cast<std::uint32_t>(std::lround(a + (b - a) * (at - static_cast<double>(below))))
                      << shift;
        }
        palette.push_back(colour);
    }
    return palette;
}

}  // namespace

const Palette& amounts() {
    static const Palette palette = through({0xFFFFFF, 0xC7E9B4, 0x41B6C4, 0x225EA8, 0x081D58}, 16);
    return palette;
}

const Palette& residuals() {
    static const Palette palette =
        through({0x053061, 0x2166AC, 0x92C5DE, 0xF7F7F7, 0xFDB863, 0xB35806, 0x5F2B02}, 15);
    return palette;
}

std::string image_of_cells(std::size_t columns, const std::vector<std::uint8_t>& colours,
                           const Palette& palette) {
    std::vector<std::string> rows;
    for (std::size_t i = 0; i < colours.size(); ++i) {
        if (i % columns == 0) rows.emplace_back();
        if (i % columns % 2 == 0)
            rows.back() += static_cast<char>(colours[i] << 4);
        else
            rows.back().back() |= static_cast<char>(colours[i]);
    }
    std::string table;
    for (const std::uint32_t colour : palette) table += big_endian(colour).substr(1);
    return "data:image/png;base64," +
           base64(png_file(static_cast<std::uint32_t>(columns), static_cast<std::uint32_t>(rows.size()), 4,
                           PngColour::palette, rows, png_chunk("PLTE", table)));
}

}  // namespace vndf::conformance
