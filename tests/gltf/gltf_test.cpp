// The reader of glTF on small files made here: what is in the scene, and what comes of broken ones.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include <fmt/format.h>
#include <unistd.h>

#include "error.h"
#include "gltf/load.h"
#include "gltf/uri.h"
#include "sound.h"
#include "support/catch.h"
#include "support/gltf_cases.h"
#include "support/skip.h"

using namespace vndf;
using namespace vndf::test;
using render::Slot;

namespace {

std::string no_file(const gltf::Item& place, const std::string&, std::uint64_t) {
    place.fail("there is no such file");
}

gltf::Loaded load(const std::string& bytes, const std::string& camera = "", const gltf::Limits& limits = {}) {
    gltf::Loaded loaded = gltf::load("memory", bytes, no_file, camera, limits);
    CHECK(unsound(loaded.scene) == "");
    return loaded;
}
gltf::Loaded load(const GltfFile& file, const std::string& camera = "") {
    return load(file.gltf(), camera);
}

// What a file is refused with; empty if it is not.
template <class... Arguments>
std::string refusal(const Arguments&... arguments) {
    try {
        gltf::load(arguments...);
        return "";
    } catch (const InputError& error) {
        return error.what();
    }
}

const render::Vertex& corner(const render::Scene& scene, std::size_t triangle, int k) {
    return scene.vertices.at(scene.triangles.at(triangle).corners[k]);
}

render::Vec face(const render::Scene& scene, std::size_t triangle) {
    std::array<std::array<double, 3>, 2> sides;
    for (int k = 0; k < 2; ++k)
        for (int c = 0; c < 3; ++c)
            sides[k][c] = corner(scene, triangle, k + 1).place[c] - corner(scene, triangle, 0).place[c];
    render::Vec normal;
    for (int c = 0; c < 3; ++c) {
        const int a = (c + 1) % 3, b = (c + 2) % 3;
        normal[c] = static_cast<float>(sides[0][a] * sides[1][b] - sides[0][b] * sides[1][a]);
    }
    return normal;
}

template <std::size_t N>
void check_near(const std::array<float, N>& a, const std::array<float, N>& b) {
    for (std::size_t i = 0; i < N; ++i) {
        CAPTURE(i, a[i], b[i]);
        CHECK(std::abs(a[i] - b[i]) <= 1e-6f * std::max(1.0f, std::abs(b[i])));
    }
}

std::array<float, 2> transformed(const render::TextureUse& use, float u, float v) {
    const std::array<float, 6>& m = use.transform;
    return {m[0] * u + m[1] * v + m[2], m[3] * u + m[4] * v + m[5]};
}

const render::TextureUse& use_of(const render::Scene& scene, Slot slot) {
    return scene.dressings.at(0).textures[static_cast<std::size_t>(slot)];
}

// Where this build decodes no images, what needs them is not tested.
#if CLVNDF_PNG && CLVNDF_JPEG
constexpr bool decodes_images = true;
#else
constexpr bool decodes_images = false;
#endif
constexpr const char* no_decoder = "this build lacks libpng or libjpeg";

std::uint32_t rgba(unsigned r, unsigned g, unsigned b, unsigned a = 255) {
    return r | g << 8 | b << 16 | a << 24;
}

}  // namespace

TEST_CASE("every defect is refused in one line that names its place, or shown with a warning") {
    if (!decodes_images) VNDF_SKIP(no_decoder);
    for (const GltfCase& one : defects()) {
        CAPTURE(one.name);
        std::string error, warnings;
        try {
            const gltf::Loaded loaded = gltf::load(one.name, one.bytes, no_file, "");
            CHECK(unsound(loaded.scene) == "");
            for (const auto& [what, count] : loaded.warnings) warnings += what + "\n";
        } catch (const InputError& refused) {
            error = refused.what();
            CHECK(error.starts_with(one.name + ": "));
            CHECK(error.find('\n') == error.npos);
        }
        CHECK(error.empty() == one.error.empty());
        CHECK(warnings.empty() == one.warning.empty());
        CHECK_THAT(error, Catch::Matchers::ContainsSubstring(one.error));
        CHECK_THAT(warnings, Catch::Matchers::ContainsSubstring(one.warning));
    }
}

