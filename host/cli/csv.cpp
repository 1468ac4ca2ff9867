#include "cli/csv.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <stdexcept>

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include "error.h"
#include "text.h"

namespace vndf::cli {
namespace {

constexpr std::size_t read_size = 1 << 16;
// No row comes near; a file without line ends must not fill memory.
constexpr std::size_t longest_line = 1 << 16;

std::string_view trimmed(std::string_view text) {
    const std::size_t begin = std::min(text.find_first_not_of(" \t"), text.size());
    const std::size_t end = text.find_last_not_of(" \t") + 1;
    return text.substr(begin, std::max(begin, end) - begin);
}

// Text from outside in a message: short, and without control characters.
std::string quoted(std::string_view text) {
    std::string out = "'";
    for (char c : text.substr(0, 40)) out += static_cast<unsigned char>(c) < ' ' || c == 127 ? '?' : c;
    return out + (text.size() > 40 ? "...'" : "'");
}

std::string joined(const std::vector<std::string>& names) {
    return fmt::format("{}", fmt::join(names, ","));
}

// Calls use(cell) for each comma-separated cell, trimmed.
template <class Use>
void for_each_cell(std::string_view line, Use use) {
    while (true) {
        const std::size_t comma = line.find(',');
        use(trimmed(line.substr(0, comma)));
        if (comma == line.npos) return;
        line.remove_prefix(comma + 1);
    }
}

template <class R>
constexpr const char* type_name = sizeof(R) == 4 ? "float" : "double";

float to_real(const char* text, float) {
    return std::strtof(text, nullptr);
}
double to_real(const char* text, double) {
    return std::strtod(text, nullptr);
}

}  // namespace

LineReader::LineReader(const std::string& path) : name_(path == "-" ? "standard input" : path) {
    descriptor_ = path == "-" ? STDIN_FILENO : open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor_ < 0) throw InputError(fmt::format("{}: cannot read: {}", name_, std::strerror(errno)));
}

LineReader::~LineReader() {
    if (descriptor_ > STDERR_FILENO) close(descriptor_);
}

