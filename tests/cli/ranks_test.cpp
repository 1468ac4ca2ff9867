// Several ranks and several devices give what one gives, to the byte; a rank that dies ends the run; checkpoints go on.
#include <regex>
#include <sstream>

#include <nlohmann/json.hpp>

#include "runtime/devices.h"
#include "support/catch.h"
#include "support/command.h"
#include "support/skip.h"

using namespace vndf;
using Catch::Matchers::ContainsSubstring;

namespace {

// As root and in a container, too; ranks get a CPU in turns, which fewer have than ranks.
const std::string mpirun =
    "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_btl_vader_single_copy_mechanism=none "
    "mpirun --oversubscribe --bind-to none ";

// Whether mpirun is there and starts this command, which then was built for it.
bool has_ranks() {
    static const bool works = [] {
        const Folder folder;
        return shell(folder, mpirun + "-n 2 \"$clvndf\" --version >out 2>err") == 0 &&
               folder.read("out") == clvndf("--version").out;
    }();
    if (!works) note_skip("no mpirun, or a build without MPI");
    return works;
}

bool has_pocl() {
    return runtime::choose_device().device.platform == "Portable Computing Language";
}

// Ways to run a command whose results must be the same: by one process, by devices (in PoCL's words), by ranks.
std::vector<std::string> ways(const std::string& command, const std::string& devices,
                              const std::vector<int>& ranks) {
    const std::string alone = "\"$clvndf\" --quiet " + command;
    std::vector<std::string> ways{alone};
    if (has_pocl()) ways.push_back("POCL_DEVICES='" + devices + "' " + alone + " --device all");
    for (const int count : ranks) ways.push_back(mpirun + "-n " + std::to_string(count) + " " + alone);
    return ways;
}

std::string without(const std::string& text, const char* pattern) {
    return std::regex_replace(text, std::regex(pattern), "");
}

// A report but for its times.
std::string timeless(const std::string& text) {
    return without(
        text, "\"seconds\": [^,\n]*|in [0-9.]+ s|[0-9.]+ s, seed|time=\"[^\"]*\"|  +[0-9]+  (?=none|[0-9])");
}

// The first line that another text has in another form; empty if there is none.
std::string first_difference(const std::string& one, const std::string& other) {
    std::istringstream a(one), b(other);
    std::string line, beside;
    while (std::getline(a, line)) {
        beside = "nothing";
        if (!std::getline(b, beside) || line != beside) return line + " | " + beside;
    }
    return one.size() == other.size() ? "" : "more lines";
}

// The pixels of a PNG file: all but its words on how it came about.
std::string pixels(const std::string& png) {
    std::string kept;
    const auto length = [&](std::size_t at) {
        std::size_t size = 0;
        for (std::size_t i = 0; i < 4; ++i) size = size << 8 | static_cast<unsigned char>(png.at(at + i));
        return size;
    };
    for (std::size_t at = 8; at + 12 <= png.size(); at += length(at) + 12)
        if (png.compare(at + 4, 4, "tEXt") != 0 && png.compare(at + 4, 4, "iTXt") != 0)
            kept += png.substr(at, length(at) + 12);
    return kept;
}

// Every square root is its argument, so that there are offenders to be counted.
std::string broken() {
    return has_pocl() ? "POCL_EXTRA_BUILD_FLAGS=-D_cl_sqrt=_cl_fabs " : "";
}

const std::string walk = "check --exhaustive --only '*_wm_heitz2018' --slice 1/3000 ";

// A copy of a checkpoint with one thing changed.
template <class Change>
std::string changed(const std::string& checkpoint, Change change) {
    auto json = nlohmann::ordered_json::parse(checkpoint);
    change(json);
    return json.dump();
}

}  // namespace

TEST_CASE("check says the same by one process, by several and by several devices") {
    if (!has_ranks()) return;
    const Folder folder;
    std::string first;
    for (const std::string& way :
         ways("check --quick --only 'vndf_ggx_*dupuy2023*' --json a.json --junit a.xml --report page --all",
              "pthread pthread", {2, 4})) {
        CAPTURE(way);
        CHECK(shell(folder, way + " >out 2>err") == 0);
        CAPTURE(folder.read("err"));
        std::string said;
        for (const char* file : {"out", "a.json", "a.xml", "page/index.html"}) {
            CHECK_FALSE(folder.read(file).empty());
            said += timeless(folder.read(file));
        }
        if (first.empty()) first = said;
        CHECK(first_difference(said, first) == "");
    }
}