TEST_CASE("sound files are read without a warning, as text and as GLB") {
    if (!decodes_images) VNDF_SKIP(no_decoder);
    for (const GltfCase& one : sound_cases()) {
        CAPTURE(one.name);
        const gltf::Loaded loaded = load(one.bytes);
        CHECK(loaded.warnings.empty());
        CHECK(loaded.triangles == loaded.scene.triangles.size());
    }
}

TEST_CASE("a triangle without normals is flat, and framed from the front") {
    const gltf::Loaded loaded = load(triangle_file());
    const render::Scene& scene = loaded.scene;
    REQUIRE(scene.triangles.size() == 1);
    for (int k = 0; k < 3; ++k) check_near(corner(scene, 0, k).normal, {0, 0, 1});
    CHECK(corner(scene, 0, 1).place == render::Vec{1, 0, 0});
    CHECK(!loaded.has_camera);
    CHECK(scene.camera.eye[2] > 1);
    CHECK(scene.camera.eye[1] > scene.camera.target[1]);
    CHECK(scene.material_names == std::vector<std::string>{"default"});
    CHECK(scene.materials[0] == render::material_of({}));
}

TEST_CASE("nodes place, turn and mirror what hangs below them") {
    const gltf::Loaded loaded = load(busy_file(), "eye");
    const render::Scene& scene = loaded.scene;
    REQUIRE(scene.triangles.size() == 2);
    // A quarter about y takes x to -z and z to x; the mesh is mirrored in x before, so that its corners run the other way.
    check_near(corner(scene, 0, 0).place, {1, 2, 3});
    check_near(corner(scene, 0, 1).place, {1, 4, 3});
    check_near(corner(scene, 0, 2).place, {1, 2, 5});
    check_near(corner(scene, 0, 0).normal, {1, 0, 0});
    CHECK(face(scene, 0)[0] > 0);
    // The matrix takes y to -z and z to y.
    check_near(corner(scene, 1, 2).place, {0, 0, 4});
    check_near(corner(scene, 1, 2).normal, {0, 1, 0});
    REQUIRE(scene.lights.size() == 3);
    CHECK(scene.lights[0].kind == render::PunctualLight::Kind::point);
    CHECK(scene.lights[0].intensity == 40);
    check_near(scene.lights[0].colour, {1, 0.5f, 0});
    check_near(scene.lights[0].place, {1, 2, 3});
    CHECK(scene.lights[1].kind == render::PunctualLight::Kind::spot);
    check_near(scene.lights[1].direction, {-1, 0, 0});
    CHECK(scene.lights[1].inner_angle == 0.25f);
    CHECK(scene.lights[1].outer_angle == static_cast<float>(std::numbers::pi / 4));
    CHECK(scene.lights[2].kind == render::PunctualLight::Kind::directional);
    CHECK(scene.lights[2].intensity == 3);
    check_near(scene.lights[2].direction, {0, -1, 0});
}

TEST_CASE("the vertices of a skin are where its joints are, whatever its node says") {
    const render::Scene scene = load(skinned_file()).scene;
    check_near(corner(scene, 0, 0).place, {0, 0, 0});
    check_near(corner(scene, 0, 1).place, {2, 0, 1});
    check_near(corner(scene, 0, 2).place, {0, 1.5f, 0.5f});
    // Joints that mirror turn the triangle round.
    GltfFile file = skinned_file();
    file.json["nodes"][1]["scale"] = {-1, 1, 1};
    const render::Scene mirrored = load(file).scene;
    CHECK(face(mirrored, 0)[2] > 0);
}

TEST_CASE("normals follow a stretched surface, and tangents a mirrored one") {
    if (!decodes_images) VNDF_SKIP(no_decoder);
    GltfFile file = mapped_file();
    file.attributes()["NORMAL"] = file.accessor<float>({0, 0.6f, 0.8f, 0, 0.6f, 0.8f, 0, 0.6f, 0.8f}, "VEC3");
    file.attributes()["TANGENT"] = file.accessor<float>({1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1}, "VEC4");
    file.material()["normalTexture"]["index"] = file.texture(small_png());
    for (const float x : {1.0f, -1.0f}) {
        file.json["nodes"][0]["scale"] = {x, 3, 1};
        const render::Scene scene = load(file).scene;
        check_near(corner(scene, 0, 0).normal,
                   {0, 0.2f / std::hypot(0.2f, 0.8f), 0.8f / std::hypot(0.2f, 0.8f)});
        check_near(corner(scene, 0, 0).tangent, {x, 0, 0, x});
        CHECK(face(scene, 0)[2] > 0);
    }
}

