#include "render/variants.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace vndf::render {
namespace {

// Encoded or not: 0 and 1 are what they are, and the others between.
Vec scaled(Vec rgb, const std::array<float, 4>& texel) {
    for (int c = 0; c < 3; ++c) rgb[c] *= texel[c];
    return rgb;
}

}  // namespace

TexelRanges::TexelRanges(const Scene& scene) : scene_(scene), ranges_(scene.bitmaps.size()) {
    for (std::size_t i = 0; i < ranges_.size(); ++i)
        for (int c = 0; c < 4; ++c) {
            std::uint32_t least = 255, most = 0;
            for (const std::uint32_t texel : scene.bitmaps[i].texels) {
                least = std::min(least, texel >> (8 * c) & 255);
                most = std::max(most, texel >> (8 * c) & 255);
            }
            ranges_[i].least[c] = least;
            ranges_[i].most[c] = most;
        }
}

TexelRange TexelRanges::of(std::size_t material, Slot slot) const {
    if (scene_.dressings.empty()) return {};
    const std::int32_t texture = scene_.dressings[material].textures[static_cast<std::size_t>(slot)].texture;
    return texture < 0 ? TexelRange{} : ranges_[scene_.textures[texture].bitmap];
}

std::vector<Material> variants(const Scene& scene, const TexelRanges& ranges, std::size_t material) {
    std::vector<Material> all{scene.materials[material]};
    if (scene.dressings.empty()) return all;
    // Everything so far with the least and with the most of a texture.
    using Texel = std::array<float, 4>;
    const auto spread = [&](Slot slot, const std::function<void(Material&, const Texel&)>& set) {
        const TexelRange range = ranges.of(material, slot);
        std::vector<Material> both;
        for (const Material& m : all)
            for (const auto& bytes : {range.least, range.most}) {
                Texel texel;
                std::transform(bytes.begin(), bytes.end(), texel.begin(),
                               [](std::uint32_t byte) { return static_cast<float>(byte) / 255; });
                both.push_back(m);
                set(both.back(), texel);
                if (range.least == range.most) break;
            }
        all = both;
    };
    const GltfMaterial& factors = scene.dressings[material].factors;
    spread(Slot::metallic_roughness, [](Material& m, const Texel& t) { m.metal *= t[2]; });
    spread(Slot::metallic_roughness, [&](Material& m, const Texel& t) {
        const float own = factors.roughness * t[1];
        m.alpha_y = own * own;
    });
    spread(Slot::anisotropy, [&](Material& m, const Texel& t) {
        const float strength = factors.anisotropy * t[2];
        m.alpha_x = std::fma(1 - m.alpha_y, strength * strength, m.alpha_y);
    });
    spread(Slot::transmission, [](Material& m, const Texel& t) { m.transmission *= t[0]; });
    spread(Slot::coat, [](Material& m, const Texel& t) { m.coat *= t[0]; });
    spread(Slot::specular, [](Material& m, const Texel& t) { m.specular *= t[3]; });
    spread(Slot::specular_colour,
           [](Material& m, const Texel& t) { m.specular_colour = scaled(m.specular_colour, t); });
    spread(Slot::base_colour, [](Material& m, const Texel& t) {
        m.first = scaled(m.first, t);
        m.albedo = scaled(m.albedo, t);
        m.transmittance = scaled(m.transmittance, t);
    });
    spread(factors.unlit ? Slot::base_colour : Slot::emissive,
           [](Material& m, const Texel& t) { m.emission = scaled(m.emission, t); });
    return all;
}

bool anisotropic(const Material& m) {
    return (m.metal > 0 || dielectric(m)) && m.alpha_x != m.alpha_y;
}

}  // namespace vndf::render
