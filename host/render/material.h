// What a surface is of, as the renderer takes it.
#pragma once

#include <array>

namespace vndf::render {

using Vec = std::array<float, 3>;

// Of linear red, green and blue with the primaries of sRGB.
inline double luminance(double red, double green, double blue) {
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue;
}

// As vndf_bsdf (kernels/vndf/bsdf.h): a rough conductor, a rough dielectric over another medium or over Lambert's reflection, or
// a mix.
struct Material {
    float alpha_x = 1, alpha_y = 1;
    float metal = 1;  // the conductor's share
    Vec first{1, 1, 1},
        second{1, 1, 1};  // of its reflectance: f0 and f90, eta and k, or f0 and the tint at 82 degrees
    Vec tint{1, 1, 1}, albedo{};
    float ior = 1, transmission = 0;  // of what is not metal
    Vec transmittance{1, 1, 1};
    float specular = 1;  // how strong its interface reflects, and a factor at normal incidence
    Vec specular_colour{1, 1, 1};
    bool thin_walled = false;  // what transmits is a wall without thickness
    float dispersion = 0;      // 20 over Abbe's number
    Vec absorption{};          // by the body behind, in a unit of length
    float diffuse_roughness = 0;
    float coat = 0, coat_alpha = 0.01f;  // a layer of index 1.5 over all
    Vec emission{};                      // radiance, on both sides

    bool operator==(const Material&) const = default;
};
Material conductor(Vec f0, float alpha_x, float alpha_y);
Material lambert(Vec albedo);
Material glass(float ior, float alpha);
Material plastic(Vec albedo, float alpha);
Material rough(Material diffuse, float roughness);
Material coated(Material base, float factor, float alpha);
// Of which a way of `distance` leaves `colour` of white light, as glTF has it (KHR_materials_volume).
Material tinted(Material glass, Vec colour, float distance);

bool dielectric(const Material& m);
bool transmits(const Material& m);

}  // namespace vndf::render
