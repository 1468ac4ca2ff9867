// Rows of numbers as CSV: a reader that says where and what is wrong, and a writer that loses no digit.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace vndf::cli {

// Lines of a file, or of the standard input for "-"; "\n" and "\r\n" end a line.
class LineReader {
  public:
    explicit LineReader(const std::string& path);
    ~LineReader();
    LineReader(const LineReader&) = delete;
    LineReader& operator=(const LineReader&) = delete;

    // False at the end. The view holds until the next call.
    bool next(std::string_view& line);

    // "input.csv:17", for messages about the line last read.
    std::string position() const { return name_ + ":" + std::to_string(number_); }
    const std::string& name() const { return name_; }

  private:
    bool fill();

    std::string name_;
    int descriptor_;
    std::string buffer_;
    std::size_t begin_ = 0;
    std::size_t number_ = 0;
};

// Reads numbers of type R (float or double) below a header that names every expected column once, in any
// order. Cells are decimal or C99 hex numbers, inf or nan, rounded correctly to R, with or without blanks
// around. Whatever else is found throws InputError with file, line and column.
template <class R>
class TableReader {
  public:
    // `what` names the columns' purpose in messages.
    TableReader(const std::string& path, const std::vector<std::string>& columns, const std::string& what);

    // Replaces the contents of `table` (one vector for each expected column, in that order) by up to `rows`
    // rows; returns their number, 0 at the end.
    std::size_t read(std::size_t rows, std::vector<std::vector<R>>& table);

  private:
    void read_header(const std::string& what);
    void parse_row(std::string_view line, std::vector<std::vector<R>>& table) const;

    LineReader lines_;
    std::vector<std::string> columns_;
    std::vector<std::size_t> order_;  // of the file's columns: index into columns_
};

// The cell as a number of type R, rounded once. Throws std::invalid_argument with what was found and is
// allowed.
template <class R>
R parse_number(std::string_view cell);

// Appends the shortest decimal (or, for hex, C99 hex) text that reads back as the same number.
template <class R>
void append_number(std::string& out, R number, bool hex);

}  // namespace vndf::cli