TEST_CASE("cameras go by name and by number, the first without either") {
    const gltf::Loaded first = load(busy_file()), named = load(busy_file(), "front"),
                       numbered = load(busy_file(), "1");
    CHECK(first.has_camera);
    CHECK(first.scene.camera.parallel);
    CHECK(first.scene.camera.width == 4);
    CHECK(first.scene.camera.height == 6);
    check_near(first.scene.camera.eye, {0, 0, 5});
    for (const gltf::Loaded* loaded : {&named, &numbered}) {
        const render::Camera& camera = loaded->scene.camera;
        CHECK(!camera.parallel);
        CHECK(camera.height == static_cast<float>(2 * std::tan(0.5)));
        CHECK(camera.width == static_cast<float>(4 * std::tan(0.5)));
        check_near(camera.eye, {1, 2, 3});
        check_near(camera.up, {0, 1, 0});
        CHECK(camera.target[0] < 1);
        check_near({camera.target[1], camera.target[2]}, std::array<float, 2>{2, 3});
    }
    const std::string error = refusal("memory", busy_file().gltf(), no_file, "side");
    CHECK(error == "memory: cameras: the scene has no camera 'side'; its cameras are 0, 1 'front'");
}

TEST_CASE("strips and fans run round like lists") {
    GltfFile file = triangle_file();
    file.attributes()["POSITION"] =
        file.accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0}, "VEC3");
    file.primitive()["mode"] = 5;
    const render::Scene strip = load(file).scene;
    REQUIRE(strip.triangles.size() == 3);
    for (std::size_t t = 0; t < 3; ++t) CHECK(face(strip, t)[2] > 0);
    file.attributes()["POSITION"] =
        file.accessor<float>({0, 0, 0, 2, 0, 0, 2, 1, 0, 1, 2, 0, 0, 2, 0}, "VEC3");
    file.primitive()["mode"] = 6;
    const render::Scene fan = load(file).scene;
    REQUIRE(fan.triangles.size() == 3);
    for (std::size_t t = 0; t < 3; ++t) {
        CHECK(face(fan, t)[2] > 0);
        CHECK(corner(fan, t, 2).place == render::Vec{0, 0, 0});
    }
}

TEST_CASE("quantized attributes are what they mean") {
    const render::Scene scene = load(quantized_file()).scene;
    REQUIRE(scene.triangles.size() == 2);
    CHECK(corner(scene, 0, 1).place == render::Vec{100, 0, 0});
    CHECK(corner(scene, 0, 0).normal == render::Vec{0, 0, 1});
    CHECK(corner(scene, 0, 1).colour == std::array<float, 4>{0, 1, 0, 1});
    GltfFile normalized = quantized_file();
    normalized.json["accessors"][1]["normalized"] = true;
    check_near(corner(load(normalized).scene, 0, 1).place, {100 / 32767.0f, 0, 0});
}

TEST_CASE("sparse accessors replace what is below, or zeros") {
    GltfFile file = sparse_file();
    const render::Scene zeros = load(file).scene;
    CHECK(corner(zeros, 0, 0).place == render::Vec{3, 0, 0});
    CHECK(corner(zeros, 0, 1).place == render::Vec{0, 0, 0});
    CHECK(corner(zeros, 0, 2).place == render::Vec{0, 4, 0});
    // Over the triangle's own vertices, only the last.
    file.json["accessors"][1]["bufferView"] = 0;
    file.json["accessors"][1]["sparse"]["count"] = 1;
    file.json["accessors"][1]["sparse"]["indices"]["byteOffset"] = 1;
    file.json["accessors"][1]["sparse"]["values"]["byteOffset"] = 12;
    const render::Scene over = load(file).scene;
    CHECK(corner(over, 0, 0).place == render::Vec{0, 0, 0});
    CHECK(corner(over, 0, 1).place == render::Vec{1, 0, 0});
    CHECK(corner(over, 0, 2).place == render::Vec{0, 4, 0});
}

