#include "emit/layout.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>

#include "emit/tokens.h"

namespace vndf::emit {
namespace {

// Takes off the parentheses of macros that nothing needs: f((x)), a = (x);
void drop_parentheses(Tokens& tokens) {
    for (std::size_t i = 1; i < tokens.size(); ++i) {
        while (tokens[i].text == "(" && one_of(tokens[i - 1], {"(", ",", "=", "return", "?", ":"})) {
            const std::size_t end = closing(tokens, i);
            if (end + 1 >= tokens.size() || !one_of(tokens[end + 1], {")", ",", ";", ":"})) break;
            if (tokens[find_outside(tokens, i + 1, {",", "?"})].text != ")") break;
            tokens.erase(tokens.begin() + end);
            tokens.erase(tokens.begin() + i);
        }
    }
}

// The two signs of -constant where the constant is negative.
void drop_double_signs(Tokens& tokens) {
    for (std::size_t i = 1; i + 1 < tokens.size(); ++i)
        if (is(tokens[i], "-") && is(tokens[i + 1], "-") &&
            one_of(tokens[i - 1], {"(", ",", "=", "return", "?", ":"}))
            tokens.erase(tokens.begin() + i, tokens.begin() + i + 2);
}

// 1 ? a : b, which the type decides, becomes a.
void drop_choices(Tokens& tokens) {
    for (std::size_t i = 1; i + 1 < tokens.size(); ++i) {
        if (tokens[i + 1].text != "?" || !one_of(tokens[i], {"0", "1"})) continue;
        if (!one_of(tokens[i - 1], {"(", ",", "="})) continue;
        const std::size_t colon = find_outside(tokens, i + 2, {":"});
        const std::size_t end = find_outside(tokens, colon + 1, {",", ";"});
        if (tokens[i].text == "1") {
            tokens.erase(tokens.begin() + colon, tokens.begin() + end);
            tokens.erase(tokens.begin() + i, tokens.begin() + i + 2);
        } else {
            tokens.erase(tokens.begin() + i, tokens.begin() + colon + 1);
        }
    }
}

// The fewest digits that still mean the same number.
template <typename Real>
std::string shortest(const std::string& text, std::string_view suffix) {
    Real value = 0;
    std::from_chars(text.data(), text.data() + text.size(), value);
    std::array<char, 32> digits;
    std::string out(digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr);
    if (out.find_first_of(".e") == out.npos) out += ".0";
    out += suffix;
    return out.size() < text.size() ? out : text;
}
void shorten_numbers(Tokens& tokens) {
    for (Token& token : tokens) {
        if (token.kind != TokenKind::number || token.text.starts_with("0x")) continue;
        if (token.text.ends_with("f"))
            token.text = shortest<float>(token.text, "f");
        else if (token.text.find('.') != token.text.npos)
            token.text = shortest<double>(token.text, "");
    }
}

class Printer {
  public:
    std::string print(const Tokens& tokens) {
        for (std::size_t i = 0; i < tokens.size(); ++i) {
            const Token& token = tokens[i];
            if (token.kind == TokenKind::comment && i > 0 && tokens[i - 1].kind != TokenKind::newline) {
                trailing(token.text);
            } else if (token.kind == TokenKind::comment) {
                std::vector<std::string> lines{token.text};
                for (; i + 2 < tokens.size() && tokens[i + 1].kind == TokenKind::newline &&
                       tokens[i + 2].kind == TokenKind::comment;
                     i += 2)
                    lines.push_back(tokens[i + 2].text);
                comment(lines);
            } else if (token.kind != TokenKind::newline) {
                word(token);
            }
        }
        flush();
        return std::move(out_);
    }

  private:
    struct Word {
        std::string text;
        bool space;  // before it
        int depth;   // of brackets
    };

    // On lines of their own.
    void comment(std::vector<std::string> lines) {
        std::erase_if(lines, [](const auto& line) { return line.find("clang-format") != line.npos; });
        (line_.empty() ? out_ : held_) += lay_out_comment(lines, indent_);
    }

    // Behind what is on the line, or before it where it has no room there.
    void trailing(const std::string& text) {
        if (!line_.empty() || out_.empty()) return comment({text});
        const std::size_t begin = out_.rfind('\n', out_.size() - 2) + 1;
        if (out_.size() - begin + text.size() + 1 <= line_length)
            out_.insert(out_.size() - 1, "  " + text);
        else
            out_.insert(begin, lay_out_comment({text}, indent_));
    }

