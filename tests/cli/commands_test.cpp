// Every command with every option, and what all commands have in common: one line for bad input, standard streams that
// cannot be written, nothing left behind.
#include <regex>
#include <set>
#include <sstream>

#include <fmt/format.h>
#include <unistd.h>

#include "error.h"
#include "runtime/devices.h"
#include "support/command.h"
#include "support/gltf_cases.h"
#include "support/options.h"

using namespace vndf;
using namespace vndf::test;
using Catch::Matchers::ContainsSubstring;

namespace {

bool has_bench() {
    const Commands all = commands();
    return std::any_of(all.commands.begin(), all.commands.end(),
                       [](const Command& command) { return command.name == "bench"; });
}

// "check --quick" for every option of every command, "--seed" for a common one.
std::set<std::string> all_options() {
    const Commands all = commands();
    std::set<std::string> names;
    for (const Option& option : all.common) names.insert(option.name);
    for (const Command& command : all.commands)
        for (const Option& option : command.options) names.insert(command.name + " " + option.name);
    return names;
}

void add_options_of(const std::string& line, std::set<std::string>& reached) {
    const std::set<std::string> all = all_options();
    std::istringstream words(line);
    std::string command, word;
    words >> command;
    if (command.starts_with("--")) reached.insert(command);
    while (words >> word) reached.insert(all.contains(command + " " + word) ? command + " " + word : word);
}

const std::string reflect_row = "wo_x,wo_y,wo_z,wm_x,wm_y,wm_z\n0.5,0,1,0,0,1\n",
                  reflected_row = "wi_x,wi_y,wi_z\n-0.5,0,1\n";

void require_refusal(const Outcome& run, const std::string& said) {
    CAPTURE(run.err, said);
    CHECK(run.status == 2);
    CHECK(run.out.empty());
    CHECK(run.err.starts_with("clvndf: "));
    CHECK_THAT(run.err, ContainsSubstring(said));
    CHECK(std::count(run.err.begin(), run.err.end(), '\n') == 1);
    CHECK(run.err.size() < 400);
}

}  // namespace