TEST_CASE("an exhaustion counts the same by one process, by several and by several devices") {
    if (!has_ranks()) return;
    const Folder folder;
    std::string first;
    for (const std::string& way : ways(walk, "pthread pthread", {2, 4})) {
        CAPTURE(way);
        CHECK(shell(folder, broken() + way + " >out 2>err") == (has_pocl() ? 1 : 0));
        CAPTURE(folder.read("err"));
        const std::string said = timeless(folder.read("out"));
        if (first.empty()) first = said;
        CHECK_THAT(said, ContainsSubstring(has_pocl() ? "(unit length)" : "none bad"));
        CHECK(said == first);
    }
}

TEST_CASE("an image has the same pixels by one process, by several and by several devices") {
    if (!has_ranks()) return;
    const Folder folder;
    for (const std::string goal : {"--spp 5", "--target-error 0.3"}) {
        std::string first;
        // Of different devices, whose strict results are the same.
        for (const std::string& way :
             ways("render --size 60x40 --max-bounces 2 -o a.png " + goal, "pthread basic", {2})) {
            CAPTURE(way);
            CHECK(shell(folder, way + " >out 2>err") == 0);
            CAPTURE(folder.read("err"));
            const std::string image = pixels(folder.read("a.png"));
            REQUIRE(image.size() > 1000);
            if (first.empty()) first = image;
            CHECK((image == first));
        }
    }
}

TEST_CASE("a rendering goes on from a checkpoint, whoever made it") {
    if (!has_ranks()) return;
    const Folder folder;
    const std::string two = mpirun + "-n 2 ", what = "\"$clvndf\" --quiet render --size 60x40 -o a.png ";
    CHECK(shell(folder, what + "--spp 7 2>err") == 0);
    const std::string whole = pixels(folder.read("a.png"));
    for (const auto& [one, other] : {std::pair(two, std::string()), {std::string(), two}}) {
        CHECK(shell(folder, "rm -f at; " + one + what + "--spp 3 --checkpoint at 2>err && " + other + what +
                                "--spp 7 --checkpoint at 2>err") == 0);
        CHECK((pixels(folder.read("a.png")) == whole));
    }
}

TEST_CASE("a rank that dies or falls silent ends the run, with its number and without a result") {
    if (!has_ranks()) return;
    const Folder folder;
    folder.write(
        "rank",
        "if [ \"$OMPI_COMM_WORLD_RANK\" = 1 ]; then (sleep 1.5; kill -$SIGNAL $$) & fi\nexec \"$@\"\n");
    const std::string run = mpirun +
                            "-n 2 sh rank \"$clvndf\" --quiet check --exhaustive --checkpoint at --only "
                            "vndf_ggx_sample_wm_heitz2018 >out 2>err";
    CHECK(shell(folder, "SIGNAL=KILL " + run) != 0);
    CHECK_THAT(folder.read("err"), ContainsSubstring("rank 1"));
    CHECK(folder.read("out").empty());
    const int status = shell(folder, "rm -f at; CLVNDF_RANK_TIMEOUT=2 SIGNAL=STOP " + run);
    CAPTURE(folder.read("err"));
    CHECK(status == 3);
    CHECK_THAT(folder.read("err"), ContainsSubstring("clvndf: rank 1 on ") &&
                                       ContainsSubstring("has been silent for 2 s: the run ends without it"));
    CHECK(folder.read("out").empty());
}

TEST_CASE("what is wrong is said once, by the first rank, wherever it is wrong") {
    if (!has_ranks()) return;
    const Folder folder;
    const auto refused = [&](const std::string& words, const std::string& said,
                             const std::string& rank = "") {
        CAPTURE(words);
        folder.write("rank", "[ \"$OMPI_COMM_WORLD_RANK\" = 1 ] && { " + (rank.empty() ? ":" : rank) +
                                 "; }\nexec \"$@\"\n");
        const int status = shell(folder, mpirun + "-n 2 sh rank \"$clvndf\" " + words + " >out 2>err");
        CAPTURE(folder.read("err"));
        CHECK((status == 2 || status == 3));
        CHECK(folder.read("out").empty());
        const std::string err = folder.read("err");
        CHECK_THAT(err, ContainsSubstring(said));
        CHECK(err.find("clvndf:") == err.rfind("clvndf:"));
    };
    refused("list", "clvndf list is done by one process, and mpirun started 2");
    refused("check --only nosuch", "no function of that name");
    refused("check --exhaustive --only heitz2018 --slice 1/9", "rank 1 on ", "export CLVNDF_DEVICE=nosuch");
    refused("check --quick --only vndf_reflect", "would do something else: ", "set -- \"$@\" --seed 7");
    for (const std::string text : {"x", "0", "-1", "nan", "1e7", "5s"}) {
        CAPTURE(text);
        CHECK(shell(folder, "CLVNDF_RANK_TIMEOUT=" + text +
                                " \"$clvndf\" check --quick --only vndf_reflect >out 2>err") == 2);
        CHECK_THAT(folder.read("err"),
                   ContainsSubstring("CLVNDF_RANK_TIMEOUT '" + text + "': expected seconds, from 1 to 1e6"));
    }
}

