// glTF files made in memory.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

#include <nlohmann/json.hpp>

#include "base64.h"

namespace vndf::test {

inline std::string data_uri(const std::string& bytes) {
    return "data:application/octet-stream;base64," + base64(bytes);
}

inline std::string little_endian(std::size_t x) {
    std::string bytes;
    for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(x >> shift & 0xFF);
    return bytes;
}

// The JSON is there to be changed; the bytes are buffer 0.
struct GltfFile {
    nlohmann::json json = {{"asset", {{"version", "2.0"}}}};
    std::string bytes;

    std::size_t view(const std::string& content) {
        bytes.resize((bytes.size() + 3) / 4 * 4);
        json["bufferViews"].push_back(
            {{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", content.size()}});
        bytes += content;
        return json["bufferViews"].size() - 1;
    }

    template <class T>
    static int component() {
        if constexpr (std::is_same_v<T, std::int8_t>) return 5120;
        if constexpr (std::is_same_v<T, std::uint8_t>) return 5121;
        if constexpr (std::is_same_v<T, std::int16_t>) return 5122;
        if constexpr (std::is_same_v<T, std::uint16_t>) return 5123;
        if constexpr (std::is_same_v<T, std::uint32_t>) return 5125;
        return 5126;
    }

    // Values one after the other, as many to an element as its type has.
    template <class T>
    std::size_t accessor(const std::vector<T>& values, const std::string& type, bool normalized = false) {
        const std::size_t width = type == "SCALAR" ? 1 : static_cast<std::size_t>(type.back() - '0');
        std::string content(values.size() * sizeof(T), '\0');
        std::memcpy(content.data(), values.data(), content.size());
        json["accessors"].push_back({{"bufferView", view(content)},
                                     {"componentType", component<T>()},
                                     {"count", values.size() / width},
                                     {"type", type}});
        if (normalized) json["accessors"].back()["normalized"] = true;
        return json["accessors"].size() - 1;
    }

    // A texture of an image in the file.
    std::size_t texture(const std::string& image) {
        json["images"].push_back({{"bufferView", view(image)}, {"mimeType", "image/png"}});
        json["textures"].push_back({{"source", json["images"].size() - 1}});
        return json["textures"].size() - 1;
    }

    nlohmann::json& primitive() { return json["meshes"][0]["primitives"][0]; }
    nlohmann::json& attributes() { return primitive()["attributes"]; }
    // The material of the only primitive.
    nlohmann::json& material() {
        primitive()["material"] = 0;
        return json["materials"][0];
    }

    std::string gltf() const {
        nlohmann::json whole = json;
        if (!bytes.empty() && !whole.contains("buffers"))
            whole["buffers"] = {{{"byteLength", bytes.size()}, {"uri", data_uri(bytes)}}};
        return whole.dump();
    }

    std::string glb() const {
        nlohmann::json whole = json;
        if (!whole.contains("buffers")) whole["buffers"] = {{{"byteLength", bytes.size()}}};
        std::string text = whole.dump(), content = bytes;
        text.resize((text.size() + 3) / 4 * 4, ' ');
        content.resize((content.size() + 3) / 4 * 4);
        return "glTF" + little_endian(2) + little_endian(28 + text.size() + content.size()) +
               little_endian(text.size()) + "JSON" + text + little_endian(content.size()) +
               std::string("BIN\0", 4) + content;
    }
};

// One triangle in the plane z = 0, counterclockwise seen from +z, at (0, 0), (1, 0), (0, 1).
inline GltfFile triangle_file() {
    GltfFile file;
    file.json["scene"] = 0;
    file.json["scenes"] = {{{"nodes", {0}}}};
    file.json["nodes"] = {{{"mesh", 0}}};
    file.attributes()["POSITION"] = file.accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
    return file;
}

// That with normals along z and coordinates that are x and 1 - y, as images lie.
inline GltfFile mapped_file() {
    GltfFile file = triangle_file();
    file.attributes()["NORMAL"] = file.accessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
    file.attributes()["TEXCOORD_0"] = file.accessor<float>({0, 1, 1, 1, 0, 0}, "VEC2");
    return file;
}

}  // namespace vndf::test