// The test to run under sanitizers. The commands are quick forms of themselves.
TEST_CASE("every command runs to its end with every option") {
    std::vector<std::string> lines = {
        "--help",
        "--version",
        "--seed 5 list",
        "devices --quiet",
        "devices --help",
        "list --help",
        "list --json",
        "eval --help",
        "eval vndf_reflect --input in --output device.csv --device \"$device\" --math builtin --real float",
        "eval vndf_reflect --input in --output host.csv --on host --hex",
        "eval my_sample --kernel \"$judge/right.cl\" --as ggx_sample_wm --options -DX --input lobe",
        "check --help",
        "check --only vndf_reflect --quick --device \"$device\" --math strict --real float --points 1024 "
        "--json check.json --junit check.xml --report checked --all",
        "check --only vndf_reflect --quick --digest --on host",
        "check --kernel \"$judge/right.cl\" --function my_sample --as ggx_sample_wm --pdf my_pdf --quick "
        "--points "
        "1024 --domain front --alpha 0.2:0.5 --isotropic --options -DX",
        "check --kernel \"$judge/bsdf.cl\" --function my_value --as bsdf --pdf my_pdf --sample my_sample "
        "--quick "
        "--points 1024",
        "check --only vndf_reflect --digest --answers",
        "check --only vndf_ggx_sample_wm_dupuy2023 --exhaustive --minutes 0.001 --slice 1/1000 "
        "--checkpoint walked",
        "emit --help",
        "emit vndf_reflect ggx_g1 --output emitted.h --as c --math builtin --real double --prefix x_ "
        "--selftest",
        "emit vndf_bsdf_sample --effects lambert,fresnel=none --output material.h",
        "energy --help",
        "energy --ndf beckmann --masking separable --output energy.h --cache kept --device \"$device\"",
        "energy --ndf beckmann --masking separable --output again.h --cache kept",
        "energy --of conductor --no-cache --output measured.h",
        "render --help",
        "render --output a.png --size 16x8 --spp 1 --max-bounces 2 --sampler plain --ndf ggx --masking "
        "separable --energy kulla_conty --random philox "
        "--math builtin --orbs anisotropy --sky white --lights-by cones --effects all --device \"$device\"",
        "render plain.gltf --output a.exr --size 8x4 --time 0.01 --explain --effect-costs",
        "render busy.glb --output c.png --size 8x4 --spp 1 --camera front --env env.hdr --env-rotation 90 "
        "--light-radius 0.1 --checkpoint at --report render.json --exposure -1",
        "render --output b.png --size 8x4 --target-error 0.5",
        "policies --help",
        "policies --only vndf_reflect --quick --flags cycles",
        "policies --only vndf_reflect --quick --device \"$device\" --real float --json policies.json"};
    if (has_bench()) {
        lines.insert(
            lines.end(),
            {"bench --help", "bench --effects --only 'conductor alone' --repetitions 3 --device \"$device\"",
             "bench --only vndf_reflect/cpp --repetitions 3 --device \"$device\" --json bench.json "
             "--report report",
             // Its own results, and the committed ones.
             "bench --only vndf_reflect/cpp --repetitions 3 --compare bench.json",
             "bench --only dupuy2023/strict --quick --repetitions 3 --alpha 0.1:1",
             "bench --kernel \"$judge/right.cl\" --function my_pdf --as ggx_pdf_wm --options -DX "
             "--repetitions 3",
             "bench --only dupuy2023/lean --advise --error 1e9 --domain front --repetitions 3",
             "bench --only vndf_reflect/cpp --repetitions 3 --compare \"$committed\""});
    }
    const Folder folder;
    folder.write("in", reflect_row);
    folder.write("lobe", "wo_x,wo_y,wo_z,alpha_x,alpha_y,u1,u2\n0.6,0,0.8,0.5,0.1,0.25,0.75\n");
    folder.write("plain.gltf", triangle_file().gltf());
    folder.write("busy.glb", busy_file().glb());
    folder.write("env.hdr",
                 "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n\x80\x80\x80\x80\x80\x80\x80\x80");
    std::set<std::string> reached;
    for (const std::string& line : lines) {
        CAPTURE(line);
        const int status = shell(folder, "device='" + runtime::choose_device().device.name +
                                             "'\ncommitted='" CLVNDF_SOURCE_DIR
                                             "/bench/results/pocl-3.1.json'\n"
                                             "judge='" CLVNDF_SOURCE_DIR
                                             "/tests/judge'\n"
                                             "PATH=/usr/bin:$PATH \"$clvndf\" " +
                                             line + " >out 2>err");
        CAPTURE(folder.read("err"));
        const bool no_matplotlib = status == 3 && folder.read("err").find("matplotlib") != std::string::npos;
        if (no_matplotlib) WARN("skipped: the page of bench --report, for want of python3-matplotlib");
        CHECK((status == 0 || no_matplotlib));
        add_options_of(line, reached);
        const bool compares = line.find("--compare") != std::string::npos;
        CHECK((folder.read("out").find("another run") != std::string::npos) == compares);
    }
    CHECK(reached.size() >= 40);
    for (const std::string& option : all_options()) {
        INFO(option << " is reached by none of the lines above: add it");
        CHECK(reached.contains(option));
    }
    for (const std::string file :
         {"device.csv", "host.csv", "check.json", "check.xml", "checked/index.html", "policies.json",
          "emitted.h", "material.h", "kept/energy-beckmann-separable", "measured.h"})
        CHECK_FALSE(folder.read(file).empty());
    CHECK(folder.read("again.h") == folder.read("energy.h"));
    if (has_bench()) CHECK(folder.read("report/bench.json") == folder.read("bench.json"));
}

TEST_CASE("bench advises the cheapest form within an error, and refuses demands that contradict each other") {
    if (!has_bench()) return;
    const Folder folder;
    const std::string bench = "\"$clvndf\" --quiet bench --only dupuy2023/lean --repetitions 3 ";
    CHECK(shell(folder, bench + "--advise --error 0.1 >out 2>err") == 0);
    CHECK(folder.read("out").find(
              "GGX visible normals: none of those measured has an error within 0.10 eps.") !=
          std::string::npos);
    CHECK(shell(folder, bench + "--advise --error 1e9 --domain front >out 2>err") == 0);
    CHECK(folder.read("out").find("GGX visible normals: vndf_ggx_sample_wm_dupuy2023 ") != std::string::npos);
    CHECK(folder.read("out").find("<- this one") != std::string::npos);
    for (const std::string arguments :
         {"--advise", "--error 5", "--advise --error 0", "--advise --error nan", "--advise --error 5 --quick",
          "--domain front", "--advise --error 5 --domain back", "--alpha 1", "--alpha 1:0.5", "--alpha 0:1",
          "--alpha 0.1:1x", "--alpha nan:1", "--alpha 0.1:1e4"}) {
        CAPTURE(arguments);
        CHECK(shell(folder, bench + arguments + " >out 2>err") == 2);
        const std::string said = folder.read("err");
        CAPTURE(said);
        CHECK(std::count(said.begin(), said.end(), '\n') == 1);
        CHECK(folder.read("out").empty());
    }
}