TEST_CASE("strides are kept, of vertices and of what a sparse accessor puts over them") {
    GltfFile file = triangle_file();
    const std::vector<float> interleaved{0, 0, 0, 9, 1, 0, 0, 9, 0, 1, 0, 9};
    file.accessor(interleaved, "VEC4");
    file.json["accessors"][1]["type"] = "VEC3";
    file.json["bufferViews"][1]["byteStride"] = 16;
    file.attributes()["POSITION"] = 1;
    CHECK(corner(load(file).scene, 0, 2).place == render::Vec{0, 1, 0});
}

TEST_CASE("a material says all that it can") {
    if (!decodes_images) VNDF_SKIP(no_decoder);
    const render::Scene scene = load(rich_file()).scene;
    REQUIRE(scene.dressings.size() == 1);
    const render::GltfMaterial& m = scene.dressings[0].factors;
    check_near(m.base_colour, {0.5f, 0.6f, 0.7f});
    check_near(m.emissive, {1, 0.5f, 0.25f});
    check_near(m.attenuation_colour, {0.25f, 1e-10f, 1});
    check_near(m.specular_colour, {1, 0.9f, 0.8f});
    const std::array<float, 16> said{m.metallic,
                                     m.roughness,
                                     m.emissive_strength,
                                     m.ior,
                                     m.transmission,
                                     m.dispersion,
                                     m.attenuation_distance,
                                     m.specular,
                                     m.clearcoat,
                                     m.clearcoat_roughness,
                                     m.anisotropy,
                                     m.anisotropy_rotation,
                                     m.normal_scale,
                                     m.opacity,
                                     m.alpha_cutoff,
                                     static_cast<float>(m.alpha)};
    check_near(said, {0.25f, 0.5f, 20, 1.33f, 0.95f, 0.3f, 3, 0.4f, 0.9f, 0.2f, 0.5f,
                      static_cast<float>(7 - 2 * std::numbers::pi), 0.75f, 0.8f, 0.4f, 1});
    CHECK(m.double_sided);
    CHECK(!m.thin_walled);
    CHECK(!m.unlit);
    for (const render::TextureUse& use : scene.dressings[0].textures) CHECK(use.texture == 0);
    CHECK(scene.bitmaps.at(0).texels == std::vector<std::uint32_t>{rgba(16, 32, 48)});
    CHECK(scene.material_names == std::vector<std::string>{"all?of it"});
    CHECK(scene.materials[0] == render::material_of(m));
}

TEST_CASE("what a factor of 0 leaves unseen is not read") {
    if (!decodes_images) VNDF_SKIP(no_decoder);
    GltfFile file = rich_file();
    nlohmann::json& material = file.material();
    material["emissiveFactor"] = {0, 0, 0};
    nlohmann::json& extensions = material["extensions"];
    extensions["KHR_materials_anisotropy"]["anisotropyStrength"] = 0;
    extensions["KHR_materials_clearcoat"]["clearcoatFactor"] = 0;
    extensions["KHR_materials_specular"]["specularFactor"] = 0;
    extensions["KHR_materials_transmission"]["transmissionFactor"] = 0;
    const render::Scene scene = load(file).scene;
    for (const Slot slot : {Slot::emissive, Slot::anisotropy, Slot::coat, Slot::coat_roughness,
                            Slot::specular, Slot::specular_colour, Slot::transmission})
        CHECK(use_of(scene, slot).texture < 0);
    CHECK(use_of(scene, Slot::normal).texture == 0);
    // And images that no material asks for may be anything.
    GltfFile other = triangle_file();
    other.texture("no image");
    CHECK(load(other).scene.bitmaps.empty());
}

TEST_CASE("what transmits without a thickness is thin, unlit materials are nothing else, an ior of 0 stays") {
    if (!decodes_images) VNDF_SKIP(no_decoder);
    GltfFile file = rich_file();
    nlohmann::json& extensions = file.material()["extensions"];
    extensions["KHR_materials_volume"]["thicknessFactor"] = 0;
    extensions["KHR_materials_ior"]["ior"] = 0;
    const render::GltfMaterial thin = load(file).scene.dressings[0].factors;
    CHECK(thin.thin_walled);
    CHECK(std::isinf(thin.attenuation_distance));
    CHECK(thin.ior == 0);
    extensions["KHR_materials_unlit"] = nlohmann::json::object();
    const render::Scene unlit = load(file).scene;
    CHECK(unlit.dressings[0].factors.unlit);
    CHECK(unlit.dressings[0].factors.transmission == 0);
    CHECK(use_of(unlit, Slot::base_colour).texture == 0);
    CHECK(use_of(unlit, Slot::normal).texture < 0);
}

