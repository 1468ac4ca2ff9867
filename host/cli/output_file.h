// A file that is there completely or not at all.
#pragma once

#include <string>
#include <string_view>

namespace vndf::cli {

// Writes to a temporary name beside the target, which commit() renames. Without commit() nothing is left and
// an older file stays as it was, also if the process is interrupted. "-" is the standard output; a target
// that is no regular file (a pipe, /dev/null) is written as it is. Failures throw InputError, naming the
// path.
class OutputFile {
  public:
    explicit OutputFile(const std::string& path);
    ~OutputFile();
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    void write(std::string_view text);
    void commit();

  private:
    [[noreturn]] void fail(int error) const;
    void open_temporary();

    std::string path_;       // as the user named it
    std::string target_;     // with symbolic links followed
    std::string temporary_;  // empty: written directly
    int descriptor_ = -1;
};

}  // namespace vndf::cli