TEST_CASE("--device all takes alike devices alone, and no command that uses one") {
    if (!has_pocl()) VNDF_SKIP("PoCL plays the devices");
    const Folder folder;
    const std::string mixed = "POCL_DEVICES='pthread basic' ";
    CHECK(shell(folder, mixed + "\"$clvndf\" check --quick --only vndf_reflect --device all >out 2>err") ==
          2);
    CHECK_THAT(folder.read("err"), ContainsSubstring("the devices are of different kinds") &&
                                       ContainsSubstring("--device all:NAME"));
    CHECK(shell(folder,
                mixed +
                    "\"$clvndf\" --quiet check --quick --only vndf_reflect --device all:basic >out 2>err") ==
          0);
    CHECK_THAT(folder.read("out"), ContainsSubstring("basic"));
    for (const std::string command : {"eval vndf_reflect", "policies --quick", "energy --no-cache"}) {
        CAPTURE(command);
        const Outcome outcome = clvndf(command + " --device all");
        CHECK(outcome.status == 2);
        CHECK_THAT(outcome.err, ContainsSubstring("--device 'all': this command uses one device"));
    }
    CHECK(clvndf("check --quick --only vndf_reflect --device all:nosuch").status == 2);
}

TEST_CASE("bench measures the devices of --device all in turn, each with a table and a file of its own") {
    if (clvndf("bench --help").status != 0) return;
    if (!has_pocl()) VNDF_SKIP("PoCL plays the devices");
    const Folder folder;
    const auto bench = [&](const std::string& json) {
        return shell(
            folder,
            "POCL_DEVICES='pthread basic' \"$clvndf\" --quiet bench --only vndf_reflect/strict/float "
            "--repetitions 3 --device all --json " +
                json + " >out 2>err");
    };
    REQUIRE(bench("run.json") == 0);
    const auto device = [&](const std::string& file) {
        return nlohmann::json::parse(folder.read(file)).at("context").at("device").get<std::string>();
    };
    const std::string first = device("run.json"), second = device("run-2.json"), out = folder.read("out");
    CAPTURE(first, second, out);
    CHECK((first.find("basic") != std::string::npos) != (second.find("basic") != std::string::npos));
    const std::size_t after = out.find('\n' + second + '\n');
    CHECK(out.starts_with(first + '\n'));
    REQUIRE(after != std::string::npos);
    for (const std::string& part : {out.substr(0, after), out.substr(after)})
        CHECK_THAT(part, ContainsSubstring("vndf_reflect\n"));
    CHECK(folder.read("err").empty());

    for (const std::string json : {"-", "/dev/null"}) {
        CHECK(bench(json) == 2);
        CHECK_THAT(folder.read("err"),
                   ContainsSubstring("--json '" + json + "': 2 devices have a file each"));
    }
    CHECK(bench("run.json --compare run-2.json") == 2);
    CHECK_THAT(folder.read("err"), ContainsSubstring("run-2.json: one file"));
    CHECK(bench("nowhere/run.json") == 2);
}

