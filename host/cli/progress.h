// How far a command has come, for people at a terminal.
#pragma once

#include <unistd.h>

#include <cstdio>
#include <string>

#include <fmt/format.h>

namespace vndf::cli {

// A line on the terminal that is written over, and gone at the end.
class Progress {
  public:
    explicit Progress(bool quiet) : shown_(!quiet && isatty(STDERR_FILENO)) {}
    ~Progress() { clear(); }
    void operator()(const std::string& what, double done) const {
        if (shown_) fmt::print(stderr, "\r\033[K{:3.0f}%  {}", 100 * done, what), std::fflush(stderr);
    }
    void clear() const {
        if (shown_) fmt::print(stderr, "\r\033[K"), std::fflush(stderr);
    }

  private:
    bool shown_;
};

}  // namespace vndf::cli
