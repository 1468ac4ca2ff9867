// What URIs say: bytes of their own, or the name of a file.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace vndf::gltf {

// Text whose bytes are written as %XX; nothing if one is written wrongly.
std::optional<std::string> percent_decoded(std::string_view text);

// Nothing if a character is none of base64's, or if bits are left over.
std::optional<std::string> base64_decoded(std::string_view text);

bool is_data_uri(std::string_view uri);
// The bytes in it; nothing if they are not in base64.
std::optional<std::string> data_of(std::string_view uri);

// "scheme:", as of an address on the web.
bool has_scheme(std::string_view uri);

}  // namespace vndf::gltf