// Reads more behind what is left; false at the end of the file.
bool LineReader::fill() {
    buffer_.erase(0, begin_);
    begin_ = 0;
    const std::size_t left = buffer_.size();
    buffer_.resize(left + read_size);
    ssize_t count;
    do count = ::read(descriptor_, buffer_.data() + left, read_size);
    while (count < 0 && errno == EINTR);
    buffer_.resize(left + static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
    if (count < 0) throw InputError(fmt::format("{}: cannot read: {}", name_, std::strerror(errno)));
    return count > 0;
}

bool LineReader::next(std::string_view& line) {
    std::size_t end = buffer_.find('\n', begin_);
    while (end == std::string::npos && buffer_.size() - begin_ <= longest_line && fill()) {
        end = buffer_.find('\n', begin_);
    }
    if (end == std::string::npos) end = buffer_.size();
    if (begin_ == buffer_.size()) return false;
    ++number_;
    if (end - begin_ > longest_line) {
        throw InputError(fmt::format("{}: line longer than {} bytes", position(), longest_line));
    }
    line = std::string_view(buffer_).substr(begin_, end - begin_);
    begin_ = std::min(end + 1, buffer_.size());
    if (line.ends_with('\r')) line.remove_suffix(1);
    return true;
}

template <class R>
TableReader<R>::TableReader(const std::string& path, const std::vector<std::string>& columns,
                            const std::string& what)
    : lines_(path), columns_(columns) {
    read_header(what);
}

template <class R>
void TableReader<R>::read_header(const std::string& what) {
    const std::string allowed = fmt::format("; {}: {}", what, joined(columns_));
    std::string_view line;
    if (!lines_.next(line))
        throw InputError(fmt::format("{}: empty, without a header{}", lines_.name(), allowed));
    if (line.starts_with("\xEF\xBB\xBF")) line.remove_prefix(3);  // the byte order mark of spreadsheets
    const auto fail = [&](std::string_view problem, std::string_view name) {
        throw InputError(
            fmt::format("{}: {} column {}{}", lines_.position(), problem, quoted(name), allowed));
    };
    for_each_cell(line, [&](std::string_view name) {
        const auto column = std::find(columns_.begin(), columns_.end(), name);
        if (column == columns_.end()) fail("unknown", name);
        const std::size_t index = static_cast<std::size_t>(column - columns_.begin());
        if (std::count(order_.begin(), order_.end(), index)) fail("doubled", name);
        order_.push_back(index);
    });
    for (std::size_t i = 0; i < columns_.size(); ++i) {
        if (!std::count(order_.begin(), order_.end(), i)) fail("missing", columns_[i]);
    }
}

template <class R>
std::size_t TableReader<R>::read(std::size_t rows, std::vector<std::vector<R>>& table) {
    table.resize(columns_.size());
    for (auto& column : table) column.clear();
    std::string_view line;
    while (table[0].size() < rows && lines_.next(line)) {
        if (!trimmed(line).empty()) {
            parse_row(line, table);
            continue;
        }
        const std::string blank = lines_.position();
        while (lines_.next(line)) {  // blank lines may end a file, not part it
            if (!trimmed(line).empty()) {
                throw InputError(fmt::format("{}: blank line before further rows; {} cells are expected",
                                             blank, order_.size()));
            }
        }
    }
    return table[0].size();
}

template <class R>
void TableReader<R>::parse_row(std::string_view line, std::vector<std::vector<R>>& table) const {
    const std::size_t cells = 1 + static_cast<std::size_t>(std::count(line.begin(), line.end(), ','));
    if (cells != order_.size()) {
        const bool shorter = cells < order_.size();
        const std::string& column = columns_[order_[shorter ? cells : order_.size() - 1]];
        throw InputError(fmt::format("{}: {} row: {} cells where the header has {}; {} column {}",
                                     lines_.position(), shorter ? "short" : "long", cells, order_.size(),
                                     shorter ? "nothing for" : "nothing belongs behind", column));
    }
    std::size_t i = 0;
    for_each_cell(line, [&](std::string_view cell) {
        const std::size_t column = order_[i++];
        try {
            table[column].push_back(parse_number<R>(cell));
        } catch (const std::invalid_argument& error) {
            throw InputError(
                fmt::format("{}: column {}: {}", lines_.position(), columns_[column], error.what()));
        }
    });
}

template <class R>
R parse_number(std::string_view cell) {
    const auto fail = [&](std::string_view problem) {
        throw std::invalid_argument(fmt::format("{} {}", quoted(cell), problem));
    };
    constexpr std::string_view no_number =
        "is no number; decimal (0.1875), C99 hex (0x1.8p-3), inf and nan are allowed";
    std::string_view digits = cell;
    const bool negative = digits.starts_with('-');
    if (negative || digits.starts_with('+')) digits.remove_prefix(1);
    const bool hex = digits.starts_with("0x") || digits.starts_with("0X");
    if (hex) digits.remove_prefix(2);
    // from_chars would take a second sign, also that of a hex exponent, and inf or nan after 0x.
    if (digits.empty() || digits[0] == '-' || digits.find("+-") != digits.npos ||
        (hex && digits[0] != '.' && !std::isxdigit(static_cast<unsigned char>(digits[0])))) {
        fail(no_number);
    }
    R number = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number,
                                              hex ? std::chars_format::hex : std::chars_format::general);
    if (error == std::errc::invalid_argument || end != digits.data() + digits.size()) fail(no_number);
    if (error == std::errc::result_out_of_range) {  // too large, or so small that it rounds to 0
        number = to_real(((hex ? "0x" : "") + std::string(digits)).c_str(), R{});
        if (std::isinf(number)) fail(fmt::format("lies outside the range of {}", type_name<R>));
    }
    return negative ? -number : number;
}

template <class R>
void append_number(std::string& out, R number, bool hex) {
    if (std::isnan(number)) {
        out += "nan";  // sign and payload are unspecified
        return;
    }
    if (hex) {
        out += hex_number(number);
        return;
    }
    char text[64];
    out.append(text, std::to_chars(text, text + sizeof text, number).ptr);
}

template class TableReader<float>;
template class TableReader<double>;
template float parse_number<float>(std::string_view);
template double parse_number<double>(std::string_view);
template void append_number<float>(std::string&, float, bool);
template void append_number<double>(std::string&, double, bool);

}  // namespace vndf::cli
