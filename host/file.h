// A file's bytes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace vndf {

// What is wrong with a file, or nothing, and then its bytes. One of more than `limit` is not read.
std::string read_into(std::string& bytes, const std::filesystem::path& file, std::uint64_t limit);

// Throws InputError, naming the file, if it is no file, cannot be read or holds more than `limit` bytes.
std::string read_file(const std::filesystem::path& file, std::uint64_t limit);

}  // namespace vndf