    void word(const Token& token) {
        const bool values = before_ && before_->text == "=";  // of an array
        const bool block = token.text == "{" && brackets_ == 0 && blocks_ == 0 && !values;
        const bool end = token.text == "}" && brackets_ == 0;
        if (end) {
            flush();
            --blocks_;
            indent_ -= 4;
        }
        if (closes(token) && !end) --brackets_;
        line_.push_back({token.text, !line_.empty() && spaced(token, block), brackets_});
        if (opens(token) && !block) ++brackets_;
        remember(token);
        if (block) {
            flush();
            ++blocks_;
            indent_ += 4;
        } else if (brackets_ == 0 && token.text == ";") {
            flush();
        }
    }

    // Whether the next token is one of two operands' operator.
    bool operand_before() const {
        return before_ &&
               (before_->kind == TokenKind::number || before_->text == ")" || before_->text == "]" ||
                (before_->kind == TokenKind::identifier && before_->text != "return"));
    }

    void remember(const Token& token) {
        unary_ = token.kind == TokenKind::punctuation && one_of(token, {"-", "+", "!", "~", "&", "*"}) &&
                 !operand_before();
        before_ = token;
    }

    bool spaced(const Token& token, bool block) const {
        const std::string &last = before_->text, &next = token.text;
        if (block) return true;
        if (unary_ || one_of(*before_, {"(", "[", "{", "."}) || one_of(token, {")", "]", "}", ",", ";", "."}))
            return false;
        if (next == "{" || next == "[") return last == "=";
        if (next == "(") return !(before_->kind == TokenKind::identifier && last != "return") && last != ")";
        if (last == ")" && (token.kind == TokenKind::identifier || token.kind == TokenKind::number))
            return false;
        return true;
    }

    // Ends the statement: breaks it where the fewest brackets are open.
    void flush() {
        if (line_.empty()) return;
        out_ += held_;
        held_.clear();
        std::size_t begin = 0, indent = indent_;
        while (begin < line_.size()) {
            const std::size_t end = line_end(begin, indent);
            out_.append(indent, ' ');
            for (std::size_t i = begin; i < end; ++i) {
                if (line_[i].space && i != begin) out_ += ' ';
                out_ += line_[i].text;
            }
            out_ += '\n';
            begin = end;
            indent = indent_ + 4;
        }
        line_.clear();
    }

    // How bad a break before this word is: within brackets, not behind a comma, before a function's name.
    int rank(std::size_t i) const {
        const bool head = line_.back().text == "{" && line_[i].depth == 0;
        return 2 * line_[i].depth + (line_[i - 1].text != "," && line_[i - 1].text != "=") + (head ? 100 : 0);
    }

    std::size_t line_end(std::size_t begin, std::size_t indent) const {
        std::size_t width = indent, best = 0;
        for (std::size_t i = begin; i < line_.size(); ++i) {
            width += line_[i].text.size() + (line_[i].space && i != begin);
            if (width > line_length && best != 0) return best;
            const std::size_t next = i + 1;
            if (next == line_.size() || !line_[next].space) continue;
            if (best == 0 || width < line_length / 2 || rank(next) <= rank(best)) best = next;
        }
        return line_.size();
    }

    std::string out_, held_;
    std::vector<Word> line_;
    std::optional<Token> before_;
    bool unary_ = false;
    int brackets_ = 0, blocks_ = 0;
    std::size_t indent_ = 0;
};

}  // namespace

std::string lay_out_comment(const std::vector<std::string>& lines, std::size_t indent) {
    const std::size_t limit = line_length - indent;
    std::string out, rest;  // what the line before had too much
    const auto margin = [](const std::string& line) {
        return std::min(line.find_first_not_of("/ "), line.size());
    };
    for (std::size_t i = 0; i < lines.size() || !rest.empty(); ++i) {
        std::string line = i < lines.size() ? lines[i] : "";
        if (!rest.empty()) {
            const bool goes_on = margin(line) == margin(rest) && line.size() > margin(line);
            if (!goes_on) --i;
            line = goes_on ? rest + line.substr(margin(line) - 1) : rest;
            rest.clear();
        }
        if (const std::size_t at = line.rfind(' ', limit);
            line.size() > limit && at != line.npos && at > margin(line)) {
            rest = line.substr(0, margin(line)) + line.substr(at + 1);
            line.resize(at);
        }
        out += std::string(indent, ' ') + line + '\n';
        if (i + 1 == lines.size() && rest.empty()) break;
    }
    return out;
}

std::string lay_out(const Declaration& declaration) {
    Tokens tokens = declaration.tokens;
    drop_parentheses(tokens);
    drop_choices(tokens);
    drop_double_signs(tokens);
    shorten_numbers(tokens);
    return lay_out_comment(declaration.comments, 0) + Printer().print(tokens);
}

}  // namespace vndf::emit
