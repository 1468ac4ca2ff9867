// The command line as a whole: what the arguments ask for, apart from doing it.
#pragma once

#include <optional>

#include "cli/commands.h"

namespace vndf::cli {

class CommandLine {
  public:
    // ranks: those of this run, if they are several processes.
    explicit CommandLine(runtime::Ranks* ranks = nullptr);
    CommandLine(const CommandLine&) = delete;
    CommandLine& operator=(const CommandLine&) = delete;

    // Throws InputError at what no command takes; touches no file and no device. Once only.
    void parse(int argc, const char* const* argv);

    // Does what was asked for; returns the exit status.
    int run();

    const Common& common() const { return common_; }
    // The commands and their options, for the tests.
    CLI::App& app() { return app_; }

  private:
    std::optional<runtime::Ranks> alone_;
    CLI::App app_;
    Common common_;
};

}  // namespace vndf::cli
