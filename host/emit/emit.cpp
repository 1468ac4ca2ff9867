#include "emit/emit.h"

#include <algorithm>
#include <regex>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "emit/layout.h"
#include "emit/prune.h"
#include "emit/selftest.h"
#include "effects.h"
#include "error.h"
#include "registry.h"
#include "text.h"

namespace vndf::emit {
namespace {

std::vector<std::string> all_names() {
    std::vector<std::string> names;
    for (const Function& function : functions()) names.push_back(function.name);
    for (const LobeFunction& lobe : lobe_functions()) names.push_back(lobe.name);
    for (const BsdfFunction& bsdf : bsdf_functions()) names.push_back(bsdf.name);
    return names;
}

// vndf_ and VNDF_ at the beginning of each name become the prefix.
std::string renamed(const std::string& text, const std::string& prefix) {
    static const std::regex lower("\\bvndf_(?=\\w)"), capitals("\\bVNDF_(?=\\w)");
    return std::regex_replace(std::regex_replace(text, lower, prefix), capitals, upper(prefix));
}

bool is_bsdf(const std::string& name) {
    return std::any_of(bsdf_functions().begin(), bsdf_functions().end(),
                       [&](const BsdfFunction& bsdf) { return bsdf.name == name; });
}

// The first function of a material, or the end.
auto material_of(const Options& options) {
    return std::find_if(options.functions.begin(), options.functions.end(), is_bsdf);
}

std::vector<std::string> macros(const Options& options) {
    std::vector<std::string> all = {fmt::format("VNDF_REAL={}", to_string(options.real)),
                                    fmt::format("VNDF_MATH={}", to_string(options.math)), "VNDF_FN=VNDF_FN",
                                    "VNDF_CONSTANT=VNDF_CONSTANT"};
    if (material_of(options) != options.functions.end())
        for (const std::string& effect :
             parse_effects(options.effects.empty() ? "all" : options.effects).macros())
            all.push_back(effect);
    switch (options.language) {
        case Language::opencl:
        case Language::string:
            all.push_back("__OPENCL_C_VERSION__=120");
            break;
        case Language::c:
            break;
        case Language::cuda:
            all.push_back("__CUDACC__=1");
            [[fallthrough]];
        case Language::cpp:
            all.push_back("__cplusplus=201103L");
            break;
    }
    return all;
}

// Its paragraphs as comments, each filled anew.
std::string commented(std::string_view text) {
    std::vector<std::string> paragraphs{"//"};
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        if (end == 0)
            paragraphs.insert(paragraphs.end(), {"//", "//"});
        else
            paragraphs.back() += fmt::format(" {}", text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return lay_out_comment(paragraphs, 0);
}

// Which program wrote it, and how.
std::string stamp(const Options& options) {
    std::string text =
        fmt::format("Made by clvndf {}: clvndf emit {}", CLVNDF_VERSION, fmt::join(options.functions, " "));
    const auto add = [&](std::string_view option, std::string_view value, std::string_view usual) {
        if (value != usual) text += fmt::format(" {} {}", option, value);
    };
    for (const auto& [name, language] : languages())
        if (language == options.language) add("--as", name, "opencl");
    add("--math", to_string(options.math), "strict");
    add("--real", to_string(options.real), "float");
    add("--prefix", options.prefix, "vndf_");
    add("--effects", options.effects, "");
    return options.selftest ? text + " --selftest" : text;
}

void require_language_with_policy(const Options& options) {
    if (options.math != runtime::Math::native) return;
    for (const auto& [name, language] : languages())
        if (language == options.language && name != "opencl" && name != "string")
            throw InputError(fmt::format(
                "--math native --as {}: native is OpenCL's alone; strict and builtin are allowed", name));
}

void require_material(const Options& options) {
    const auto material = material_of(options);
    const bool named = material != options.functions.end();
    if (!named && !options.effects.empty())
        throw InputError(fmt::format(
            "--effects {}: no function of a material (vndf_bsdf_sample, ...) is named", options.effects));
    if (named && options.selftest)
        throw InputError(fmt::format("--selftest: there are no known answers of {}", *material));
}

// What the user may want to know before the functions.
std::string introduction(const Options& options) {
    std::string out = "//\n" + commented(licence_files().at(0).text) + "//\n";
    out += commented(fmt::format(
        "wo, wi: view and light direction, wm: normal of the microfacet; unit vectors away from the surface, "
        "z along its normal. alpha: no perceptual roughness. u: uniform in [0, 1]. eps: {}. VNDF_FN may "
        "be set before.",
        options.real == runtime::Real::f32 ? "2^-24" : "2^-53"));
    return out;
}

// What is said of accuracy but means nothing here: that of internals, in units of impl/math.h, and of double in float.
std::vector<std::string> own_comments(const Declaration& declaration, runtime::Real real) {
    static const std::regex of_internal(" *Accuracy: .*"), of_double("; double [0-9., ]+\\.$");
    std::vector<std::string> lines;
    for (const std::string& line : declaration.comments) {
        if (!declaration.name.starts_with("vndf_impl_")) {
            lines.push_back(real == runtime::Real::f32 ? std::regex_replace(line, of_double, ".") : line);
        } else if (line.find("Accuracy: ") == line.npos) {
            lines.push_back(line);
        } else {
            lines.push_back(std::regex_replace(line, of_internal, ""));
            if (lines.back() == "//") lines.pop_back();
            break;
        }
    }
    return lines;
}

// What each language needs, and nothing else.
std::string prologue(const Options& options, bool copies_bits) {
    std::string out = "#ifndef VNDF_EMITTED_H\n#define VNDF_EMITTED_H\n\n";
    const auto function = [&](std::string_view words) {
        return fmt::format("#ifndef VNDF_FN\n#define VNDF_FN {}\n#endif\n", words);
    };
    switch (options.language) {
        case Language::opencl:
        case Language::string:
            // Fast math stays outside, as in vndf/impl/shim.h.
            out +=
                "#ifdef __x86_64__\n#pragma float_control(precise, on, push)\n#endif\n"
                "#pragma OPENCL FP_CONTRACT OFF\n";
            if (options.real == runtime::Real::f64)
                out +=
                    "#if defined(__OPENCL_C_VERSION__) && __OPENCL_C_VERSION__ < 120\n"
                    "#pragma OPENCL EXTENSION cl_khr_fp64 : enable\n#endif\n";
            return out + function("static inline __attribute__((always_inline, __unused__))");
        case Language::cuda:
            return out + function("static inline __host__ __device__ __attribute__((__unused__))");
        case Language::c:
        case Language::cpp:
            out += copies_bits ? "#include <math.h>\n#include <string.h>\n\n" : "#include <math.h>\n\n";
            out +=
                "#if defined(__FAST_MATH__) && !defined(VNDF_ALLOW_FAST_MATH)\n"
                "#error \"-ffast-math changes results; compile without it, or define "
                "VNDF_ALLOW_FAST_MATH\"\n#endif\n"
                "#if !defined(VNDF_FN) && defined(__GNUC__)\n"
                "#define VNDF_FN static inline __attribute__((__unused__))\n#endif\n";
            return out + function("static inline");
    }
    return out;
}

// How arrays are declared, where there are any.
std::string arrays(const Options& options, const std::string& body) {
    if (body.find("VNDF_CONSTANT ") == body.npos) return {};
    const bool opencl = options.language == Language::opencl || options.language == Language::string;
    return fmt::format("#ifndef VNDF_CONSTANT\n#define VNDF_CONSTANT {}\n#endif\n",
                       opencl                               ? "__constant"
                       : options.language == Language::cuda ? "static __device__ const"
                                                            : "static const");
}

std::string epilogue(const Options& options) {
    const bool opencl = options.language == Language::opencl || options.language == Language::string;
    return opencl ? "#pragma OPENCL FP_CONTRACT DEFAULT\n#ifdef __x86_64__\n#pragma "
                    "float_control(pop)\n#endif\n#endif\n"
                  : "#endif\n";
}

// As string literals of C and C++; beyond what compilers take of one (MSVC: 65535 characters) as an array of lines.
std::string as_string(const std::string& source, const Options& options) {
    std::string lines;
    const bool array = source.size() > 65000;
    std::string_view rest = source;
    while (!rest.empty()) {
        const std::size_t end = rest.find('\n');
        std::string line(rest.substr(0, end));
        line = std::regex_replace(line, std::regex(R"(["\\])"), "\\$&");
        lines += fmt::format("    \"{}\\n\"{}\n", line, array ? "," : "");
        rest.remove_prefix(end + 1);
    }
    lines.pop_back();
    if (lines.back() == ',') lines.pop_back();
    const std::string name = renamed("vndf_source", options.prefix);
    const std::string declaration =
        array ? "/* Lines, since compilers limit the length of one literal. */\n"
                "static const char* const " +
                    name + "[] = {\n" + lines + "\n};\n"
              // ISO C asks compilers for 4095 characters alone, of which GCC and clang warn under -pedantic.
              : "#ifdef __GNUC__\n#pragma GCC diagnostic push\n"
                "#pragma GCC diagnostic ignored \"-Woverlength-strings\"\n#endif\n"
                "static const char " +
                    name + "[] =\n" + lines + ";\n#ifdef __GNUC__\n#pragma GCC diagnostic pop\n#endif\n";
    const std::string guard = renamed("VNDF_SOURCE_H", options.prefix);
    return commented(stamp(options)) + fmt::format("#ifndef {0}\n#define {0}\n\n", guard) + declaration +
           "\n#endif\n";
}

// The structs that are users': those of materials, and of lobes of which no function is asked for that would read them.
std::set<std::string> structs_of_users(const Options& options, const std::vector<Declaration>& all) {
    std::set<std::string> structs{"vndf_bsdf", "vndf_bsdf_value", "vndf_bsdf_direction", "vndf_rgb"};
    const auto reads = [](const std::string& name) { return find_function(name) || is_bsdf(name); };
    if (std::any_of(options.functions.begin(), options.functions.end(), reads)) return structs;
    for (const Declaration& declaration : all)
        if (declaration.tokens[0].text == "struct") structs.insert(declaration.name);
    return structs;
}

}  // namespace

const std::map<std::string, Language>& languages() {
    static const std::map<std::string, Language> all = {{"opencl", Language::opencl},
                                                        {"c", Language::c},
                                                        {"c++", Language::cpp},
                                                        {"cuda", Language::cuda},
                                                        {"string", Language::string}};
    return all;
}

std::string resolve(const std::string& name) {
    const std::vector<std::string> all = all_names();
    for (const std::string& full : all)
        if (full == name || full == "vndf_" + name) return full;
    std::vector<std::string> found;
    for (const std::string& full : all)
        if (full.find(name) != full.npos) found.push_back(full);
    if (found.size() == 1) return found[0];
    if (found.empty())
        throw InputError(fmt::format("unknown function '{}'; the nearest names are {} (see clvndf list)",
                                     name, fmt::join(nearest_names(name), ", ")));
    const std::size_t count = found.size();
    found.resize(std::min<std::size_t>(count, 3));
    throw InputError(
        fmt::format("'{}' is ambiguous: {} functions have it in their names, among them {} (see clvndf list)",
                    name, count, fmt::join(found, ", ")));
}

void require_prefix(const std::string& prefix) {
    static const std::regex name("[A-Za-z_][A-Za-z0-9_]*");
    if (prefix.size() > 64 || !std::regex_match(prefix, name))
        throw InputError(
            fmt::format("--prefix '{}': no beginning of a name (letters, digits and _, at most 64)", prefix));
    // What OpenCL and C keep for themselves, and begins like names of ours with that prefix.
    static const std::regex reserved(
        "_.*|.*__.*|(as|convert|make|native|half|get|async|atomic|read|write|sub_group|work_group|intel|amd|"
        "cl|gl|"
        "to|is|str|mem|wcs)_"
        "|cl|gl|vload|vstore|E|is|to|str|mem|wcs");
    if (std::regex_match(prefix, reserved))
        throw InputError(
            fmt::format("--prefix '{}': names that begin so belong to C, C++ or OpenCL", prefix));
}

std::string emit(const Options& options) {
    runtime::require_policy(options.math, options.real);
    require_language_with_policy(options);
    require_prefix(options.prefix);
    require_material(options);
    std::string source = runtime::assemble("kernels/vndf/vndf.h");
    if (material_of(options) != options.functions.end()) source += runtime::assemble("kernels/vndf/bsdf.h");
    const std::vector<Token> tokens = preprocess(source, macros(options));
    std::set<std::string> names(options.functions.begin(), options.functions.end());
    if (options.selftest) names.merge(selftest_needs(options));
    const std::vector<Declaration> needed = closure(declarations(tokens), names);
    std::vector<Declaration> chosen = pruned(needed, names, structs_of_users(options, needed));
    std::set<std::string> files;  // whose head is kept: of those with a function asked for
    for (const Declaration& declaration : chosen)
        if (names.contains(declaration.name)) files.insert(declaration.file);
    std::string body;
    for (Declaration& declaration : chosen) {
        declaration.comments = own_comments(declaration, options.real);
        if (files.erase(declaration.file))
            body += lay_out_comment(file_comment(tokens, declaration.file), 0) + '\n';
        body += lay_out(declaration) + '\n';
    }
    if (options.selftest) body += selftest(options) + '\n';
    const bool copies_bits = body.find("memcpy(") != body.npos;
    const std::string rest = introduction(options) + prologue(options, copies_bits) + arrays(options, body) +
                             '\n' + body + epilogue(options);
    const std::string text = commented(stamp(options)) + renamed(rest, options.prefix);
    return options.language == Language::string ? as_string(text, options) : text;
}

}  // namespace vndf::emit
