// The command line as a user runs it.
#pragma once

#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "catch.h"

namespace vndf {

// A folder of its own that goes with the object.
class Folder {
  public:
    Folder() {
        std::string name = (std::filesystem::temp_directory_path() / "clvndf.XXXXXX").string();
        REQUIRE(mkdtemp(name.data()) != nullptr);
        path_ = name;
    }
    ~Folder() { std::filesystem::remove_all(path_); }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;

    std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
    std::string string() const { return path_.string(); }
    void write(const std::string& name, const std::string& text) const {
        std::ofstream(path_ / name, std::ios::binary) << text;
    }
    std::string read(const std::string& name) const {
        std::ifstream file(path_ / name, std::ios::binary);
        return {std::istreambuf_iterator<char>(file), {}};
    }
    std::size_t files() const {
        return std::distance(std::filesystem::directory_iterator(path_),
                             std::filesystem::directory_iterator());
    }

  private:
    std::filesystem::path path_;
};

// Runs a shell script in `folder`, with the command as $clvndf; returns its exit status.
inline int shell(const Folder& folder, const std::string& script) {
    folder.write(".script", "cd '" + folder.string() + "'\nclvndf='" CLVNDF_EXECUTABLE "'\n" + script + "\n");
    const int status = std::system(("sh '" + (folder / ".script").string() + "'").c_str());
    std::filesystem::remove(folder / ".script");
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

struct Outcome {
    int status;
    std::string out, err;
};

// Runs `clvndf arguments` with `input` on its standard input.
inline Outcome clvndf(const std::string& arguments, const std::string& input = {}) {
    const Folder folder;
    folder.write("in", input);
    const int status = shell(folder, "\"$clvndf\" " + arguments + " <in >out 2>err");
    return {status, folder.read("out"), folder.read("err")};
}

// The same in a shell that runs `before` first; status 124 after two minutes.
inline Outcome clvndf_after(const std::string& before, const std::string& arguments,
                            const std::string& input = {}) {
    const Folder folder;
    folder.write("in", input);
    const int status = shell(folder, before + "\ntimeout 120 \"$clvndf\" " + arguments + " <in >out 2>err");
    return {status, folder.read("out"), folder.read("err")};
}

inline bool one_line(const std::string& text) {
    return std::count(text.begin(), text.end(), '\n') == 1;
}

}  // namespace vndf
