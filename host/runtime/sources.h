// The kernel sources, embedded in the binary, and their assembly into one translation unit.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "runtime/evaluator.h"

namespace vndf::runtime {

struct SourceFile {
    std::string_view path;  // from the project's root: "kernels/vndf/ggx.h"
    std::string_view text;
};

// Every file below kernels/ that a program may need, and the headers of Random123 ("Random123/philox.h").
const std::vector<SourceFile>& embedded_sources();

// A seeded mistake, for tests: in `file` the one occurrence of `old_text`, within a line, becomes `new_text`
// where VNDF_MUTANT is `id`. The assembled source holds both forms.
struct Substitution {
    std::string file;
    std::string old_text;
    std::string new_text;
    int id = 0;
};

// The names in quotes that a file includes.
std::vector<std::string> quoted_includes(std::string_view text);

// What assemble() changes on the way.
struct Assembly {
    std::vector<std::string> functions;  // registered names kept in registry.def; empty: all
    std::vector<Substitution> substitutions;
};

// The file at `path` with every include resolved (in quotes relative to the including file, or from the root), once for
// a file with an include guard. #line directives keep the compiler's messages at "kernels/vndf/ggx.h:41", so
// that a program needs no include path. Includes that no embedded file answers stay as they are. Throws
// DeviceError if a path is unknown, or if a substitution's text is not found exactly once.
std::string assemble(std::string_view path, const Assembly& assembly = {},
                     const std::vector<SourceFile>& files = embedded_sources());

// How float quotients and roots are rounded: correctly by a device that does so on request; correctly by our own code, which
// double and the policy native do not need; or as the device pleases, for builds that do without.
enum class Division { hardware, software, loose };

// The build options of a policy, for a device with a hardware fma or without. clvndf/sources.h has the same for users.
std::string build_options(Math math, Real real, bool fma, Division division);

}  // namespace vndf::runtime
