#include "emit/prune.h"

#include <algorithm>

#include "emit/tokens.h"

namespace vndf::emit {
namespace {

bool is_struct(const Declaration& declaration) {
    return is(declaration.tokens[0], "struct");
}
bool is_function(const Declaration& declaration) {
    return is(declaration.tokens[0], "VNDF_FN");
}

std::size_t position(const Tokens& tokens, std::string_view text) {
    return std::find_if(tokens.begin(), tokens.end(), [&](const Token& token) { return is(token, text); }) -
           tokens.begin();
}

// The tokens from `begin` to the semicolon, `end`: comments before it apart.
struct Statement {
    std::size_t begin, end;
};

std::vector<Statement> statements(const Tokens& tokens) {
    std::vector<Statement> all;
    std::size_t i = position(tokens, "{") + 1;
    while (i < tokens.size()) {
        while (i < tokens.size() &&
               (tokens[i].kind == TokenKind::comment || tokens[i].kind == TokenKind::newline))
            ++i;
        const std::size_t end = find_outside(tokens, i, {";"});
        if (end >= tokens.size() || !is(tokens[end], ";")) break;
        all.push_back({i, end});
        i = end + 1;
    }
    return all;
}

// Erases it with the comments on its line and on the lines right before it.
void erase(Tokens& tokens, Statement statement) {
    std::size_t begin = statement.begin, end = statement.end + 1;
    if (end < tokens.size() && tokens[end].kind == TokenKind::comment) ++end;
    while (tokens[begin - 1].kind == TokenKind::newline || tokens[begin - 1].kind == TokenKind::comment) {
        if (tokens[begin - 1].kind == TokenKind::comment && tokens[begin - 2].kind != TokenKind::newline)
            break;
        --begin;
    }
    tokens.erase(tokens.begin() + begin, tokens.begin() + end);
}

// What a declaration statement declares: each name up to its comma or the semicolon; nothing if it is none.
struct Declarator {
    std::string name;
    std::size_t begin, end;
};

std::vector<Declarator> declarators(const Tokens& tokens, Statement statement) {
    std::vector<Declarator> all;
    std::size_t i = statement.begin + (is(tokens[statement.begin], "struct") ? 2 : 1);
    if (is(tokens[i - 1], "return") || tokens[i - 1].kind != TokenKind::identifier ||
        tokens[i].kind != TokenKind::identifier)
        return all;
    if (is(tokens[i], "long")) ++i;  // long long
    while (i < statement.end) {
        while (tokens[i].kind != TokenKind::identifier) ++i;
        const std::size_t end = find_outside(tokens, i, {",", ";"});
        all.push_back({tokens[i].text, i, end});
        i = end + 1;
    }
    return all;
}

// Erases those declarators of a statement, or all of it.
void erase(Tokens& tokens, Statement statement, const std::vector<Declarator>& all,
           const std::set<std::string>& unused) {
    const auto gone = [&](const Declarator& d) { return unused.contains(d.name); };
    if (std::all_of(all.begin(), all.end(), gone)) return erase(tokens, statement);
    Tokens kept;
    for (const Declarator& d : all) {
        if (gone(d)) continue;
        if (!kept.empty()) kept.push_back({TokenKind::punctuation, ",", "", 0});
        kept.insert(kept.end(), tokens.begin() + d.begin, tokens.begin() + d.end);
    }
    tokens.erase(tokens.begin() + all[0].begin, tokens.begin() + statement.end);
    tokens.insert(tokens.begin() + all[0].begin, kept.begin(), kept.end());
}

// a.b = c.d = value: the members that a statement only stores to, and where the value begins.
struct Stores {
    std::vector<std::string> members;
    std::size_t value;
};

Stores stores(const Tokens& tokens, Statement statement) {
    Stores found{{}, statement.begin};
    for (std::size_t& i = found.value;
         i + 3 < statement.end && is(tokens[i + 1], ".") && is(tokens[i + 3], "="); i += 4)
        found.members.push_back(tokens[i + 2].text);
    return found;
}

void add_members_read(const Tokens& tokens, std::size_t begin, std::size_t end, std::set<std::string>& read) {
    for (std::size_t i = begin; i + 1 < end; ++i)
        if (is(tokens[i], ".")) read.insert(tokens[i + 1].text);
}

// The members of which something that is returned depends, and those of these structs.
std::set<std::string> members_read(const std::vector<Declaration>& all,
                                   const std::set<std::string>& structs) {
    std::set<std::string> read;
    for (const Declaration& declaration : all)
        if (is_struct(declaration) && structs.contains(declaration.name))
            for (const Statement& statement : statements(declaration.tokens))
                for (const Declarator& d : declarators(declaration.tokens, statement)) read.insert(d.name);
    for (std::size_t before = 0; read.empty() || before != read.size();) {
        before = read.size();
        for (const Declaration& function : all) {
            if (!is_function(function)) continue;
            for (const Statement& statement : statements(function.tokens)) {
                const Stores s = stores(function.tokens, statement);
                const bool idle =
                    !s.members.empty() && std::none_of(s.members.begin(), s.members.end(),
                                                       [&](auto& m) { return read.contains(m); });
                if (!idle) add_members_read(function.tokens, s.value, statement.end, read);
            }
        }
        if (read.empty()) break;
    }
    return read;
}

bool drop_stores(Tokens& tokens, const std::set<std::string>& read) {
    bool changed = false;
    std::vector<Statement> all = statements(tokens);
    for (std::size_t k = all.size(); k-- > 0;) {
        const Stores s = stores(tokens, all[k]);
        std::size_t idle = 0;
        for (const std::string& member : s.members) idle += !read.contains(member);
        if (idle == 0) continue;
        changed = true;
        if (idle == s.members.size()) {
            erase(tokens, all[k]);
            continue;
        }
        for (std::size_t m = s.members.size(); m-- > 0;)
            if (!read.contains(s.members[m]))
                tokens.erase(tokens.begin() + all[k].begin + 4 * m,
                             tokens.begin() + all[k].begin + 4 * m + 4);
    }
    return changed;
}

bool drop_members(Tokens& tokens, const std::set<std::string>& read) {
    const std::vector<Statement> all = statements(tokens);
    std::set<std::string> unused;
    std::size_t kept = 0;
    for (const Statement& statement : all)
        for (const Declarator& d : declarators(tokens, statement))
            read.contains(d.name) ? void(++kept) : void(unused.insert(d.name));
    if (unused.empty() || kept == 0) return false;
    for (std::size_t k = all.size(); k-- > 0;) erase(tokens, all[k], declarators(tokens, all[k]), unused);
    return true;
}

// How often a local name is used: not as a member.
std::size_t uses(const Tokens& tokens, const std::string& name) {
    std::size_t count = 0;
    for (std::size_t i = 1; i < tokens.size(); ++i)
        count += tokens[i].kind == TokenKind::identifier && tokens[i].text == name && !is(tokens[i - 1], ".");
    return count;
}

bool drop_locals(Tokens& tokens) {
    const std::vector<Statement> all = statements(tokens);
    for (std::size_t k = all.size(); k-- > 0;) {
        std::set<std::string> unused;
        const std::vector<Declarator> found = declarators(tokens, all[k]);
        for (const Declarator& d : found)
            if (uses(tokens, d.name) == 1) unused.insert(d.name);
        if (unused.empty()) continue;
        erase(tokens, all[k], found, unused);
        return true;
    }
    return false;
}

// The arguments or parameters of the bracket that opens at i: where each begins, and the bracket's end.
std::vector<std::size_t> arguments(const Tokens& tokens, std::size_t i) {
    std::vector<std::size_t> begins;
    const std::size_t end = closing(tokens, i);
    for (++i; i < end; i = find_outside(tokens, i, {","}) + 1) begins.push_back(i);
    begins.push_back(end + 1);
    return begins;
}

void drop_argument(Tokens& tokens, std::size_t open, std::size_t index) {
    const std::vector<std::size_t> begins = arguments(tokens, open);
    const bool last = index + 2 == begins.size();
    const std::size_t end = last ? begins[index + 1] - 1 : begins[index + 1];
    tokens.erase(tokens.begin() + begins[index] - (last && index > 0), tokens.begin() + end);
}

// The index of a parameter that nothing uses, or -1.
int unused_parameter(const Tokens& tokens) {
    const std::size_t open = position(tokens, "(");
    const std::vector<std::size_t> begins = arguments(tokens, open);
    for (std::size_t k = 0; k + 1 < begins.size(); ++k)
        if (uses(tokens, tokens[begins[k + 1] - 2].text) == 1) return static_cast<int>(k);
    return -1;
}

bool drop_parameter(std::vector<Declaration>& all, Declaration& function) {
    const int index = unused_parameter(function.tokens);
    if (index < 0) return false;
    for (Declaration& caller : all)
        for (std::size_t i = 0; i + 1 < caller.tokens.size(); ++i)
            if (is(caller.tokens[i], function.name) && is(caller.tokens[i + 1], "("))
                drop_argument(caller.tokens, i + 1, static_cast<std::size_t>(index));
    return true;
}

}  // namespace

std::vector<Declaration> pruned(std::vector<Declaration> all, const std::set<std::string>& names,
                                const std::set<std::string>& structs) {
    for (bool changed = true; changed;) {
        changed = false;
        const std::set<std::string> read = members_read(all, structs);
        for (Declaration& declaration : all) {
            if (is_struct(declaration)) changed |= drop_members(declaration.tokens, read);
            if (!is_function(declaration)) continue;
            changed |= drop_stores(declaration.tokens, read);
            while (drop_locals(declaration.tokens)) changed = true;
            if (!names.contains(declaration.name))
                while (drop_parameter(all, declaration)) changed = true;
        }
        all = closure(all, names);
    }
    return all;
}

}  // namespace vndf::emit
