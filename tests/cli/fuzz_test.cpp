// The command line's readers on a million generated inputs: no crash, and never a silent wrong answer.
// tests/cli/fuzz holds the same judges as libFuzzer targets.
#include <algorithm>
#include <cfloat>
#include <random>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/command_line.h"
#include "registry.h"
#include "support/command.h"
#include "support/csv_oracle.h"
#include "support/options.h"

using namespace vndf;
using namespace vndf::test;

namespace {

// Failures are collected, not asserted one by one: a million assertions would take most of the time.
class Failures {
  public:
    void add(const std::string& input, const std::string& fault) {
        if (!fault.empty() && count_++ < 5) text_ += fmt::format("'{}': {}\n", input, fault);
    }
    void require_none() const {
        INFO(text_);
        CHECK(count_ == 0);
    }

  private:
    std::size_t count_ = 0;
    std::string text_;
};

class Generator {
  public:
    explicit Generator(std::uint64_t seed) : engine_(seed) {}

    std::size_t below(std::size_t n) { return engine_() % n; }
    bool chance(unsigned percent) { return below(100) < percent; }
    template <class T>
    const T& pick(const std::vector<T>& from) {
        return from[below(from.size())];
    }

    // Any finite double, or one near the edges of float and double.
    double number() {
        const std::uint64_t bits = engine_();
        double x;
        std::memcpy(&x, &bits, sizeof x);
        if (chance(50))
            x = std::ldexp(1 + static_cast<double>(bits >> 12) * 0x1p-52, static_cast<int>(below(300)) - 160);
        if (chance(5)) x = FLT_MAX * (1 + static_cast<double>(below(9)) * 0x1p-26);
        return std::isfinite(x) ? x : 1;
    }

    // Halfway between two floats, in all its digits and sometimes a little more or less.
    std::string tie() {
        const auto x = static_cast<float>(number());
        const double low = std::isfinite(x) ? x : 1, high = std::nextafter(static_cast<float>(low), FLT_MAX);
        std::string text = fmt::format("{:.170e}", low + (high - low) / 2);
        const std::size_t exponent = text.find('e');
        if (chance(60)) text.insert(exponent, std::string(below(900), '0') + (chance(50) ? "1" : ""));
        return text;
    }

    std::string digits(std::size_t most) {
        std::string text;
        for (std::size_t n = below(most + 1); n > 0; --n) text += static_cast<char>('0' + below(10));
        return text;
    }

    // A cell that is a number, most of the time.
    std::string cell() {
        switch (below(8)) {
            case 0:
                return fmt::format("{:.{}g}", number(), 1 + below(20));
            case 1:
                return fmt::format("{:a}", number());
            case 2:
                return fmt::format("{:A}", static_cast<float>(number()));
            case 3:
                return tie();
            case 4:
                return pick(signs_) + digits(30) + (chance(70) ? "." + digits(40) : "") +
                       (chance(50) ? pick(exponents_) + digits(chance(5) ? 25 : 3) : "");
            case 5:
                return pick(signs_) + "0x" + hex_digits(20) + (chance(50) ? "." + hex_digits(30) : "") +
                       (chance(70) ? pick(binary_exponents_) + digits(chance(5) ? 25 : 4) : "");
            case 6:
                return pick(words_);
            default:
                return pick(signs_) + std::to_string(below(1000));
        }
    }

    std::string hex_digits(std::size_t most) {
        std::string text;
        for (std::size_t n = below(most + 1); n > 0; --n) text += "0123456789abcdefABCDEF000"[below(25)];
        return text;
    }

    // A few characters changed, lost, doubled or put in.
    std::string mutated(std::string text) {
        for (std::size_t n = 1 + below(3); n > 0; --n) {
            const std::size_t at = below(text.size() + 1);
            const char c = chance(80) ? alphabet_[below(alphabet_.size())] : static_cast<char>(below(256));
            if (at == text.size() || chance(30))
                text.insert(at, 1, c);
            else if (chance(50))
                text[at] = c;
            else if (chance(50))
                text.erase(at, 1 + below(4));
            else
                text.insert(at, text.substr(at, 1 + below(12)));
        }
        return text;
    }

    std::string blanks() { return chance(90) ? "" : pick(blanks_); }