TEST_CASE("bench times a user's function beside ours, built with options of its own") {
    if (!has_bench()) return;
    const Folder folder;
    folder.write("mine.cl", "float3 mine(float3 wo, float3 wm) { return SIGN dot(wo, wm) * wm - wo; }\n");
    const std::string bench = "\"$clvndf\" bench --repetitions 3 --kernel mine.cl --as vndf_reflect ";
    REQUIRE(shell(folder, bench + "--function mine --options '-DSIGN=2*' --json a.json >out 2>err") == 0);
    const std::string table = folder.read("out"), json = folder.read("a.json");
    CAPTURE(table);
    const std::regex sentence(
        "mine takes [0-9.]+ ns a sample in cache, [0-9.]+ times what vndf_reflect strict/float takes");
    CHECK(std::regex_search(table, sentence));
    for (const std::string part :
         {"\"mine/user/float/stream\"", "\"mine/user/float/cached\"", "\"vndf_reflect/strict/float/cached\"",
          "\"kernel_options\": \"-DSIGN=2*\""})
        CHECK_THAT(json, ContainsSubstring(part));
    // What it computes is compared as well: this one is wrong.
    REQUIRE(shell(folder, bench + "--function mine --options '-DSIGN=3*' --json b.json >out 2>err") == 0);
    const auto error = [&](const std::string& file) {
        const auto data = nlohmann::json::parse(folder.read(file));
        for (const auto& entry : data["benchmarks"])
            if (entry["run_name"] == "mine/user/float/stream" && entry.contains("err_p99"))
                return entry["err_p99"].get<double>();
        return -1.0;
    };
    CHECK((error("a.json") >= 0 && error("a.json") < 100));
    CHECK(error("b.json") > 1e5);
    for (const auto& [arguments, said] :
         {std::pair("--function mine", "SIGN"),
          {"--function other --options '-DSIGN=2*'", "no function 'other'"}}) {
        CHECK(shell(folder, bench + arguments + " >out 2>err") == 2);
        CHECK_THAT(folder.read("err"), ContainsSubstring(said));
    }
    require_refusal(clvndf("bench --kernel a --function f --as bsdf"), "bsdf");
}

TEST_CASE("a selection of nothing is refused, with what there is to select") {
    std::vector<std::pair<std::string, std::string>> cases = {
        {"check --only ''", "--only: its value is empty"},
        {"check --only=", "--only: its value is empty"},
        {"policies --only ''", "--only: its value is empty"},
        {"policies --only nosuch", "--only 'nosuch': no function of that name; the nearest are vndf_"},
        {"check --only vndf_reflect --exhaustive", "--only 'vndf_reflect': no sampler"},
        {"check --only vndf_ggx_sample_wm_walter2007 --exhaustive --slice 999999/999999",
         "--slice '999999/999999': expected a part I/N with 1 <= I <= N <= "},
        {"check --exhaustive --slice ' +1/5'", "--slice ' +1/5': expected a part I/N"},
        {"eval vndf_reflect --device ''", "--device: its value is empty"},
        {"check --device ''", "--device: its value is empty"},
        {"check --digest --on host --device x", "--device 'x': --on host uses no device"},
        {"policies --device ''", "--device: its value is empty"}};
    if (has_bench()) {
        const std::vector<std::pair<std::string, std::string>> of_bench = {
            {"bench --only ''", "--only: its value is empty"},
            {"bench --device ''", "--device: its value is empty"},
            {"bench --only nosuch/strict", "--only 'nosuch': no function of that name"},
            {"bench --effects --only nosuch", "--only 'nosuch': no program of --effects has it in its name"},
            {"bench --only vndf_reflect/", "--only 'vndf_reflect/': nothing after the slash"},
            {"bench --only vndf_reflect/nosuch", "'nosuch' is part of none of builtin/"},
            {"bench --only vndf_reflect/strict/float/stream", "'strict/float/stream' is part of none of"},
            // What others are compared with is no selection.
            {"bench --only vndf_ggx_sample_wm_dupuy2023/nosuch", "'nosuch' is part of none of"}};
        cases.insert(cases.end(), of_bench.begin(), of_bench.end());
    }
    for (const auto& [arguments, said] : cases) {
        CAPTURE(arguments);
        require_refusal(clvndf(arguments), said);
    }
}

