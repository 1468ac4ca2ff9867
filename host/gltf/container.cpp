#include "gltf/container.h"

#include <cstring>

#include <fmt/format.h>

#include "error.h"
#include "gltf/uri.h"

namespace vndf::gltf {
namespace {

constexpr std::string_view magic = "glTF";
constexpr std::uint32_t json_chunk = 0x4E4F534A, bin_chunk = 0x004E4942;
constexpr std::size_t header_size = 12, chunk_header_size = 8;

std::uint32_t word(std::string_view bytes, std::size_t at) {
    std::uint32_t result = 0;
    for (int i = 3; i >= 0; --i) result = result << 8 | static_cast<unsigned char>(bytes[at + i]);
    return result;
}

}  // namespace

Chunks chunks_of(const std::string& file, std::string_view bytes) {
    if (!bytes.starts_with(magic) && !file.ends_with(".glb")) return {bytes, {}};
    const auto refuse = [&](const std::string& what) { throw InputError(fmt::format("{}: {}", file, what)); };
    if (bytes.size() < header_size)
        refuse(fmt::format("{} bytes, where the header of a GLB has {}", bytes.size(), header_size));
    if (!bytes.starts_with(magic)) refuse("no GLB: it does not begin with glTF");
    if (word(bytes, 4) != 2) refuse(fmt::format("GLB of version {}; version 2 is read", word(bytes, 4)));
    const std::size_t length = word(bytes, 8);
    if (length > bytes.size())
        refuse(fmt::format("a GLB of {} bytes that says it has {}", bytes.size(), length));
    Chunks chunks;
    bool first = true;
    for (std::size_t at = header_size; at < length; first = false) {
        if (length - at < chunk_header_size) refuse(fmt::format("the chunk at byte {} has no header", at));
        const std::size_t size = word(bytes, at);
        const std::uint32_t type = word(bytes, at + 4);
        at += chunk_header_size;
        if (size > length - at)
            refuse(fmt::format("the chunk at byte {} says it has {} bytes; {} are left",
                               at - chunk_header_size, size, length - at));
        if (first != (type == json_chunk)) refuse("the chunk of JSON is not the first and only one");
        if (type == json_chunk) chunks.json = bytes.substr(at, size);
        if (type == bin_chunk && !chunks.bin) chunks.bin = bytes.substr(at, size);
        at += size;
    }
    if (first) refuse("a GLB without chunks");
    return chunks;
}

std::string_view Resources::of_uri(const Item& uri) {
    const std::string text = uri.text();
    if (is_data_uri(text)) {
        std::optional<std::string> data = data_of(text);
        if (!data) uri.fail("this data URI is not in base64");
        return kept_.emplace_back(std::move(*data));
    }
    if (has_scheme(text)) uri.fail(in_quotes(text) + ": only files beside the scene and data URIs are read");
    const std::optional<std::string> path = percent_decoded(text);
    if (!path) uri.fail(in_quotes(text) + ": a % without two digits after it");
    const std::string& bytes = kept_.emplace_back(beside_(uri, *path, left_));
    left_ -= bytes.size();
    if (bytes.starts_with("version https://git-lfs"))
        uri.fail(in_quotes(*path) + " is what Git LFS has in a file's place; git lfs pull gets the file");
    return bytes;
}

}  // namespace vndf::gltf
