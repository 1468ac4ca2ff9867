#include "runtime/sources.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <regex>
#include <set>

#include <fmt/format.h>

#include "error.h"

namespace vndf::runtime {
namespace {

constexpr std::string_view registry_path = "kernels/registry.def";

std::vector<std::string> split_lines(std::string_view text) {
    std::vector<std::string> lines;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        lines.emplace_back(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return lines;
}

// The word after '#': "include", "ifndef" ...; empty if the line is no directive.
std::string_view directive(std::string_view line) {
    constexpr std::string_view blank = " \t";
    const std::size_t hash = line.find_first_not_of(blank);
    if (hash == line.npos || line[hash] != '#') return {};
    const std::size_t begin = std::min(line.find_first_not_of(blank, hash + 1), line.size());
    const std::size_t end = line.find_first_of(" \t<\"(", begin);
    return line.substr(begin, end == line.npos ? end : end - begin);
}

const std::regex include(R"re(^\s*#\s*include\s*(["<])([^">]+)[">])re");

// Whether the first directive stands for a guard.
bool has_pragma_once(const std::vector<std::string>& lines) {
    const auto first = std::find_if(lines.begin(), lines.end(),
                                    [](const std::string& line) { return !directive(line).empty(); });
    return first != lines.end() && directive(*first) == "pragma" && first->find("once") != first->npos;
}

// Whether the first two directives are those of an include guard.
bool has_guard(const std::vector<std::string>& lines) {
    std::vector<std::string_view> words;
    for (const std::string& line : lines) {
        if (!directive(line).empty()) words.push_back(directive(line));
        if (words.size() == 2) return words[0] == "ifndef" && words[1] == "define";
    }
    return false;
}

// One place in a file with the seeded mistakes that change it.
struct Edit {
    std::size_t last_line = 0;
    std::vector<std::pair<int, std::string>> variants;  // VNDF_MUTANT, the lines instead
};
using Edits = std::map<std::size_t, Edit>;  // by first line

class Assembler {
  public:
    Assembler(const Assembly& assembly, const std::vector<SourceFile>& files) {
        for (const SourceFile& file : files) files_.emplace(file.path, file.text);
        for (const Substitution& s : assembly.substitutions) add_edit(s);
        for (std::string name : assembly.functions) kept_.insert(std::move(name));
    }

    std::string assemble(const std::string& path) {
        if (!files_.count(path)) throw DeviceError(fmt::format("no embedded source '{}'", path));
        append(path, false);
        return std::move(out_);
    }

  private:
    void add_edit(const Substitution& s) {
        const auto fail = [&](std::string_view why) {
            throw DeviceError(fmt::format("substitution {} in {}: {}: '{}'", s.id, s.file, why, s.old_text));
        };
        const auto file = files_.find(s.file);
        if (file == files_.end()) fail("no such embedded source");
        const std::string_view text = file->second;
        const std::size_t at = text.find(s.old_text);
        if (s.old_text.empty() || at == text.npos) fail("text not found");
        if (text.find(s.old_text, at + 1) != text.npos) fail("text found more than once");

        const auto line_begin = [&](std::size_t i) { return i == 0 ? 0 : text.rfind('\n', i - 1) + 1; };
        const auto line_end = [&](std::size_t i) { return std::min(text.find('\n', i), text.size()); };
        std::size_t begin = line_begin(at), end = line_end(at + s.old_text.size() - 1);
        // A directive cannot stand inside a macro's continued lines: all of them are repeated.
        while (begin >= 2 && text[begin - 2] == '\\') begin = line_begin(begin - 1);
        while (text[end - 1] == '\\' && end < text.size()) end = line_end(end + 1);
        const std::string_view block = text.substr(begin, end - begin);
        for (const std::string& line : split_lines(block)) {
            if (directive(line) == "include" || directive(line).substr(0, 2) == "if")
                fail("directive changed");
        }

        const std::size_t first_line = std::count(text.begin(), text.begin() + begin, '\n');
        const std::size_t last_line = first_line + std::count(block.begin(), block.end(), '\n');
        for (const auto& [first, edit] : edits_[s.file]) {
            const bool same = first == first_line && edit.last_line == last_line;
            if (!same && first <= last_line && first_line <= edit.last_line) fail("overlaps another one");
        }
        Edit& edit = edits_[s.file][first_line];
        edit.last_line = last_line;
        std::string changed(block);
        changed.replace(at - begin, s.old_text.size(), s.new_text);
        edit.variants.emplace_back(s.id, std::move(changed));
    }

