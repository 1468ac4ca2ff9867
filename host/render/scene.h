// A scene as the renderer takes it: triangles, materials, sky and camera. The built-in ones are made here.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "kernels/render/queues.h"

namespace vndf::render {

using Vec = std::array<float, 3>;

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
    float dispersion = 0;  // 20 over Abbe's number
    Vec absorption{};      // by the body behind, in a unit of length
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

struct Vertex {
    Vec place, normal;
};

struct Triangle {
    std::array<std::uint32_t, 3> corners;
    std::uint32_t material = 0;
};

struct Camera {
    Vec eye{0, 0, 5}, target{};
    float width = 1;  // of the film at distance 1
};

struct Sky {
    Vec zenith{}, horizon{}, ground{}, sun{};
    Vec to_sun{0, 1, 0};
    float sun_radius = 0.02f;  // radians
    float sun_share = 0.5f;    // of the samples of light; 0 where there is no sun
};

struct Scene {
    std::string name;
    std::vector<Vertex> vertices;
    std::vector<Triangle> triangles;
    std::vector<Material> materials;
    std::string fresnel = "schlick";  // the model of every conductor, a value of VNDF_FRESNEL
    bool open = false;                // surfaces may be seen from behind
    Sky sky;
    Camera camera;

    // Triangles of a sphere with smooth normals: 2 rows (rows - 1) * 2 of them, poles along y.
    void add_sphere(Vec centre, float radius, unsigned rows, const Material& material);
    // The square of the floor y = 0 between two corners.
    void add_square(float x0, float z0, float x1, float z1, std::uint32_t material);
    std::uint32_t add_material(const Material& material);
};

Sky constant_sky(float radiance);

// Five orbs on a floor under a sky with a sun; `kind` is one of orb_kinds().
Scene orbs(std::string_view kind);
const std::vector<std::string>& orb_kinds();

// The camera and the sky as the kernels take them.
vndf_render_view view_of(const Camera& camera, unsigned width, unsigned height);
vndf_render_sky sky_of(const Sky& sky);

}  // namespace vndf::render
