// Tables of energy as text that is kept on disk: a line with a title, a version and a checksum, then a number a line.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace vndf::energy {

std::string kept_text(const std::string& title, const std::vector<float>& numbers);

// The numbers of a text with this title. Throws InputError that says what is wrong with the file at `path`.
std::vector<float> read_kept_text(const std::string& title, std::size_t count, std::string_view text,
                                  const std::string& path);

// `numbers`, twelve a line, as the initialiser of an array of constants in a header.
std::string array_text(const std::string& type, const std::string& name,
                       const std::vector<std::string>& numbers);

}  // namespace vndf::energy