TEST_CASE("textures have their samplers, and coordinates of a set and transform of their own") {
    if (!decodes_images) VNDF_SKIP(no_decoder);
    GltfFile file = textured_file(small_png());
    file.attributes()["TEXCOORD_1"] = file.accessor<std::uint16_t>({0, 0, 65535, 0, 0, 65535}, "VEC2", true);
    file.json["textures"][0]["sampler"] = 0;
    file.json["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}}};
    // The extension's example: the lower left quadrant, turned clockwise.
    nlohmann::json& info = file.material()["pbrMetallicRoughness"]["baseColorTexture"];
    info["extensions"]["KHR_texture_transform"] = {
        {"offset", {0, 1}}, {"rotation", std::numbers::pi / 2}, {"scale", {0.5, 0.5}}, {"texCoord", 1}};
    const render::Scene scene = load(file).scene;
    const render::TextureUse& use = use_of(scene, Slot::base_colour);
    CHECK(use.set == 1);
    check_near(transformed(use, 0, 0), {0, 1});
    check_near(transformed(use, 1, 0), {0, 0.5f});
    check_near(transformed(use, 0, 1), {0.5f, 1});
    CHECK(corner(scene, 0, 1).uv[1] == std::array<float, 2>{1, 0});
    const render::Texture& texture = scene.textures.at(0);
    CHECK(texture.wrap_s == render::Wrap::clamp);
    CHECK(texture.wrap_t == render::Wrap::mirror);
    CHECK(texture.nearest);
}

TEST_CASE("pixels of every kind of PNG, and of JPEG") {
    if (!decodes_images) VNDF_SKIP(no_decoder);
    const std::string palette = png_chunk("PLTE", std::string("\x0A\x14\x1E\x28\x32\x3C", 6)),
                      alphas = png_chunk("tRNS", std::string("\x80", 1)),
                      gamma = png_chunk("gAMA", big_endian(20000));  // to be ignored
    struct Row {
        const char* what;
        std::string file;
        std::vector<std::uint32_t> texels;
    };
    const std::vector<Row> rows{
        {"grey of 1 bit", png_file(2, 1, 1, PngColour::grey, {"\x40"}), {rgba(0, 0, 0), rgba(255, 255, 255)}},
        {"grey of 2 bits",
         png_file(2, 1, 2, PngColour::grey, {"\x60"}),
         {rgba(85, 85, 85), rgba(170, 170, 170)}},
        {"grey of 4 bits",
         png_file(2, 1, 4, PngColour::grey, {"\x1F"}),
         {rgba(17, 17, 17), rgba(255, 255, 255)}},
        {"grey", png_file(1, 2, 8, PngColour::grey, {"\x07", "\x09"}, gamma), {rgba(7, 7, 7), rgba(9, 9, 9)}},
        {"grey of 16 bits", png_file(1, 1, 16, PngColour::grey, {std::string("\0\xFF", 2)}), {rgba(1, 1, 1)}},
        {"grey and alpha", png_file(1, 1, 8, PngColour::grey_alpha, {"\x07\x08"}), {rgba(7, 7, 7, 8)}},
        {"palette",
         png_file(2, 1, 8, PngColour::palette, {std::string("\0\1", 2)}, palette + alphas),
         {rgba(10, 20, 30, 128), rgba(40, 50, 60)}},
        {"palette of 1 bit",
         png_file(2, 1, 1, PngColour::palette, {"\x40"}, palette),
         {rgba(10, 20, 30), rgba(40, 50, 60)}},
        {"colours", png_file(1, 1, 8, PngColour::rgb, {"\x01\x02\x03"}), {rgba(1, 2, 3)}},
        {"colours of 16 bits",
         png_file(1, 1, 16, PngColour::rgb, {"\x01\x01\x02\x02\xFF\xFF"}),
         {rgba(1, 2, 255)}},
        {"colours and alpha", png_file(1, 1, 8, PngColour::rgba, {"\x01\x02\x03\x04"}), {rgba(1, 2, 3, 4)}},
    };
    for (const Row& row : rows) {
        CAPTURE(row.what);
        const render::Scene scene = load(textured_file(row.file)).scene;
        REQUIRE(scene.bitmaps.size() == 1);
        CHECK(scene.bitmaps[0].texels == row.texels);
    }
    const render::Scene jpeg = load(textured_file(jpeg_file())).scene;
    REQUIRE(jpeg.bitmaps.at(0).texels.size() == 64);
    for (const std::uint32_t texel : jpeg.bitmaps[0].texels)
        for (const auto& [shift, value] : {std::pair{0, 200}, {8, 100}, {16, 50}, {24, 255}})
            CHECK(std::abs(static_cast<int>(texel >> shift & 255) - value) <= 2);
}

TEST_CASE("tangents are made where the normal map has none, and mirrored coordinates share no vertex") {
    if (!decodes_images) VNDF_SKIP(no_decoder);
    // Two triangles over an edge on the y axis; u runs away from it on both sides, v up in space is down in images.
    GltfFile file = triangle_file();
    file.attributes()["POSITION"] = file.accessor<float>({0, 0, 0, 0, 1, 0, -1, 0, 0, 1, 0, 0}, "VEC3");
    file.attributes()["NORMAL"] = file.accessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
    file.attributes()["TEXCOORD_0"] = file.accessor<float>({0, 1, 0, 0, 1, 1, 1, 1}, "VEC2");
    file.primitive()["indices"] = file.accessor<std::uint16_t>({0, 1, 2, 0, 3, 1}, "SCALAR");
    file.material()["normalTexture"]["index"] = file.texture(small_png());
    const render::Scene scene = load(file).scene;
    CHECK(scene.vertices.size() == 6);
    for (int k = 0; k < 3; ++k) {
        check_near(corner(scene, 0, k).tangent, {-1, 0, 0, -1});
        check_near(corner(scene, 1, k).tangent, {1, 0, 0, 1});
    }
    // Coordinates turned by a quarter turn the tangent.
    file.material()["normalTexture"]["extensions"]["KHR_texture_transform"] = {
        {"rotation", std::numbers::pi / 2}};
    const render::Scene turned = load(file).scene;
    check_near(corner(turned, 1, 0).tangent, {0, -1, 0, 1});
}

TEST_CASE("vertices in a mirror's line are there once for each side") {
    if (!decodes_images) VNDF_SKIP(no_decoder);
    const render::Scene scene = load(grid_file()).scene;
    CHECK(scene.vertices.size() == 9 + 3);
    for (std::size_t t = 0; t < scene.triangles.size(); ++t) {
        const bool left =
            corner(scene, t, 0).place[0] + corner(scene, t, 1).place[0] + corner(scene, t, 2).place[0] < 3;
        for (int k = 0; k < 3; ++k)
            CHECK(corner(scene, t, k).tangent ==
                  std::array<float, 4>{left ? -1.0f : 1.0f, 0, 0, left ? -1.0f : 1.0f});
    }
    CHECK(corner(scene, 0, 1).colour == std::array<float, 4>{0.5f, 0, 0.5f, 1});
}

TEST_CASE("a tangent is the mean by angles of the triangles around") {
    if (!decodes_images) VNDF_SKIP(no_decoder);
    // A fan about the origin whose coordinates are sheared in the second triangle: tangents along x and along (1, 1).
    GltfFile file = triangle_file();
    file.attributes()["POSITION"] = file.accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, -1, 1, 0}, "VEC3");
    file.attributes()["NORMAL"] = file.accessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
    file.attributes()["TEXCOORD_0"] = file.accessor<float>({0, 1, 1, 1, 0, 0, -1, 1}, "VEC2");
    file.primitive()["indices"] = file.accessor<std::uint16_t>({0, 1, 2, 0, 2, 3}, "SCALAR");
    file.material()["normalTexture"]["index"] = file.texture(small_png());
    const render::Scene scene = load(file).scene;
    CHECK(scene.vertices.size() == 4);
    // Angles at the origin: a right one and half of one.
    const double x = 1 + 0.5 * std::sqrt(0.5), y = -0.5 * std::sqrt(0.5), size = std::hypot(x, y);
    check_near(corner(scene, 0, 0).tangent,
               {static_cast<float>(x / size), static_cast<float>(y / size), 0, 1});
}

