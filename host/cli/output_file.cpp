#include "cli/output_file.h"

#include <array>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "cli/leftovers.h"
#include "error.h"

namespace vndf::cli {
namespace {

namespace fs = std::filesystem;

// The descriptor behind "-" and what the system calls descriptors, or -1. Their links lead to files whose names say
// nothing of where the descriptor stands, or are gone.
int named_descriptor(std::string_view path, int dash) {
    if (path == "-") return dash;
    if (path == "/dev/stdin") return STDIN_FILENO;
    if (path == "/dev/stdout") return STDOUT_FILENO;
    if (path == "/dev/stderr") return STDERR_FILENO;
    for (const std::string_view folder : {"/dev/fd/", "/proc/self/fd/"}) {
        if (!path.starts_with(folder)) continue;
        const char *const begin = path.data() + folder.size(), *const last = path.data() + path.size();
        int number = -1;
        const auto [end, error] = std::from_chars(begin, last, number);
        if (error == std::errc() && end == last) return number;
    }
    return -1;
}

// Where `path` leads through symbolic links, also if there is nothing yet.
std::string followed(const std::string& path) {
    fs::path file = path;
    std::error_code none;
    for (int links = 0; links < 40 && fs::is_symlink(file, none); ++links)
        file = file.parent_path() / fs::read_symlink(file, none);
    return file.string();
}

// What a path names; a file that is not there yet by its name alone.
struct Identity {
    bool there = false;
    struct stat status {};
    int descriptor = -1;
    std::string name;
};

Identity identity(const std::string& path, int dash) {
    Identity result;
    result.descriptor = named_descriptor(path, dash);
    result.there = result.descriptor < 0 ? stat(path.c_str(), &result.status) == 0
                                         : fstat(result.descriptor, &result.status) == 0;
    std::error_code none;
    result.name = fs::weakly_canonical(fs::absolute(followed(path), none), none).string();
    return result;
}

// Devices may be named twice: a terminal takes what comes, and /dev/null everything.
bool same_file(const Identity& a, const Identity& b) {
    if (a.descriptor >= 0 && a.descriptor == b.descriptor) return true;
    if (!a.there || !b.there) return a.there == b.there && a.name == b.name;
    return (S_ISREG(a.status.st_mode) || S_ISFIFO(a.status.st_mode)) && a.status.st_dev == b.status.st_dev &&
           a.status.st_ino == b.status.st_ino;
}

bool write_all(int descriptor, std::string_view text) {
    while (!text.empty()) {
        const ssize_t written = ::write(descriptor, text.data(), text.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) return false;
        text.remove_prefix(static_cast<std::size_t>(written));
    }
    return true;
}

}  // namespace

OutputFile::OutputFile(const std::string& path) : path_(path), target_(path) {
    if (const int named = named_descriptor(path, STDOUT_FILENO); named >= 0) {
        const int mode = fcntl(named, F_GETFL);
        if (mode < 0 || (mode & O_ACCMODE) == O_RDONLY) fail(EBADF);
        descriptor_ = fcntl(named, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
        return;
    }
    struct stat status {};
    const bool exists = stat(path.c_str(), &status) == 0;
    if (!exists && errno != ENOENT) fail(errno);
    if (exists) {
        // Opened even if it is to be replaced: it is the surest test that it can be written.
        descriptor_ = open(path.c_str(), O_WRONLY | O_CLOEXEC);
        if (descriptor_ < 0) fail(errno);
        if (!S_ISREG(status.st_mode)) return;
        close(descriptor_);
    }
    target_ = followed(path);
    open_temporary(exists);
    const mode_t mask = umask(0);
    umask(mask);
    fchmod(descriptor_, exists ? status.st_mode & 07777 : 0666 & ~mask);
}

void OutputFile::open_temporary(bool exists) {
    temporary_ = target_ + ".XXXXXX";
    descriptor_ = mkostemp(temporary_.data(), O_CLOEXEC);
    const int error = errno;
    if (descriptor_ < 0 && exists) {  // in a folder that takes no new files
        std::error_code none;
        temporary_ = (fs::temp_directory_path(none) / "clvndf.XXXXXX").string();
        descriptor_ = mkostemp(temporary_.data(), O_CLOEXEC);
    }
    if (descriptor_ < 0) {
        temporary_.clear();
        fail(error);
    }
    remove_on_signal(temporary_);
}

OutputFile::~OutputFile() {
    if (descriptor_ >= 0) close(descriptor_);
    if (!temporary_.empty()) {
        unlink(temporary_.c_str());
        keep_on_signal(temporary_);
    }
}

void OutputFile::fail(int error) const {
    throw InputError((path_ == "-" ? "standard output" : path_) + ": cannot write: " + std::strerror(error));
}

void OutputFile::write(std::string_view text) {
    if (!write_all(descriptor_, text)) fail(errno);
}

void OutputFile::commit() {
    // Some file systems report a full disk only here.
    if (close(std::exchange(descriptor_, -1)) != 0) fail(errno);
    if (temporary_.empty()) return;
    if (std::rename(temporary_.c_str(), target_.c_str()) != 0) {
        write_in_place();
        unlink(temporary_.c_str());
    }
    keep_on_signal(temporary_);
    temporary_.clear();
}

// For a target that rename() refuses to replace.
void OutputFile::write_in_place() {
    const int refusal = errno;
    const int from = open(temporary_.c_str(), O_RDONLY | O_CLOEXEC);
    // Not created: a new file comes by renaming or not at all.
    const int to = open(target_.c_str(), O_WRONLY | O_TRUNC | O_CLOEXEC);
    int error = from < 0 || to < 0 ? refusal : 0;
    std::array<char, 1 << 16> part;
    while (error == 0) {
        const ssize_t count = read(from, part.data(), part.size());
        if (count == 0) break;
        if (count < 0 || !write_all(to, {part.data(), static_cast<std::size_t>(count)})) error = errno;
    }
    if (from >= 0) close(from);
    if (to >= 0 && close(to) != 0 && error == 0) error = errno;
    if (error != 0) fail(error);
}

std::string in_folder(const std::string& folder, const char* name) {
    return (fs::path(folder) / name).string();
}

bool is_standard_output(const std::string& path) {
    return named_descriptor(path, STDOUT_FILENO) == STDOUT_FILENO;
}

void require_distinct(const std::vector<NamedFile>& outputs, const std::vector<NamedFile>& inputs) {
    for (std::size_t i = 0; i < outputs.size(); ++i) {
        const auto& [option, path] = outputs[i];
        if (path.empty()) continue;
        const auto compare = [&, &option = option, &path = path](const NamedFile& other, int dash) {
            if (other.second.empty() ||
                !same_file(identity(path, STDOUT_FILENO), identity(other.second, dash)))
                return;
            throw InputError(fmt::format("{} {} and {} {}: one file; each needs its own", other.first,
                                         other.second, option, path));
        };
        for (std::size_t j = 0; j < i; ++j) compare(outputs[j], STDOUT_FILENO);
        for (const NamedFile& input : inputs) compare(input, STDIN_FILENO);
    }
}

}  // namespace vndf::cli
