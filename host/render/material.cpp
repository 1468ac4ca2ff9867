#include "render/material.h"

#include <cmath>

namespace vndf::render {

Material conductor(Vec f0, float alpha_x, float alpha_y) {
    Material m;
    m.alpha_x = alpha_x;
    m.alpha_y = alpha_y;
    m.first = f0;
    return m;
}

Material lambert(Vec albedo) {
    Material m;
    m.metal = 0;
    m.albedo = albedo;
    return m;
}

Material glass(float ior, float alpha) {
    Material m;
    m.metal = 0;
    m.alpha_x = m.alpha_y = alpha;
    m.ior = ior;
    m.transmission = 1;
    return m;
}

Material plastic(Vec albedo, float alpha) {
    Material m = lambert(albedo);
    m.alpha_x = m.alpha_y = alpha;
    m.ior = 1.5f;
    return m;
}

Material tinted(Material glass, Vec colour, float distance) {
    for (int c = 0; c < 3; ++c) glass.absorption[c] = -std::log(colour[c]) / distance;
    return glass;
}

bool dielectric(const Material& m) {
    return m.metal < 1 && (m.ior != 1 || m.transmission > 0);
}
bool transmits(const Material& m) {
    return m.metal < 1 && m.transmission > 0;
}

Material rough(Material diffuse, float roughness) {
    diffuse.diffuse_roughness = roughness;
    return diffuse;
}

Material coated(Material base, float factor, float alpha) {
    base.coat = factor;
    base.coat_alpha = alpha;
    return base;
}

}  // namespace vndf::render
