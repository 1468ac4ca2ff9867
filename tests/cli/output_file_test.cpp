// Where a result goes: links, mounts, names of open files, and names that are one file.
#include <unistd.h>

#include "support/command.h"

using namespace vndf;
using Catch::Matchers::ContainsSubstring;

namespace {

const std::string input = "wo_x,wo_y,wo_z,wm_x,wm_y,wm_z\n0.5,0,1,0,0,1\n",
                  output = "wi_x,wi_y,wi_z\n-0.5,0,1\n",
                  eval = "\"$clvndf\" eval vndf_reflect --on host --input in --output ";

}  // namespace

TEST_CASE("a link is followed, wherever it leads, and stays") {
    const Folder folder;
    folder.write("in", input);
    for (const std::string link :
         {"ln -s target link",                                       // to nothing yet
          "ln -s middle link; ln -s target middle",                  // along a chain
          "ln -s \"$PWD/target\" link",                              // absolute
          "mkdir sub; ln -s ../target sub/far; ln -s sub/far link",  // relative to where the link is
          "ln -s target link; echo old >target"}) {
        CAPTURE(link);
        CHECK(shell(folder, link + "; " + eval + "link && [ -L link ] && [ ! -L target ]") == 0);
        CHECK(folder.read("target") == output);
        CHECK(shell(folder, "rm -rf link target middle sub; [ \"$(ls)\" = in ]") == 0);
    }
}

TEST_CASE("an output that cannot be written is an error before the work, and leaves nothing") {
    const Folder folder;
    folder.write("file", "precious");
    const std::vector<std::pair<std::string, std::string>> cases = {
        {"ln -s out out", "out: cannot write: Too many levels"},
        {"ln -s other out; ln -s out other", "out: cannot write: Too many levels"},
        {"ln -s nowhere/target out", "out: cannot write: No such file"},
        {"mkdir out", "out: cannot write: Is a directory"},
        {"ln -s . out", "out: cannot write: Is a directory"},
        {"out=nowhere/out", "nowhere/out: cannot write: No such file"},
        {"out=file/out", "file/out: cannot write: Not a directory"},
        {"out=new/", "new/: cannot write: No such file"},
        {"out=/dev/fd/9", "/dev/fd/9: cannot write: Bad file descriptor"},
        {"out=/dev/fd/4; exec 4<file", "/dev/fd/4: cannot write: Bad file descriptor"},
        {"out=", "--output: its value is empty"}};
    for (const auto& [before, said] : cases) {
        CAPTURE(before);
        // The input cannot be read either, which shows later.
        CHECK(shell(folder, "out=out; " + before +
                                "\n\"$clvndf\" eval vndf_reflect --on host --input missing --output \"$out\" "
                                "2>err") == 2);
        CHECK_THAT(folder.read("err"), ContainsSubstring(said));
        CHECK(folder.read("file") == "precious");
        CHECK(shell(folder, "rm -rf out other err; [ \"$(ls)\" = file ]") == 0);
    }
    // Every command that writes a file looks before it turns to the device, which may take hours.
    for (const std::string arguments : {"check --quick --json", "check --quick --junit",
                                        "policies --quick --json", "bench --json", "bench --report"}) {
        CAPTURE(arguments);
        const int status = shell(
            folder, "\"$clvndf\" " + arguments + " file/out --device nosuch --only vndf_reflect >out 2>err");
        const std::string err = folder.read("err");
        CAPTURE(err);
        if (err.find("unknown command 'bench'") != std::string::npos) continue;
        CHECK(status == 2);
        CHECK_THAT(err, ContainsSubstring("file/out") && ContainsSubstring("Not a directory"));
    }
}

TEST_CASE("a file that cannot be replaced is written in place") {
    const Folder folder;
    folder.write("in", input);
    // A file mounted on another, and the same in a folder that takes no new files.
    const int status =
        shell(folder,
              "mkdir tmp folder; echo old >mounted; echo old >target; echo old >other\n"
              "echo old >folder/target\n"
              "unshare -m true 2>/dev/null && own=-m || own=-rm\n"
              "unshare $own true 2>/dev/null || exit 99\n"
              "cat >script <<'end'\n"
              "mount --bind mounted target && mount --bind folder folder &&\n"
              "mount --bind other folder/target && mount -o remount,bind,ro folder || exit 99\n"
              "touch folder/new 2>/dev/null && exit 98\n" +
                  eval + "target || exit 1\n" + eval +
                  "folder/target || exit 2\n"
                  "end\n"
                  "clvndf=$clvndf TMPDIR=$PWD/tmp unshare $own sh script");
    if (status == 99) {
        WARN("skipped: no privilege to mount a file");
        return;
    }
    CHECK(status == 0);
    CHECK(folder.read("mounted") == output);
    CHECK(folder.read("other") == output);
    CHECK(folder.read("target") == "old\n");
    CHECK(shell(folder,
                "[ \"$(ls)\" = \"$(printf 'folder\\nin\\nmounted\\nother\\nscript\\ntarget\\ntmp')\" ] && "
                "[ -z \"$(ls tmp)\" ]") == 0);
}

TEST_CASE("an open file is written where it stands") {
    const Folder folder;
    folder.write("in", input);
    for (const std::string name : {"/dev/stdout", "/dev/fd/1", "-"}) {
        CAPTURE(name);
        CHECK(shell(folder, "{ echo before; " + eval + name + "; echo behind; } >log") == 0);
        CHECK(folder.read("log") == "before\n" + output + "behind\n");
        CHECK(shell(folder, eval + name + " >>log") == 0);
        CHECK(folder.read("log") == "before\n" + output + "behind\n" + output);
    }
    CHECK(shell(folder, eval + "/dev/fd/3 3>log") == 0);
    CHECK(folder.read("log") == output);
}

TEST_CASE("one file for two purposes is refused, by whatever names") {
    const Folder folder;
    folder.write("in", input);
    folder.write("old", "precious");
    CHECK(shell(folder, "ln -s old link; ln old hard; ln -s new dangling; mkdir sub; mkfifo pipe") == 0);
    for (const std::string arguments :
         {"check --json a --junit a", "check --json a --junit ./sub/../a",
          "check --json a --junit \"$PWD/a\"", "check --json old --junit link",
          "check --json old --junit hard", "check --json new --junit dangling",
          "check --json pipe --junit pipe", "check --json - --junit -", "check --json - --junit /dev/stdout",
          "check --json - --junit out", "eval vndf_reflect --input in --output in",
          "eval vndf_reflect --input in --output ./in", "eval vndf_reflect --input - --output in <in",
          "eval vndf_reflect --input out"}) {
        CAPTURE(arguments);
        CHECK(shell(folder, "\"$clvndf\" " + std::string(arguments) + " >out 2>err") == 2);
        CHECK_THAT(folder.read("err"), ContainsSubstring(": one file; each needs its own"));
        CHECK(folder.read("out").empty());
        CHECK(folder.read("in") == input);
        CHECK(folder.read("old") == "precious");
        CHECK(folder.files() == 9);
    }
    // What is no file to keep may be named twice.
    CHECK(
        shell(
            folder,
            "\"$clvndf\" check --quick --points 1024 --only vndf_reflect --json /dev/null --junit /dev/null "
            ">out") == 0);
    CHECK(shell(folder, eval + "- </dev/null >/dev/null") == 0);
}
