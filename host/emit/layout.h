// Tokens as text: one statement a line, blanks as everywhere in these sources, long lines broken.
#pragma once

#include <string>
#include <vector>

#include "emit/declarations.h"

namespace vndf::emit {

inline constexpr std::size_t line_length = 110;

// A declaration below its comments.
std::string lay_out(const Declaration& declaration);

// The lines of a comment behind `indent` blanks; what is too long goes on in the next line of the same paragraph.
std::string lay_out_comment(const std::vector<std::string>& lines, std::size_t indent);

}  // namespace vndf::emit
