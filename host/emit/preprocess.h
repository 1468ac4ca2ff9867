// The kernel headers after the preprocessor: their tokens with comments kept, by Boost.Wave.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace vndf::emit {

enum class TokenKind { identifier, number, punctuation, comment, newline };

struct Token {
    TokenKind kind;
    std::string text;  // of a comment without its newline
    std::string file;  // "kernels/vndf/ggx.h"
    std::size_t line;
};

// `source` preprocessed with these macros ("VNDF_REAL=float"). Includes that are left in it and pragmas are passed over.
std::vector<Token> preprocess(std::string_view source, const std::vector<std::string>& macros);

}  // namespace vndf::emit