TEST_CASE("normals without a direction are those of the triangle") {
    GltfFile file = mapped_file();
    file.attributes()["NORMAL"] = file.accessor<float>({0, 0, 0, 0, 0, 1, 0, NAN, 1}, "VEC3");
    const gltf::Loaded loaded = load(file);
    for (int k = 0; k < 3; ++k) check_near(corner(loaded.scene, 0, k).normal, {0, 0, 1});
    REQUIRE(loaded.warnings.size() == 1);
    CHECK(loaded.warnings[0].second == 2);
}

TEST_CASE("vertices that no triangle uses are left out, however many there are") {
    for (const std::uint32_t count : {4u, 5u, 4000000000u}) {
        CAPTURE(count);
        GltfFile file = triangle_file();
        // Zeros but for the last three. Accessors and views have the same numbers.
        const std::size_t numbers = file.accessor<std::uint32_t>({count - 3, count - 2, count - 1}, "SCALAR"),
                          places = file.accessor<float>({0, 0, 1, 1, 0, 1, 0, 1, 1}, "VEC3");
        file.json["accessors"].push_back({{"componentType", 5126},
                                          {"count", count},
                                          {"type", "VEC3"},
                                          {"sparse",
                                           {{"count", 3},
                                            {"indices", {{"bufferView", numbers}, {"componentType", 5125}}},
                                            {"values", {{"bufferView", places}}}}}});
        file.attributes()["POSITION"] = file.attributes()["NORMAL"] = places + 1;
        file.primitive()["indices"] = numbers;
        const render::Scene scene = load(file).scene;
        CHECK(scene.vertices.size() == 3);
        CHECK(corner(scene, 0, 0).place == render::Vec{0, 0, 1});
        CHECK(corner(scene, 0, 1).place == render::Vec{1, 0, 1});
        CHECK(corner(scene, 0, 2).place == render::Vec{0, 1, 1});
    }
}