    std::string table(const std::vector<std::string>& columns) {
        const std::string end = chance(80) ? "\n" : "\r\n";
        std::vector<std::string> names = columns;
        std::shuffle(names.begin(), names.end(), engine_);
        std::string text = chance(90) ? "" : "\xEF\xBB\xBF";
        const auto add_row = [&](auto cell) {
            for (std::size_t c = 0; c < names.size(); ++c) {
                if (c > 0) text += ',';
                text += blanks();
                text += cell(c);
                text += blanks();
            }
            text += end;
        };
        add_row([&](std::size_t c) { return names[c]; });
        for (std::size_t rows = below(20); rows > 0; --rows)
            add_row([&](std::size_t) { return finite_cell(); });
        if (chance(10)) text += end + blanks() + end;
        if (chance(20)) text.resize(text.size() - end.size());
        return text;
    }

  private:
    std::string finite_cell() { return fmt::format("{:.{}g}", static_cast<float>(number()), 1 + below(12)); }

    std::mt19937_64 engine_;
    const std::vector<std::string> signs_{"", "", "-", "+"}, exponents_{"e", "E", "e-", "e+", "E-"},
        binary_exponents_{"p", "P", "p-", "p+", "P-"}, blanks_{" ", "\t", "  ", " \t "},
        // clang-format off
        words_{"inf", "-inf", "+INF", "Infinity", "-infinity", "nan", "-NaN", "NAN(1)", "0", "-0", "1e-46", "7e-46",
               "7.1e-46", "3.4028235677973366e38", "3.4028235677973367e38", "1e999999999999", "1e-999999999999",
               "0x1p-150", "0x1.8p-150", "0x1p-1075", "0x.8p-1074", "0x1.51D2a9P-129", "0x1p+-1", "0x", "1e", ".",
               "-", ""};
    // clang-format on
    const std::string alphabet_ = "0123456789+-.,eExXpPabcdfinIN()_ \t\r\n\"';:";
};

const std::vector<std::string> columns{"u1", "alpha_x", "wo_x"};

}  // namespace

TEST_CASE("every accepted cell is the number it says, rounded once, and every other cell is refused") {
    Generator generator(1);
    Failures failures;
    std::size_t accepted = 0, refused = 0;
    for (std::size_t i = 0; i < 500000; ++i) {
        const std::string cell =
            generator.chance(70) ? generator.cell() : generator.mutated(generator.cell());
        failures.add(cell, misread_number<float>(cell));
        failures.add(cell, misread_number<double>(cell));
        ++(expected_number<double>(cell) ? accepted : refused);
    }
    failures.require_none();
    CHECK(accepted > 250000);
    CHECK(refused > 50000);
}

TEST_CASE("every number that is written reads back as the same number") {
    Generator generator(2);
    Failures failures;
    for (std::size_t i = 0; i < 200000; ++i) {
        const double x = generator.number();
        failures.add(fmt::format("{:a}", x), miswritten(x));
        failures.add(fmt::format("{:a}", x), miswritten(static_cast<float>(x)));
    }
    for (const double x : {0.0, -0.0, DBL_TRUE_MIN, DBL_MIN, DBL_MAX, HUGE_VAL, -HUGE_VAL, std::nan("")}) {
        failures.add(fmt::format("{:a}", x), miswritten(x));
        failures.add(fmt::format("{:a}", x), miswritten(static_cast<float>(x)));
    }
    failures.require_none();
}

TEST_CASE("a table is read row by row as it stands, or refused with the line and column of its first fault") {
    Generator generator(3);
    Failures failures;
    std::size_t accepted = 0, refused = 0;
    for (std::size_t i = 0; i < 30000; ++i) {
        const std::string text =
            generator.chance(40) ? generator.table(columns) : generator.mutated(generator.table(columns));
        const std::size_t chunk = 1 + generator.below(12);
        failures.add(text, generator.chance(50) ? misread<float>(text, columns, chunk)
                                                : misread<double>(text, columns, chunk));
        ++(expected_table<double>(text, columns).bad_line == 0 ? accepted : refused);
    }
    failures.require_none();
    CHECK(accepted > 10000);
    CHECK(refused > 5000);
}