TEST_CASE("an exhaustion that is cut short goes on from its checkpoint to the same record") {
    const Folder folder;
    const std::string run = broken() + "\"$clvndf\" --quiet " + walk;
    const auto ends = [&](const std::string& words) { return shell(folder, run + words + " 2>err"); };
    const int found = has_pocl() ? 1 : 0;
    REQUIRE(ends(">whole") == found);
    // Cut by its time, then killed.
    REQUIRE(ends("--minutes 0.001 --checkpoint at >part") == found);
    const nlohmann::json begun = nlohmann::json::parse(folder.read("at"));
    CHECK(begun.at("walked") < begun.at("pieces"));
    CHECK(ends("--checkpoint at >out & sleep 0.7; kill -KILL $!; ! wait $! 2>err") == 0);
    REQUIRE(ends("--checkpoint at >rest") == found);
    CHECK(timeless(folder.read("rest")) == timeless(folder.read("whole")));
    CHECK(nlohmann::json::parse(folder.read("at")).at("walked") == begun.at("pieces"));
    // What is walked is not walked again.
    REQUIRE(ends("--checkpoint at >again") == found);
    CHECK(timeless(folder.read("again")) == timeless(folder.read("whole")));
}

TEST_CASE("a checkpoint of another run, damaged or hostile is refused in a line, and left as it is") {
    const Folder folder;
    REQUIRE(shell(folder, "\"$clvndf\" --quiet " + walk + "--minutes 0.001 --checkpoint at >out 2>err") == 0);
    const std::string good = folder.read("at");
    const auto refused = [&](const std::string& text, const std::string& said,
                             const std::string& words = walk) {
        folder.write("at", text);
        CAPTURE(text.substr(0, 200), said);
        CHECK(shell(folder, "\"$clvndf\" --quiet " + words + "--checkpoint at >out 2>err") == 2);
        const std::string err = folder.read("err");
        CAPTURE(err);
        CHECK_THAT(err, ContainsSubstring("--checkpoint 'at': ") && ContainsSubstring(said));
        CHECK(std::count(err.begin(), err.end(), '\n') == 1);
        CHECK(std::none_of(err.begin(), err.end() - 1, [](unsigned char c) { return c < ' ' || c == 127; }));
        CHECK(folder.read("at") == text);
        CHECK(folder.read("out").empty());
    };
    const std::string other = "of another run: ", none = "no checkpoint of check --exhaustive",
                      bad = "damaged: ";
    refused(good, other, "check --exhaustive --only '*_wm_heitz2018' --slice 2/3000 ");
    refused(good, other, "check --exhaustive --only '*_wm_dupuy2023' --slice 1/3000 ");
    refused(good, other, walk + "--math builtin ");
    refused(std::regex_replace(good, std::regex("kernels [0-9a-f]{4}"), "kernels 0123"), other);
    for (const std::string& text :
         {std::string(), std::string("{"), std::string("[]"), std::string("null"),
          good.substr(0, good.size() / 2), std::string(1000, '['), std::string("\0\xff", 2)})
        refused(text, none);
    using Json = nlohmann::ordered_json;
    refused(changed(good, [](Json& j) { j["format"] = "2"; }), none);
    for (const Json& walked : {Json(-1), Json(1.5), Json("1"), Json(nullptr), Json(1e300), Json(1u << 31)})
        refused(changed(good, [&](Json& j) { j["walked"] = walked; }),
                "walked is no whole number from 0 to ");
    refused(changed(good, [](Json& j) { j["walked"] = 0; }), bad + "samplers[0].inputs is not 0");
    refused(changed(good, [](Json& j) { j["samplers"][0]["inputs"] = 5; }),
            bad + "samplers[0].inputs is not ");
    refused(changed(good, [](Json& j) { j["samplers"] = Json::array(); }), bad + "samplers is no array of 1");
    refused(changed(good, [](Json& j) { j["samplers"][0]["sampler"] = "\x1b[2J"; }),
            bad + "samplers[0].sampler");
    refused(changed(good, [](Json& j) { j["samplers"][0]["offenders"][1]["count"] = 3; }),
            "a count or a first one without the other");
    refused(changed(good,
                    [](Json& j) {
                        j["samplers"][0]["offenders"][1]["count"] = 3;
                        j["samplers"][0]["offenders"][1]["first"] = "\x1b[31m";
                    }),
            "samplers[0].offenders[1].first is no input");
    refused(changed(good, [](Json& j) { j["seconds"] = -1; }), bad + "seconds is no number of seconds");
    refused(changed(good, [](Json& j) { j.erase("device"); }), bad + "it has no member 'device'");
    folder.write("large", std::string((std::size_t{1} << 20) + 1, ' '));
    for (const std::string file : {"large", "."}) {
        CHECK(shell(folder, "\"$clvndf\" " + walk + "--checkpoint " + file + " >out 2>err") == 2);
        CHECK_THAT(folder.read("err"), ContainsSubstring(file + ": "));
    }
}
