// Small glTF files, each with what must come of it: for tests, and as the fuzzer's seeds.
#pragma once

#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "png_file.h"
#include "support/gltf_file.h"

namespace vndf::test {

struct GltfCase {
    std::string name;  // of the file
    std::string bytes;
    std::string error;    // a part of the refusal; empty: it is read
    std::string warning;  // a part of one; empty: there is none
};

// 8 x 8 pixels of red 200, green 100, blue 50.
inline std::string jpeg_file() {
    constexpr std::string_view text =
        "/9j/2wBDAAMCAgMCAgMDAwMEAwMEBQgFBQQEBQoHBwYIDAoMDAsKCwsNDhIQDQ4RDgsLEBYQERMUFRUVDA8XGBYUGB"
        "IUFRT/2wBDAQMEBAUEBQkFBQkUDQsNFBQUFBQUFBQUFBQUFBQUFBQUFBQUFBQUFBQUFBQUFBQUFBQUFBQUFBQUFBQU"
        "FBQUFBT/wAARCAAIAAgDAREAAhEBAxEB/8QAFAABAAAAAAAAAAAAAAAAAAAABP/EABQQAQAAAAAAAAAAAAAAAAAAAA"
        "D/xAAVAQEBAAAAAAAAAAAAAAAAAAAHCP/EABQRAQAAAAAAAAAAAAAAAAAAAAD/2gAMAwEAAhEDEQA/ACA9SD//2Q==";
    std::string bytes;
    std::uint32_t bits = 0;
    int count = 0;
    for (const char c : text.substr(0, text.find('='))) {
        const int digit = c == '+'   ? 62
                          : c == '/' ? 63
                          : c <= '9' ? c - '0' + 52
                          : c <= 'Z' ? c - 'A'
                                     : c - 'a' + 26;
        bits = bits << 6 | static_cast<std::uint32_t>(digit);
        count += 6;
        if (count >= 8) bytes += static_cast<char>(bits >> (count -= 8) & 0xFF);
    }
    return bytes;
}

inline std::string small_png() {
    return png_file(1, 1, 8, PngColour::rgb, {"\x10\x20\x30"});
}

// A triangle with an image on it.
inline GltfFile textured_file(const std::string& image) {
    GltfFile file = mapped_file();
    file.material()["pbrMetallicRoughness"]["baseColorTexture"]["index"] = file.texture(image);
    return file;
}

// Everything that a material can say.
inline GltfFile rich_file() {
    GltfFile file = mapped_file();
    const nlohmann::json texture = {{"index", file.texture(small_png())}};
    nlohmann::json& material = file.material();
    material = {{"name", "all\nof it"},
                {"pbrMetallicRoughness",
                 {{"baseColorFactor", {0.5, 0.6, 0.7, 0.8}},
                  {"metallicFactor", 0.25},
                  {"roughnessFactor", 0.5},
                  {"baseColorTexture", texture},
                  {"metallicRoughnessTexture", texture}}},
                {"normalTexture", texture},
                {"emissiveTexture", texture},
                {"emissiveFactor", {1, 0.5, 0.25}},
                {"alphaMode", "MASK"},
                {"alphaCutoff", 0.4},
                {"doubleSided", true}};
    material["normalTexture"]["scale"] = 0.75;
    nlohmann::json& extensions = material["extensions"];
    extensions["KHR_materials_anisotropy"] = {
        {"anisotropyStrength", 0.5}, {"anisotropyRotation", 7}, {"anisotropyTexture", texture}};
    extensions["KHR_materials_clearcoat"] = {{"clearcoatFactor", 0.9},
                                             {"clearcoatRoughnessFactor", 0.2},
                                             {"clearcoatTexture", texture},
                                             {"clearcoatRoughnessTexture", texture}};
    extensions["KHR_materials_dispersion"] = {{"dispersion", 0.3}};
    extensions["KHR_materials_emissive_strength"] = {{"emissiveStrength", 20}};
    extensions["KHR_materials_ior"] = {{"ior", 1.33}};
    extensions["KHR_materials_specular"] = {{"specularFactor", 0.4},
                                            {"specularColorFactor", {1, 0.9, 0.8}},
                                            {"specularTexture", texture},
                                            {"specularColorTexture", texture}};
    extensions["KHR_materials_transmission"] = {{"transmissionFactor", 0.95},
                                                {"transmissionTexture", texture}};
    extensions["KHR_materials_volume"] = {
        {"thicknessFactor", 2}, {"attenuationDistance", 3}, {"attenuationColor", {0.25, 0, 1}}};
    return file;
}

// Two scenes; the one to be shown has lights and cameras under nodes that turn, and one mesh in two places.
inline GltfFile busy_file() {
    GltfFile file = mapped_file();
    const double half = std::sqrt(0.5);
    file.json["scene"] = 1;
    file.json["scenes"] = {{{"nodes", {0}}}, {{"nodes", {1, 4}}}};
    file.json["nodes"] = {
        {{"mesh", 0}},
        {{"name", "arm"}, {"translation", {1, 2, 3}}, {"rotation", {0, half, 0, half}}, {"children", {2, 3}}},
        {{"mesh", 0}, {"scale", {-2, 2, 2}}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}},
        {{"name", "eye"}, {"camera", 1}, {"extensions", {{"KHR_lights_punctual", {{"light", 1}}}}}},
        {{"matrix", {1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 5, 1}}, {"children", {5}}},
        {{"mesh", 0}, {"camera", 0}, {"extensions", {{"KHR_lights_punctual", {{"light", 2}}}}}}};
    file.json["cameras"] = {
        {{"type", "orthographic"}, {"orthographic", {{"xmag", 2}, {"ymag", 3}, {"znear", 0}, {"zfar", 9}}}},
        {{"name", "front"},
         {"type", "perspective"},
         {"perspective", {{"yfov", 1}, {"aspectRatio", 2}, {"znear", 1}}}}};
    file.json["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "point"}, {"intensity", 40}, {"color", {1, 0.5, 0}}},
        {{"type", "spot"}, {"spot", {{"innerConeAngle", 0.25}}}},
        {{"type", "directional"}, {"intensity", 3}}};
    return file;
}

