// What the command line turns into one line on stderr and an exit status.
#pragma once

#include <stdexcept>
#include <string>

namespace vndf {

class Error : public std::runtime_error {
  public:
    Error(int exit_status, const std::string& message)
        : std::runtime_error(message), exit_status_(exit_status) {}
    int exit_status() const { return exit_status_; }

  private:
    int exit_status_;
};

// What the user gave cannot be used: the message names the file, line, column or option, what was found and
// what is allowed.
struct InputError : Error {
    explicit InputError(const std::string& message) : Error(2, message) {}
};

// A device or a build failed: the message says what, on which device, with which options, at which source
// line.
struct DeviceError : Error {
    explicit DeviceError(const std::string& message) : Error(3, message) {}
};

// The compiler refused the source or the options; with its words.
struct BuildError : DeviceError {
    using DeviceError::DeviceError;
};

}  // namespace vndf
