// What a CSV file of numbers means, said a second time and as plainly as possible: the judge of the reader
// (cli/csv.h) for the property test and the fuzzing targets.
#pragma once

#include <sys/mman.h>
#include <unistd.h>

#include <cfenv>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "cli/csv.h"
#include "error.h"

namespace vndf::test {

// `text`, which strtold reads as a whole, rounded correctly to R. Both neighbours in long double tell: strtof and
// strtod themselves lose a bit of some subnormal hex numbers (glibc 2.36 reads 0x1.51D2a9p-129 as 0x1.51d2ap-129).
template <class R>
R rounded(const char* text) {
    std::fesetround(FE_DOWNWARD);
    const long double below = std::strtold(text, nullptr);
    std::fesetround(FE_UPWARD);
    const long double above = std::strtold(text, nullptr);
    std::fesetround(FE_TONEAREST);
    const R low = static_cast<R>(below), high = static_cast<R>(above);
    if (std::isnan(below) || low == high) return low;
    // The midpoint of the two is a long double: it is one of the neighbours, and the number lies strictly between.
    const long double infinity = std::ldexp(1.0L, std::numeric_limits<R>::max_exponent);
    const auto value = [&](R x) {
        return std::isinf(x) ? std::copysign(infinity, static_cast<long double>(x)) : x;
    };
    return below == value(low) / 2 + value(high) / 2 ? high : low;
}

// The number in the whole of `cell`, correctly rounded; nothing where it is none or a finite text overflows.
template <class R>
std::optional<R> expected_number(std::string_view cell) {
    const std::string text(cell);
    if (text.empty() || std::isspace(static_cast<unsigned char>(text[0]))) return {};
    char* end = nullptr;
    std::strtold(text.c_str(), &end);
    if (end != text.c_str() + text.size()) return {};
    const R number = rounded<R>(text.c_str());
    const bool said_infinite = text.find_first_of("iI") != text.npos;
    if (std::isinf(number) && !said_infinite) return {};
    return number;
}

template <class R>
bool same_number(R a, R b) {
    return (std::isnan(a) && std::isnan(b)) || std::memcmp(&a, &b, sizeof a) == 0;
}

inline std::vector<std::string> split(const std::string& text, char separator) {
    std::vector<std::string> parts(1);
    for (const char c : text) {
        if (c == separator)
            parts.emplace_back();
        else
            parts.back() += c;
    }
    return parts;
}

inline std::string without_blanks(const std::string& text) {
    std::size_t begin = 0, end = text.size();
    while (begin < end && (text[begin] == ' ' || text[begin] == '\t')) ++begin;
    while (end > begin && (text[end - 1] == ' ' || text[end - 1] == '\t')) --end;
    return text.substr(begin, end - begin);
}

// A file as it is to be read: its rows, or the line of its first fault and the column, where there is one.
template <class R>
struct Expected {
    std::vector<std::vector<R>> columns;
    std::size_t bad_line = 0;  // 0: none
    std::string bad_column;
};

template <class R>
Expected<R> expected_table(const std::string& text, const std::vector<std::string>& columns) {
    constexpr std::size_t longest_line = 1 << 16;
    std::vector<std::string> lines = split(text, '\n');
    if (lines.back().empty()) lines.pop_back();
    Expected<R> expected;
    expected.columns.resize(columns.size());
    const auto fault = [&](std::size_t line, const std::string& column = {}) {
        expected.bad_line = line + 1, expected.bad_column = column;
        return expected;
    };
    if (lines.empty()) return fault(0);
    std::size_t blank = lines.size();  // the first blank line of those that may end the file
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        std::string line = lines[i];
        if (line.size() > longest_line) return fault(i);
        if (!line.empty() && line.back() == '\r') line.pop_back();
        if (i == 0 && line.compare(0, 3, "\xEF\xBB\xBF") == 0) line.erase(0, 3);
        if (i > 0 && without_blanks(line).empty()) {
            blank = std::min(blank, i);
            continue;
        }
        if (blank < i) return fault(blank);
        const std::vector<std::string> cells = split(line, ',');
        if (i == 0) {
            for (const std::string& cell : cells) {
                std::size_t column = 0;
                while (column < columns.size() && columns[column] != without_blanks(cell)) ++column;
                for (const std::size_t earlier : order)
                    if (earlier == column) return fault(i);
                if (column == columns.size()) return fault(i);
                order.push_back(column);
            }
            if (order.size() != columns.size()) return fault(i);
            continue;
        }
        if (cells.size() < order.size()) return fault(i, columns[order[cells.size()]]);
        if (cells.size() > order.size()) return fault(i, columns[order.back()]);
        for (std::size_t c = 0; c < cells.size(); ++c) {
            const auto number = expected_number<R>(without_blanks(cells[c]));
            if (!number) return fault(i, columns[order[c]]);
            expected.columns[order[c]].push_back(*number);
        }
    }
    return expected;
}

