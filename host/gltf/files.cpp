#include "gltf/files.h"

#include <algorithm>
#include <fstream>

#include <fmt/format.h>

#include "error.h"

namespace vndf::gltf {
namespace {

namespace fs = std::filesystem;

// What is wrong with a file, or nothing.
std::string read(const fs::path& file, std::uint64_t limit, std::string& bytes) {
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

bool within(const fs::path& folder, const fs::path& file) {
    const auto [end, rest] = std::mismatch(folder.begin(), folder.end(), file.begin(), file.end());
    return end == folder.end();
}

}  // namespace

std::string read_file(const fs::path& file, std::uint64_t limit) {
    std::string bytes;
    const std::string wrong = read(file, limit, bytes);
    if (!wrong.empty()) throw InputError(fmt::format("{}: {}", file.string(), wrong));
    return bytes;
}

Beside beside(const fs::path& folder) {
    return [folder](const Item& place, const std::string& path, std::uint64_t limit) {
        if (path.empty() || path.find('\0') != path.npos)
            place.fail(in_quotes(path) + " is no name of a file");
        const fs::path relative = fs::path(path).lexically_normal();
        const bool leaves = relative.is_absolute() || *relative.begin() == "..";
        std::error_code error;
        const fs::path home = fs::canonical(folder.empty() ? fs::path(".") : folder, error);
        const fs::path file = fs::weakly_canonical(home / relative, error);
        if (leaves || error || !within(home, file))
            place.fail(in_quotes(path) + " is outside of the scene's folder; files of it and below are read");
        std::string bytes;
        const std::string wrong = read(file, limit, bytes);
        if (!wrong.empty()) place.fail(in_quotes(path) + ": " + wrong);
        return bytes;
    };
}

}  // namespace vndf::gltf
