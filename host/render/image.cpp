#include "render/image.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include <fmt/format.h>

#include "error.h"

#if CLVNDF_OPENEXR
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>
#endif
#if CLVNDF_STB
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#pragma GCC diagnostic ignored "-Wunused-function"
#endif
#include <stb/stb_image_write.h>
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif
#endif

namespace vndf::render {
namespace {

bool ends_with(const std::string& path, std::string_view end) {
    return path.size() > end.size() && path.ends_with(end);
}

#if CLVNDF_OPENEXR

class Memory final : public Imf::OStream {
  public:
    Memory() : OStream("image") {}
    void write(const char* from, int size) override {
        if (bytes.size() < at_ + size) bytes.resize(at_ + size);
        std::memcpy(bytes.data() + at_, from, size);
        at_ += size;
    }
    uint64_t tellp() override { return at_; }
    void seekp(uint64_t to) override { at_ = to; }

    std::string bytes;

  private:
    std::size_t at_ = 0;
};

std::string exr(const Image& image, const Metadata& metadata) {
    Imf::Header header(static_cast<int>(image.width), static_cast<int>(image.height));
    for (const auto& [name, value] : metadata) header.insert(name, Imf::StringAttribute(value));
    Imf::FrameBuffer frame;
    const char* const names[] = {"R", "G", "B"};
    for (int channel = 0; channel < 3; ++channel) {
        header.channels().insert(names[channel], Imf::Channel(Imf::FLOAT));
        char* const base = reinterpret_cast<char*>(const_cast<float*>(image.pixels.data() + channel));
        frame.insert(names[channel],
                     Imf::Slice(Imf::FLOAT, base, 3 * sizeof(float), 3 * sizeof(float) * image.width));
    }
    Memory memory;
    {
        Imf::OutputFile file(memory, header);
        file.setFrameBuffer(frame);
        file.writePixels(static_cast<int>(image.height));
    }
    return std::move(memory.bytes);
}

#endif

#if CLVNDF_STB

// Below .6 as it is; above, an approach to 1.
double with_shoulder(double x) {
    constexpr double knee = 0.6, room = 1 - knee;
    return x <= knee ? x : knee + room * (1 - std::exp(-(x - knee) / room));
}

unsigned char srgb(double linear) {
    const double x = std::clamp(linear, 0.0, 1.0);
    const double encoded = x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
    return static_cast<unsigned char>(std::lround(255 * encoded));
}

std::string png(const Image& image, double stops) {
    std::vector<unsigned char> bytes(image.pixels.size());
    const double scale = std::exp2(stops);
    std::transform(image.pixels.begin(), image.pixels.end(), bytes.begin(),
                   [&](float x) { return srgb(with_shoulder(scale * x)); });
    std::string file;
    const auto append = [](void* to, void* data, int size) {
        static_cast<std::string*>(to)->append(static_cast<const char*>(data), size);
    };
    stbi_write_png_to_func(append, &file, static_cast<int>(image.width), static_cast<int>(image.height), 3,
                           bytes.data(), static_cast<int>(3 * image.width));
    return file;
}

#endif

[[noreturn]] void lacks(const std::string& path, const char* library, const char* package) {
    throw DeviceError(fmt::format("{}: this build has no {}; install {}, then configure and build again",
                                  path, library, package));
}

}  // namespace

void require_image_name(const std::string& path) {
    if (ends_with(path, ".exr")) {
#if !CLVNDF_OPENEXR
        lacks(path, "OpenEXR", "libopenexr-dev");
#endif
    } else if (ends_with(path, ".png")) {
#if !CLVNDF_STB
        lacks(path, "stb", "libstb-dev");
#endif
    } else {
        throw InputError(fmt::format(
            "--output '{}': no name of an image; names that end in .exr or .png are allowed", path));
    }
}

double fitting_stops(const Image& image) {
    std::vector<double> bright;
    for (std::size_t i = 0; i < image.pixels.size(); i += 3) {
        const double own = luminance(image.pixels[i], image.pixels[i + 1], image.pixels[i + 2]);
        if (own > 0) bright.push_back(own);
    }
    if (bright.empty()) return 0;
    const auto tenth = bright.end() - 1 - static_cast<std::ptrdiff_t>(bright.size() / 10);
    std::nth_element(bright.begin(), tenth, bright.end());
    return std::log2(0.8 / *tenth);
}

std::string encoded(const Image& image, const std::string& path, [[maybe_unused]] const Metadata& metadata,
                    [[maybe_unused]] double stops) {
#if CLVNDF_OPENEXR
    if (ends_with(path, ".exr")) return exr(image, metadata);
#endif
#if CLVNDF_STB
    if (ends_with(path, ".png")) return png(image, stops);
#endif
    lacks(path, "library for it", "libopenexr-dev and libstb-dev");
}

}  // namespace vndf::render
