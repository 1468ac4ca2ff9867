// Words and letters of what users write.
#pragma once

#include <cctype>
#include <charconv>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

namespace vndf {

inline std::string lower(std::string text) {
    for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
}
inline std::string upper(std::string text) {
    for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return text;
}

// One word for a POSIX shell, whatever is in it.
inline std::string quoted_for_shell(std::string_view text) {
    std::string out = "'";
    for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return out + "'";
}

// C99's hex: 0x1.8p-3. Not by fmt's {:a}, which in Debian 13 writes 0 as 0x0p-1022.
template <class R>
std::string hex_number(R x) {
    char digits[32];
    *std::to_chars(digits, digits + sizeof digits - 1, std::abs(x), std::chars_format::hex).ptr = '\0';
    std::string text = std::signbit(x) ? "-" : "";
    if (std::isfinite(x)) text += "0x";
    return text += digits;
}

// What stands between the separators: one part more than there are of them, some of them empty.
inline std::vector<std::string> split(std::string_view text, char separator) {
    std::vector<std::string> parts;
    for (std::size_t end; (end = text.find(separator)) != text.npos; text.remove_prefix(end + 1))
        parts.emplace_back(text.substr(0, end));
    parts.emplace_back(text);
    return parts;
}

}  // namespace vndf