TEST_CASE("energy refuses what there is not, and measures again what was damaged") {
    const Folder folder;
    const std::vector<std::pair<std::string, std::string>> refusals = {
        {"energy --ndf phong", "--ndf"},
        {"energy --masking none", "--masking"},
        {"energy --of wood", "--of"},
        {"energy --output nowhere/a.h", "nowhere/a.h"},
        {"energy --device nosuch --no-cache", "nosuch"}};
    for (const auto& [line, said] : refusals) {
        CAPTURE(line);
        CHECK(shell(folder, "\"$clvndf\" " + line + " >out 2>err") == 2);
        CHECK(folder.read("err").find(said) != std::string::npos);
        CHECK(folder.read("err").find('\n') == folder.read("err").size() - 1);
        CHECK(folder.read("out").empty());
    }
    std::filesystem::create_directory(folder / "kept");
    folder.write("kept/energy-ggx-correlated", "clvndf energy table 0\n");
    CHECK(shell(folder, "\"$clvndf\" energy --cache kept -o a.h 2>err") == 0);
    CHECK(folder.read("err").find("kept/energy-ggx-correlated:1: no table") != std::string::npos);
    CHECK(shell(folder, "\"$clvndf\" energy --cache kept -o b.h 2>err && cmp a.h b.h") == 0);
    CHECK(folder.read("err").empty());
}

TEST_CASE("emit refuses what it cannot write, and writes the same for the same request") {
    const std::vector<std::pair<std::string, std::string>> cases = {
        {"emit", "name is required"},
        {"emit nosuch", "unknown function 'nosuch'; the nearest names are vndf_"},
        {"emit vndf_reflect nosuch", "unknown function 'nosuch'"},
        {"emit dupuy2023", "'dupuy2023' is ambiguous: 4 functions have it in their names"},
        {"emit vndf_reflect --as metal", "--as"},
        {"emit vndf_reflect --as c --math native", "--math native --as c: native is OpenCL's alone"},
        {"emit vndf_reflect --math native --real double", "native"},
        {"emit vndf_reflect --prefix 1a", "--prefix '1a': no beginning of a name"},
        {"emit vndf_reflect --prefix 'a b'", "--prefix 'a b': no beginning of a name"},
        {"emit vndf_reflect --prefix _", "belong to C, C++ or OpenCL"},
        {"emit vndf_reflect --prefix native_", "belong to C, C++ or OpenCL"},
        {"emit vndf_reflect --prefix make_", "belong to C, C++ or OpenCL"},
        {"emit vndf_reflect --prefix ''", "--prefix: its value is empty"},
        {"emit vndf_ggx_conic2026_lobe --selftest", "--selftest: vndf_ggx_conic2026_lobe returns no numbers"},
        {"emit vndf_reflect --effects all", "--effects all: no function of a material"},
        {"emit vndf_bsdf_sample --effects lamp",
         "--effects: unknown 'lamp'; allowed are all, conductor, dielectric, specular"},
        {"emit vndf_bsdf_sample --effects fresnel=x", "unknown 'fresnel=x'"},
        {"emit vndf_bsdf_sample --effects tint", "--effects 'tint': nothing is left of a material"},
        {"emit vndf_bsdf_sample --effects all,ndf=beckmann,sampling=conic",
         "--effects: sampling=conic with ndf=beckmann; plain is allowed"},
        {"emit vndf_bsdf_sample --selftest", "--selftest: there are no known answers of vndf_bsdf_sample"},
        {"emit vndf_reflect --output nowhere/a.cl", "nowhere/a.cl"},
        {"emit vndf_reflect --as c --as c++", "--as is given twice"}};
    for (const auto& [arguments, said] : cases) {
        CAPTURE(arguments);
        require_refusal(clvndf(arguments), said);
    }
    const Folder folder;
    CHECK(shell(folder, "\"$clvndf\" emit nosuch -o a.cl 2>err; [ ! -e a.cl ]") == 0);
    CHECK(shell(folder,
                "\"$clvndf\" emit vndf_ggx_g1 --seed 5 -o a.cl && \"$clvndf\" emit ggx_g1 -o b.cl && "
                "cmp a.cl b.cl") == 0);
}

