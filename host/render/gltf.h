// A material of glTF 2.0 as the renderer's.
#pragma once

#include <limits>

#include "render/material.h"

namespace vndf::render {

enum class Alpha { opaque, mask, blend };

// The metallic-roughness material with KHR_materials_specular, _ior, _transmission, _volume, _dispersion, _clearcoat, _anisotropy
// and _emissive_strength: factors at a point, textures multiplied in, each as glTF defines it.
struct GltfMaterial {
    Vec base_colour{1, 1, 1};
    float metallic = 1, roughness = 1;
    Vec emissive{};
    float emissive_strength = 1;
    float ior = 1.5f, transmission = 0, dispersion = 0;
    bool thin_walled = false;  // without a KHR_materials_volume of some thickness
    Vec attenuation_colour{1, 1, 1};
    float attenuation_distance = std::numeric_limits<float>::infinity();
    float specular = 1;
    Vec specular_colour{1, 1, 1};
    float clearcoat = 0, clearcoat_roughness = 0;
    float anisotropy = 0, anisotropy_rotation = 0;  // strength; radians, from the tangent to the bitangent
    float normal_scale = 1;
    Alpha alpha = Alpha::opaque;
    float opacity = 1, alpha_cutoff = 0.5f;
    bool unlit = false, double_sided = false;
};

// alpha is the square of a roughness. An ior of 0, which glTF has for a reflectance of 1, is the largest index.
Material material_of(const GltfMaterial& gltf);

}  // namespace vndf::render
