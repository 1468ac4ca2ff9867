#include "file.h"

#include <fstream>

#include <fmt/format.h>

#include "error.h"

namespace vndf {

namespace fs = std::filesystem;

std::string read_into(std::string& bytes, const fs::path& file, std::uint64_t limit) {
    std::error_code error;
    const fs::file_status status = fs::status(file, error);
    if (status.type() == fs::file_type::not_found) return "there is no such file";
    if (error) return "cannot be read: " + error.message();
    if (!fs::is_regular_file(status)) return "is no file";
    std::ifstream stream(file, std::ios::binary);
    const std::uintmax_t size = fs::file_size(file, error);
    if (!stream || error) return "cannot be read";
    if (size > limit) return fmt::format("{} bytes; at most {} are read", size, limit);
    bytes.resize(size);
    stream.read(bytes.data(), static_cast<std::streamsize>(size));
    bytes.resize(static_cast<std::size_t>(stream.gcount()));
    return {};
}

std::string read_file(const fs::path& file, std::uint64_t limit) {
    std::string bytes;
    const std::string wrong = read_into(bytes, file, limit);
    if (!wrong.empty()) throw InputError(fmt::format("{}: {}", file.string(), wrong));
    return bytes;
}

}  // namespace vndf
