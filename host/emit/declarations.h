// The declarations of preprocessed headers, and which of them a function needs.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "emit/preprocess.h"

namespace vndf::emit {

struct Declaration {
    std::string name;  // of the function, struct or type; empty: of nothing that can be called for
    std::string file;
    std::vector<std::string> comments;  // the lines right before it
    std::vector<Token> tokens;
};

// In their order. Namespaces are taken off.
std::vector<Declaration> declarations(const std::vector<Token>& tokens);

// The comment at the head of each file.
std::vector<std::string> file_comment(const std::vector<Token>& tokens, const std::string& file);

// Those of these names and all that they use, in the order of `all`.
std::vector<Declaration> closure(const std::vector<Declaration>& all, const std::set<std::string>& names);

}  // namespace vndf::emit