// A file in memory, with a path.
class MemoryFile {
  public:
    explicit MemoryFile(std::string_view text) : descriptor_(memfd_create("csv", MFD_CLOEXEC)) {
        if (descriptor_ < 0 ||
            write(descriptor_, text.data(), text.size()) != static_cast<ssize_t>(text.size()))
            throw std::runtime_error("no file in memory");
    }
    ~MemoryFile() { close(descriptor_); }
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;
    std::string path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

  private:
    int descriptor_;
};

// The reader's answer to `text` in chunks of `chunk` rows; what is wrong with it, or nothing.
template <class R>
std::string misread(const std::string& text, const std::vector<std::string>& columns, std::size_t chunk) {
    const Expected<R> expected = expected_table<R>(text, columns);
    const MemoryFile file(text);
    std::vector<std::vector<R>> read(columns.size()), table;
    try {
        cli::TableReader<R> reader(file.path(), columns, "the test takes");
        while (const std::size_t rows = reader.read(chunk, table))
            for (std::size_t c = 0; c < columns.size(); ++c) {
                if (table[c].size() != rows) return "columns of different lengths";
                read[c].insert(read[c].end(), table[c].begin(), table[c].end());
            }
    } catch (const InputError& error) {
        const std::string message = error.what();
        if (expected.bad_line == 0) return "refused: " + message;
        // A file without a line has none to name.
        const std::string place =
            text.empty() ? file.path() + ": " : file.path() + ":" + std::to_string(expected.bad_line) + ": ";
        if (message.compare(0, place.size(), place) != 0) return "expected " + place + " not " + message;
        if (!expected.bad_column.empty() && message.find("column " + expected.bad_column) == message.npos)
            return "expected column " + expected.bad_column + ", not " + message;
        return {};
    }
    if (expected.bad_line != 0) return "accepted in spite of line " + std::to_string(expected.bad_line);
    for (std::size_t c = 0; c < columns.size(); ++c) {
        if (read[c].size() != expected.columns[c].size()) return "wrong number of rows";
        for (std::size_t i = 0; i < read[c].size(); ++i)
            if (!same_number(read[c][i], expected.columns[c][i]))
                return "wrong number in row " + std::to_string(i + 1) + " of column " + columns[c];
    }
    return {};
}

// The reader's answer to one cell; what is wrong with it, or nothing.
template <class R>
std::string misread_number(std::string_view cell) {
    const std::optional<R> expected = expected_number<R>(cell);
    R number;
    try {
        number = cli::parse_number<R>(cell);
    } catch (const std::invalid_argument& error) {
        return expected ? std::string("refused: ") + error.what() : "";
    }
    if (!expected) return "accepted";
    return same_number(number, *expected) ? "" : "wrong number";
}

// What is wrong with the text that the writer makes of `number`, or nothing.
template <class R>
std::string miswritten(R number) {
    for (const bool hex : {false, true}) {
        std::string text;
        cli::append_number(text, number, hex);
        const std::optional<R> read = expected_number<R>(text);
        if (!read || !same_number(*read, number)) return "written as " + text;
        if (const std::string fault = misread_number<R>(text); !fault.empty()) return text + " " + fault;
    }
    return {};
}

}  // namespace vndf::test
