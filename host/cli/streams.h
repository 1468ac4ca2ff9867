// What the commands say on the standard output and on stderr.
#pragma once

#include <string_view>
#include <utility>

#include <fmt/format.h>

namespace vndf::cli {

// Writes what the command owes. Throws InputError if the standard output does not take it.
void put(std::string_view text);

template <class... T>
void put(fmt::format_string<T...> form, T&&... values) {
    put(fmt::format(form, std::forward<T>(values)...));
}

// Throws InputError if what was printed does not arrive.
void flush_output();

// Throws InputError if the standard output is closed: before the work whose result it is to take.
void require_output();

// What is printed from now on goes nowhere: of a rank that does not lead.
void silence_output();

// Tells somebody who may be there something on stderr; if nobody can read it, nothing is lost.
void remark(std::string_view text);

template <class... T>
void remark(fmt::format_string<T...> form, T&&... values) {
    remark(fmt::format(form, std::forward<T>(values)...));
}

}  // namespace vndf::cli
