#include "render/gltf.h"

#include <algorithm>
#include <cmath>

namespace vndf::render {
namespace {

constexpr float largest_index = 1000;

// The index whose interface reflects `share` times as much at normal incidence.
float index_of(float ior, float share) {
    if (ior == 0) ior = largest_index;
    if (share == 1) return ior;
    const float root =
        std::sqrt(std::min(share, 1 / std::pow((ior - 1) / (ior + 1), 2.0f))) * std::abs(ior - 1) / (ior + 1);
    return root < 1 ? std::min((1 + root) / (1 - root), largest_index) : largest_index;
}

}  // namespace

Material material_of(const GltfMaterial& gltf) {
    Material m;
    // KHR_materials_anisotropy: alpha along the tangent is mix(alpha, 1, strength^2).
    m.alpha_y = gltf.roughness * gltf.roughness;
    m.alpha_x = m.alpha_y + (1 - m.alpha_y) * gltf.anisotropy * gltf.anisotropy;
    m.metal = gltf.metallic;
    m.first = m.albedo = m.transmittance = gltf.base_colour;
    const float brightest = *std::max_element(gltf.specular_colour.begin(), gltf.specular_colour.end());
    m.ior = index_of(gltf.ior, gltf.transmission > 0 ? 1 : gltf.specular * brightest);
    m.transmission = gltf.transmission;
    m.dispersion = gltf.dispersion;
    if (std::isfinite(gltf.attenuation_distance))
        m = tinted(m, gltf.attenuation_colour, gltf.attenuation_distance);
    m.coat = gltf.clearcoat;
    m.coat_alpha = gltf.clearcoat_roughness * gltf.clearcoat_roughness;
    for (int c = 0; c < 3; ++c) m.emission[c] = gltf.emissive[c] * gltf.emissive_strength;
    return m;
}

}  // namespace vndf::render
