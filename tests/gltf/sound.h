// What holds of every scene that was read, whatever the file was.
#pragma once

#include <cmath>
#include <string>

#include "render/scene.h"

namespace vndf::test {

namespace sound {

template <class Numbers>
bool finite(const Numbers& numbers) {
    for (const float x : numbers)
        if (!std::isfinite(x)) return false;
    return true;
}
inline double length(const render::Vec& v) {
    return std::hypot(double{v[0]}, double{v[1]}, double{v[2]});
}
inline bool is_unit(const render::Vec& v) {
    return std::abs(length(v) - 1) < 1e-5;
}

inline std::string fault(const render::Vertex& v) {
    const auto [x, y, z, sign] = v.tangent;
    const render::Vec tangent{x, y, z};
    if (!finite(v.place) || !finite(v.uv[0]) || !finite(v.uv[1])) return "a vertex that is nowhere";
    if (!is_unit(v.normal)) return "a normal that is no unit vector";
    if (sign == 0 ? tangent != render::Vec{} : !(is_unit(tangent) && std::abs(sign) == 1)) return "a tangent";
    const double cosine = double{x} * v.normal[0] + double{y} * v.normal[1] + double{z} * v.normal[2];
    if (!(std::abs(cosine) < 1e-5)) return "a tangent that is not orthogonal to its normal";
    for (const float c : v.colour)
        if (!(c >= 0 && c <= 1)) return "a colour";
    return "";
}

inline std::string fault(const render::Material& m) {
    for (const float x : {m.alpha_x, m.alpha_y, m.metal, m.transmission, m.coat, m.coat_alpha})
        if (!(x >= 0 && x <= 1)) return "a material beyond 0 and 1";
    for (const render::Vec& v :
         {m.first, m.second, m.tint, m.albedo, m.transmittance, m.absorption, m.emission})
        for (const float x : v)
            if (!(x >= 0 && std::isfinite(x))) return "a material's colour";
    if (!(m.ior > 0 && std::isfinite(m.ior)) || !(m.dispersion >= 0 && std::isfinite(m.dispersion)))
        return "a material's index";
    return "";
}

inline std::string fault(const render::Scene& scene, const render::Dressing& dressing) {
    for (const render::TextureUse& use : dressing.textures) {
        if (use.texture >= static_cast<std::int32_t>(scene.textures.size()))
            return "a texture that is not there";
        if (use.set > 1 || !finite(use.transform)) return "a use of a texture";
    }
    const float scale = dressing.factors.normal_scale, turn = dressing.factors.anisotropy_rotation;
    return std::isfinite(scale) && std::isfinite(turn) ? "" : "a dressing";
}

inline std::string fault(const render::PunctualLight& light) {
    if (!finite(light.place) || !finite(light.colour) || !is_unit(light.direction)) return "a light";
    if (!(light.intensity >= 0 && std::isfinite(light.intensity))) return "a light's intensity";
    if (!(light.inner_angle >= 0 && light.inner_angle < light.outer_angle && light.outer_angle < 1.5708f))
        return "a light's angles";
    return "";
}

inline std::string fault(const render::Camera& camera) {
    render::Vec way{};
    for (int c = 0; c < 3; ++c) way[c] = camera.target[c] - camera.eye[c];
    if (!finite(camera.eye) || !(length(way) > 0) || !is_unit(camera.up)) return "a camera";
    return camera.width > 0 && camera.height > 0 && std::isfinite(camera.width + camera.height) ? ""
                                                                                                : "a film";
}

}  // namespace sound

// What is wrong with a scene, or nothing.
inline std::string unsound(const render::Scene& scene) {
    std::string fault;
    const auto note = [&](const std::string& one) {
        if (fault.empty()) fault = one;
    };
    if (scene.triangles.empty() || !scene.open) note("nothing to see");
    if (scene.dressings.size() != scene.materials.size() ||
        scene.material_names.size() != scene.materials.size())
        note("materials that do not match");
    for (const render::Vertex& vertex : scene.vertices) note(sound::fault(vertex));
    for (const render::Triangle& triangle : scene.triangles) {
        if (triangle.material >= scene.materials.size()) note("a triangle's material");
        for (const std::uint32_t corner : triangle.corners)
            if (corner >= scene.vertices.size()) note("a triangle's corner");
    }
    for (const render::Material& material : scene.materials) note(sound::fault(material));
    for (const render::Dressing& dressing : scene.dressings) note(sound::fault(scene, dressing));
    for (const render::Texture& texture : scene.textures)
        if (texture.bitmap >= scene.bitmaps.size()) note("a texture's bitmap");
    for (const render::Bitmap& bitmap : scene.bitmaps)
        if (bitmap.texels.empty() || bitmap.texels.size() != std::size_t{bitmap.width} * bitmap.height)
            note("a bitmap's size");
    for (const render::PunctualLight& light : scene.lights) note(sound::fault(light));
    note(sound::fault(scene.camera));
    return fault;
}

}  // namespace vndf::test
