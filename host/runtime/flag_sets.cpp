#include "runtime/flag_sets.h"

#include <algorithm>
#include <set>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "error.h"
#include "text.h"

namespace vndf::runtime {
namespace {

std::vector<std::string> words(const std::string& text) {
    std::istringstream stream(text);
    std::vector<std::string> all;
    for (std::string word; stream >> word;) all.push_back(word);
    return all;
}

// The flags that a word of a set stands for.
std::string flags_of(const std::string& word) {
    for (const FlagSet& set : renderer_flags())
        if (set.name == word) return set.flags;
    const std::vector<std::string>& flags = loosening_flags();
    if (word.starts_with("-D") && word.size() > 2) return word;
    if (std::find(flags.begin(), flags.end(), word) != flags.end()) return word;
    std::vector<std::string> names;
    for (const FlagSet& set : renderer_flags()) names.push_back(set.name);
    throw InputError(fmt::format("--flags: unknown '{}'; allowed are {}, renderers, pairs, {}, -D...", word,
                                 fmt::join(names, ", "), fmt::join(flags, ", ")));
}

}  // namespace

const std::vector<FlagSet>& renderer_flags() {
    static const std::vector<FlagSet> sets = {
        {"luxcore", "-cl-fast-relaxed-math -cl-mad-enable"},
        {"baikal", "-cl-mad-enable -cl-fast-relaxed-math"},
        {"fluctus", "-cl-denorms-are-zero -cl-fast-relaxed-math"},
        {"cycles", "-cl-fast-relaxed-math"},
        {"hydracore",
         "-cl-mad-enable -cl-no-signed-zeros -cl-single-precision-constant -cl-denorms-are-zero"}};
    return sets;
}

std::vector<FlagSet> distinct(const std::vector<FlagSet>& sets) {
    std::vector<FlagSet> some;
    std::set<std::set<std::string>> seen;
    for (const FlagSet& set : sets) {
        const std::vector<std::string> flags = words(set.flags);
        if (seen.insert({flags.begin(), flags.end()}).second) some.push_back(set);
    }
    return some;
}

const std::vector<std::string>& loosening_flags() {
    static const std::vector<std::string> flags = {
        "-cl-fast-relaxed-math",         "-cl-mad-enable",       "-cl-no-signed-zeros",
        "-cl-unsafe-math-optimizations", "-cl-finite-math-only", "-cl-denorms-are-zero",
        "-cl-single-precision-constant"};
    return flags;
}

std::vector<FlagSet> flag_pairs() {
    std::vector<FlagSet> pairs;
    const std::vector<std::string>& flags = loosening_flags();
    for (std::size_t i = 0; i < flags.size(); ++i) {
        pairs.push_back({flags[i], flags[i]});
        for (std::size_t k = i + 1; k < flags.size(); ++k) {
            const std::string both = flags[i] + ' ' + flags[k];
            pairs.push_back({both, both});
        }
    }
    return pairs;
}

std::vector<FlagSet> parse_flag_sets(std::string_view text) {
    std::vector<FlagSet> sets;
    for (const std::string& part : split(text, ',')) {
        const std::vector<std::string> parts = words(part);
        if (parts.empty()) throw InputError(fmt::format("--flags: an empty set in '{}'", text));
        if (parts.size() == 1 && (parts[0] == "renderers" || parts[0] == "pairs")) {
            const std::vector<FlagSet> more = parts[0] == "pairs" ? flag_pairs() : renderer_flags();
            sets.insert(sets.end(), more.begin(), more.end());
            continue;
        }
        std::vector<std::string> flags;
        for (const std::string& word : parts) flags.push_back(flags_of(word));
        sets.push_back({fmt::format("{}", fmt::join(parts, " ")), fmt::format("{}", fmt::join(flags, " "))});
    }
    return sets;
}

}  // namespace vndf::runtime
