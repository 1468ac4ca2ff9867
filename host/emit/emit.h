// One self-contained source file with the functions asked for and what they use.
#pragma once

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
    bool selftest = false;
    std::vector<std::string> effects;  // macros of a material's switches
    std::string stamp;                 // which program wrote it, and how
};

// Whether it is a function of a material, which has switches.
bool is_bsdf(const std::string& name);

// The full name of the one function that `name` stands for: its name with or without vndf_, or a part that no other function
// has. Throws InputError if there is none, or several.
std::string resolve(const std::string& name);

// Throws InputError if names that begin so would not be names, or would be those of a language.
void require_prefix(const std::string& prefix);

// The text of the file; the same for the same options.
std::string emit(const Options& options);

// The project's licence, as one file.
const std::vector<runtime::SourceFile>& licence_files();

}  // namespace vndf::emit
