// OpenEXR files as images of all directions.
#include <algorithm>
#include <array>
#include <cstring>

#include <fmt/format.h>

#include "error.h"
#include "render/lat_long.h"

#if CLVNDF_OPENEXR
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfStandardAttributes.h>
#endif

namespace vndf::render {

#if CLVNDF_OPENEXR

namespace {

class Memory final : public Imf::IStream {
  public:
    Memory(std::string_view bytes, const std::string& name) : IStream(name.c_str()), bytes_(bytes) {}
    bool read(char* to, int size) override {
        if (size < 0 || static_cast<std::size_t>(size) > bytes_.size() - at_)
            throw std::runtime_error("the file ends before the image does");
        std::memcpy(to, bytes_.data() + at_, size);
        at_ += size;
        return at_ < bytes_.size();
    }
    uint64_t tellg() override { return at_; }
    void seekg(uint64_t to) override { at_ = std::min<uint64_t>(to, bytes_.size()); }

  private:
    std::string_view bytes_;
    std::size_t at_ = 0;
};

using Rejection = std::runtime_error;

std::uint32_t little_endian(std::string_view bytes) {
    std::uint32_t value = 0;
    for (int i = 3; i >= 0; --i) value = value << 8 | static_cast<unsigned char>(bytes[i]);
    return value;
}

// OpenEXR allocates what a header says before it reads it: so that no attribute may be longer than the file.
void require_attributes_inside(std::string_view bytes) {
    constexpr std::uint32_t deep = 0x800, parts = 0x1000;
    if (bytes.size() < 8) throw Rejection("the file ends within its header");
    const std::uint32_t version = little_endian(bytes.substr(4));
    if (version & deep) throw Rejection("it has deep data; an image of one part is allowed");
    if (version & parts) throw Rejection("it has several parts; an image of one part is allowed");
    for (bytes.remove_prefix(8); !bytes.empty() && bytes[0] != 0;) {
        for (int i = 0; i < 2; ++i) {  // name and type
            const std::size_t end = bytes.find('\0');
            if (end == bytes.npos) throw Rejection("the file ends within its header");
            bytes.remove_prefix(end + 1);
        }
        if (bytes.size() < 4 || little_endian(bytes) > bytes.size() - 4)
            throw Rejection("an attribute of its header ends beyond the file");
        bytes.remove_prefix(4 + little_endian(bytes));
    }
}

// What OpenEXR allocates by the header alone.
void require_layout(const Imf::Header& header, std::size_t bytes) {
    constexpr unsigned most_channels = 64, most_tile_pixels = 1u << 22;
    unsigned channels = 0;
    for (auto i = header.channels().begin(); i != header.channels().end(); ++i) ++channels;
    if (channels > most_channels) throw Rejection(fmt::format("more than {} channels", most_channels));
    if (!header.hasTileDescription()) return;
    const auto& box = header.dataWindow();
    const std::uint64_t x = header.tileDescription().xSize, y = header.tileDescription().ySize;
    if (x == 0 || y == 0 || x > most_tile_pixels / y)
        throw Rejection(fmt::format("tiles of {} x {} pixels", x, y));
    const std::uint64_t tiles = ((box.max.x - box.min.x) / x + 1) * ((box.max.y - box.min.y) / y + 1);
    if (tiles > bytes / 8) throw Rejection("more tiles are announced than the file has bytes for");
}

void require_kind(const Imf::Header& header) {
    if (header.hasType() && header.type() != "scanlineimage" && header.type() != "tiledimage")
        throw Rejection(
            fmt::format("its type is '{}'; scanlineimage and tiledimage are allowed", header.type()));
    if (Imf::hasEnvmap(header) && Imf::envmap(header) != Imf::ENVMAP_LATLONG)
        throw Rejection("its attribute envmap says that it is a cube; latitude and longitude are allowed");
}

// R, G and B, or Y for all three.
std::array<const char*, 3> channels(const Imf::ChannelList& list) {
    const bool grey = !list.findChannel("R") && list.findChannel("Y") && !list.findChannel("RY");
    const std::array<const char*, 3> names = grey ? std::array{"Y", "Y", "Y"} : std::array{"R", "G", "B"};
    std::string all;
    for (auto i = list.begin(); i != list.end(); ++i)
        all += (all.empty() ? "" : ", ") + std::string(i.name());
    for (const char* name : names) {
        const Imf::Channel* channel = list.findChannel(name);
        if (!channel)
            throw Rejection(
                fmt::format("no channel {} among {}; R, G and B or Y alone are allowed", name, all));
        if (channel->type == Imf::UINT)
            throw Rejection(fmt::format("channel {} is of integers; half and float are allowed", name));
        if (channel->xSampling != 1 || channel->ySampling != 1)
            throw Rejection(fmt::format("channel {} has not every pixel", name));
    }
    return names;
}

LatLong pixels(std::string_view bytes, const std::string& name) {
    require_attributes_inside(bytes);
    {
        Memory stream(bytes, name);
        stream.seekg(8);
        Imf::Header header;
        int version = static_cast<int>(little_endian(bytes.substr(4)));
        header.readFrom(stream, version);
        const auto& box = header.dataWindow();
        require_size(std::max(std::int64_t{0}, std::int64_t{box.max.x} - box.min.x + 1),
                     std::max(std::int64_t{0}, std::int64_t{box.max.y} - box.min.y + 1), name);
        require_kind(header);
        require_layout(header, bytes.size());
    }
    Memory stream(bytes, name);
    Imf::InputFile file(stream, 0);
    const auto names = channels(file.header().channels());
    // The data window is the whole map (ImfEnvmap.h), wherever it is.
    const auto& box = file.header().dataWindow();
    LatLong image;
    image.width = box.max.x - box.min.x + 1;
    image.height = box.max.y - box.min.y + 1;
    constexpr int rows = 256;  // the most that are compressed together
    // Some rows at a time, so that memory follows what is there.
    for (int y = box.min.y; y <= box.max.y; y += rows) {
        const int last = std::min(y + rows - 1, box.max.y);
        image.pixels.resize(std::size_t{3} * image.width * (last - box.min.y + 1));
        Imf::FrameBuffer frame;
        for (int c = 0; c < 3; ++c)
            frame.insert(names[c], Imf::Slice::Make(Imf::FLOAT, image.pixels.data() + c, box,
                                                    3 * sizeof(float), 3 * sizeof(float) * image.width));
        file.setFrameBuffer(frame);
        file.readPixels(y, last);
    }
    if (names[0] == names[1])  // one slice for each name: the last one
        for (std::size_t i = 0; i < image.pixels.size(); i += 3)
            image.pixels[i] = image.pixels[i + 1] = image.pixels[i + 2];
    return image;
}

}  // namespace

LatLong read_exr(std::string_view bytes, const std::string& name) {
    try {
        return pixels(bytes, name);
    } catch (const InputError&) {
        throw;
    } catch (const std::exception& failure) {
        std::string what = failure.what();
        std::replace(what.begin(), what.end(), '\n', ' ');
        throw InputError(fmt::format("{}: {}", name, what));
    }
}

#else

LatLong read_exr(std::string_view, const std::string& name) {
    throw DeviceError(fmt::format(
        "{}: this build has no OpenEXR; install libopenexr-dev, then configure and build again", name));
}

#endif

}  // namespace vndf::render
