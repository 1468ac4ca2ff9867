// One self-contained source file with the functions asked for and what they use.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "runtime/evaluator.h"
#include "runtime/sources.h"

namespace vndf::emit {

enum class Language { opencl, c, cpp, cuda, string };

struct Options {
    std::vector<std::string> functions;  // full names, of registered functions, lobes or materials
    Language language = Language::opencl;
    runtime::Math math = runtime::Math::strict;
    runtime::Real real = runtime::Real::f32;
    std::string prefix = "vndf_";
    std::string effects;  // of a material, as parse_effects takes them (effects.h); "": all
    bool selftest = false;
};

// The languages by the names that users know them by.
const std::map<std::string, Language>& languages();

// The full name of the one function that `name` stands for: its name with or without vndf_, or a part that no other function
// has. Throws InputError if there is none, or several.
std::string resolve(const std::string& name);

// Throws InputError if names that begin so would not be names, or would be those of a language.
void require_prefix(const std::string& prefix);

// The text of the file; the same for the same options. Throws InputError if they contradict each other.
std::string emit(const Options& options);

// The project's licence, as one file.
const std::vector<runtime::SourceFile>& licence_files();

}  // namespace vndf::emit
