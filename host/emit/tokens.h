// Places in a row of tokens.
#pragma once

#include <set>
#include <string_view>
#include <vector>

#include "emit/preprocess.h"

namespace vndf::emit {

using Tokens = std::vector<Token>;

inline bool is(const Token& token, std::string_view text) {
    return token.text == text && token.kind != TokenKind::comment;
}
inline bool one_of(const Token& token, const std::set<std::string_view>& words) {
    return token.kind != TokenKind::comment && words.contains(token.text);
}
inline bool opens(const Token& token) {
    return one_of(token, {"(", "[", "{"});
}
inline bool closes(const Token& token) {
    return one_of(token, {")", "]", "}"});
}

// The end of the bracket that opens at i.
inline std::size_t closing(const Tokens& tokens, std::size_t i) {
    int depth = 0;
    for (; i < tokens.size(); ++i) {
        depth += opens(tokens[i]);
        depth -= closes(tokens[i]);
        if (depth == 0) break;
    }
    return i;
}

// The first of `ends` from i on that stands in no bracket, or the end of the bracket around i.
inline std::size_t find_outside(const Tokens& tokens, std::size_t i, const std::set<std::string_view>& ends) {
    for (; i < tokens.size(); ++i) {
        if (one_of(tokens[i], ends) || closes(tokens[i])) break;
        if (opens(tokens[i])) i = closing(tokens, i);
    }
    return i;
}

}  // namespace vndf::emit
