#include "emit/declarations.h"

#include <algorithm>
#include <map>

#include "emit/tokens.h"

namespace vndf::emit {
namespace {

bool is_array(const std::vector<Token>& tokens) {
    return is(tokens[0], "VNDF_CONSTANT");
}

// The name that a declaration declares: before its first parenthesis or an array's bracket, behind `struct`, or at the end of a
// typedef.
std::string name_of(const std::vector<Token>& tokens) {
    std::string last;
    const bool type = is(tokens[0], "typedef"), record = is(tokens[0], "struct");
    for (const Token& token : tokens) {
        if (!type && is(token, is_array(tokens) ? "[" : "(")) return last;
        if (token.kind != TokenKind::identifier) continue;
        last = token.text;
        if (record && last != "struct") return last;
    }
    return type ? last : std::string();
}

// Gathers the tokens of one declaration after the other.
class Splitter {
  public:
    std::vector<Declaration> split(const std::vector<Token>& tokens) {
        for (std::size_t i = 0; i < tokens.size(); ++i) {
            if (current_.empty() && is(tokens[i], "inline") && is(tokens[i + 1], "namespace")) {
                i += 3;
            } else if (current_.empty() && is(tokens[i], "}")) {
                continue;  // of a namespace
            } else if (current_.empty()) {
                between(tokens[i]);
            } else {
                within(tokens[i]);
            }
        }
        return std::move(found_);
    }

  private:
    void between(const Token& token) {
        if (token.kind == TokenKind::newline) return;
        if (token.kind != TokenKind::comment) return within(token);
        if (!comments_.empty() && token.line != comments_.back().line + 1) comments_.clear();
        comments_.push_back(token);
    }

    void within(const Token& token) {
        current_.push_back(token);
        if (token.kind != TokenKind::punctuation) return;
        depth_ += token.text == "(" || token.text == "{" || token.text == "[";
        depth_ -= token.text == ")" || token.text == "}" || token.text == "]";
        const bool body = token.text == "}" && !is(current_[0], "struct") && !is(current_[0], "typedef") &&
                          !is_array(current_);
        if (depth_ == 0 && (token.text == ";" || body)) finish();
    }

    void finish() {
        // The first token that no macro made knows the line. Comments belong to what begins on the next one.
        const auto first = std::find_if(current_.begin(), current_.end(), [](const Token& token) {
            return token.text == "struct" || token.text.starts_with("vndf_");
        });
        Declaration declaration{name_of(current_), "", {}, {}};
        if (first != current_.end()) {
            declaration.file = first->file;
            if (!comments_.empty() && comments_.back().line + 1 == first->line)
                for (const Token& comment : comments_) declaration.comments.push_back(comment.text);
        }
        declaration.tokens = std::move(current_);
        found_.push_back(std::move(declaration));
        comments_.clear();
        current_.clear();
    }

    std::vector<Declaration> found_;
    std::vector<Token> comments_, current_;
    int depth_ = 0;
};

}  // namespace

std::vector<Declaration> declarations(const std::vector<Token>& tokens) {
    return Splitter().split(tokens);
}

std::vector<std::string> file_comment(const std::vector<Token>& tokens, const std::string& file) {
    std::vector<std::string> lines;
    for (const Token& token : tokens)
        if (token.file == file && token.kind == TokenKind::comment && token.line == lines.size() + 1)
            lines.push_back(token.text);
    return lines;
}

std::vector<Declaration> closure(const std::vector<Declaration>& all, const std::set<std::string>& names) {
    std::multimap<std::string, const Declaration*> by_name;
    for (const Declaration& declaration : all) by_name.emplace(declaration.name, &declaration);
    std::set<const Declaration*> needed;
    std::vector<std::string> open(names.begin(), names.end());
    while (!open.empty()) {
        const auto [first, last] = by_name.equal_range(open.back());
        open.pop_back();
        for (auto i = first; i != last; ++i) {
            if (!needed.insert(i->second).second) continue;
            for (const Token& token : i->second->tokens)
                if (token.kind == TokenKind::identifier) open.push_back(token.text);
        }
    }
    std::vector<Declaration> result;
    std::copy_if(all.begin(), all.end(), std::back_inserter(result),
                 [&](const Declaration& declaration) { return needed.contains(&declaration); });
    return result;
}

}  // namespace vndf::emit