TEST_CASE("each extension that is left out is named, up to a number, and counted") {
    GltfFile file = triangle_file();
    for (int i = 0; i < 20; ++i)
        file.json["nodes"][0]["extensions"][fmt::format("EXT_{:02}", i)] = nlohmann::json::object();
    file.json["meshes"][0]["extensions"]["EXT_00"] = nlohmann::json::object();
    file.json["meshes"][0]["extras"]["extensions"]["EXT_extra"] = nlohmann::json::object();
    const auto warnings = load(file).warnings;
    REQUIRE(warnings.size() == 17);
    CHECK(warnings[0] == std::pair<std::string, std::size_t>{"extension 'EXT_00', left out", 2});
    CHECK(warnings[16] == std::pair<std::string, std::size_t>{"other extensions, left out", 4});
}

TEST_CASE("limits are held before memory is asked for") {
    if (!decodes_images) VNDF_SKIP(no_decoder);
    gltf::Limits limits;
    limits.triangles = 1;
    CHECK(refusal("memory", triangle_file().gltf(), no_file, "", limits) == "");
    CHECK(refusal("memory", busy_file().gltf(), no_file, "", limits) ==
          "memory: more than 1 triangles, instances counted");
    limits = {};
    limits.json_bytes = 10;
    CHECK_THAT(refusal("memory", triangle_file().gltf(), no_file, "", limits),
               Catch::Matchers::ContainsSubstring("bytes of JSON; at most 10"));
    limits = {};
    limits.json_values = 10;
    CHECK_THAT(refusal("memory", triangle_file().gltf(), no_file, "", limits),
               Catch::Matchers::ContainsSubstring("JSON of more than 10 values"));
    limits = {};
    limits.sparse_elements = 1;
    CHECK_THAT(refusal("memory", sparse_file().gltf(), no_file, "", limits),
               Catch::Matchers::ContainsSubstring("more elements of sparse accessors"));
    for (const std::string& image : {png_file(2, 1, 8, PngColour::grey, {"ab"}), jpeg_file()}) {
        limits = {};
        limits.image_pixels = 1;
        CHECK_THAT(refusal("memory", textured_file(image).gltf(), no_file, "", limits),
                   Catch::Matchers::ContainsSubstring("pixels; at most 1 are read"));
    }
    // All images together.
    GltfFile two = textured_file(png_file(2, 1, 8, PngColour::grey, {"ab"}));
    two.material()["normalTexture"]["index"] = two.texture(png_file(2, 1, 8, PngColour::grey, {"cd"}));
    limits = {};
    limits.total_pixels = 3;
    CHECK_THAT(refusal("memory", two.gltf(), no_file, "", limits),
               Catch::Matchers::ContainsSubstring("images[1]: 2 x 1 pixels; at most 1 are read"));
}

