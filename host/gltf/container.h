// Where the JSON and the bytes of a scene are.
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <string_view>

#include "gltf/files.h"
#include "gltf/json.h"

namespace vndf::gltf {

// A .gltf as it is, or the chunks of a .glb; they live as long as the file's bytes.
struct Chunks {
    std::string_view json;
    std::optional<std::string_view> bin;
};
Chunks chunks_of(const std::string& file, std::string_view bytes);

// Bytes that the JSON names, kept as long as this.
class Resources {
  public:
    Resources(Beside beside, const Limits& limits) : beside_(std::move(beside)), left_(limits.total_bytes) {}
    // Those of a data URI, or of a file beside the scene.
    std::string_view of_uri(const Item& uri);

  private:
    Beside beside_;
    std::uint64_t left_;
    std::deque<std::string> kept_;
};

}  // namespace vndf::gltf