TEST_CASE("lines are numbered and read alike wherever the reader's buffer ends") {
    Generator generator(4);
    Failures failures;
    for (std::size_t i = 0; i < 40; ++i) {
        std::string text = "u1,alpha_x,wo_x\n";
        while (text.size() < 200000)
            text += fmt::format("{}{:.{}g},{},{:a}\n", std::string(generator.below(400), ' '),
                                generator.number(), 1 + generator.below(15), generator.below(10), 0.5);
        if (i % 4 == 0) text += std::string(65500 + generator.below(70), ' ') + "1,2,3\n4,5,6\n";
        if (i % 2 == 0) text += "1,2\n";
        failures.add(text.substr(0, 60), misread<double>(text, columns, 1 + generator.below(5000)));
    }
    failures.require_none();
}

TEST_CASE("the judge of these tests tells right from wrong") {
    CHECK(misread<float>("u1,alpha_x,wo_x\n1,2,3\n", columns, 1).empty());
    CHECK(misread_number<float>("0.1").empty());
    CHECK(*expected_number<float>("0x1.8p1") == 3);
    CHECK(*expected_number<float>("0x1.51D2a9p-129") == 0x1.51d2bp-129f);
    CHECK(*expected_number<float>("0x1.000001p0") == 1);
    CHECK(*expected_number<float>("0x1.00000100000000000000000000001p0") == 0x1.000002p0f);
    CHECK(*expected_number<float>("-0x1.000002ffffffffffffffffffffffp0") == -0x1.000002p0f);
    CHECK(*expected_number<float>("-0x1.000003p0") == -0x1.000004p0f);
    CHECK(*expected_number<float>("0x1.fffffeffffffffffffffffffffffp127") == FLT_MAX);
    CHECK_FALSE(expected_number<float>("-0x1.ffffffp127"));
    CHECK(*expected_number<double>("-1e-9999") == 0);
    CHECK_FALSE(expected_number<float>(" 1"));
    CHECK_FALSE(expected_number<float>("1 "));
    CHECK_FALSE(expected_number<float>("1e39"));
    CHECK_FALSE(expected_number<double>(std::string_view("1\0", 2)));
    CHECK(std::isinf(*expected_number<float>("-inf")));
    const auto fault = [](const std::string& text) {
        const Expected<float> expected = expected_table<float>(text, columns);
        return std::pair(expected.bad_line, expected.bad_column);
    };
    const std::string header = "wo_x,u1,alpha_x\n";
    CHECK(fault(header + "1,2,3\r\n\n \n") == std::pair(std::size_t{0}, std::string{}));
    CHECK(fault(header + "1,2,3\n1,x,3\n") == std::pair(std::size_t{3}, std::string("u1")));
    CHECK(fault(header + "1,2\n") == std::pair(std::size_t{2}, std::string("alpha_x")));
    CHECK(fault(header + "\n1,2,3\n") == std::pair(std::size_t{2}, std::string{}));
    CHECK(fault("wo_x,u1\n").first == 1);
    CHECK(fault("wo_x,u1,u1\n").first == 1);
    CHECK(fault("").first == 1);
}

