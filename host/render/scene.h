// A scene as the renderer takes it: triangles, materials, sky and camera. The built-in ones are made here.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "kernels/render/queues.h"
#include "render/environment.h"
#include "render/gltf.h"
#include "render/material.h"

namespace vndf::render {

struct Vertex {
    Vec place, normal;
    // Of the texture coordinates that the normal map has, or else of set 0, orthogonal to the normal, and the sign of the bitangent
    // (normal x tangent times it); 0 where there is none.
    std::array<float, 4> tangent{};
    std::array<std::array<float, 2>, 2> uv{};
    std::array<float, 4> colour{1, 1, 1, 1};  // linear
};

// The corners run counterclockwise seen from outside.
struct Triangle {
    std::array<std::uint32_t, 3> corners;
    std::uint32_t material = 0;
};

// Red in the lowest byte, alpha in the highest, rows from the top.
struct Bitmap {
    std::uint32_t width = 0, height = 0;
    std::vector<std::uint32_t> texels;
};

enum class Wrap : std::uint32_t { repeat, clamp, mirror };
struct Texture {
    std::uint32_t bitmap = 0;
    Wrap wrap_s = Wrap::repeat, wrap_t = Wrap::repeat;
    bool nearest = false;  // no interpolation between texels
};

// What textures say of a material.
enum class Slot {
    base_colour,
    metallic_roughness,
    normal,
    emissive,
    transmission,
    coat,
    coat_roughness,
    specular,
    specular_colour,
    anisotropy
};
constexpr std::size_t slot_count = 10;

// A texture at the coordinates (t0 u + t1 v + t2, t3 u + t4 v + t5) of a set; texture < 0: none.
struct TextureUse {
    std::int32_t texture = -1;
    std::uint32_t set = 0;
    std::array<float, 6> transform{1, 0, 0, 0, 1, 0};
};

// What a material is made from where textures have a say.
struct Dressing {
    GltfMaterial factors;
    std::array<TextureUse, slot_count> textures;
};

// KHR_lights_punctual: candela, lux for a directional one. Colour linear. A point or spot light with a radius is a sphere
// (kernels/render/spheres.h).
struct PunctualLight {
    enum class Kind : std::uint32_t { point, spot, directional };
    Kind kind = Kind::point;
    Vec colour{1, 1, 1};
    float intensity = 1;
    Vec place{}, direction{0, 0, -1};  // that it shines in
    float inner_angle = 0, outer_angle = 0.785398163f;
    float radius = 0;

    bool sphere() const { return radius > 0 && kind != Kind::directional; }
};

struct Camera {
    Vec eye{0, 0, 5}, target{};
    float width = 1;  // of the film at distance 1
    Vec up{0, 1, 0};
    float height = 0;       // if > 0, that of the film, and the width goes by the image
    bool parallel = false;  // rays: then the film is that large wherever it is
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
    std::vector<std::string> material_names;  // or none
    std::vector<Dressing> dressings;          // of each material, or none
    std::vector<Bitmap> bitmaps;
    std::vector<Texture> textures;
    std::vector<PunctualLight> lights;
    std::string fresnel = "schlick";  // the model of every conductor, a value of VNDF_FRESNEL
    bool open = false;                // surfaces may be seen from behind
    Sky sky;
    Environment environment;  // in the sky's place, if it is not empty
    Camera camera;

    // Triangles of a sphere with smooth normals: 2 rows (rows - 1) * 2 of them, poles along y.
    void add_sphere(Vec centre, float radius, unsigned rows, const Material& material);
    // The square of the floor y = 0 between two corners.
    void add_square(float x0, float z0, float x1, float z1, std::uint32_t material);
    std::uint32_t add_material(const Material& material);
};

Sky constant_sky(float radiance);
// Blue, with a sun.
Sky day_sky();

// Five orbs on a floor under a sky with a sun; `kind` is one of orb_kinds().
Scene orbs(std::string_view kind);
const std::vector<std::string>& orb_kinds();
// Four point lights over them, equally bright: a sample that takes one of four takes each as often.
void add_lights_over_orbs(Scene& scene);

// The camera as the kernels take it.
vndf_render_view view_of(const Camera& camera, unsigned width, unsigned height);

}  // namespace vndf::render
