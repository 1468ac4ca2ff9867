// clvndf emit
#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <vector>

#include <fmt/format.h>

#include "cli/commands.h"
#include "cli/output_file.h"
#include "emit/emit.h"
#include "effects.h"
#include "error.h"

namespace vndf::cli {
namespace {

struct Emit {
    std::vector<std::string> names;
    std::string effects, output = "-", as = "opencl", math = "strict", real = "float", prefix = "vndf_";
    bool selftest = false;
};

const std::map<std::string, emit::Language>& languages() {
    using emit::Language;
    static const std::map<std::string, Language> all = {{"opencl", Language::opencl},
                                                        {"c", Language::c},
                                                        {"c++", Language::cpp},
                                                        {"cuda", Language::cuda},
                                                        {"string", Language::string}};
    return all;
}

emit::Options options_of(const Emit& e) {
    emit::Options options;
    for (const std::string& name : e.names) options.functions.push_back(emit::resolve(name));
    options.language = languages().at(e.as);
    options.math = math_named(e.math);
    options.real = real_named(e.real);
    runtime::require_policy(options.math, options.real);
    const bool opencl = e.as == "opencl" || e.as == "string";
    if (!opencl && options.math == runtime::Math::native)
        throw InputError(fmt::format(
            "--math native --as {}: native is OpenCL's alone; strict and builtin are allowed", e.as));
    emit::require_prefix(e.prefix);
    options.prefix = e.prefix;
    options.selftest = e.selftest;
    const auto material = std::find_if(options.functions.begin(), options.functions.end(), emit::is_bsdf);
    if (material == options.functions.end() && !e.effects.empty())
        throw InputError(fmt::format(
            "--effects {}: no function of a material (vndf_bsdf_sample, ...) is named", e.effects));
    if (material != options.functions.end() && e.selftest)
        throw InputError(fmt::format("--selftest: there are no known answers of {}", *material));
    if (material != options.functions.end())
        options.effects = parse_effects(e.effects.empty() ? "all" : e.effects).macros();
    options.stamp =
        fmt::format("Made by clvndf {}: clvndf emit {}", CLVNDF_VERSION, fmt::join(options.functions, " "));
    for (const auto& [option, value, usual] : {std::array{"--as", e.as.c_str(), "opencl"},
                                               {"--math", e.math.c_str(), "strict"},
                                               {"--real", e.real.c_str(), "float"},
                                               {"--prefix", e.prefix.c_str(), "vndf_"}})
        if (std::string_view(value) != usual) options.stamp += fmt::format(" {} {}", option, value);
    if (!e.effects.empty()) options.stamp += " --effects " + e.effects;
    if (e.selftest) options.stamp += " --selftest";
    return options;
}

void run(const Emit& e) {
    const std::string text = emit::emit(options_of(e));
    OutputFile output(e.output);
    output.write(text);
    output.commit();
}

}  // namespace

void add_emit(CLI::App& app, Common& common) {
    CLI::App* command =
        app.add_subcommand("emit", "write one source file with the functions named and all they use");
    const auto e = std::make_shared<Emit>();
    // CLI11 takes "---" for a word.
    const CLI::Validator no_option(
        [](const std::string& name) { return name[0] == '-' ? "unknown option" : ""; }, "", "");
    command->add_option("name", e->names, "functions, as clvndf list names them")
        ->required()
        ->check(no_option);
    command->add_option("-o,--output", e->output, "file to write, or -")->capture_default_str();
    command->add_option("--as", e->as, "language: opencl, c, c++, cuda, or string (OpenCL C in a C string)")
        ->check(CLI::IsMember(languages()))
        ->capture_default_str();
    add_switches(*command, e->math, e->real);
    command->add_option("--prefix", e->prefix, "what every name begins with")->capture_default_str();
    command->add_option("--effects", e->effects,
                        "of a material: all (default), or effects and choices: conductor,tint,fresnel=f82");
    command->add_flag("--selftest", e->selftest, "with a kernel of known answers that counts wrong results");
    command->callback([e, &common] { common.action = [e] { run(*e); }; });
}

}  // namespace vndf::cli