TEST_CASE("a number outside its range is refused with a range that can be read") {
    const Commands all = commands();
    for (const Command& command : all.commands)
        for (const Option& option : command.options) {
            if (option.flag || option.values.good[0].find_first_not_of("0123456789.") != std::string::npos)
                continue;
            for (const std::string value :
                 {"nan", "inf", "-1", "1e309", "0x7fffffff", "99999999999999999999"}) {
                const std::string line = command.name + " " + option.name + " " + value;
                cli::CommandLine command_line;
                CAPTURE(line);
                std::vector<const char*> words{"clvndf", command.name.c_str(), option.name.c_str(),
                                               value.c_str()};
                for (const std::string& needed : option.needs) words.push_back(needed.c_str());
                std::string refusal;
                try {
                    command_line.parse(static_cast<int>(words.size()), words.data());
                } catch (const InputError& error) {
                    refusal = error.what();
                }
                CHECK_THAT(refusal, ContainsSubstring(option.name + ": '" + value + "' is no ") &&
                                        ContainsSubstring(" number from "));
                CHECK(refusal.size() < 100);
            }
        }
}

TEST_CASE("a refusal speaks of the first word that does not fit") {
    const std::vector<std::pair<std::string, std::string>> cases = {
        {"list --only walter",
         "unknown option '--only'; clvndf list takes --json, --seed, --quiet; see clvndf list"},
        {"list walter", "'walter' is one word too many; clvndf list takes --json"},
        {"list list", "'list' is one word too many"},
        {"--json list", "unknown option '--json'; clvndf takes --seed, --quiet; the commands are devices"},
        {"help", "unknown command 'help'; the commands are devices, list, eval"},
        {"--seed", "--seed: its value is missing"},
        {"list --seed", "--seed: its value is missing"},
        {"list --seed 1 --seed=2", "--seed is given twice"},
        {"list --json=a.json", "'--json=a.json': --json takes no value"},
        {"eval --fun 5 vndf_ggx_g1", "unknown option '--fun'; clvndf eval takes a name, --on"},
        {"eval --fun", "unknown option '--fun'"},
        {"eval vndf_ggx_g1 a.csv", "'a.csv' is one word too many; clvndf eval takes a name, --on"},
        {"eval vndf_ggx_g1 -i a.csv", "unknown option '-i'"},
        {"eval vndf_ggx_g1 --input", "--input: its value is missing"},
        {"eval vndf_ggx_g1 --input a --input b", "--input is given twice"},
        {"check vndf_ggx_g1", "'vndf_ggx_g1' is one word too many; clvndf check takes --device"},
        {"check --quick --math", "--math: its value is missing"},
        {"policies --math strict", "unknown option '--math'; clvndf policies takes --device, --real"},
        {"devices --device x", "unknown option '--device'; clvndf devices takes --seed"}};
    for (const auto& [arguments, said] : cases) {
        CAPTURE(arguments);
        require_refusal(clvndf(arguments), said);
    }
    if (!has_bench()) return;
    require_refusal(clvndf("bench --compare ."), ".: cannot read: Is a directory");
    require_refusal(clvndf("bench --compare in", "{}"), "in: not the JSON of clvndf bench");
    const Folder folder;
    CHECK(shell(folder, "TMPDIR=/nonexistent \"$clvndf\" bench --only vndf_reflect/cpp >out 2>err") == 2);
    CHECK(folder.read("out").empty());
    CHECK(folder.read("err") ==
          "clvndf: TMPDIR '/nonexistent': cannot create a folder for temporary files there: "
          "No such file or directory\n");
}

TEST_CASE("a command that cannot write to stderr ends as if it could") {
    const Folder folder;
    folder.write("in", reflect_row);
    for (const std::string nowhere : {"2>/dev/full", "2>&-"}) {
        CAPTURE(nowhere);
        for (const std::string arguments : {"eval nosuch", "nosuch", "list --seed x", "check --device nosuch",
                                            "policies --only nosuch", "list >/dev/full"}) {
            CAPTURE(arguments);
            CHECK(shell(folder, "\"$clvndf\" " + arguments + " " + nowhere) == 2);
        }
        // PoCL with two devices, of which stderr says which one was taken.
        const std::string remark =
            "POCL_DEVICES='pthread basic' \"$clvndf\" eval vndf_reflect --device 'Portable Computing' "
            "--input in "
            "--output out ";
        shell(folder, remark + "2>err");
        if (folder.read("err").find("taking") == std::string::npos)
            WARN("skipped: a run with a remark, for want of a platform with two devices");
        else
            CHECK(shell(folder, remark + nowhere) == 0);
    }
}