namespace {

struct Line {
    std::vector<std::string> words;
    std::string seed = "1", wrong;  // wrong: what a refusal must speak of
};

const Commands& known() {
    static const Commands all = commands();
    return all;
}

// Options of the command and common ones, in any order, none of which excludes or lacks another.
std::vector<Option> random_options(Generator& generator, const Command& command) {
    std::vector<Option> all = known().common, chosen;
    all.insert(all.end(), command.options.begin(), command.options.end());
    for (std::size_t i = all.size(); i > 1; --i) std::swap(all[i - 1], all[generator.below(i)]);
    std::set<std::string> names, barred;
    for (const Option& option : all) {
        if (only_informs(option) || generator.chance(50)) continue;
        // With those that it needs, which may need it in turn.
        std::vector<Option> group{option};
        for (std::size_t i = 0; i < group.size(); ++i)
            for (const Option& other : all)
                if (std::count(group[i].needs.begin(), group[i].needs.end(), other.name) != 0 &&
                    std::none_of(group.begin(), group.end(),
                                 [&](const Option& o) { return o.name == other.name; }))
                    group.push_back(other);
        const auto clashes = [&](const Option& o) {
            return barred.contains(o.name) ||
                   std::any_of(o.excludes.begin(), o.excludes.end(),
                               [&](const std::string& name) { return names.contains(name); });
        };
        if (std::any_of(group.begin(), group.end(), clashes)) continue;
        for (const Option& o : group) {
            barred.insert(o.excludes.begin(), o.excludes.end());
            if (names.insert(o.name).second) chosen.push_back(o);
        }
    }
    return chosen;
}

using Words = std::vector<std::string>;

Words words_of(Generator& generator, const Option& option, const std::string& value) {
    if (option.flag) return {option.name};
    if (generator.chance(30) && !value.empty()) return {option.name + "=" + value};
    return {option.name, value};
}

// Makes the line one that must be refused.
void spoil(Generator& generator, const Command& command, const std::vector<Option>& options,
           std::vector<Words>& groups, Line& line) {
    static const Words junk{"--colour", "-x", "--quik", "---", "--seeds=1", "vndf_refract", "list"};
    const std::size_t at = generator.below(options.size() + 3);
    const auto unmet = std::find_if(command.options.begin(), command.options.end(),
                                    [](const Option& option) { return !option.needs.empty(); });
    if (at < options.size() && options[at].flag && generator.chance(50)) {
        line.wrong = options[at].name + "=1";  // takes no value
        groups[at] = {line.wrong};
    } else if (at < options.size() && !options[at].excludes.empty()) {
        const std::string& other = line.wrong = generator.pick(options[at].excludes);
        for (const Option& option : command.options)
            if (option.name == other)
                groups.push_back({words_of(generator, option, option.flag ? "" : option.values.good[0])});
    } else if (at < options.size() && !options[at].flag) {
        line.wrong = options[at].name;
        if (generator.chance(70))
            groups[at] = words_of(generator, options[at], generator.pick(options[at].values.wrong));
        else
            groups.push_back(words_of(generator, options[at], generator.pick(options[at].values.good)));
    } else if (unmet != command.options.end() && generator.chance(20) &&
               std::none_of(options.begin(), options.end(), [&](const Option& option) {
                   return option.name == unmet->name || option.name == unmet->needs[0];
               })) {
        line.wrong = unmet->name;
        groups.push_back(words_of(generator, *unmet, unmet->values.good[0]));
    } else {
        do {
            line.wrong = generator.pick(junk);
        } while (command.takes_names && line.wrong[0] != '-');
        // Of words without a dash the last is one too many.
        const std::size_t place = line.wrong[0] == '-' ? generator.below(groups.size() + 1) : groups.size();
        groups.insert(groups.begin() + static_cast<std::ptrdiff_t>(place), {line.wrong});
    }
}

Line random_line(Generator& generator) {
    const Command& command = generator.pick(known().commands);
    const std::vector<Option> options = random_options(generator, command);
    Line line;
    std::vector<Words> groups;
    for (const Option& option : options) {
        const std::string value = option.flag ? "" : generator.pick(option.values.good);
        if (option.name == "--seed") line.seed = value;
        groups.push_back(words_of(generator, option, value));
    }
    if (generator.chance(60)) spoil(generator, command, options, groups, line);
    if (command.takes_name) groups.insert(groups.begin(), {"vndf_reflect"});
    groups.insert(groups.begin(), {command.name});
    for (const Words& group : groups) line.words.insert(line.words.end(), group.begin(), group.end());
    return line;
}

std::vector<const char*> pointers(const std::vector<std::string>& words) {
    std::vector<const char*> result{"clvndf"};
    for (const std::string& word : words) result.push_back(word.c_str());
    return result;
}

// What is wrong with the answer to `line`, or nothing.
std::string misparsed(const Line& line) {
    cli::CommandLine command_line;
    const std::vector<const char*> words = pointers(line.words);
    try {
        command_line.parse(static_cast<int>(words.size()), words.data());
    } catch (const InputError& error) {
        if (line.wrong.empty()) return std::string("refused: ") + error.what();
        return std::string(error.what()).find(line.wrong) == std::string::npos
                   ? "expected " + line.wrong + " in: " + error.what()
                   : "";
    }
    if (!line.wrong.empty()) return "accepted in spite of " + line.wrong;
    if (!command_line.common().action) return "accepted, with nothing to do";
    if (std::to_string(command_line.common().seed) != line.seed) return "another seed";
    return {};
}

}  // namespace

