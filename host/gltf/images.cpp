#include "gltf/images.h"

#include <algorithm>

#include <fmt/format.h>

#include "gltf/decode.h"

namespace vndf::gltf {
namespace {

using namespace std::string_view_literals;

constexpr std::string_view png_signature = "\x89PNG\r\n\x1A\n"sv, jpeg_signature = "\xFF\xD8\xFF"sv;

enum Filter { nearest = 9728, linear = 9729 };

render::Wrap wrap_of(const Item& item) {
    switch (item.whole_or(10497, 0, 0xFFFF)) {
        case 10497:
            return render::Wrap::repeat;
        case 33071:
            return render::Wrap::clamp;
        case 33648:
            return render::Wrap::mirror;
        default:
            item.fail("no mode of wrapping; 10497, 33071 and 33648 are");
    }
}

}  // namespace

Images::Images(const Item& root, const Accessors& accessors, Resources& resources, const Limits& limits,
               render::Scene& scene, Warnings& warnings)
    : textures_(root["textures"]),
      images_(root["images"]),
      samplers_(root["samplers"]),
      accessors_(accessors),
      resources_(resources),
      limits_(limits),
      pixels_left_(limits.total_pixels),
      scene_(scene),
      warnings_(warnings) {}

std::optional<std::uint32_t> Images::texture(const Item& index) {
    const std::size_t number = index.index(textures_.size(), "texture");
    const auto [found, is_new] = texture_of_.try_emplace(number);
    if (!is_new) return found->second;
    const Item texture = textures_.at(number), source = texture["source"];
    if (!source) {
        warnings_.add("textures without an image that is read, left out", texture.place());
        return {};
    }
    render::Texture result = sampler_of(texture);
    result.bitmap = bitmap(source);
    scene_.textures.push_back(result);
    found->second = static_cast<std::uint32_t>(scene_.textures.size() - 1);
    return found->second;
}

render::Texture Images::sampler_of(const Item& texture) const {
    render::Texture result;
    const Item index = texture["sampler"];
    if (!index) return result;
    const Item sampler = samplers_.at(index.index(samplers_.size(), "sampler"));
    result.wrap_s = wrap_of(sampler["wrapS"]);
    result.wrap_t = wrap_of(sampler["wrapT"]);
    // There are no smaller versions of an image to choose among: of both filters, that for large texels.
    const Item larger = sampler["magFilter"], smaller = sampler["minFilter"];
    const std::uint64_t filter =
        larger ? larger.whole(nearest, linear) : smaller.whole_or(linear, nearest, 9987);
    result.nearest = filter == nearest;
    return result;
}

std::uint32_t Images::bitmap(const Item& index) {
    const std::size_t number = index.index(images_.size(), "image");
    if (const auto found = bitmap_of_.find(number); found != bitmap_of_.end()) return found->second;
    const Item image = images_.at(number), view = image["bufferView"];
    const std::string_view bytes = view ? accessors_.view(view) : resources_.of_uri(image["uri"]);
    const std::uint64_t most = std::min(limits_.image_pixels, pixels_left_);
    render::Bitmap bitmap;
    std::string wrong = "neither PNG nor JPEG";
    long damage = 0;
    if (bytes.starts_with(png_signature)) wrong = decode_png(bytes, most, bitmap);
    if (bytes.starts_with(jpeg_signature)) wrong = decode_jpeg(bytes, most, bitmap, damage);
    if (!wrong.empty()) image.fail(wrong);
    if (damage > 0) warnings_.add("images that are damaged, shown as far as they can be read", image.place());
    pixels_left_ -= bitmap.texels.size();
    scene_.bitmaps.push_back(std::move(bitmap));
    return bitmap_of_[number] = static_cast<std::uint32_t>(scene_.bitmaps.size() - 1);
}

}  // namespace vndf::gltf
