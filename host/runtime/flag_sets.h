// OpenCL's build options that loosen arithmetic, alone and as renderers combine them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace vndf::runtime {

struct FlagSet {
    std::string name;   // "luxcore"; of an unnamed set its flags
    std::string flags;  // "-cl-fast-relaxed-math -cl-mad-enable"
};

// What renderers build everything with.
const std::vector<FlagSet>& renderer_flags();

// Of sets with the same flags, in whatever order, the first: what is worth a build of its own.
std::vector<FlagSet> distinct(const std::vector<FlagSet>& sets);

// The options themselves.
const std::vector<std::string>& loosening_flags();

// Each of them, and each two together.
std::vector<FlagSet> flag_pairs();

// The sets that `text` names, with commas between them: a renderer, flags, macros (-D...), or several of these with spaces
// between them ("luxcore -cl-denorms-are-zero"); "renderers" and "pairs" stand for all of theirs. Throws InputError at
// anything else.
std::vector<FlagSet> parse_flag_sets(std::string_view text);

}  // namespace vndf::runtime
