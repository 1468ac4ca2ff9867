// PNG files of any depth and kind of colour, written without compression.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace vndf {

enum class PngColour { grey = 0, rgb = 2, palette = 3, grey_alpha = 4, rgba = 6 };

inline std::string big_endian(std::uint32_t x) {
    std::string bytes;
    for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(x >> shift & 0xFF);
    return bytes;
}

inline std::string png_chunk(const std::string& type, const std::string& data) {
    std::uint32_t crc = 0xFFFFFFFF;
    for (const char c : type + data) {
        crc ^= static_cast<unsigned char>(c);
        for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (crc & 1 ? 0xEDB88320u : 0);
    }
    return big_endian(static_cast<std::uint32_t>(data.size())) + type + data + big_endian(~crc);
}

// Blocks of deflate that store what they hold.
inline std::string zlib_stored(const std::string& data) {
    constexpr std::size_t longest = 65535;
    std::string bytes = "\x78\x01";
    for (std::size_t at = 0; at == 0 || at < data.size(); at += longest) {
        const std::string block = data.substr(at, longest);
        bytes += at + longest >= data.size() ? '\1' : '\0';
        const auto size = static_cast<std::uint32_t>(block.size());
        for (const std::uint32_t word : {size, ~size})
            for (int shift = 0; shift <= 8; shift += 8) bytes += static_cast<char>(word >> shift & 0xFF);
        bytes += block;
    }
    std::uint32_t a = 1, b = 0;
    for (const char c : data) {
        a = (a + static_cast<unsigned char>(c)) % 65521;
        b = (b + a) % 65521;
    }
    return bytes + big_endian(b << 16 | a);
}

// `rows`: packed as the format has them. `extra`: chunks between header and pixels.
inline std::string png_file(std::uint32_t width, std::uint32_t height, int depth, PngColour colour,
                            const std::vector<std::string>& rows, const std::string& extra = {}) {
    std::string pixels;
    for (const std::string& row : rows) pixels += '\0' + row;
    const std::string header = big_endian(width) + big_endian(height) + static_cast<char>(depth) +
                               static_cast<char>(colour) + std::string(3, '\0');
    return "\x89PNG\r\n\x1A\n" + png_chunk("IHDR", header) + extra + png_chunk("IDAT", zlib_stored(pixels)) +
           png_chunk("IEND", "");
}

}  // namespace vndf