TEST_CASE("files are those of the scene's folder and below") {
    namespace fs = std::filesystem;
    const fs::path work = fs::temp_directory_path() / fmt::format("clvndf-gltf-{}", ::getpid()),
                   home = work / "home";
    fs::create_directories(home / "below");
    const auto write = [](const fs::path& file, const std::string& bytes) {
        std::ofstream(file, std::ios::binary) << bytes;
        return file;
    };
    const GltfFile whole = triangle_file();
    write(work / "secret.bin", whole.bytes);
    write(home / "below" / "a b\xC3\xA9.bin", whole.bytes);
    fs::create_symlink(work / "secret.bin", home / "link.bin");
    fs::create_directory_symlink(work, home / "way");
    const auto with = [&](const std::string& uri) {
        GltfFile file = whole;
        file.json["buffers"] = {{{"byteLength", whole.bytes.size()}, {"uri", uri}}};
        return refusal(write(home / "scene.gltf", file.gltf()), "");
    };
    CHECK(with("below/a%20b%C3%A9.bin") == "");
    CHECK(with("below/a b\xC3\xA9.bin") == "");
    CHECK(with("./below/../below/a%20b%C3%A9.bin") == "");
    for (const char* uri : {"../secret.bin", "below/../../secret.bin", "%2e%2e/secret.bin", "link.bin",
                            "way/secret.bin", "/etc/passwd", "../home/../secret.bin"}) {
        CAPTURE(uri);
        CHECK_THAT(with(uri), Catch::Matchers::ContainsSubstring("is outside of the scene's folder"));
    }
    CHECK_THAT(with("file:///etc/passwd"), Catch::Matchers::ContainsSubstring("only files beside the scene"));
    CHECK_THAT(with("below"), Catch::Matchers::ContainsSubstring("is no file"));
    CHECK_THAT(with(""), Catch::Matchers::ContainsSubstring("is no name of a file"));
    CHECK_THAT(with("a%00b"), Catch::Matchers::ContainsSubstring("is no name of a file"));
    CHECK_THAT(with("absent.bin"), Catch::Matchers::ContainsSubstring("there is no such file"));
    write(home / "pointer.bin", "version https://git-lfs.github.com/spec/v1\noid sha256:0\n");
    CHECK_THAT(with("pointer.bin"), Catch::Matchers::ContainsSubstring("Git LFS"));
    gltf::Limits limits;
    limits.file_bytes = 10;
    CHECK_THAT(refusal(home / "scene.gltf", "", limits),
               Catch::Matchers::ContainsSubstring("at most 10 are read"));
    CHECK_THAT(refusal(home, ""), Catch::Matchers::ContainsSubstring("is no file"));
    CHECK_THAT(refusal(home / "none.glb", ""), Catch::Matchers::ContainsSubstring("there is no such file"));
    fs::remove_all(work);
}

TEST_CASE("URIs are decoded, or refused") {
    CHECK(gltf::percent_decoded("a%20%C3%a9") == "a \xC3\xA9");
    for (const char* wrong : {"%", "a%4", "%zz", "%4g"}) CHECK(!gltf::percent_decoded(wrong));
    CHECK(gltf::base64_decoded("Zm9vYg==") == "foob");
    CHECK(gltf::base64_decoded("Zm9vYg") == "foob");
    CHECK(gltf::base64_decoded("Zm9vYmE=") == "fooba");
    CHECK(gltf::base64_decoded("") == "");
    for (const char* wrong : {"Z", "Zm9v Yg", "Zm9vYg===", "Z*=="}) CHECK(!gltf::base64_decoded(wrong));
    // Names from a file in a message are short lines of whole characters.
    const std::string long_name = std::string(59, 'a') + "\xC3\xA9";
    CHECK(gltf::printable(long_name) == std::string(59, 'a') + "...");
    CHECK(gltf::printable("a\x1B\n\x7F\xC3\xA9") == "a???\xC3\xA9");
    CHECK(gltf::has_scheme("http://x"));
    CHECK(!gltf::has_scheme("a/b:c"));
}