// Positions of 16 bits, normals of 8, coordinates of 8, colours of 16, indices of 8; a strip.
inline GltfFile quantized_file() {
    GltfFile file = triangle_file();
    file.json["extensionsUsed"] = file.json["extensionsRequired"] = {"KHR_mesh_quantization"};
    file.primitive()["mode"] = 5;
    file.attributes()["POSITION"] =
        file.accessor<std::int16_t>({0, 0, 0, 100, 0, 0, 0, 50, 0, 100, 50, 0}, "VEC3");
    file.attributes()["NORMAL"] =
        file.accessor<std::int8_t>({0, 0, 127, 0, 0, 127, 0, 0, 127, 0, 0, 127}, "VEC3", true);
    file.attributes()["TEXCOORD_0"] =
        file.accessor<std::uint8_t>({0, 255, 255, 255, 0, 0, 255, 0}, "VEC2", true);
    file.attributes()["COLOR_0"] = file.accessor<std::uint16_t>(
        {65535, 0, 0, 0, 65535, 0, 0, 0, 65535, 65535, 65535, 65535}, "VEC3", true);
    file.primitive()["indices"] = file.accessor<std::uint8_t>({0, 1, 2, 3}, "SCALAR");
    return file;
}

// Vertices that are zero but for those given, twice.
inline GltfFile sparse_file() {
    GltfFile file = triangle_file();
    const std::size_t numbers = file.view(std::string("\0\2", 2));
    file.accessor<float>({3, 0, 0, 0, 4, 0}, "VEC3");
    const std::size_t others = file.json["accessors"][1]["bufferView"];
    file.json["accessors"][1] = {{"componentType", 5126},
                                 {"count", 3},
                                 {"type", "VEC3"},
                                 {"sparse",
                                  {{"count", 2},
                                   {"indices", {{"bufferView", numbers}, {"componentType", 5121}}},
                                   {"values", {{"bufferView", others}}}}}};
    file.attributes()["POSITION"] = 1;
    return file;
}

