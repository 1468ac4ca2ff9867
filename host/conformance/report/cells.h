// Cells of a histogram as a small picture: a PNG of at most 16 colours, as a text that a page can hold.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace vndf::conformance {

// 0xRRGGBB, at most 16 of them.
using Palette = std::vector<std::uint32_t>;

// White, for nothing, to dark blue.
const Palette& amounts();
// Blue, for too few, over white to brown, for too many: 15 steps that those with any colour vision tell apart.
const Palette& residuals();

// The colours of the cells, row by row from the top, as "data:image/png;base64,...".
std::string image_of_cells(std::size_t columns, const std::vector<std::uint8_t>& colours,
                           const Palette& palette);

}  // namespace vndf::conformance
