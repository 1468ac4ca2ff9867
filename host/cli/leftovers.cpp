#include "cli/leftovers.h"

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include "error.h"

namespace vndf::cli {
namespace {

namespace fs = std::filesystem;

// For the signal handler, which may touch nothing else; an empty slot starts with 0.
constexpr std::size_t slots = 16, longest_path = 4096;
char leftovers[slots][longest_path];

constexpr int deadly[] = {SIGHUP, SIGINT, SIGQUIT, SIGPIPE, SIGTERM, SIGXCPU};

extern "C" void remove_leftovers_and_die(int signal_number) {
    remove_leftovers();
    std::signal(signal_number, SIG_DFL);
    std::raise(signal_number);
}

}  // namespace

void remove_leftovers() {
    for (std::size_t i = slots; i-- > 0;) {
        if (leftovers[i][0] == '\0') continue;
        unlink(leftovers[i]);
        rmdir(leftovers[i]);
    }
}

void remove_on_signal(const std::string& path) {
    for (char* slot : leftovers) {
        if (slot[0] != '\0' || path.size() >= longest_path) continue;
        std::strcpy(slot, path.c_str());
        break;
    }
    for (int number : deadly) {
        // What the parent had ignored (nohup) stays ignored.
        if (std::signal(number, remove_leftovers_and_die) == SIG_IGN) std::signal(number, SIG_IGN);
    }
}

void keep_on_signal(const std::string& path) {
    for (char* slot : leftovers) {
        if (path == slot) slot[0] = '\0';
    }
}

TemporaryFolder::TemporaryFolder(const std::string& prefix) {
    std::error_code none;
    const fs::path parent = fs::temp_directory_path(none);
    path_ = (none ? fs::path() : fs::absolute(parent) / (prefix + "XXXXXX")).string();
    int ends[2];
    if (none || pipe2(ends, O_CLOEXEC) != 0 || !mkdtemp(path_.data())) {
        const char* const variable = std::getenv("TMPDIR");
        throw InputError(fmt::format("{} '{}': cannot create a folder for temporary files there: {}",
                                     variable ? "TMPDIR" : "temporary folder",
                                     variable ? variable : parent.string(),
                                     none ? none.message() : std::strerror(errno)));
    }
    alive_ = ends[1];
    keeper_ = fork();
    if (keeper_ == 0) {
        setsid();  // away from the terminal, whose signals are for the other
        for (int number : deadly) std::signal(number, SIG_IGN);
        dup2(ends[0], STDIN_FILENO);
        closefrom(STDOUT_FILENO);
        char byte;
        while (read(STDIN_FILENO, &byte, 1) < 0 && errno == EINTR) continue;
        fs::remove_all(path_, none);
        _exit(0);
    }
    close(ends[0]);
}

TemporaryFolder::~TemporaryFolder() {
    close(alive_);
    if (keeper_ > 0) waitpid(keeper_, nullptr, 0);
    std::error_code ignored;
    fs::remove_all(path_, ignored);
}

NewFolder::NewFolder(const std::string& path) {
    std::error_code failure;
    const auto missing = [&](const fs::path& folder) {
        return !folder.empty() && !fs::exists(fs::symlink_status(folder, failure));
    };
    for (fs::path folder = fs::absolute(path, failure); missing(folder); folder = folder.parent_path()) {
        created_.insert(created_.begin(), folder.string());
    }
    for (const std::string& folder : created_) remove_on_signal(folder);
    fs::create_directories(path, failure);
    if (!failure) return;
    remove();
    throw InputError(fmt::format("{}: cannot create this folder: {}", path, failure.message()));
}

NewFolder::~NewFolder() {
    remove();
}

void NewFolder::remove() {
    std::error_code ignored;
    for (std::size_t i = created_.size(); i-- > 0;) fs::remove(created_[i], ignored);
    keep();
}

void NewFolder::keep() {
    for (const std::string& folder : created_) keep_on_signal(folder);
    created_.clear();
}

}  // namespace vndf::cli
