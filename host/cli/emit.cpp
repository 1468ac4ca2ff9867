// clvndf emit
#include <memory>
#include <vector>

#include "cli/commands.h"
#include "cli/output_file.h"
#include "effects.h"
#include "emit/emit.h"

namespace vndf::cli {
namespace {

struct Emit {
    std::vector<std::string> names;
    std::string effects, output = "-", as = "opencl", math = "strict", real = "float", prefix = "vndf_";
    bool selftest = false;
};

emit::Options options_of(const Emit& e) {
    emit::Options options;
    for (const std::string& name : e.names) options.functions.push_back(emit::resolve(name));
    options.language = emit::languages().at(e.as);
    options.math = math_named(e.math);
    options.real = real_named(e.real);
    options.prefix = e.prefix;
    options.effects = e.effects;
    options.selftest = e.selftest;
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
        ->check(CLI::IsMember(emit::languages()))
        ->capture_default_str();
    add_switches(*command, e->math, e->real);
    command->add_option("--prefix", e->prefix, "what every name begins with")->capture_default_str();
    command->add_option_function<std::string>(
        "--effects", [e](const std::string& text) { parse_effects(text), e->effects = text; },
        "of a material: all (default), or effects and choices: conductor,tint,fresnel=f82");
    command->add_flag("--selftest", e->selftest, "with a kernel of known answers that counts wrong results");
    command->callback([e, &common] { common.action = [e] { run(*e); }; });
}

}  // namespace vndf::cli
