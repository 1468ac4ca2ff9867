// A file that is there completely or not at all.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace vndf::cli {

// Writes to a temporary name beside the target, which commit() renames. Without commit() nothing is left and
// an older file stays as it was, also if the process is interrupted. Where a file can be written but not replaced
// (another is mounted on it, or its folder is read-only), commit() writes it in place. Links are followed. "-" is the
// standard output, /dev/fd/3 an open descriptor; they and a target that is no regular file (a pipe, /dev/null) are
// written as they are. Failures throw InputError, naming the path; the constructor finds all but a full disk.
class OutputFile {
  public:
    explicit OutputFile(const std::string& path);
    ~OutputFile();
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    void write(std::string_view text);
    void commit();

    // What another program is to write instead, before commit().
    const std::string& temporary_path() const { return temporary_.empty() ? target_ : temporary_; }

  private:
    [[noreturn]] void fail(int error) const;
    void open_temporary(bool exists);
    void write_in_place();

    std::string path_;       // as the user named it
    std::string target_;     // with symbolic links followed
    std::string temporary_;  // empty: written directly
    int descriptor_ = -1;
};

// The path of a file in a folder.
std::string in_folder(const std::string& folder, const char* name);

// Whether an output of this name is the standard output.
bool is_standard_output(const std::string& path);

// What an option names, for messages: {"--json", "a.json"}.
using NamedFile = std::pair<std::string, std::string>;

// Throws InputError if two of the outputs are one file, or an output is one of the inputs. Empty paths are passed over.
void require_distinct(const std::vector<NamedFile>& outputs, const std::vector<NamedFile>& inputs = {});

}  // namespace vndf::cli
