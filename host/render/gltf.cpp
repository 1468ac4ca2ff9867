#include "render/gltf.h"

#include <cmath>

namespace vndf::render {

Material material_of(const GltfMaterial& gltf) {
    Material m;
    if (gltf.unlit) {  // KHR_materials_unlit: its colour, whatever falls on it
        m = lambert({});
        m.emission = gltf.base_colour;
        return m;
    }
    // KHR_materials_anisotropy: alpha along the tangent is mix(alpha, 1, strength^2).
    m.alpha_y = gltf.roughness * gltf.roughness;
    m.alpha_x = std::fma(1 - m.alpha_y, gltf.anisotropy * gltf.anisotropy, m.alpha_y);
    m.metal = gltf.metallic;
    m.first = m.albedo = m.transmittance = gltf.base_colour;
    m.ior = gltf.ior == 0 ? 1000 : gltf.ior;
    m.specular = gltf.specular;
    m.specular_colour = gltf.specular_colour;
    m.transmission = gltf.transmission;
    m.thin_walled = gltf.thin_walled;
    m.dispersion = gltf.dispersion;
    if (std::isfinite(gltf.attenuation_distance))
        m = tinted(m, gltf.attenuation_colour, gltf.attenuation_distance);
    m.coat = gltf.clearcoat;
    m.coat_alpha = gltf.clearcoat_roughness * gltf.clearcoat_roughness;
    for (int c = 0; c < 3; ++c) m.emission[c] = gltf.emissive[c] * gltf.emissive_strength;
    return m;
}

}  // namespace vndf::render