// A triangle whose corners hang at one joint, at the other, and between both; its own node is elsewhere.
inline GltfFile skinned_file() {
    GltfFile file = triangle_file();
    file.json["scenes"][0]["nodes"] = {0, 1};
    file.json["nodes"] = {{{"mesh", 0}, {"skin", 0}, {"translation", {100, 0, 0}}},
                          {{"translation", {0, 0, 1}}, {"children", {2}}},
                          {{"scale", {2, 2, 2}}}};
    file.attributes()["JOINTS_0"] = file.accessor<std::uint8_t>({0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0}, "VEC4");
    file.attributes()["WEIGHTS_0"] = file.accessor<float>({1, 0, 0, 0, 2, 0, 0, 0, 0.5, 0.5, 0, 0}, "VEC4");
    const std::size_t inverses = file.accessor<float>({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, -1, 1,  //
                                                       1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0,  1},
                                                      "VEC4");
    file.json["accessors"][inverses]["type"] = "MAT4";
    file.json["accessors"][inverses]["count"] = 2;
    file.json["skins"] = {{{"joints", {1, 2}}, {"inverseBindMatrices", inverses}}};
    return file;
}

// Three by three vertices under a normal map whose coordinates are mirrored in the middle column.
inline GltfFile grid_file() {
    GltfFile file = triangle_file();
    std::vector<float> places, normals, coordinates, colours, tangents;
    std::vector<std::uint32_t> indices;
    for (const std::uint32_t row : {0u, 1u, 2u})
        for (const std::uint32_t column : {0u, 1u, 2u}) {
            const auto x = static_cast<float>(column), y = static_cast<float>(row);
            places.insert(places.end(), {x, y, 0.1f * x * y});
            normals.insert(normals.end(), {0, 0, 1});
            coordinates.insert(coordinates.end(), {std::abs(x - 1), 1 - y / 2});
            colours.insert(colours.end(), {x / 2, y / 2, 0.5f, 1});
            tangents.insert(tangents.end(), {1, 0, 0, 1});
            if (row == 2 || column == 2) continue;
            const std::uint32_t a = 3 * row + column;
            indices.insert(indices.end(), {a, a + 1, a + 4, a, a + 4, a + 3});
        }
    file.attributes() = {{"POSITION", file.accessor(places, "VEC3")},
                         {"NORMAL", file.accessor(normals, "VEC3")},
                         {"TEXCOORD_0", file.accessor(coordinates, "VEC2")},
                         {"COLOR_0", file.accessor(colours, "VEC4")}};
    file.accessor(tangents, "VEC4");  // for whom wants them
    file.primitive()["indices"] = file.accessor(indices, "SCALAR");
    file.material()["normalTexture"]["index"] = file.texture(small_png());
    file.json["textures"][0]["sampler"] = 0;
    file.json["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}, {"minFilter", 9987}}};
    return file;
}

inline std::vector<GltfCase> sound_cases() {
    GltfFile chunked = busy_file();
    std::string more = chunked.glb() + little_endian(4) + "ODD!abcd";
    more.replace(8, 4, little_endian(more.size()));
    GltfFile given = grid_file();
    given.attributes()["TANGENT"] = 5;
    return {{"grid.glb", grid_file().glb(), "", ""},
            {"given.glb", given.glb(), "", ""},
            {"triangle.gltf", triangle_file().gltf(), "", ""},
            {"triangle.glb", triangle_file().glb(), "", ""},
            {"more.glb", more, "", ""},
            {"rich.glb", rich_file().glb(), "", ""},
            {"rich.gltf", rich_file().gltf(), "", ""},
            {"busy.gltf", busy_file().gltf(), "", ""},
            {"quantized.glb", quantized_file().glb(), "", ""},
            {"sparse.gltf", sparse_file().gltf(), "", ""},
            {"jpeg.glb", textured_file(jpeg_file()).glb(), "", ""}};
}

// A triangle, with the value at a place of its JSON changed.
inline GltfFile edited(const std::string& place, const nlohmann::json& value,
                       GltfFile file = triangle_file()) {
    file.json[nlohmann::json::json_pointer(place)] = value;
    return file;
}

inline std::vector<GltfCase> defects() {
    std::vector<GltfCase> cases;
    const auto add = [&](const std::string& name, const GltfFile& file, const std::string& error,
                         const std::string& warning = {}) {
        cases.push_back({name + ".gltf", file.gltf(), error, warning});
    };
    const auto add_bytes = [&](const std::string& name, const std::string& bytes, const std::string& error) {
        cases.push_back({name, bytes, error, ""});
    };
    const nlohmann::json view = {{"buffer", 0}, {"byteLength", 36}};
    add("accessor-count", edited("/accessors/0/count", 4), "accessors[0]: 4 elements of 12 bytes");
    add("accessor-count_zero", edited("/accessors/0/count", 0), "accessors[0].count: 0 is out of range");
    add("accessor-count_huge", edited("/accessors/0/count", 5000000000), "accessors[0].count: 5000000000");
    add("accessor-count_wraps", edited("/accessors/0/count", 1e300),
        "accessors[0].count: 1e+300 is no whole");
    add("accessor-count_negative", edited("/accessors/0/count", -3), "accessors[0].count: -3");
    add("accessor-count_fraction", edited("/accessors/0/count", 2.5), "accessors[0].count: 2.5 is no whole");
    add("accessor-count_text", edited("/accessors/0/count", "3"), "accessors[0].count: '3' is no whole");
    add("accessor-offset", edited("/accessors/0/byteOffset", 4), "do not fit its bufferView of 36 bytes");
    add("accessor-type", edited("/accessors/0/type", "VEC5"), "accessors[0].type: 'VEC5'");
    add("accessor-component", edited("/accessors/0/componentType", 5124), "accessors[0].componentType: 5124");
    add("accessor-normalized", edited("/accessors/0/normalized", true), "accessors[0].normalized");
    add("accessor-view", edited("/accessors/0/bufferView", 7),
        "there is no bufferView 7; those of the file are 0 to 0");
    add("accessors-no_array", edited("/accessors", 5), "accessors: 5 is no array");
    add("view-too_long", edited("/bufferViews/0/byteLength", 37),
        "bufferViews[0]: 37 bytes from 0 on do not fit");
    add("view-offset", edited("/bufferViews/0/byteOffset", 1),
        "bufferViews[0]: 36 bytes from 1 on do not fit");
    add("view-stride", edited("/bufferViews/0/byteStride", 8), "overlap");
    add("view-stride_wild", edited("/bufferViews/0/byteStride", 256), "bufferViews[0].byteStride: 256");
    add("buffer-base64", edited("/buffers", {{{"byteLength", 36}, {"uri", "data:;base64,AA*A"}}}),
        "not in base64");
    add("buffer-base64_rest", edited("/buffers", {{{"byteLength", 1}, {"uri", "data:;base64,A"}}}),
        "not in base64");
    add("buffer-plain", edited("/buffers", {{{"byteLength", 2}, {"uri", "data:text/plain,AAAA"}}}),
        "not in base64");
    add("buffer-web", edited("/buffers", {{{"byteLength", 2}, {"uri", "https://a/b.bin"}}}),
        "only files beside");
    add("buffer-percent", edited("/buffers", {{{"byteLength", 2}, {"uri", "a%2.bin"}}}),
        "a % without two digits");
    add("buffer-no_uri", edited("/buffers", {{{"byteLength", 36}}}), "buffers[0]: has no uri");
    add(
        "index-out_of_range",
        [] {
            GltfFile file = triangle_file();
            file.primitive()["indices"] = file.accessor<std::uint16_t>({0, 1, 3}, "SCALAR");
            return file;
        }(),
        "index 3 at 2: the vertices are 3");
    add(
        "index-restart",
        [] {
            GltfFile file = triangle_file();
            file.primitive()["indices"] = file.accessor<std::uint8_t>({0, 1, 255}, "SCALAR");
            return file;
        }(),
        "the restart value");
    add(
        "index-rest",
        [] {
            GltfFile file = triangle_file();
            file.primitive()["indices"] = file.accessor<std::uint32_t>({0, 1, 2, 0}, "SCALAR");
            return file;
        }(),
        "", "no whole triangle");
    add(
        "mesh-counts",
        [] {
            GltfFile file = triangle_file();
            file.attributes()["NORMAL"] = file.accessor<float>({0, 0, 1, 0, 0, 1}, "VEC3");
            return file;
        }(),
        "NORMAL: 2 elements for 3 vertices");
    add(
        "mesh-short_positions",
        [] {
            GltfFile file = triangle_file();
            file.attributes()["POSITION"] = file.accessor<std::int16_t>({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
            return file;
        }(),
        "POSITION: VEC3 of components 5122");
    add("mesh-mode", edited("/meshes/0/primitives/0/mode", 7), "mode: 7 is out of range");
    add("mesh-points", edited("/meshes/0/primitives/0/mode", 0),
        "nothing to render: the scene has no triangle; points");
    add("mesh-zeros", edited("/accessors/0", {{"componentType", 5126}, {"count", 3}, {"type", "VEC3"}}),
        "without an area");
    add("mesh-zeros_many",
        edited("/accessors/0", {{"componentType", 5126}, {"count", 4000000000}, {"type", "VEC3"}}),
        "triangles, instances counted");
    add(
        "mesh-nan",
        [] {
            GltfFile file = triangle_file();
            file.attributes()["POSITION"] =
                file.accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, NAN, 1, 0, 0, 0, 1, 0}, "VEC3");
            return file;
        }(),
        "", "no numbers or too far, dropped");
    add(
        "mesh-nan_mapped",
        [] {
            GltfFile file = mapped_file();
            file.attributes()["POSITION"] =
                file.accessor<float>({NAN, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
            file.attributes()["NORMAL"] =
                file.accessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
            file.attributes()["TEXCOORD_0"] =
                file.accessor<float>({0, 1, 1, 1, 0, 0, 0, 1, 1, 1, 0, 0}, "VEC2");
            file.material()["normalTexture"]["index"] = file.texture(small_png());
            return file;
        }(),
        "", "no numbers or too far, dropped");
    add(
        "mesh-far",
        [] {
            GltfFile file = triangle_file();
            file.attributes()["POSITION"] =
                file.accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1e16f, 1, 0, 0, 0, 1, 0}, "VEC3");
            return file;
        }(),
        "", "no numbers or too far, dropped");
    add("node-cycle", edited("/nodes", {{{"mesh", 0}}, {{"children", {2}}}, {{"children", {1}}}}),
        "nodes[1]: is below itself");
    add("node-own_child", edited("/nodes", {{{"mesh", 0}, {"children", {0}}}}), "nodes[0]: is below itself");
    add("node-two_parents", edited("/nodes", {{{"mesh", 0}}, {{"children", {0}}}, {{"children", {0}}}}),
        "node 0 has two parents");
    add("node-not_a_root", edited("/nodes", {{{"mesh", 0}}, {{"children", {0}}}}), "node 0 is below another");
    add("node-twice", edited("/scenes/0/nodes", {0, 0}), "listed twice");
    add("node-mesh", edited("/nodes/0/mesh", 1), "nodes[0].mesh: there is no mesh 1");
    add("node-rotation", edited("/nodes/0/rotation", {0, 0, 0, 0}), "a quaternion of length 0");
    add("node-rotation_long", edited("/nodes/0/rotation", {0, 0, 0, 2}), "", "made unit quaternions");
    add("node-translation", edited("/nodes/0/translation", {0, 0}), "an array of 2, where 3 numbers belong");
    add("node-translation_text", edited("/nodes/0/translation", {0, "a", 0}),
        "translation[1]: 'a' is no number");
    add("node-translation_huge", edited("/nodes/0/translation", {0, 1e39, 0}),
        "1e+39 is no number of floats");
    add("node-perspective", edited("/nodes/0/matrix", {1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}),
        "its last row");
    add("node-scale_zero", edited("/nodes/0/scale", {0, 1, 1}), "without an area");
    add("scene-none", edited("/scene", 1), "scene: there is no scene 1");
    add("scene-empty", edited("/scenes/0", nlohmann::json::object()), "nothing to render");
    add("material-none", edited("/meshes/0/primitives/0/material", 0), "there is no material 0");
    add("material-alpha",
        edited("/materials", {{{"alphaMode", "GLOW"}}},
               [] {
                   GltfFile file = triangle_file();
                   file.material();
                   return file;
               }()),
        "alphaMode: 'GLOW'");
    add("material-texture",
        edited("/materials", {{{"normalTexture", {{"index", 3}}}}},
               [] {
                   GltfFile file = mapped_file();
                   file.material();
                   return file;
               }()),
        "there is no texture 3");
    add("material-roughness",
        edited("/materials", {{{"pbrMetallicRoughness", {{"roughnessFactor", 2}}}}},
               [] {
                   GltfFile file = mapped_file();
                   file.material();
                   return file;
               }()),
        "", "roughnessFactor 2 to 1");
    add("material-third_set",
        edited("/materials/0/pbrMetallicRoughness/baseColorTexture/texCoord", 2, textured_file(small_png())),
        "", "set 2 or above");
    add(
        "material-no_set",
        [] {
            GltfFile file = textured_file(small_png());
            file.attributes().erase("TEXCOORD_0");
            return file;
        }(),
        "", "without the texture coordinates");
    add("sampler-wrap",
        edited("/samplers", {{{"wrapS", 1}}},
               [] {
                   GltfFile file = textured_file(small_png());
                   file.json["textures"][0]["sampler"] = 0;
                   return file;
               }()),
        "samplers[0].wrapS");
    add("texture-no_source", edited("/textures/0", nlohmann::json::object(), textured_file(small_png())), "",
        "textures without an image");
    add("texture-source", edited("/textures/0/source", 1, textured_file(small_png())), "there is no image 1");
    const std::string png = small_png();
    add("png-truncated", textured_file(png.substr(0, png.size() - 24)), "images[0]: the file ends early");
    add("png-header", textured_file(png.substr(0, 20)), "images[0]: the file ends early");
    std::string flipped = png;
    flipped[45] ^= 1;  // in the pixels' chunk
    add("png-damaged", textured_file(flipped), "images[0]: ");
    add("png-bomb", textured_file(png_file(60000, 60000, 8, PngColour::rgb, {""})), "60000 x 60000 pixels");
    add("png-empty_bomb", textured_file(png_file(8000, 8000, 8, PngColour::rgb, {""})),
        "8000 x 8000 pixels in ");
    add("png-no_rows", textured_file(png_file(8, 8, 8, PngColour::rgb, {""})), "images[0]: ");
    add("image-webp", textured_file("RIFF\0\0\0\0WEBPVP8 "), "neither PNG nor JPEG");
    const std::string jpeg = jpeg_file();
    add("jpeg-truncated", textured_file(jpeg.substr(0, jpeg.size() - 6)), "", "images that are damaged");
    add("jpeg-header", textured_file(jpeg.substr(0, 100)), "images[0]: ");
    add("light-type", edited("/extensions/KHR_lights_punctual/lights/0/type", "area", busy_file()), "'area'");
    add("light-none", edited("/extensions/KHR_lights_punctual/lights", nlohmann::json::array(), busy_file()),
        "there is no light 0");
    add("light-negative", edited("/extensions/KHR_lights_punctual/lights/0/intensity", -1, busy_file()), "",
        "intensity -1 to 0");
    add("light-cones", edited("/extensions/KHR_lights_punctual/lights/1/spot/innerConeAngle", 2, busy_file()),
        "", "innerConeAngle 2 to ");
    add("light-nowhere", edited("/nodes/1/translation", {1e20, 0, 0}, busy_file()), "",
        "lights without a place");
    add("camera-nowhere", edited("/nodes/4/matrix/12", 1e20, busy_file()),
        "nodes[5]: the camera here looks nowhere");
    add("camera-angle", edited("/cameras/0/orthographic/xmag", 0, busy_file()),
        "cameras[0].orthographic.xmag: 0");
    add("camera-type", edited("/cameras/0/type", "fisheye", busy_file()), "'fisheye'");
    add("camera-none", edited("/nodes/5/camera", 4, busy_file()), "there is no camera 4");
    add("extension-required", edited("/extensionsRequired", {"KHR_draco_mesh_compression", "EXT_x\ny"}),
        "not supported: 'KHR_draco_mesh_compression', 'EXT_x?y'");
    add("extension-optional", edited("/nodes/0/extensions/EXT_odd", nlohmann::json::object()), "",
        "'EXT_odd'");
    add("asset-version", edited("/asset/version", "3.0"), "asset.version: '3.0'");
    add("asset-min_version", edited("/asset/minVersion", "2.1"), "asset.minVersion: '2.1'");
    add("asset-none", edited("/asset", nullptr), "asset: null is no object");
    add("skin", skinned_file(), "", "skins, shown at rest");
    add("skin-none", edited("/nodes/0/skin", 1, skinned_file()), "there is no skin 1");
    add("skin-no_joints", edited("/skins/0/joints", nlohmann::json::array(), skinned_file()),
        "without joints");
    add("skin-joint", edited("/skins/0/joints", {1}, skinned_file()), "joint 1 of vertex 1: its skin has 1");
    add("skin-elsewhere", edited("/scenes/0/nodes", {0}, skinned_file()),
        "skins[0].joints[0]: a joint that is not");
    add("skin-inverses", edited("/skins/0/inverseBindMatrices", 0, skinned_file()),
        "not a MAT4 of floats for each of 2");
    add("skin-weights", edited("/accessors/2/type", "VEC3", skinned_file()), "WEIGHTS_0: VEC3");
    add("skin-unused", edited("/nodes/0/skin", 0), "", "skins, shown at rest");
    add("morph", edited("/meshes/0/primitives/0/targets", {{{"POSITION", 0}}}), "", "morph targets");
    add("animation", edited("/animations", nlohmann::json::array({nlohmann::json::object()})), "",
        "animations");
    add("sparse-order",
        edited("/accessors/1/sparse/indices/byteOffset", 1,
               edited("/bufferViews/1/byteLength", 3, sparse_file())),
        "accessors[1].sparse.indices: index 0 at 1");
    add("sparse-count", edited("/accessors/1/sparse/count", 4, sparse_file()),
        "sparse.count: 4 is out of range");
    add("sparse-signed", edited("/accessors/1/sparse/indices/componentType", 5120, sparse_file()),
        "unsigned");
    add("sparse-values", edited("/accessors/1/sparse/values/byteOffset", 4, sparse_file()), "sparse.values");
    const std::string deep(200000, '['), shut(200000, ']');
    add_bytes("json-deep.gltf", R"({"asset":{"version":"2.0"},"extras":)" + deep + shut + "}",
              "nested more than 128");
    add_bytes("json-open.gltf", deep, "nested more than 128");
    add_bytes("json-cut.gltf", triangle_file().gltf().substr(0, 100), "no JSON");
    add_bytes("json-array.gltf", "[]", "the JSON is no object");
    add_bytes("json-utf8.gltf", "{\"asset\": \"\xFF\"}", "no JSON");
    add_bytes("json-number.gltf", R"({"asset": 1e999})", "too large");
    const std::string glb = triangle_file().glb();
    add_bytes("glb-short.glb", glb.substr(0, 11), "11 bytes, where the header");
    add_bytes("glb-no_chunk.glb", "glTF" + little_endian(2) + little_endian(12), "without chunks");
    add_bytes("glb-cut.glb", glb.substr(0, glb.size() - 1), "that says it has");
    add_bytes("glb-version.glb", "glTF" + little_endian(1) + glb.substr(8), "GLB of version 1");
    add_bytes("glb-chunk_size.glb", glb.substr(0, 12) + "\xFF\xFF\xFF\xFF" + glb.substr(16), "bytes; ");
    add_bytes("glb-chunk_type.glb", glb.substr(0, 16) + "BIN" + '\0' + glb.substr(20),
              "not the first and only");
    return cases;
}

}  // namespace vndf::test
