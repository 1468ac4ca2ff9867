// How far a command has come, for people at a terminal.
#pragma once

#include <unistd.h>

#include <string>

#include "cli/streams.h"

namespace vndf::cli {

// A line on the terminal that is written over, and gone at the end.
class Progress {
  public:
    explicit Progress(bool quiet) : shown_(!quiet && isatty(STDERR_FILENO)) {}
    ~Progress() { clear(); }
    void operator()(const std::string& what, double done) const {
        if (shown_) remark("\r\033[K{:3.0f}%  {}", 100 * done, what);
    }
    void clear() const {
        if (shown_) remark("\r\033[K");
    }

  private:
    bool shown_;
};

}  // namespace vndf::cli
