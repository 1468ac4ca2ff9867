// Environments: images as they are in files, resampled, and drawn from.
//
// CLVNDF_SCENES names the folder of real files, which are read beside those made here.
#include <fmt/format.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <limits>
#include <numbers>
#include <random>

#include "error.h"
#include "kernels/render/environment.h"
#include "render/environment.h"
#include "support/command.h"

#if CLVNDF_OPENEXR
#include <ImfArray.h>
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <ImfStandardAttributes.h>
#include <ImfTiledOutputFile.h>
#endif

using namespace vndf;
using render::Environment;
using render::LatLong;

namespace {

constexpr double pi = std::numbers::pi;

// ---- images ----

LatLong filled(std::uint32_t width, std::uint32_t height, std::array<float, 3> rgb) {
    LatLong image{width, height, {}};
    for (std::uint32_t i = 0; i < width * height; ++i)
        image.pixels.insert(image.pixels.end(), rgb.begin(), rgb.end());
    return image;
}
LatLong noise(std::uint32_t width, std::uint32_t height, unsigned seed) {
    std::mt19937 random(seed);
    std::exponential_distribution<float> level;
    LatLong image = filled(width, height, {});
    for (float& x : image.pixels) x = level(random);
    return image;
}
// By a function of the direction, at the middles of the pixels.
LatLong of(std::uint32_t width, std::uint32_t height,
           const std::function<float(std::array<double, 3>)>& level) {
    LatLong image = filled(width, height, {});
    for (std::uint32_t y = 0; y < height; ++y)
        for (std::uint32_t x = 0; x < width; ++x) {
            const double longitude = pi * (1 - 2 * (x + 0.5) / width),
                         latitude = pi * (0.5 - (y + 0.5) / height);
            const std::array<double, 3> d{std::sin(longitude) * std::cos(latitude), std::sin(latitude),
                                          std::cos(longitude) * std::cos(latitude)};
            for (int c = 0; c < 3; ++c) image.pixels[3 * (y * width + x) + c] = level(d);
        }
    return image;
}
// The mean over all directions, of pixels as areas.
double mean(const LatLong& image, int channel) {
    double sum = 0;
    for (std::uint32_t y = 0; y < image.height; ++y) {
        const double area = std::cos(pi * y / image.height) - std::cos(pi * (y + 1) / image.height);
        for (std::uint32_t x = 0; x < image.width; ++x)
            sum += area / 2 / image.width * image.pixels[3 * (y * image.width + x) + channel];
    }
    return sum;
}

float radiance(const Environment& e, std::array<double, 3> d, int channel = 0) {
    const double length = std::hypot(d[0], d[1], d[2]);
    const vndf_render_vector v =
        vndf_render_env_radiance(e.radiance.data(), e.side,
                                 {static_cast<float>(d[0] / length), static_cast<float>(d[1] / length),
                                  static_cast<float>(d[2] / length)});
    return std::array{v.x, v.y, v.z}[channel];
}

// ---- files ----

const std::string head = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n";
std::string size_line(unsigned width, unsigned height) {
    return fmt::format("-Y {} +X {}\n", height, width);
}

using Rgbe = std::array<unsigned char, 4>;
// Single ones, then runs among them, none of which is mistaken for a run or a code.
std::vector<Rgbe> rgbe_pixels(unsigned count, unsigned seed) {
    std::mt19937 random(seed);
    std::vector<Rgbe> pixels;
    while (pixels.size() < count) {
        Rgbe pixel;
        for (unsigned char& byte : pixel) byte = static_cast<unsigned char>(3 + random() % 200);
        pixels.insert(pixels.end(), 1 + (pixels.size() > count / 3 && random() % 3 == 0 ? random() % 700 : 0),
                      pixel);
    }
    pixels.resize(count);
    pixels[count / 2][3] = 0;  // black
    return pixels;
}
std::string bytes_of(const Rgbe& pixel) {
    return {reinterpret_cast<const char*>(pixel.data()), 4};
}
std::string flat(unsigned width, unsigned height, const std::vector<Rgbe>& pixels) {
    std::string file = head + size_line(width, height);
    for (const Rgbe& pixel : pixels) file += bytes_of(pixel);
    return file;
}
std::string old_runs(unsigned width, unsigned height, const std::vector<Rgbe>& pixels) {
    std::string file = head + size_line(width, height);
    for (unsigned y = 0; y < height; ++y)
        for (unsigned x = 0; x < width;) {
            const Rgbe* pixel = &pixels[y * width + x];
            unsigned more = 0;
            while (x + more + 1 < width && pixel[more + 1] == *pixel) ++more;
            file += bytes_of(*pixel);
            x += more + 1;
            for (; more > 0; more >>= 8) file += bytes_of({1, 1, 1, static_cast<unsigned char>(more & 255)});
        }
    return file;
}
std::string new_runs(unsigned width, unsigned height, const std::vector<Rgbe>& pixels) {
    std::string file = head + size_line(width, height);
    for (unsigned y = 0; y < height; ++y) {
        file += {2, 2, static_cast<char>(width >> 8), static_cast<char>(width & 255)};
        for (int c = 0; c < 4; ++c)
            for (unsigned x = 0; x < width;) {
                const auto value = [&](unsigned i) { return static_cast<char>(pixels[y * width + i][c]); };
                unsigned run = 1, others = 1;
                while (x + run < width && run < 127 && value(x + run) == value(x)) ++run;
                while (x + others < width && others < 128 && value(x + others) != value(x + others - 1))
                    ++others;
                if (run > 1) {
                    file += {static_cast<char>(128 + run), value(x)};
                    x += run;
                } else {
                    file += static_cast<char>(others);
                    for (unsigned i = 0; i < others; ++i) file += value(x++);
                }
            }
    }
    return file;
}

// What reading ends with: "" or its message, of one line.
std::string refusal(const std::function<void()>& read) {
    try {
        read();
        return "";
    } catch (const InputError& error) {
        const std::string what = error.what();
        CHECK_FALSE(what.empty());
        CHECK(what.find('\n') == std::string::npos);
        return what;
    }
}
std::string hdr_refusal(const std::string& bytes) {
    return refusal([&] { render::read_hdr(bytes, "a.hdr"); });
}
std::string file_refusal(const std::filesystem::path& file) {
    std::vector<std::string> warnings;
    return refusal([&] { render::read_environment(file, warnings); });
}

bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("Radiance pictures are read without runs, with old ones and with new ones") {
    for (const unsigned width : {1u, 7u, 8u, 300u, 1500u}) {
        CAPTURE(width);
        const std::vector<Rgbe> pixels = rgbe_pixels(width * 3, width);
        std::vector<float> expected;
        for (const Rgbe& pixel : pixels)
            for (int c = 0; c < 3; ++c)
                expected.push_back(pixel[3] == 0 ? 0.0f
                                                 : std::ldexp(static_cast<float>(pixel[c]), pixel[3] - 136));
        for (const std::string& file :
             {flat(width, 3, pixels), old_runs(width, 3, pixels), new_runs(width, 3, pixels)}) {
            if (width < 8 && file == new_runs(width, 3, pixels)) continue;  // has none
            const LatLong image = render::read_hdr(file, "a.hdr");
            CHECK((image.width == width && image.height == 3));
            CHECK(image.pixels == expected);
        }
    }
}

TEST_CASE("what a Radiance picture has been multiplied by is taken back") {
    const std::string pixel = bytes_of({128, 64, 32, 129});  // 1, 1/2, 1/4
    const auto read = [&](const std::string& lines) {
        return render::read_hdr("#?RADIANCE\n" + lines + "\n-Y 1 +X 1\n" + pixel, "a.hdr").pixels;
    };
    CHECK(read("") == std::vector<float>{1, 0.5f, 0.25f});
    CHECK(read("EXPOSURE=4\nGAMMA=1\nEXPOSURE= 0.5\n") == std::vector<float>{0.5f, 0.25f, 0.125f});
    for (const char* wrong :
         {"EXPOSURE=0\n", "EXPOSURE=-1\n", "EXPOSURE=x\n", "EXPOSURE=nan\n", "EXPOSURE=1e31\n"})
        CHECK(has(refusal([&] { read(wrong); }), "EXPOSURE"));
}

TEST_CASE("Radiance pictures that are none are refused in a line that says why") {
    const auto refused = [](const std::string& bytes, const std::string& part) {
        CAPTURE(bytes, part);
        const std::string what = hdr_refusal(bytes);
        CHECK(has(what, part));
        CHECK(has(what, "a.hdr: "));
    };
    const std::string row = head + "-Y 1 +X 9\n";
    refused("", "file ends");
    refused("P6\n", "#?");
    refused("#?RADIANCE", "file ends");
    refused("#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n", "FORMAT");
    refused(head + "+X 9 -Y 1\n", "no size");
    refused(head + "-Y 1 +X 9 \n", "no size");
    refused(head + "-Y 99999999999 +X 9\n", "no size");
    refused(head + "-Y -1 +X 9\n", "no size");
    refused(head + "-Y 0 +X 9\n", "0 pixels");
    refused(head + "-Y 40000 +X 40000\n", "40000 x 40000");
    refused(row, "file ends");
    refused(row + std::string("\2\2\0\10", 4), "scan line of 8");
    refused(row + std::string("\2\2\0\11\0", 5), "does not fit");
    refused(row + std::string("\2\2\0\11\212x", 6), "does not fit");           // ten times
    refused(row + std::string("\2\2\0\11\12abcdefghij", 15), "does not fit");  // ten of their own
    refused(row + std::string("\1\1\1\1", 4), "does not fit");                 // nothing to repeat
    refused(row + std::string("abcd\1\1\1\11", 8), "does not fit");
    refused(row + std::string("abcd\1\1\1\0\1\1\1\0\1\1\1\0\1\1\1\0", 20), "does not fit");
}

TEST_CASE("damaged Radiance pictures are read or refused, cut anywhere or with any byte changed") {
    const std::vector<Rgbe> pixels = rgbe_pixels(40 * 4, 2);
    int read = 0, refused = 0;
    const auto look = [&](const std::string& bytes) { ++(hdr_refusal(bytes).empty() ? read : refused); };
    for (const std::string& file : {flat(40, 4, pixels), old_runs(40, 4, pixels), new_runs(40, 4, pixels)}) {
        for (std::size_t length = 0; length < file.size(); ++length) {
            look(file.substr(0, length));
            CHECK(refused > 0);
        }
        CHECK(read == 0);
        for (std::size_t i = 0; i < file.size(); ++i)
            for (const int flip : {1, 2, 4, 8, 16, 32, 64, 128, 255}) {
                std::string damaged = file;
                damaged[i] = static_cast<char>(damaged[i] ^ flip);
                look(damaged);
            }
        CHECK(read > 0);
        CHECK(refused > 300);
        read = refused = 0;
    }
}

TEST_CASE("what is no environment is refused, and what is no light is counted") {
    const Folder folder;
    CHECK(has(file_refusal(folder / "none.hdr"), "none.hdr: no file"));
    CHECK(has(file_refusal(folder / ""), "no file"));
    folder.write("text.hdr", "hello");
    CHECK(has(file_refusal(folder / "text.hdr"), "neither"));
    folder.write("empty.exr", "");
    CHECK(has(file_refusal(folder / "empty.exr"), "neither"));

    std::vector<std::string> warnings;
    folder.write("a.hdr", flat(8, 4, rgbe_pixels(32, 1)));
    render::read_environment(folder / "a.hdr", warnings);
    CHECK(warnings.empty());
    folder.write("a.hdr", flat(8, 3, rgbe_pixels(24, 1)));
    render::read_environment(folder / "a.hdr", warnings);
    REQUIRE(warnings.size() == 1);
    CHECK(has(warnings[0], "a.hdr: 8 x 3 pixels"));
}

#if CLVNDF_OPENEXR

namespace {

// What the files below differ in.
struct Exr {
    std::vector<std::string> channels{"R", "G", "B"};
    Imf::PixelType type = Imf::FLOAT;
    int tile = 0;                 // pixels; 0: scan lines
    bool levels = false;          // mip-mapped
    int x = 0, y = 0, shown = 0;  // where the data window begins; the display window goes so far around it
    int sampling = 1;
    std::function<void(Imf::Header&)> change = [](Imf::Header&) {};
};

// Channel c of pixel i is i + c / 4, exact as a half.
std::string exr(const Folder& folder, int width, int height, const Exr& kind) {
    const Imath::Box2i data({kind.x, kind.y}, {kind.x + width - 1, kind.y + height - 1});
    Imath::Box2i display = data;
    display.min -= Imath::V2i(kind.shown);
    display.max += Imath::V2i(kind.shown);
    Imf::Header header(display, data);
    header.compression() = Imf::ZIP_COMPRESSION;
    kind.change(header);
    const std::size_t count = static_cast<std::size_t>(width) * height, size = kind.type == Imf::HALF ? 2 : 4;
    std::vector<std::vector<char>> planes;
    Imf::FrameBuffer frame;
    for (std::size_t c = 0; c < kind.channels.size(); ++c) {
        std::vector<char>& plane = planes.emplace_back(count * size);
        for (std::size_t i = 0; i < count; ++i) {
            const float value = static_cast<float>(i) + static_cast<float>(c) / 4;
            const half as_half(value);
            const unsigned as_uint = static_cast<unsigned>(i);
            std::memcpy(&plane[i * size],
                        kind.type == Imf::HALF   ? static_cast<const void*>(&as_half)
                        : kind.type == Imf::UINT ? static_cast<const void*>(&as_uint)
                                                 : &value,
                        size);
        }
        header.channels().insert(kind.channels[c], Imf::Channel(kind.type, kind.sampling, kind.sampling));
        frame.insert(kind.channels[c],
                     Imf::Slice::Make(kind.type, planes.back().data(), data, size,
                                      size * width / kind.sampling, kind.sampling, kind.sampling));
    }
    const std::string path = (folder / "made.exr").string();
    if (kind.tile == 0) {
        Imf::OutputFile file(path.c_str(), header);
        file.setFrameBuffer(frame);
        file.writePixels(height);
    } else {
        header.setTileDescription(
            Imf::TileDescription(kind.tile, kind.tile, kind.levels ? Imf::MIPMAP_LEVELS : Imf::ONE_LEVEL));
        Imf::TiledOutputFile file(path.c_str(), header);
        file.setFrameBuffer(frame);
        for (int level = 0; level < file.numLevels();
             ++level)  // the lower ones are wrong, and not to be read
            file.writeTiles(0, file.numXTiles(level) - 1, 0, file.numYTiles(level) - 1, level);
    }
    return folder.read("made.exr");
}
std::string exr_refusal(const std::string& bytes) {
    return refusal([&] { render::read_exr(bytes, "a.exr"); });
}

}  // namespace

TEST_CASE(
    "OpenEXR images are read by scan lines, tiles and levels, half and float, wherever their data are") {
    const Folder folder;
    const std::vector<std::string> rgba{"R", "G", "B", "A"};
    std::vector<Exr> kinds(9);
    kinds[1].type = Imf::HALF;
    kinds[2].tile = 4;
    kinds[3].tile = 4, kinds[3].levels = true, kinds[3].type = Imf::HALF;
    kinds[4].x = -7, kinds[4].y = 12345;
    kinds[5].shown = 5;
    kinds[6].x = 3, kinds[6].y = 2, kinds[6].shown = -2;  // a display window inside
    kinds[7].channels = rgba;
    kinds[8].change = [](Imf::Header& header) { Imf::addEnvmap(header, Imf::ENVMAP_LATLONG); };
    for (std::size_t k = 0; k < kinds.size(); ++k) {
        CAPTURE(k);
        const LatLong image = render::read_exr(exr(folder, 12, 6, kinds[k]), "a.exr");
        CHECK((image.width == 12 && image.height == 6));
        int wrong = 0;
        for (std::size_t i = 0; i < image.pixels.size(); ++i)
            wrong += image.pixels[i] != static_cast<float>(i / 3) + static_cast<float>(i % 3) / 4;
        CHECK(wrong == 0);
    }
    Exr grey;
    grey.channels = {"Y"};
    const LatLong image = render::read_exr(exr(folder, 12, 6, grey), "a.exr");
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        REQUIRE(image.pixels[i] == static_cast<float>(i / 3));
}

TEST_CASE("OpenEXR images that are no environment are refused in a line that says why") {
    const Folder folder;
    const auto refused = [&](const Exr& kind, const std::string& part) {
        CAPTURE(part);
        CHECK(has(exr_refusal(exr(folder, 12, 6, kind)), part));
    };
    refused({.channels = {"R", "G"}}, "no channel B among G, R");
    refused({.channels = {"G"}}, "no channel R among G");
    refused({.channels = {"Y", "RY", "BY"}}, "no channel R");
    refused({.type = Imf::UINT}, "channel R is of integers");
    refused({.sampling = 2}, "channel R has not every pixel");
    refused({.change = [](Imf::Header& header) { Imf::addEnvmap(header, Imf::ENVMAP_CUBE); }}, "cube");
    std::string typed =
        exr(folder, 12, 6, {.change = [](Imf::Header& header) { header.setType("scanlineimage"); }});
    CHECK(exr_refusal(typed) == "");
    CHECK(has(exr_refusal(typed.replace(typed.find("scanlineimage"), 13, "deepscanlines")),
              "type is 'deepscanlines'"));
    std::vector<std::string> many{"R", "G", "B"};
    for (int i = 0; i < 80; ++i) many.push_back(fmt::format("more{}", i));
    refused({.channels = many}, "64 channels");

    // By changing bytes of a file that is right.
    const std::string file = exr(folder, 12, 6, {.tile = 4});
    const auto changed = [&](const std::string& behind, std::size_t offset, const std::string& bytes) {
        std::string other = file;
        return other.replace(other.find(behind) + behind.size() + offset, bytes.size(), bytes);
    };
    const std::string window("dataWindow\0box2i\0\x10\0\0\0", 21), tiles("tiles\0tiledesc\0\x9\0\0\0", 19);
    CHECK(exr_refusal(file) == "");
    CHECK(has(exr_refusal(changed(window, 8, std::string("\xff\xff\xff\x0f", 4))), "pixels; 1 to"));
    CHECK(has(exr_refusal(changed(window, 8, std::string("\xff\xff\xff\xff", 4))), "a.exr: "));
    CHECK(has(exr_refusal(changed(window, 8, std::string("\xff\x7f\0\0\xff\x03\0\0", 8))), "more tiles"));
    CHECK(has(exr_refusal(changed(tiles, 0, std::string("\0\0\1\0\0\0\1\0", 8))), "tiles of 65536 x 65536"));
    CHECK(has(exr_refusal(changed(tiles, -4, std::string("\xff\xff\xff\x7f", 4))), "ends beyond the file"));
    CHECK(
        has(exr_refusal(changed(std::string("\x76\x2f\x31\1", 4), 0, std::string("\2\x0a\0\0", 4))), "deep"));
    CHECK(has(exr_refusal(changed(std::string("\x76\x2f\x31\1", 4), 0, std::string("\2\x10\0\0", 4))),
              "parts"));
}

TEST_CASE("damaged OpenEXR images are read or refused, cut anywhere or with any byte changed") {
    const Folder folder;
    for (const int tile : {0, 4}) {
        const std::string file = exr(folder, 12, 6, {.type = Imf::HALF, .tile = tile});
        int read = 0, refused = 0;
        const auto look = [&](const std::string& bytes) { ++(exr_refusal(bytes).empty() ? read : refused); };
        for (std::size_t length = 0; length < file.size(); ++length) look(file.substr(0, length));
        CHECK(read == 0);
        for (std::size_t i = 0; i < file.size(); ++i)
            for (const int flip : {1, 16, 128, 255}) {
                std::string damaged = file;
                damaged[i] = static_cast<char>(damaged[i] ^ flip);
                look(damaged);
            }
        CHECK(read > 0);
        CHECK(refused > 500);
    }
}

TEST_CASE("pixels of an image that are no light are taken as black, and counted") {
    const Folder folder;
    // Values of a float file, by their bytes, without compression.
    Exr plain;
    plain.change = [](Imf::Header& header) { header.compression() = Imf::NO_COMPRESSION; };
    std::string file = exr(folder, 8, 4, plain);
    const auto put = [&](std::size_t back, float value) {
        std::memcpy(&file[file.size() - 4 * back], &value, 4);
    };
    put(1, std::numeric_limits<float>::quiet_NaN());
    put(2, std::numeric_limits<float>::infinity());
    put(3, -std::numeric_limits<float>::infinity());
    put(4, -1);
    put(5, 3e38f);
    folder.write("bad.exr", file);
    std::vector<std::string> warnings;
    const Environment e = render::read_environment(folder / "bad.exr", warnings);
    REQUIRE(warnings.size() == 2);
    CHECK(has(warnings[0], "3 values that are no finite numbers"));
    CHECK(has(warnings[1], "1 values below 0"));
    for (const auto* table : {&e.radiance, &e.pdf, &e.keep})
        for (const float x : *table) REQUIRE((std::isfinite(x) && x >= 0));
}

#endif

TEST_CASE("an image of one colour is that everywhere, and drawn from evenly") {
    const Environment e = render::environment_of(filled(64, 32, {1, 2, 0.3f}), 77);
    REQUIRE(e.side == 32);
    const std::size_t n = e.radiance.size() / 3;
    for (std::size_t i = 0; i < n; ++i)
        REQUIRE((e.radiance[i] == 1 && e.radiance[n + i] == 2 && e.radiance[2 * n + i] == 0.3f));
    for (const float p : e.pdf) REQUIRE(std::abs(p * 4 * pi - 1) <= 0x1p-22);
    CHECK(render::mean_radiance(e) == render::Vec{1, 2, 0.3f});
}

TEST_CASE("an image keeps its light") {
    // Noise of every size; and a pixel alone, which the cells share.
    for (const auto& [width, height] :
         {std::pair{2u, 1u}, {64u, 32u}, {300u, 150u}, {1024u, 512u}, {2100u, 1000u}}) {
        CAPTURE(width);
        const LatLong image = noise(width, height, width);
        const render::Vec found = render::mean_radiance(render::environment_of(image, 31));
        for (int c = 0; c < 3; ++c) CHECK(std::abs(found[c] / mean(image, c) - 1) <= (height > 1 ? 1e-3 : 1));
    }
    std::mt19937 random(8);
    for (int i = 0; i < 20; ++i) {
        LatLong image = filled(128, 64, {});
        const std::size_t pixel = (4 + random() % 56) * 128 + random() % 128;
        image.pixels[3 * pixel] = 1000;
        const double found = render::mean_radiance(render::environment_of(image))[0];
        CHECK(std::abs(found / mean(image, 0) - 1) <= 5e-3);
    }
}

TEST_CASE("directions are where OpenEXR has them, turned by the rotation") {
    const auto level = [](std::array<double, 3> d) {
        const double cosine = std::max(0.0, d[0] * 0.6 + d[1] * 0.48 + d[2] * 0.64);
        return static_cast<float>(0.1 + std::pow(cosine, 20));
    };
    const LatLong image = of(512, 256, level);
    CHECK(image.pixels[3 * (128 * 512 + 128)] >
          image.pixels[3 * (128 * 512 + 384)]);  // +x is left of the middle
    for (const double degrees : {0.0, 90.0, -30.0, 400.0}) {
        CAPTURE(degrees);
        const Environment e = render::environment_of(image, static_cast<float>(degrees));
        const double s = std::sin(degrees * pi / 180), c = std::cos(degrees * pi / 180);
        std::mt19937 random(9);
        std::normal_distribution<double> normal;
        double worst = 0;
        for (int i = 0; i < 20000; ++i) {
            std::array<double, 3> d{normal(random), normal(random), normal(random)};
            const double length = std::hypot(d[0], d[1], d[2]);
            for (double& x : d) x /= length;
            // Seen from above, x to the right and z down: counterclockwise is from z to x.
            const std::array<double, 3> turned{c * d[0] + s * d[2], d[1], c * d[2] - s * d[0]};
            worst = std::max(worst, std::abs(double{radiance(e, turned)} - level(d)));
        }
        // Half a cell where the square is folded.
        CHECK(worst < 0.02);
    }
}

TEST_CASE("between cells and across the edges of the square the light does not jump") {
    const Environment e = render::environment_of(noise(64, 32, 6));
    const auto at = [&](double x, double y) {
        return vndf_render_env_at(e.radiance.data(), e.side, {static_cast<float>(x), static_cast<float>(y)})
            .x;
    };
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform;
    double largest = 0, jump = 0;
    for (int i = 0; i < 20000; ++i) {
        const double x = uniform(random), y = uniform(random), step = 1e-5;
        largest = std::max(largest, static_cast<double>(at(x, y)));
        for (const double edge : {0.0, 1.0}) {
            jump = std::max<double>(jump, std::abs(at(edge, y) - at(edge, 1 - y)));
            jump = std::max<double>(jump, std::abs(at(y, edge) - at(1 - y, edge)));
        }
        jump = std::max<double>(jump, std::abs(at(x, y) - at(std::min(x + step, 1.0), y)));
        // At the middles of cells, and at their borders.
        const double border = std::floor(x * e.side) / e.side;
        jump = std::max<double>(jump, std::abs(at(border, y) - at(std::max(border - step, 0.0), y)));
    }
    for (const double x : {0.0, 1.0})
        for (const double y : {0.0, 1.0}) jump = std::max<double>(jump, std::abs(at(x, y) - at(0, 0)));
    CHECK(largest > 1);
    CHECK(jump < 32 * 1e-5 * 2 * largest);
}

TEST_CASE("cells are drawn exactly as their density says, and all that shine are") {
    LatLong image = noise(64, 32, 12);
    for (std::size_t i = 0; i < image.pixels.size() / 2; ++i) image.pixels[i] = 0;
    image.pixels[3] = 1e-30f;
    image.pixels[image.pixels.size() - 100] = 1e30f;
    for (const LatLong& one : {image, noise(64, 32, 13), filled(64, 32, {})}) {
        const Environment e = render::environment_of(one);
        const std::size_t n = e.pdf.size();
        std::vector<double> chance(n);
        const auto drawn = [&](std::size_t first, float c) {
            const float b = (static_cast<float>(first) + 0.5f) / static_cast<float>(n);
            const vndf_render_place p = vndf_render_octahedral_place(
                vndf_render_env_sample(e.radiance.data(), e.pdf.data(), e.keep.data(), e.other.data(), e.side,
                                       b, c, 0.5f, 0.5f)
                    .direction);
            const auto side = static_cast<float>(e.side);
            return static_cast<std::size_t>(p.y * side) * e.side + static_cast<std::size_t>(p.x * side);
        };
        for (std::size_t i = 0; i < n; ++i) {
            // Of 2^24 numbers, those below keep.
            REQUIRE(
                (e.keep[i] >= 0 && e.keep[i] <= 1 && e.keep[i] * 0x1p24f == std::floor(e.keep[i] * 0x1p24f)));
            REQUIRE(e.other[i] < n);
            if (e.keep[i] > 0) REQUIRE(drawn(i, e.keep[i] - 0x1p-24f) == i);
            if (e.keep[i] < 1) REQUIRE(drawn(i, e.keep[i]) == e.other[i]);
            chance[i] += e.keep[i];
            chance[e.other[i]] += 1 - double{e.keep[i]};
        }
        double total = 0;
        int wrong = 0, dark = 0;
        for (std::size_t i = 0; i < n; ++i) {
            total += chance[i];
            wrong += std::abs(chance[i] / (4 * pi) - e.pdf[i]) > 0x1p-24 * e.pdf[i];
            // The cell and its neighbours, which are interpolated.
            const std::size_t row = i / e.side, column = i % e.side, stride = e.side + 2;
            float brightest = 0;
            for (std::size_t y = row; y < row + 3; ++y)
                for (std::size_t x = column; x < column + 3; ++x)
                    for (std::size_t c = 0; c < 3; ++c)
                        brightest = std::max(brightest, e.radiance[(c * stride + y) * stride + x]);
            dark += brightest > 0 && !(e.pdf[i] > 0);
        }
        CHECK(total == static_cast<double>(n));
        CHECK(wrong == 0);
        CHECK(dark == 0);
    }
}

TEST_CASE("directions are drawn with their density, which integrates to 1, and carry the light there") {
    const Environment e = render::environment_of(noise(64, 32, 20));
    const std::size_t n = e.pdf.size();
    std::mt19937 random(21);
    const auto number = [&] { return static_cast<float>(random() >> 8) * 0x1p-24f; };
    constexpr int count = 1 << 21;
    std::vector<int> drawn(n);
    int elsewhere = 0, far = 0;
    double light = 0, square = 0;
    for (int i = 0; i < count; ++i) {
        const vndf_render_env_draw draw = vndf_render_env_sample(
            e.radiance.data(), e.pdf.data(), e.keep.data(), e.other.data(), e.side, number(), number(),
            i % 3 == 0 ? 0 : number(), i % 5 == 0 ? 1 - 0x1p-24f : number());
        const vndf_render_place p = vndf_render_octahedral_place(draw.direction);
        const auto column = std::min<unsigned>(static_cast<unsigned>(p.x * static_cast<float>(e.side)),
                                               e.side - 1),
                   row = std::min<unsigned>(static_cast<unsigned>(p.y * static_cast<float>(e.side)),
                                            e.side - 1);
        if (i % 3 != 0 && i % 5 != 0) ++drawn[row * e.side + column];
        // On the border of two cells rounding decides.
        elsewhere +=
            draw.pdf != vndf_render_env_pdf(e.pdf.data(), e.side, draw.direction) && i % 3 != 0 && i % 5 != 0;
        const vndf_render_vector there = vndf_render_env_radiance(e.radiance.data(), e.side, draw.direction);
        far += std::abs(there.x - draw.radiance.x) + std::abs(there.y - draw.radiance.y) +
                   std::abs(there.z - draw.radiance.z) >
               1e-4f;
        if (i % 3 == 0 || i % 5 == 0) continue;
        const double weighed = draw.radiance.x / draw.pdf;
        light += weighed;
        square += weighed * weighed;
    }
    int inside = 0;
    for (const int k : drawn) inside += k;
    double chi2 = 0, integral = 0;
    for (std::size_t i = 0; i < n; ++i) {
        const double expected = inside * e.pdf[i] * 4 * pi / static_cast<double>(n);
        chi2 += (drawn[i] - expected) * (drawn[i] - expected) / expected;
        integral += e.pdf[i] * 4 * pi / static_cast<double>(n);
    }
    CHECK(std::abs(integral - 1) < 1e-6);
    // n - 1 degrees of freedom; five standard deviations.
    CHECK(std::abs(chi2 - static_cast<double>(n)) < 5 * std::sqrt(2.0 * static_cast<double>(n)));
    CHECK(elsewhere < count / 10000);
    CHECK(far == 0);
    const double estimate = light / inside,
                 error = std::sqrt((square / inside - estimate * estimate) / inside);
    CHECK(std::abs(estimate - 4 * pi * render::mean_radiance(e)[0]) < 5 * error);
}

TEST_CASE("real environments give what is said of each") {
    const char* scenes = std::getenv("CLVNDF_SCENES");
    if (!scenes) return;  // the others stand in for them
    const std::filesystem::path folder(scenes);
    const auto read = [&](const std::string& file, std::vector<std::string>& warnings) {
        CAPTURE(file);
        Environment e;
        CHECK(refusal([&] { e = render::read_environment(folder / file, warnings); }) == "");
        for (const auto* table : {&e.radiance, &e.pdf, &e.keep})
            CHECK(std::all_of(table->begin(), table->end(),
                              [](float x) { return std::isfinite(x) && x >= 0; }));
        return e;
    };
    for (const char* good : {"env/venice_sunset_1k.hdr", "env/brown_photostudio_06_1k.hdr"}) {
        std::vector<std::string> warnings;
        CHECK(read(good, warnings).side == 512);
        CHECK(warnings.empty());
    }
    const struct {
        const char *file, *part;
    } refused[] = {{"env/odd/rgba32f-custom-channels.exr", "no channel R"},
                   {"env/odd/rg32ui.exr", "integers"},
                   {"env/odd/levels2D.exr", "no channel G among R"},
                   {"env/odd/envmap-cube.exr", "cube"},
                   {"broken/env-bomb_40000x40000.hdr", "40000 x 40000"},
                   {"broken/env-truncated.hdr", "file ends"},
                   {"broken/env-early_eof.exr", "ends beyond the file"},
                   {"broken/env-bad_bounds.exr", "ends beyond the file"},
                   {"broken/env-wrong_part_type.exr", "deepscanline"},
                   {"broken/env-heap_overflow.exr", "deep"},
                   {"broken/env-memory_dos.exr", "pixels"},
                   {"broken/env-allocation_error.exr", "ends beyond the file"},
                   {"broken/env-fuzz_envmap.exr", "ends beyond the file"},
                   {"broken/env-wide_float_range.exr", "no channel R among G"}};
#if CLVNDF_OPENEXR
    for (const auto& [file, part] : refused) {
        CAPTURE(file, part);
        const std::string what = file_refusal(folder / file);
        CHECK(has(what, part));
        CHECK(has(what, file));
    }
    for (const char* odd : {"rgb16f.exr", "rgba32f.exr", "rgb16f-tiled.exr", "rgb16f-custom-windows.exr"}) {
        std::vector<std::string> warnings;
        read(std::string("env/odd/") + odd, warnings);
        CHECK(warnings.size() == 1);  // not twice as wide as high
    }
    // Dark lines begin at +z, towards +x and +y; and at +x, towards +z and +y.
    std::vector<std::string> warnings;
    const Environment axes = read("env/OrientationLatLong.exr", warnings);
    CHECK(warnings.empty());
    const auto line = [&](std::array<double, 3> from, std::array<double, 3> to) {
        double sum = 0;
        for (int degrees = 2; degrees < 18; ++degrees) {
            const double c = std::cos(degrees * pi / 180), s = std::sin(degrees * pi / 180);
            std::array<double, 3> d;
            for (int i = 0; i < 3; ++i) d[i] = c * from[i] + s * to[i];
            sum += radiance(axes, d) / 16;
        }
        return sum;
    };
    for (const auto& [from, beside] :
         {std::pair{std::array{0.0, 0.0, 1.0}, std::array{1.0, 0.0, 0.0}}, {{1, 0, 0}, {0, 0, 1}}}) {
        const double dark = std::max(line(from, beside), line(from, {0, 1, 0})),
                     light = std::min(line(from, {-beside[0], 0, -beside[2]}), line(from, {0, -1, 0}));
        CAPTURE(dark, light);
        CHECK(dark < 0.45);
        CHECK(light > 0.65);
    }

    read("broken/env-nan_inf.exr", warnings);
    REQUIRE(warnings.size() == 2);
    CHECK(has(warnings[0], "18 values"));
#endif
}
