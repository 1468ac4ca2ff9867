#include "cli/output_file.h"

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <utility>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "error.h"

namespace vndf::cli {
namespace {

// The temporary files of this process, for the signal handler; an empty slot starts with 0.
constexpr std::size_t slots = 8, longest_path = 4096;
char temporaries[slots][longest_path];

extern "C" void remove_temporaries_and_die(int signal_number) {
    for (const char* path : temporaries) {
        if (path[0] != '\0') unlink(path);
    }
    std::signal(signal_number, SIG_DFL);
    std::raise(signal_number);
}

void guard_against_signals(const std::string& path) {
    for (char* slot : temporaries) {
        if (slot[0] != '\0' || path.size() >= longest_path) continue;
        std::strcpy(slot, path.c_str());
        break;
    }
    for (int number : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) {
        // What the parent had ignored (nohup) stays ignored.
        if (std::signal(number, remove_temporaries_and_die) == SIG_IGN) std::signal(number, SIG_IGN);
    }
}

void release_from_signals(const std::string& path) {
    for (char* slot : temporaries) {
        if (path == slot) slot[0] = '\0';
    }
}

}  // namespace

OutputFile::OutputFile(const std::string& path) : path_(path), target_(path) {
    if (path == "-") {
        descriptor_ = STDOUT_FILENO;
        return;
    }
    std::error_code ignored;
    const auto resolved = std::filesystem::canonical(path, ignored);
    if (!resolved.empty()) target_ = resolved.string();

    struct stat status {};
    const bool exists = stat(target_.c_str(), &status) == 0;
    if (exists && !S_ISREG(status.st_mode)) {
        descriptor_ = open(target_.c_str(), O_WRONLY | O_CLOEXEC);
        if (descriptor_ < 0) fail(errno);
        return;
    }
    if (exists && access(target_.c_str(), W_OK) != 0) fail(errno);
    open_temporary();
    const mode_t mask = umask(0);
    umask(mask);
    fchmod(descriptor_, exists ? status.st_mode & 07777 : 0666 & ~mask);
}

void OutputFile::open_temporary() {
    temporary_ = target_ + ".XXXXXX";
    descriptor_ = mkstemp(temporary_.data());
    if (descriptor_ < 0) {
        temporary_.clear();
        fail(errno);
    }
    guard_against_signals(temporary_);
}

OutputFile::~OutputFile() {
    if (descriptor_ > STDERR_FILENO) close(descriptor_);
    if (!temporary_.empty()) {
        unlink(temporary_.c_str());
        release_from_signals(temporary_);
    }
}

void OutputFile::fail(int error) const {
    throw InputError((path_ == "-" ? "standard output" : path_) + ": cannot write: " + std::strerror(error));
}

void OutputFile::write(std::string_view text) {
    while (!text.empty()) {
        const ssize_t written = ::write(descriptor_, text.data(), text.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) fail(errno);
        text.remove_prefix(static_cast<std::size_t>(written));
    }
}

void OutputFile::commit() {
    if (temporary_.empty()) return;
    // Some file systems report a full disk only here.
    const int descriptor = std::exchange(descriptor_, -1);
    if (close(descriptor) != 0) fail(errno);
    if (std::rename(temporary_.c_str(), target_.c_str()) != 0) fail(errno);
    release_from_signals(temporary_);
    temporary_.clear();
}

}  // namespace vndf::cli
