// The README shows what is registered, compiled and printed. After a change that it should show, run
//   clvndf_tests "the README is brought up to date"
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <sstream>
#include <string>

#include "registry.h"
#include "support/catch.h"

namespace {

using namespace vndf;
const std::filesystem::path root = CLVNDF_SOURCE_DIR;

std::string read(const std::filesystem::path& path) {
    std::ifstream file(path);
    REQUIRE(file);
    return {std::istreambuf_iterator<char>(file), {}};
}

// The lines from the one after `begin` to the one before `end`, replaced by what `replacement` makes of the
// line `begin` and of them. Throws if there is no such passage.
using Replacement = std::function<std::string(const std::string& begin, const std::string& passage)>;
std::string replace_passages(const std::string& text, const std::string& begin, const std::string& end,
                             const Replacement& replacement) {
    std::istringstream lines(text);
    std::string result, line;
    int found = 0;
    while (std::getline(lines, line)) {
        result += line + "\n";
        if (line.rfind(begin, 0) != 0) continue;
        std::string opening = line, passage;
        while (std::getline(lines, line) && line != end) passage += line + "\n";
        result += replacement(opening, passage) + line + "\n";
        ++found;
    }
    if (!found) throw std::runtime_error("nothing begins with " + begin);
    return result;
}

// "wo_x", "wo_y", "wo_z", "u1", "u2" become "wo, u".
std::string arguments(const Function& f) {
    std::string all;
    for (std::size_t i = 0; i < f.inputs.size(); ++i) {
        std::string name = f.inputs[i];
        if (name.ends_with("_y") || name.ends_with("_z") || name == "u2") continue;
        if (name.ends_with("_x")) name.resize(name.size() - 2);
        if (name == "u1" && i + 1 < f.inputs.size()) name = "u";
        all += (all.empty() ? "" : ", ") + name;
    }
    return "`" + f.name + "(" + all + ")`";
}

std::string number(double x) {
    std::ostringstream text;
    text << x;
    return text.str();
}

std::string sampler_table() {
    std::string table =
        "| sampler | density | method | domain | p99 front, back | source |\n"
        "|---|---|---|---|---|---|\n";
    for (const Function& f : functions()) {
        if (f.kind != Kind::sampler || f.with_pdf) continue;
        table += "| " + arguments(f) + " | `" + f.density + "` | " + std::string(to_string(f.method)) +
                 " | " + std::string(to_string(f.domain)) + " | " + number(f.p99_front) + ", " +
                 (f.p99_back > 0 ? number(f.p99_back) : "-") + " | " + f.source + " |\n";
    }
    return table;
}

std::string function_table() {
    std::string table = "| function | kind | bound | source |\n|---|---|---|---|\n";
    for (const Function& f : functions()) {
        if (f.kind == Kind::sampler) continue;
        table += "| " + arguments(f) + " | " + std::string(to_string(f.kind)) + " | " + number(f.bound) +
                 " | " + f.source + " |\n";
    }
    return table;
}

std::string with_tables(const std::string& readme) {
    const std::string samplers = replace_passages(readme, "<!-- samplers: begin", "<!-- samplers: end -->",
                                                  [](auto&, auto&) { return sampler_table(); });
    return replace_passages(samplers, "<!-- functions: begin", "<!-- functions: end -->",
                            [](auto&, auto&) { return function_table(); });
}

// <!-- file: PATH --> stands above a code block that shows the file; its comment closes with the fence.
std::string with_files(const std::string& readme) {
    return replace_passages(readme, "<!-- file: ", "```",
                            [](const std::string& begin, const std::string& old) {
                                const std::string path = begin.substr(11, begin.find(" -->") - 11);
                                return old.substr(0, old.find('\n') + 1) + read(root / path);
                            });
}

std::string output_of(const std::string& command) {
    const std::string folder = std::filesystem::path(CLVNDF_EXECUTABLE).parent_path().string();
    const std::string line = "PATH='" + folder + "':$PATH; cd '" + root.string() + "'; " + command + " 2>&1";
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> pipe(popen(line.c_str(), "r"), pclose);
    REQUIRE(pipe);
    std::string output;
    for (int c; (c = std::fgetc(pipe.get())) != EOF;) output += static_cast<char>(c);
    return output;
}

// In a block ```console the lines that begin with "$ " are commands; their output follows.
std::string with_outputs(const std::string& readme) {
    return replace_passages(readme, "```console", "```", [](auto&, const std::string& session) {
        std::istringstream lines(session);
        std::string result, line;
        while (std::getline(lines, line)) {
            if (line.rfind("$ ", 0) == 0) result += line + "\n" + output_of(line.substr(2));
        }
        return result;
    });
}

std::string readme() {
    return read(root / "README.md");
}

// Empty if the README is as it should be, else the first line that differs.
std::string difference(const std::string& wanted) {
    std::istringstream is(readme()), should_be(wanted);
    std::string a, b;
    for (int line = 1;; ++line) {
        const bool more_a = bool(std::getline(is, a)), more_b = bool(std::getline(should_be, b));
        if (!more_a && !more_b) return {};
        if (more_a != more_b || a != b) return number(line) + ": \"" + a + "\" should be \"" + b + "\"";
    }
}

}  // namespace

TEST_CASE("the README's tables are the registry") {
    CHECK(difference(with_tables(readme())) == "");
}

TEST_CASE("the README's embedding examples are the files that are compiled") {
    CHECK(difference(with_files(readme())) == "");
}

TEST_CASE("the README's commands print what it shows") {
    CHECK(difference(with_outputs(readme())) == "");
}

TEST_CASE("the README is brought up to date", "[.update]") {
    const std::string current = with_outputs(with_files(with_tables(readme())));
    std::ofstream(root / "README.md") << current;
}
