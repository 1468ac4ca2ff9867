#include "emit/preprocess.h"

#include <cctype>
#include <regex>
#include <stdexcept>

#include <boost/wave.hpp>
#include <boost/wave/cpplexer/cpp_lex_iterator.hpp>
#include <boost/wave/cpplexer/cpp_lex_token.hpp>

namespace vndf::emit {
namespace {

using WaveToken = boost::wave::cpplexer::lex_token<>;

using Lexer = boost::wave::cpplexer::lex_iterator<WaveToken>;
using Context = boost::wave::context<std::string::const_iterator, Lexer,
                                     boost::wave::iteration_context_policies::load_file_to_string,
                                     boost::wave::context_policies::eat_whitespace<WaveToken>>;

// Appends what a token is to us: blanks are nothing, a comment of a line ends with that line.
void append(std::vector<Token>& tokens, const WaveToken& token) {
    using namespace boost::wave;
    const token_id id = token;
    const std::string text(token.get_value().c_str());
    const std::string file(token.get_position().get_file().c_str());
    const auto has = [&](token_category category) {  // IS_CATEGORY, which clang++ warns of
        return ((unsigned(id) ^ unsigned(category)) & TokenTypeMask) == 0;
    };
    const auto add = [&](TokenKind kind, std::string value) {
        tokens.push_back({kind, std::move(value), file, token.get_position().get_line()});
    };
    if (id == T_CPPCOMMENT) {
        add(TokenKind::comment, text.substr(0, text.find_last_not_of(" \n") + 1));
        add(TokenKind::newline, "\n");
    } else if (id == T_NEWLINE || id == T_GENERATEDNEWLINE) {
        add(TokenKind::newline, "\n");
    } else if (id == T_IDENTIFIER || has(KeywordTokenType)) {
        add(TokenKind::identifier, text);
    } else if (!text.empty() && std::isdigit(static_cast<unsigned char>(text[0]))) {
        add(TokenKind::number, text);
    } else if (!has(WhiteSpaceTokenType) && id != T_EOF && id != T_PLACEHOLDER) {
        add(TokenKind::punctuation, text);
    }
}

}  // namespace

std::vector<Token> preprocess(std::string_view source, const std::vector<std::string>& macros) {
    // The headers of the language are the reader's.
    static const std::regex include("#include <[^>\n]*>");
    const std::string text = std::regex_replace(std::string(source), include, "");
    std::vector<Token> tokens;
    try {
        using namespace boost::wave;
        Context context(text.begin(), text.end(), "kernels");
        context.set_language(language_support((support_c99 | support_option_preserve_comments) &
                                              ~support_option_emit_line_directives));
        for (const std::string& macro : macros) context.add_macro_definition(macro, true);
        bool pragma = false;
        for (auto token = context.begin(); token != context.end(); ++token) {
            if (token_id(*token) == T_PP_PRAGMA) pragma = true;
            if (token_id(*token) == T_NEWLINE) pragma = false;
            if (!pragma) append(tokens, *token);
        }
    } catch (const boost::wave::preprocess_exception& error) {
        throw std::logic_error(std::string(error.file_name()) + ":" + std::to_string(error.line_no()) + ": " +
                               error.description());
    }
    return tokens;
}

}  // namespace vndf::emit