TEST_CASE("the command line takes what its help says and names what it does not take") {
    Generator generator(5);
    Failures failures;
    for (std::size_t i = 0; i < 3000; ++i) {
        const Line line = random_line(generator);
        failures.add(fmt::format("{}", fmt::join(line.words, "' '")), misparsed(line));
    }
    failures.require_none();
}

TEST_CASE("every command and every option of each is tried") {
    Generator generator(7);
    std::set<std::string> tried, all;
    for (std::size_t i = 0; i < 3000; ++i) {
        const std::vector<std::string> words = random_line(generator).words;
        for (const std::string& word : words) tried.insert(words[0] + " " + word.substr(0, word.find('=')));
    }
    for (const Command& command : known().commands)
        for (const auto* options : {&known().common, &command.options})
            for (const Option& option : *options)
                if (!only_informs(option)) all.insert(command.name + " " + option.name);
    CHECK(all.size() > 40);
    for (const std::string& option : all) {
        CAPTURE(option);
        CHECK(tried.contains(option));
    }
    // libFuzzer's dictionary.
    std::ifstream file(CLVNDF_SOURCE_DIR "/tests/cli/fuzz/command_line.dict");
    const std::string dictionary(std::istreambuf_iterator<char>(file), {});
    for (const std::string& option : all) {
        CAPTURE(option);
        CHECK(dictionary.find('"' + option.substr(option.find(' ') + 1) + '"') != std::string::npos);
    }
}

TEST_CASE("whatever the arguments, the answer is an action or a refusal") {
    Generator generator(6);
    for (std::size_t i = 0; i < 3000; ++i) {
        std::vector<std::string> words = random_line(generator).words;
        for (std::string& word : words)
            if (generator.chance(20)) word = generator.mutated(word).c_str();
        if (generator.chance(20)) words.push_back(generator.mutated("-"));
        const std::vector<const char*> arguments = pointers(words);
        cli::CommandLine command_line;
        try {
            command_line.parse(static_cast<int>(arguments.size()), arguments.data());
        } catch (const InputError&) {
            continue;
        }
        REQUIRE(command_line.common().action);
    }
}

TEST_CASE("a refusal is one line, whatever the names in it hold") {
    for (const std::string arguments :
         {"\"$(printf 'a\\nb\\033[31mc')\"", "eval \"$(printf 'x\\ny')\"", "list \"$(printf 'x\\ry')\"",
          "check --only \"$(printf 'x\\ny')\"", "list --seed \"$(printf '1\\n2')\"",
          "eval vndf_reflect --on host --input \"$(printf 'x\\ny')\""}) {
        const Outcome run = clvndf(arguments);
        CAPTURE(arguments, run.err);
        CHECK(run.status == 2);
        CHECK(std::count(run.err.begin(), run.err.end(), '\n') == 1);
        CHECK(std::none_of(run.err.begin(), run.err.end() - 1, [](unsigned char c) { return c < ' '; }));
    }
}

TEST_CASE("with a standard stream closed nothing goes where it does not belong") {
    const Folder folder;
    folder.write("in", "wo_x,wo_y,wo_z,wm_x,wm_y,wm_z\n0.5,0,1,0,0,1\n");
    const std::string eval = "\"$clvndf\" eval vndf_reflect --on host ";
    CHECK(shell(folder, eval + "--input in --output out >&-") == 0);
    CHECK(folder.read("out") == "wi_x,wi_y,wi_z\n-0.5,0,1\n");
    CHECK(shell(folder, eval + "--input in --output out 2>&-") == 0);
    CHECK(folder.read("out") == "wi_x,wi_y,wi_z\n-0.5,0,1\n");
    CHECK(shell(folder, eval + "<&- 2>err") == 2);
    CHECK(shell(folder, eval + "--input in >&- 2>err") == 2);
    CHECK(shell(folder, "\"$clvndf\" list >&- 2>err") == 2);
    CHECK(shell(folder, "\"$clvndf\" --help >/dev/full 2>err") == 2);
    CHECK(shell(folder, "\"$clvndf\" check --quick --only vndf_reflect --json json >&- 2>err") == 2);
    CHECK((!std::filesystem::exists(folder / "json") || folder.read("json")[0] == '{'));
}
