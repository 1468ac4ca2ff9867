// Radiance pictures: a header of lines, then scan lines of red, green, blue and a common exponent, run-length encoded in either of
// two ways or not at all.
// Source: Ward, Real Pixels, Graphics Gems II, 1991; Radiance's filefmts.pdf.
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include <fmt/format.h>

#include "error.h"
#include "render/lat_long.h"

namespace vndf::render {
namespace {

using Pixel = std::array<unsigned char, 4>;

class Hdr {
  public:
    Hdr(std::string_view bytes, const std::string& name) : rest_(bytes), name_(name) {}

    LatLong read() {
        header();
        LatLong image = size();
        std::vector<Pixel> row(image.width);
        // Row by row, so that memory follows what is there.
        for (std::uint32_t y = 0; y < image.height; ++y) {
            scan_line(row);
            for (const Pixel& pixel : row) {
                const double scale = pixel[3] == 0 ? 0 : std::ldexp(1 / exposure_, pixel[3] - 136);
                for (int c = 0; c < 3; ++c) image.pixels.push_back(static_cast<float>(pixel[c] * scale));
            }
        }
        return image;
    }

  private:
    [[noreturn]] void fail(const std::string& what) const {
        throw InputError(fmt::format("{}: {}", name_, what));
    }

    std::string_view take(std::size_t count) {
        if (rest_.size() < count) fail("the file ends before the picture does");
        const std::string_view taken = rest_.substr(0, count);
        rest_.remove_prefix(count);
        return taken;
    }
    unsigned byte() { return static_cast<unsigned char>(take(1)[0]); }
    std::string_view line() {
        const std::string_view taken = take(rest_.find('\n') + 1);  // nothing if there is no end
        if (taken.empty()) fail("the file ends before the picture does");
        return taken.substr(0, taken.size() - 1);
    }

    void header() {
        if (!line().starts_with("#?")) fail("no Radiance picture, which begins with #?");
        for (std::string_view text = line(); !text.empty(); text = line()) {
            if (text.starts_with("FORMAT=") && text != "FORMAT=32-bit_rle_rgbe")
                fail(fmt::format("'{}': FORMAT=32-bit_rle_rgbe is allowed", text.substr(0, 40)));
            if (text.starts_with("EXPOSURE=")) exposure_ *= exposure(text.substr(9));
        }
        if (!(exposure_ > 1e-30 && exposure_ < 1e30)) fail("EXPOSURE: no number from 1e-30 to 1e30");
    }
    // Pixels have been multiplied by it; by several, one after the other.
    double exposure(std::string_view text) const {
        text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
        double value = 0;
        std::from_chars(text.data(), text.data() + text.size(), value);
        return value;
    }

    LatLong size() {
        const std::string_view text = line();
        LatLong image;
        std::string_view left = text;
        const bool read =
            number(left, "-Y ", image.height) && number(left, " +X ", image.width) && left.empty();
        if (!read) fail(fmt::format("'{}': no size such as -Y 512 +X 1024", text.substr(0, 40)));
        require_size(image.width, image.height, name_);
        return image;
    }
    static bool number(std::string_view& text, std::string_view before, std::uint32_t& value) {
        if (!text.starts_with(before)) return false;
        text.remove_prefix(before.size());
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        text.remove_prefix(end - text.data());
        return error == std::errc();
    }

    void scan_line(std::vector<Pixel>& row) {
        const std::string_view four = rest_.substr(0, 4);
        const bool by_channel = row.size() >= 8 && row.size() < 32768 && four.size() == 4 && four[0] == 2 &&
                                four[1] == 2 && static_cast<unsigned char>(four[2]) < 128;
        by_channel ? channels(row) : pixels(row);
    }

    // Each channel by itself: a byte n > 128 repeats the next one n - 128 times, another one is followed by n as they are.
    void channels(std::vector<Pixel>& row) {
        take(2);
        if (const unsigned high = byte(), length = high << 8 | byte(); length != row.size())
            fail(fmt::format("a scan line of {} pixels; {} are announced", length, row.size()));
        for (int c = 0; c < 4; ++c)
            for (std::size_t x = 0; x < row.size();) {
                const unsigned code = byte(), count = code > 128 ? code - 128 : code;
                if (count == 0 || count > row.size() - x) fail("a run that does not fit its scan line");
                const std::string_view values = take(code > 128 ? 1 : count);
                for (unsigned i = 0; i < count; ++i)
                    row[x++][c] = static_cast<unsigned char>(values[code > 128 ? 0 : i]);
            }
    }

    // Pixels as they are; 1, 1, 1, n repeats the one before n times, 256 n times where another such one precedes it, and so on.
    void pixels(std::vector<Pixel>& row) {
        unsigned shift = 0;
        for (std::size_t x = 0; x < row.size();) {
            const std::string_view four = take(4);
            Pixel pixel;
            for (int c = 0; c < 4; ++c) pixel[c] = static_cast<unsigned char>(four[c]);
            if (pixel[0] != 1 || pixel[1] != 1 || pixel[2] != 1) {
                row[x++] = pixel;
                shift = 0;
                continue;
            }
            const std::uint64_t count = std::uint64_t{pixel[3]} << shift;
            if (x == 0 || shift > 16 || count > row.size() - x) fail("a run that does not fit its scan line");
            for (std::uint64_t i = 0; i < count; ++i, ++x) row[x] = row[x - 1];
            shift += 8;
        }
    }

    std::string_view rest_;
    const std::string& name_;
    double exposure_ = 1;
};

}  // namespace

void require_size(std::uint64_t width, std::uint64_t height, const std::string& name) {
    const bool fits = width <= longest_side && height <= longest_side && width * height <= most_pixels;
    if (!fits || width == 0 || height == 0)
        throw InputError(fmt::format("{}: {} x {} pixels; 1 to {} are allowed, and at most {} each way", name,
                                     width, height, most_pixels, longest_side));
}

LatLong read_hdr(std::string_view bytes, const std::string& name) {
    return Hdr(bytes, name).read();
}

}  // namespace vndf::render
