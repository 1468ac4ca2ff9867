#include "gltf/files.h"

#include <algorithm>

#include "file.h"

namespace vndf::gltf {
namespace {

namespace fs = std::filesystem;

bool within(const fs::path& folder, const fs::path& file) {
    const auto [end, rest] = std::mismatch(folder.begin(), folder.end(), file.begin(), file.end());
    return end == folder.end();
}

}  // namespace

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
        const std::string wrong = read_into(bytes, file, limit);
        if (!wrong.empty()) place.fail(in_quotes(path) + ": " + wrong);
        return bytes;
    };
}

}  // namespace vndf::gltf