    // `conditional`: the include stands inside an #if, so that a later one may still be needed.
    void append(const std::string& path, bool conditional) {
        const std::vector<std::string> lines = split_lines(files_.at(path));
        const bool by_macro = has_guard(lines), guarded = by_macro || has_pragma_once(lines);
        if (guarded && (done_.count(path) || std::count(open_.begin(), open_.end(), path))) return;
        if (open_.size() > 64) throw DeviceError(fmt::format("{} includes itself without end", path));
        open_.push_back(path);
        out_ += fmt::format("#line 1 \"{}\"\n", path);
        int depth = by_macro ? -1 : 0;  // of conditionals within this file, its guard apart
        for (std::size_t i = 0; i < lines.size(); ++i) {
            const std::string_view word = directive(lines[i]);
            depth += word.substr(0, 2) == "if";
            depth -= word == "endif";
            i = append_line(path, lines, i, conditional || depth > 0);
        }
        open_.pop_back();
        if (guarded && !conditional) done_.insert(path);
    }

    // Appends line i, or what stands for it, and returns the index of the last line dealt with.
    std::size_t append_line(const std::string& path, const std::vector<std::string>& lines, std::size_t i,
                            bool conditional) {
        if (const auto edit = edits_[path].find(i); edit != edits_[path].end()) {
            append_edit(path, lines, i, edit->second);
            return edit->second.last_line;
        }
        const std::string target = directive(lines[i]) == "include" ? resolve(path, lines[i]) : std::string();
        if (!target.empty()) {
            append(target, conditional);
            out_ += fmt::format("#line {} \"{}\"\n", i + 2, path);
        } else {
            out_ += path == registry_path && !kept(lines[i]) ? std::string() : lines[i];
            out_ += '\n';
        }
        return i;
    }

    void append_edit(const std::string& path, const std::vector<std::string>& lines, std::size_t i,
                     const Edit& edit) {
        const char* word = "if";
        for (const auto& [id, text] : edit.variants) {
            out_ += fmt::format("#{} VNDF_MUTANT == {}\n#line {} \"{}\"\n{}\n", word, id, i + 1, path, text);
            word = "elif";
        }
        out_ += fmt::format("#else\n#line {} \"{}\"\n", i + 1, path);
        for (std::size_t j = i; j <= edit.last_line; ++j) out_ += lines[j] + '\n';
        out_ += fmt::format("#endif\n#line {} \"{}\"\n", edit.last_line + 2, path);
    }

    // The embedded file that an include line names, or nothing.
    std::string resolve(const std::string& path, const std::string& line) const {
        std::smatch match;
        if (!std::regex_search(line, match, include)) return {};
        const std::filesystem::path name(match[2].str());
        const std::string beside =
            (std::filesystem::path(path).parent_path() / name).lexically_normal().generic_string();
        if (match[1] == "\"" && files_.count(beside)) return beside;
        return files_.count(name.generic_string()) ? name.generic_string() : std::string();
    }

    // Whether a line of the registry stays: all but the functions that nobody asked for.
    bool kept(const std::string& line) const {
        static const std::regex entry(R"re(^VNDF_(SAMPLER|DENSITY|TERM|INVERSE|GEOMETRY)\((\w+),)re");
        std::smatch match;
        if (kept_.empty() || !std::regex_search(line, match, entry)) return true;
        return kept_.count(match[2]) || kept_.count(match[2].str() + "_with_pdf");
    }

    std::map<std::string, std::string_view, std::less<>> files_;
    std::map<std::string, Edits> edits_;
    std::set<std::string> kept_;
    std::set<std::string> done_;
    std::vector<std::string> open_;
    std::string out_;
};

}  // namespace

std::vector<std::string> quoted_includes(std::string_view text) {
    std::vector<std::string> names;
    std::smatch match;
    for (const std::string& line : split_lines(text))
        if (std::regex_search(line, match, include) && match[1] == "\"") names.push_back(match[2]);
    return names;
}

std::string assemble(std::string_view path, const Assembly& assembly, const std::vector<SourceFile>& files) {
    return Assembler(assembly, files).assemble(std::string(path));
}

std::string build_options(Math math, Real real, bool fma, Division division) {
    const bool software = division == Division::software && real == Real::f32 && math != Math::native;
    return fmt::format("-DVNDF_REAL={} -DVNDF_MATH={}{}{}{}", to_string(real), to_string(math),
                       division == Division::hardware ? " -cl-fp32-correctly-rounded-divide-sqrt" : "",
                       fma ? "" : " -DVNDF_SOFTWARE_FMA=1", software ? " -DVNDF_SOFTWARE_DIVIDE=1" : "");
}

}  // namespace vndf::runtime
