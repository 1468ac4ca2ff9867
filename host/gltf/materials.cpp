#include "gltf/materials.h"

#include <cmath>
#include <numbers>

namespace vndf::gltf {
namespace {

using render::Slot;

// What is left of light of a channel that is said to be absorbed at once, so that its absorption is a number.
constexpr float least_transmittance = 1e-10f;
constexpr double shortest_attenuation = 1e-12, largest_index = 1000, brightest = 1e30;

float angle(const Item& item) {
    constexpr double any = 1e9;
    return static_cast<float>(std::remainder(item.number_or(0, -any, any), 2 * std::numbers::pi));
}

render::TextureUse& slot(render::Dressing& dressing, Slot slot) {
    return dressing.textures[static_cast<std::size_t>(slot)];
}

}  // namespace

std::uint32_t Materials::use(const Item& index) {
    std::optional<std::size_t> number;
    if (index) number = index.index(items_.size(), "material");
    if (const auto found = number_of_.find(number); found != number_of_.end()) return found->second;
    render::Dressing dressing;
    std::string name = "default";
    if (number) {
        const Item material = items_.at(*number);
        dressing = dressing_of(material);
        name = printable(material["name"].text_or(""));
    }
    scene_.dressings.push_back(dressing);
    scene_.material_names.push_back(name);
    return number_of_[number] = scene_.add_material(material_of(dressing.factors));
}

render::Dressing Materials::dressing_of(const Item& material) {
    render::Dressing dressing;
    const Item extensions = material["extensions"];
    dressing.factors.double_sided = material["doubleSided"].truth_or(false);
    dressing.factors.unlit = static_cast<bool>(extensions["KHR_materials_unlit"]);
    read_base(material, dressing);
    read_alpha(material, dressing);
    if (dressing.factors.unlit) return dressing;  // nothing else is looked at
    read_interface(extensions, dressing);
    read_body(extensions, dressing);
    read_coat(extensions, dressing);
    read_anisotropy(extensions, dressing);
    read_normal(material, dressing);
    return dressing;
}

void Materials::read_base(const Item& material, render::Dressing& dressing) {
    const Item pbr = material["pbrMetallicRoughness"];
    const std::array<float, 4> base = values_.numbers<4>(pbr["baseColorFactor"], {1, 1, 1, 1}, 0, 1);
    render::GltfMaterial& factors = dressing.factors;
    factors.base_colour = {base[0], base[1], base[2]};
    factors.opacity = base[3];
    slot(dressing, Slot::base_colour) = texture(pbr["baseColorTexture"]);
    if (factors.unlit) return;
    factors.metallic = values_.number(pbr["metallicFactor"], 1, 0, 1);
    factors.roughness = values_.number(pbr["roughnessFactor"], 1, 0, 1);
    slot(dressing, Slot::metallic_roughness) = texture(pbr["metallicRoughnessTexture"]);
    factors.emissive = values_.numbers<3>(material["emissiveFactor"], {0, 0, 0}, 0, 1);
    const Item strength = material["extensions"]["KHR_materials_emissive_strength"];
    factors.emissive_strength = values_.number(strength["emissiveStrength"], 1, 0, brightest);
    // Where a factor is 0, its textures change nothing: here and below they are not read.
    if (factors.emissive != render::Vec{})
        slot(dressing, Slot::emissive) = texture(material["emissiveTexture"]);
}

void Materials::read_alpha(const Item& material, render::Dressing& dressing) {
    const Item item = material["alphaMode"];
    const std::string mode = item.text_or("OPAQUE");
    if (mode == "MASK")
        dressing.factors.alpha = render::Alpha::mask;
    else if (mode == "BLEND")
        dressing.factors.alpha = render::Alpha::blend;
    else if (mode != "OPAQUE")
        item.fail(in_quotes(mode) + " is no mode; OPAQUE, MASK and BLEND are");
    dressing.factors.alpha_cutoff = values_.number(material["alphaCutoff"], 0.5, 0, largest_value);
}

void Materials::read_interface(const Item& extensions, render::Dressing& dressing) {
    render::GltfMaterial& factors = dressing.factors;
    const Item ior = extensions["KHR_materials_ior"]["ior"];
    factors.ior =
        ior && ior.number(-brightest, brightest) == 0 ? 0 : values_.number(ior, 1.5, 1, largest_index);
    factors.dispersion =
        values_.number(extensions["KHR_materials_dispersion"]["dispersion"], 0, 0, largest_value);
    const Item specular = extensions["KHR_materials_specular"];
    factors.specular = values_.number(specular["specularFactor"], 1, 0, 1);
    factors.specular_colour =
        values_.numbers<3>(specular["specularColorFactor"], {1, 1, 1}, 0, largest_value);
    if (factors.specular > 0) {
        slot(dressing, Slot::specular) = texture(specular["specularTexture"]);
        slot(dressing, Slot::specular_colour) = texture(specular["specularColorTexture"]);
    }
}

void Materials::read_body(const Item& extensions, render::Dressing& dressing) {
    render::GltfMaterial& factors = dressing.factors;
    const Item transmission = extensions["KHR_materials_transmission"],
               volume = extensions["KHR_materials_volume"];
    factors.transmission = values_.number(transmission["transmissionFactor"], 0, 0, 1);
    const float thickness = values_.number(volume["thicknessFactor"], 0, 0, brightest);
    const render::Vec colour = values_.numbers<3>(volume["attenuationColor"], {1, 1, 1}, 0, 1);
    const float infinity = std::numeric_limits<float>::infinity(),
                distance =
                    values_.number(volume["attenuationDistance"], infinity, shortest_attenuation, brightest);
    if (factors.transmission == 0) return;
    slot(dressing, Slot::transmission) = texture(transmission["transmissionTexture"]);
    factors.thin_walled = thickness == 0;
    if (factors.thin_walled) return;  // which has no inside
    ignore(volume["thicknessTexture"], "thickness");
    factors.attenuation_distance = distance;
    for (int c = 0; c < 3; ++c) factors.attenuation_colour[c] = std::max(colour[c], least_transmittance);
}

void Materials::read_coat(const Item& extensions, render::Dressing& dressing) {
    const Item coat = extensions["KHR_materials_clearcoat"];
    dressing.factors.clearcoat = values_.number(coat["clearcoatFactor"], 0, 0, 1);
    if (dressing.factors.clearcoat == 0) return;
    dressing.factors.clearcoat_roughness = values_.number(coat["clearcoatRoughnessFactor"], 0, 0, 1);
    slot(dressing, Slot::coat) = texture(coat["clearcoatTexture"]);
    slot(dressing, Slot::coat_roughness) = texture(coat["clearcoatRoughnessTexture"]);
    ignore(coat["clearcoatNormalTexture"], "a coat's normals");
}

void Materials::read_anisotropy(const Item& extensions, render::Dressing& dressing) {
    const Item anisotropy = extensions["KHR_materials_anisotropy"];
    dressing.factors.anisotropy = values_.number(anisotropy["anisotropyStrength"], 0, 0, 1);
    if (dressing.factors.anisotropy == 0) return;
    dressing.factors.anisotropy_rotation = angle(anisotropy["anisotropyRotation"]);
    slot(dressing, Slot::anisotropy) = texture(anisotropy["anisotropyTexture"]);
}

void Materials::read_normal(const Item& material, render::Dressing& dressing) {
    const Item normal = material["normalTexture"];
    dressing.factors.normal_scale = values_.number(normal["scale"], 1, -largest_value, largest_value);
    slot(dressing, Slot::normal) = texture(normal);
}

render::TextureUse Materials::texture(const Item& info) {
    render::TextureUse use;
    if (!info) return use;
    const Item transform = info["extensions"]["KHR_texture_transform"], other_set = transform["texCoord"],
               set = other_set ? other_set : info["texCoord"];
    const std::optional<std::uint32_t> number = images_.texture(info["index"]);
    use.set = static_cast<std::uint32_t>(set.whole_or(0, 0, 0xFFFFFFFF));
    if (use.set > 1) {
        warnings_.add("textures at coordinates of set 2 or above, left out", info.place());
        return {};
    }
    if (!number) return {};
    use.texture = static_cast<std::int32_t>(*number);
    if (!transform) return use;
    // Scaled, then turned, then moved; the sense of the turn is that of the extension's example.
    const std::array<float, 2> scale = values_.numbers<2>(transform["scale"], {1, 1}, -largest_value,
                                                          largest_value),
                               offset = values_.numbers<2>(transform["offset"], {0, 0}, -largest_value,
                                                           largest_value);
    const float turn = angle(transform["rotation"]), cosine = std::cos(turn), sine = std::sin(turn);
    use.transform = {cosine * scale[0], sine * scale[1],   offset[0],
                     -sine * scale[0],  cosine * scale[1], offset[1]};
    return use;
}

void Materials::ignore(const Item& item, const char* what) {
    if (item) warnings_.add(fmt::format("textures of {}, left out", what), item.place());
}

std::array<bool, 2> sets_of(const render::Dressing& dressing) {
    std::array<bool, 2> sets{};
    for (const render::TextureUse& use : dressing.textures)
        if (use.texture >= 0) sets[use.set] = true;
    return sets;
}

bool needs_tangents(const render::Dressing& dressing) {
    return dressing.textures[static_cast<std::size_t>(Slot::normal)].texture >= 0 ||
           dressing.factors.anisotropy > 0;
}

}  // namespace vndf::gltf
