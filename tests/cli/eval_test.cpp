// clvndf eval as a user meets it. vndf_reflect about the normal (0, 0, 1) gives (-wo_x, -wo_y, wo_z) exactly and
// so shows how cells are read.
#include <cmath>
#include <random>
#include <sstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "registry.h"
#include "support/command.h"

namespace {

using namespace vndf;
using Catch::Matchers::ContainsSubstring;

const std::string reflect_header = "wo_x,wo_y,wo_z,wm_x,wm_y,wm_z\n";
const std::string dupuy = "vndf_ggx_sample_wm_dupuy2023";
const std::string dupuy_header = "wo_x,wo_y,wo_z,alpha_x,alpha_y,u1,u2\n";

// The first result of vndf_reflect for this cell as wo_x, as printed: its negative.
std::string reflected(const std::string& cell, const std::string& options) {
    const Outcome run = clvndf("eval vndf_reflect " + options, reflect_header + cell + ",0,1,0,0,1\n");
    INFO(run.err);
    REQUIRE(run.status == 0);
    const std::size_t begin = run.out.find('\n') + 1;
    return run.out.substr(begin, run.out.find(',') == run.out.npos ? 0 : run.out.find(',', begin) - begin);
}

std::string random_rows(std::size_t n) {
    std::mt19937 bits(1);
    std::uniform_real_distribution<double> uniform(0.01, 0.99);
    std::string text = dupuy_header;
    for (std::size_t i = 0; i < n; ++i) {
        for (int c = 0; c < 7; ++c) text += fmt::format("{}{:.9g}", c ? "," : "", uniform(bits));
        text += '\n';
    }
    return text;
}

TEST_CASE("eval gives the same digits on the device and on the host") {
    const std::string input = random_rows(1000);
    for (const std::string options : {"", " --real double", " --hex"}) {
        const Outcome device = clvndf("eval " + dupuy + "_with_pdf" + options, input);
        const Outcome host = clvndf("eval " + dupuy + "_with_pdf --on host" + options, input);
        CAPTURE(options, device.err);
        CHECK(device.status == 0);
        CHECK(device.out == host.out);
        CHECK(std::count(host.out.begin(), host.out.end(), '\n') == 1001);
        CHECK(host.out.starts_with("wm_x,wm_y,wm_z,pdf\n"));
    }
}

TEST_CASE("columns may come in any order, with blanks, CRLF, a byte order mark and blank lines at the end") {
    const Outcome plain =
        clvndf("eval vndf_refract --on host", "wo_x,wo_y,wo_z,wm_x,wm_y,wm_z,eta\n.6,0,.8,0,0,1,1.5\n");
    const Outcome other =
        clvndf("eval vndf_refract --on host",
               "\xEF\xBB\xBF eta , wm_z,wm_y,wm_x,\two_z,wo_y,wo_x\r\n 1.5,1 ,0,0,8e-1,0,+0.6\r\n\r\n  \n");
    REQUIRE(plain.status == 0);
    CHECK(other.out == plain.out);
    CHECK(other.err.empty());
}

TEST_CASE("numbers are decimal, C99 hex, inf or nan") {
    const std::string options = GENERATE("--on host", "--on device", "--on reference");
    CAPTURE(options);
    CHECK(reflected("0x1.8p-3", options) == "-0.1875");
    CHECK(reflected("0X1.8P-3", options) == "-0.1875");
    CHECK(reflected("-0x.4", options) == "0.25");
    CHECK(reflected("1.875e-1", options) == "-0.1875");
    CHECK(reflected("nan", options) == "nan");
    CHECK(reflected("-NaN", options) == "nan");
}

TEST_CASE("inf is a number") {
    // What a direction of infinite length is reflected to does not matter here.
    for (const std::string cell : {"inf", "-inf", "+inf", "INFINITY"}) {
        const Outcome run = clvndf("eval vndf_reflect --on host", reflect_header + cell + ",0,1,0,0,1\n");
        CHECK(run.status == 0);
    }
}

TEST_CASE("a cell is rounded once, to the real type, for the reference as well") {
    // Just above the midpoint of 1 and 1 + 2^-23, by less than a double can tell.
    const std::string cell = "1.000000059604644775390625000000000001";
    CHECK(reflected(cell, "--on host --hex") == "-0x1.000002p+0");
    CHECK(reflected(cell, "--on device --hex") == "-0x1.000002p+0");
    CHECK(reflected(cell, "--on reference --hex") == "-0x1.000002p+0");
    CHECK(reflected(cell, "--on reference --hex --real double") == "-0x1.000001p+0");
    CHECK(reflected("0x1.000001000000000001p0", "--on host --hex") == "-0x1.000002p+0");
}

TEST_CASE("numbers too small for the type become subnormal or zero; numbers too large are refused") {
    CHECK(reflected("1e-40", "--on host") == "-1e-40");
    CHECK(reflected("1e-60", "--on host") == "0");
    CHECK(reflected("1e-60", "--on host --real double") == "-1e-60");
    for (const std::string cell : {"1e39", "-3.5e38", "0x1p128", "1e400"}) {
        const Outcome run = clvndf("eval vndf_reflect --on host", reflect_header + cell + ",0,1,0,0,1\n");
        CHECK(run.status == 2);
        CHECK_THAT(run.err, ContainsSubstring("column wo_x: '" + cell + "' lies outside the range of float"));
    }
}

TEST_CASE("results read back as the same number") {
    const std::string input = random_rows(500);
    for (const std::string real : {"float", "double"}) {
        const std::string command = "eval " + dupuy + " --on host --real " + real;
        std::istringstream decimal(clvndf(command, input).out), hex(clvndf(command + " --hex", input).out);
        std::string a, b;
        REQUIRE((std::getline(decimal, a) && std::getline(hex, b)));
        std::size_t cells = 0;
        while (std::getline(decimal, a, ',') && std::getline(hex, b, ',')) {
            const bool same = real == "float"
                                  ? std::strtof(a.c_str(), nullptr) == std::strtof(b.c_str(), nullptr)
                                  : std::strtod(a.c_str(), nullptr) == std::strtod(b.c_str(), nullptr);
            CAPTURE(a, b);
            CHECK(same);
            CHECK(b.find("0x") != b.npos);
            ++cells;
        }
        CHECK(cells == 2 * 500 + 1);  // getline splits at commas only
    }
}

TEST_CASE("a header without rows gives a header") {
    CHECK(clvndf("eval vndf_reflect", reflect_header).out == "wi_x,wi_y,wi_z\n");
    CHECK(clvndf("eval vndf_reflect --on host", "wo_x,wo_y,wo_z,wm_x,wm_y,wm_z").out == "wi_x,wi_y,wi_z\n");
}

TEST_CASE("bad input is one line that says what was found, where, and what is allowed") {
    struct Case {
        std::string arguments, input, said;
    };
    const std::string row = "0,0,1,0,0,1\n";
    const std::string on_host = " --on host";
    const std::string float_only = "--math native --real double: native functions are float only";
    const std::vector<Case> cases = {
        {"eval vndf_reflct", "",
         "unknown function 'vndf_reflct'; the nearest names are vndf_reflect, vndf_refract"},
        {"eval vndf_reflect", "", "standard input: empty, without a header; vndf_reflect takes: wo_x,wo_y"},
        {"eval vndf_reflect", "wo_x,wo_y,wo_z,wm_x,wm_y\n", "standard input:1: missing column 'wm_z'"},
        {"eval vndf_reflect", "wo_x,wo_y,wo_z,wm_x,wm_y,wm_z,u1\n", "standard input:1: unknown column 'u1'"},
        {"eval vndf_reflect", "wo_x,wo_y,wo_z,wm_x,wm_y,wm_z,wo_x\n",
         "standard input:1: doubled column 'wo_x'"},
        {"eval vndf_reflect", "wo_x,wo_y,wo_z,wm_x,wm_y,wm_z,\n", "unknown column ''"},
        {"eval vndf_reflect" + on_host, reflect_header + row + "0,0,1,0,0\n",
         "standard input:3: short row: 5 cells"},
        {"eval vndf_reflect" + on_host, reflect_header + row + row + "0,0,1,0,0,1,\n",
         "input:4: long row: 7 cells"},
        {"eval vndf_reflect" + on_host, reflect_header + row + "\n" + row, "standard input:3: blank line"},
        {"eval vndf_reflect" + on_host, reflect_header + "0,one,1,0,0,1\n",
         "standard input:2: column wo_y: 'one' is no number; decimal (0.1875), C99 hex (0x1.8p-3), inf and "
         "nan"},
        {"eval vndf_reflect --device nosuch", reflect_header,
         "--device: no platform or device name contains 'nosuch'; there are '"},
        {"eval vndf_reflect --on host --math native", reflect_header, "--math native: "},
        {"eval vndf_reflect --math native --real double", reflect_header, float_only},
        {"eval vndf_reflect --on host --math native --real double", reflect_header, float_only},
        {"eval vndf_reflect --on reference --real double --math native", reflect_header, float_only},
        {"check --quick --only vndf_reflect --math native --real double", "", float_only},
        {"check --digest --math native --real double", "", float_only},
        {"check --exhaustive --math native --real double", "", "--real double: "},
        {"eval vndf_reflect --on host --device x", reflect_header, "--device 'x': --on host uses no device"},
        {"eval vndf_reflect --on reference --device x", reflect_header,
         "--device 'x': --on reference uses no device"},
        {"eval vndf_reflect --on gpu", "", "--on: gpu not in {device,host,reference}"},
        {"eval vndf_reflect --math fast", "", "--math: fast not in {strict,builtin,native}"},
        {"eval vndf_reflect --real half", "", "--real: half not in {float,double}"},
        {"eval vndf_reflect --input nowhere.csv", "", "nowhere.csv: cannot read: No such file"},
        {"eval vndf_reflect --input .", "", ".: cannot read: Is a directory"},
        {"eval vndf_reflect --output nowhere/x.csv", reflect_header,
         "nowhere/x.csv: cannot write: No such file"},
        {"eval vndf_reflect --output .", reflect_header, ".: cannot write: Is a directory"},
        {"eval vndf_reflect --colour", "", "--colour"},
        {"eval", "", "name is required"},
        {"evaluate", "", "unknown command 'evaluate'; the commands are devices, list, eval, check"},
        {"", "", "A subcommand is required; the commands are devices, list, eval, check"},
        {"list --seed -1", "", "--seed: '-1' is no whole number from 0 to 18446744073709551615"},
    };
    for (const Case& c : cases) {
        const Outcome run = clvndf(c.arguments, c.input);
        CAPTURE(c.arguments, c.input, run.err, run.out);
        CHECK(run.status == 2);
        CHECK_THAT(run.err, ContainsSubstring(c.said));
        CHECK(run.err.starts_with("clvndf: "));
        CHECK(std::count(run.err.begin(), run.err.end(), '\n') == 1);
        CHECK(run.out.empty());
    }
}

TEST_CASE("whatever is no number is refused") {
    for (const std::string cell :
         {"",   "abc", "1.5.2", "1,5e",  "--1",   "+-1",   "0x",   "0xg", "0x-1",  "0xinf", "0x1p", "0x1p+-1",
          "1e", "1 2", "1f",    "1.0_0", "\"1\"", "infin", "nanx", "0b1", "1'000", "½",     "'0;'"}) {
        if (cell.find(',') != cell.npos) continue;
        const Outcome run = clvndf("eval vndf_reflect --on host", reflect_header + cell + ",0,1,0,0,1\n");
        CAPTURE(cell, run.out);
        CHECK(run.status == 2);
        CHECK_THAT(run.err, ContainsSubstring("standard input:2: column wo_x: '" + cell + "' is no number"));
    }
}

TEST_CASE("a failed run leaves no file and destroys none") {
    const Folder folder;
    folder.write("good", reflect_header + "0.5,0,1,0,0,1\n");
    std::string bad = reflect_header;
    for (int i = 0; i < 70000; ++i) bad += "0,0,1,0,0,1\n";  // fails after rows have been written
    folder.write("bad", bad + "x,0,1,0,0,1\n");
    folder.write("old", "precious");
    const std::string eval = "\"$clvndf\" eval vndf_reflect --on host ";
    CHECK(shell(folder, eval + "--input bad --output new 2>/dev/null") == 2);
    CHECK(shell(folder, eval + "--input bad --output old 2>/dev/null") == 2);
    CHECK(folder.read("old") == "precious");
    CHECK(folder.files() == 3);
    CHECK(shell(folder, eval + "--input good --output old && " + eval + "--input good --output new") == 0);
    CHECK(folder.read("old") == "wi_x,wi_y,wi_z\n-0.5,0,1\n");
    CHECK(folder.read("new") == folder.read("old"));
    CHECK(folder.files() == 4);
}

TEST_CASE("an interrupted run leaves no file and destroys none") {
    const std::string signal = GENERATE("INT", "TERM", "HUP", "PIPE", "QUIT", "XCPU");
    CAPTURE(signal);
    const Folder folder;
    folder.write("old", "precious");
    // The input stays open, so that the run waits in the middle; its temporary file tells that it does. A shell's
    // background jobs ignore some signals unless told.
    const int status =
        shell(folder,
              "exec 2>/dev/null; mkfifo pipe; ulimit -c 0\n"
              "env --default-signal=INT,QUIT \"$clvndf\" eval vndf_reflect --on host --input pipe --output "
              "old & run=$!\n"
              "exec 3>pipe; printf '" +
                  reflect_header.substr(0, reflect_header.size() - 1) +
                  "\\n' >&3\n"
                  "n=0; until ls old.* >/dev/null 2>&1 || [ $n = 100 ]; do sleep .05; n=$((n+1)); done\n"
                  "ls old.* >/dev/null 2>&1 || exit 99\n"
                  "kill -" +
                  signal + " $run; wait $run");
    CHECK(status > 128);
    CHECK(status != 128 + 99);
    CHECK(folder.read("old") == "precious");
    CHECK(folder.files() == 2);  // with the pipe
}

TEST_CASE("an output that is no regular file is written, not replaced; a link's target is") {
    const Folder folder;
    folder.write("in", reflect_header + "0.5,0,1,0,0,1\n");
    folder.write("target", "old");
    const std::string eval = "\"$clvndf\" eval vndf_reflect --on host --input in --output ";
    CHECK(shell(folder, "ln -s target link; " + eval + "link && [ -L link ]") == 0);
    CHECK(folder.read("target") == "wi_x,wi_y,wi_z\n-0.5,0,1\n");
    CHECK(shell(folder, "mkfifo pipe; cat pipe >copy & " + eval + "pipe && wait && [ -p pipe ]") == 0);
    CHECK(folder.read("copy") == folder.read("target"));
}

TEST_CASE("a full disk is an error") {
    const Folder folder;
    folder.write("in", reflect_header + "0,0,1,0,0,1\n");
    CHECK(shell(folder, "\"$clvndf\" eval vndf_reflect --on host --input in >/dev/full 2>err") == 2);
    CHECK_THAT(folder.read("err"), ContainsSubstring("standard output: cannot write: No space left"));
    CHECK(shell(folder, "\"$clvndf\" list >/dev/full 2>err") == 2);
    CHECK_THAT(folder.read("err"), ContainsSubstring("standard output: cannot write"));
}

TEST_CASE("a reader that goes away ends the run quietly") {
    const Folder folder;
    folder.write("in", random_rows(100000));
    CHECK(shell(folder, "{ \"$clvndf\" eval " + dupuy +
                            " --on host --input in 2>err; echo $? >status; } | head -1 >out") == 0);
    CHECK(folder.read("out") == "wm_x,wm_y,wm_z\n");
    CHECK(folder.read("err").empty());
    CHECK(folder.read("status") == "141\n");  // 128 + SIGPIPE, as every filter
}

TEST_CASE("rows stream: results come before the input ends") {
    const Folder folder;
    folder.write("in", random_rows(70000));
    CHECK(shell(folder,
                "{ cat in; n=0; until [ -s out ] || [ $n = 200 ]; do sleep .05; n=$((n+1)); done\n"
                "  [ -s out ] && touch streamed; } | \"$clvndf\" eval " +
                    dupuy + " --on host >out; [ -e streamed ]") == 0);
    const std::string out = folder.read("out");
    CHECK(std::count(out.begin(), out.end(), '\n') == 70001);
}

TEST_CASE("a file without line ends does not fill the memory") {
    const Outcome run = clvndf("eval vndf_reflect --on host --input /dev/zero");
    CHECK(run.status == 2);
    CHECK_THAT(run.err, ContainsSubstring("/dev/zero:1: line longer than"));
}

TEST_CASE("list --json holds every registered function with its scalars") {
    const Outcome run = clvndf("list --json");
    REQUIRE(run.status == 0);
    const auto json = nlohmann::json::parse(run.out);
    REQUIRE(json.size() == functions().size() + lobe_functions().size() + bsdf_functions().size());
    for (std::size_t i = 0; i < functions().size(); ++i) {
        const Function& f = functions()[i];
        CHECK(json[i]["name"] == f.name);
        CHECK(json[i]["inputs"] == f.inputs);
        CHECK(json[i]["outputs"] == f.outputs);
        CHECK(json[i].contains("density") == (f.kind == Kind::sampler));
        CHECK(json[i].contains("support") == (f.kind == Kind::density));
        for (const char* real : {"float", "double"})
            CHECK(json[i]["bounds"][real].contains(f.kind == Kind::sampler ? "front" : "error"));
    }
    for (std::size_t i = 0; i < lobe_functions().size(); ++i) {
        const auto& lobe = json[functions().size() + i];
        CHECK(lobe["name"] == lobe_functions()[i].name);
        CHECK(lobe["kind"] == "lobe");
        const Outcome evaluated = clvndf("eval " + lobe_functions()[i].name + " --on host --input /dev/null");
        CHECK(evaluated.status == 2);
        CHECK_THAT(evaluated.err, ContainsSubstring("not numbers"));
    }
    for (std::size_t i = 0; i < bsdf_functions().size(); ++i) {
        const auto& bsdf = json[functions().size() + lobe_functions().size() + i];
        CHECK(bsdf["name"] == bsdf_functions()[i].name);
        CHECK(bsdf["bounds"]["float"]["error"] == bsdf_functions()[i].float_bound);
    }
}

TEST_CASE("list names every function on a line") {
    const Outcome run = clvndf("list");
    CHECK(std::count(run.out.begin(), run.out.end(), '\n') == std::ptrdiff_t(functions().size()));
    for (const Function& f : functions()) CHECK_THAT(run.out, ContainsSubstring(f.name + " "));
}

TEST_CASE("devices tells what matters of each device") {
    const Outcome run = clvndf("devices");
    REQUIRE(run.status == 0);
    for (const std::string what :
         {"driver version", "OpenCL C version", "fp64", "fma", "denormals", "correctly rounded / and sqrt",
          "compute units", "clock", "memory", "compiler", "largest work-group", "addresses"}) {
        CHECK_THAT(run.out, ContainsSubstring(what));
    }
}

}  // namespace