TEST_CASE("a command that cannot write to the standard output fails in one line") {
    const Folder folder;
    folder.write("in", reflect_row);
    std::vector<std::string> lines = {
        "--help",
        "--version",
        "devices",
        "devices --help",
        "list",
        "list --json",
        "emit vndf_reflect",
        "eval vndf_reflect --on host --input in",
        "check --help",
        "check --only vndf_reflect --quick --points 1024",
        "check --only vndf_reflect --quick --points 1024 --json -",
        "check --only vndf_reflect --digest --answers",
        "check --only vndf_reflect --quick --digest --on host",
        "check --only vndf_ggx_sample_wm_dupuy2023 --exhaustive --minutes 0.001",
        "policies --only vndf_reflect --quick"};
    if (has_bench()) lines.push_back("bench --only vndf_reflect/cpp --repetitions 3");
    for (const std::string& line : lines)
        for (const std::string nowhere : {">/dev/full", ">&-"}) {
            CAPTURE(line, nowhere);
            CHECK(shell(folder, "\"$clvndf\" " + line + " " + nowhere + " 2>err") == 2);
            const std::string err = folder.read("err");
            CAPTURE(err);
            CHECK(err.starts_with("clvndf: standard output: cannot write: "));
            CHECK(std::count(err.begin(), err.end(), '\n') == 1);
        }
}

// --- Leftovers ---

TEST_CASE("bench leaves nothing behind, whatever ends it") {
    if (!has_bench()) return;
    const std::string signal = GENERATE("INT", "TERM", "HUP", "KILL");
    CAPTURE(signal);
    const Folder folder;
    // Its folder among the temporary ones shows that it runs. A shell's background jobs ignore SIGINT unless told.
    const int status =
        shell(folder,
              "exec 2>/dev/null; mkdir tmp\n"
              "TMPDIR=$PWD/tmp env --default-signal=INT \"$clvndf\" bench --only vndf_reflect "
              "--json out.json --report new/report >/dev/null & run=$!\n"
              "n=0; until ls tmp/* >/dev/null 2>&1 || [ $n = 200 ]; do sleep .05; n=$((n+1)); done\n"
              "ls tmp/* >/dev/null 2>&1 || exit 99\n"
              "[ -d new ] || exit 98\n"
              "kill -" +
                  signal +
                  " $run; wait $run; status=$?\n"
                  "n=0; while ls tmp/* >/dev/null 2>&1; do sleep .05; n=$((n+1)); "
                  "[ $n -lt 100 ] || exit 97; done\n"
                  "exit $status");
    const std::map<std::string, int> numbers{{"INT", 2}, {"TERM", 15}, {"HUP", 1}, {"KILL", 9}};
    CHECK(status == 128 + numbers.at(signal));
    if (signal != "KILL") CHECK(folder.files() == 1);  // tmp
}

TEST_CASE("bench that fails leaves no folder that it made") {
    if (!has_bench()) return;
    const Folder folder;
    folder.write("file", "precious");
    folder.write("bad", "{}");
    const std::string bench = "\"$clvndf\" bench --only vndf_reflect/cpp --repetitions 3 ";
    for (const std::string arguments :
         {"--report new/report --device nosuch", "--report new/report --compare bad", "--report file/report",
          "--report file", "--report new/report --json new/report/bench.json", "--json bad --compare bad",
          "--report new/report --json nowhere/a.json", "--report new/$(printf %0300d 0)"}) {
        CAPTURE(arguments);
        CHECK(shell(folder, bench + arguments + " >out 2>err") == 2);
        CAPTURE(folder.read("err"));
        CHECK(folder.read("file") == "precious");
        CHECK(folder.files() == 4);
    }
}

TEST_CASE("a file beyond the limit of sizes is an error, and is gone") {
    const Folder folder;
    std::string rows = reflect_row;
    for (int i = 0; i < 10000; ++i) rows += "0.5,0,1,0,0,1\n";
    folder.write("in", rows);
    folder.write("old", "precious");
    const std::string eval = "ulimit -f 8; \"$clvndf\" eval vndf_reflect --on host --input in ";
    CHECK(shell(folder, eval + "--output old 2>err") == 2);
    CHECK(folder.read("err") == "clvndf: old: cannot write: File too large\n");
    CHECK(folder.read("old") == "precious");
    CHECK(folder.files() == 3);
    CHECK(shell(folder, eval + ">out 2>err") == 2);
    CHECK(folder.read("err") == "clvndf: standard output: cannot write: File too large\n");
}
