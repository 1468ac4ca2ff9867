// The commands and options that the command line itself knows, with values to try them on.
#pragma once

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "catch.h"
#include "cli/command_line.h"

namespace vndf::test {

struct Values {
    std::vector<std::string> good, wrong;  // as far as parsing tells, which looks at no file and no device
};

struct Option {
    std::string name;  // "--seed"
    bool flag;
    Values values;                             // of an option that is no flag
    std::vector<std::string> excludes, needs;  // names of others
};

struct Command {
    std::string name;
    bool takes_name;   // a word beside the options
    bool takes_names;  // any number of them
    std::vector<Option> options;
};

struct Commands {
    std::vector<Option> common;  // before or behind every command
    std::vector<Command> commands;
};

// By the option's name, or by that of its command and its own.
inline const std::map<std::string, Values>& values() {
    static const std::vector<std::string> no_count{"",
                                                   "nan",
                                                   "inf",
                                                   "-1",
                                                   "0",
                                                   "1e309",
                                                   "0x1000",
                                                   " 64",
                                                   "1024 ",
                                                   "5x",
                                                   "99.5",
                                                   "1e4",
                                                   "99999999999999999999"};
    static const std::map<std::string, Values> table{
        {"--device", {{"x", "PoCL", "a b"}, {""}}},
        {"--math", {{"strict", "builtin", "native"}, {"Strict", "fast", "", "strict "}}},
        {"--real", {{"float", "double"}, {"half", "Float", "32", ""}}},
        {"--seed",
         {{"0", "1", "18446744073709551615"},
          {"-1", "1.5", "x", "", "18446744073709551616", "0x1", " 1", "nan", "inf", "1e309"}}},
        {"--only", {{"vndf_ggx", "*", "dupuy2023/strict"}, {""}}},
        {"render --output", {{"a.png", "b.exr"}, {""}}},
        {"--size", {{"1x1", "960x340"}, {""}}},
        {"--spp", {{"1", "1024"}, no_count}},
        {"--time", {{"0.5", "10"}, {"", "nan", "inf", "0", "-1", "1e309", "5s", " 5"}}},
        {"--target-error", {{"0.1", "1e-3"}, {"", "nan", "inf", "0", "-1", "2", "5x", " 5"}}},
        {"--max-bounces", {{"0", "6", "128"}, {"", "-1", "129", "1.5", "x", "nan"}}},
        {"--sampler", {{"bounded", "plain", "conic", "tilted", "ndf", "cosine"}, {"", "vndf", "Plain"}}},
        {"--ndf", {{"ggx", "beckmann"}, {"", "gtr"}}},
        {"--masking", {{"correlated", "separable"}, {"", "smith"}}},
        {"energy --of", {{"conductor", "glass"}, {"", "wood"}}},
        {"--energy", {{"none", "turquin", "kulla_conty"}, {"", "kulla"}}},
        {"--cache", {{"a", "a/b"}, {""}}},
        {"--random", {{"sobol", "philox"}, {"", "halton"}}},
        {"--orbs", {{"roughness", "metals"}, {"", "glass of water"}}},
        {"--sky", {{"auto", "day", "none", "white", "sunlit"}, {"", "night"}}},
        {"--camera", {{"front", "0"}, {""}}},
        {"--env", {{"a.hdr", "b.exr"}, {""}}},
        {"--env-rotation", {{"-12.5", "90"}, {"", "nan", "inf", "1e5", "5x"}}},
        {"--light-radius", {{"0.1", "1e3"}, {"", "nan", "inf", "0", "-1", "1e7", "5x"}}},
        {"--lights-by", {{"mis", "cap", "bsdf", "cones"}, {"", "vndf", "Mis"}}},
        {"--checkpoint", {{"a", "a/b"}, {""}}},
        {"--exposure", {{"-2.5", "0"}, {"", "nan", "inf", "1e5", "5x"}}},
        {"--effects", {{"auto", "all", "conductor,lambert"}, {""}}},
        {"--input", {{"-", "a.csv", "a b"}, {""}}},
        {"--output", {{"-", "b.csv"}, {""}}},
        {"--json", {{"-", "a.json"}, {""}}},
        {"--junit", {{"-", "a.xml"}, {""}}},
        {"--report", {{"a", "a/b"}, {""}}},
        {"--compare", {{"a.json"}, {""}}},
        {"--as", {{"opencl", "c", "c++", "cuda", "string"}, {"C", "metal", "", "opencl "}}},
        {"--prefix", {{"vndf_", "a", "1"}, {""}}},
        {"emit --effects",
         {{"all", "lambert,tint", "conductor,fresnel=f82"}, {"", "lamp", "tint", "fresnel=", "all,ndf=x"}}},
        {"eval --on", {{"device", "host", "reference"}, {"gpu", "", "hos"}}},
        {"check --on", {{"device", "host"}, {"reference", ""}}},
        {"--flags",
         {{"luxcore", "-cl-mad-enable -cl-denorms-are-zero", "cycles -DX=1,renderers", "pairs"},
          {"", " ", "fast", "luxcore,", "-cl-fast", "-D", "-cl-std=CL1.2"}}},
        {"--kernel", {{"a.cl", "a b.cl"}, {""}}},
        {"--function", {{"f", "my_sample"}, {""}}},
        {"check --as", {{"ggx_sample_wm", "bsdf"}, {""}}},
        {"eval --as", {{"ggx_sample_wm", "ggx_pdf_wm", "bsdf_sample"}, {""}}},
        {"bench --as", {{"ggx_sample_wm", "ggx_pdf_wm"}, {""}}},
        {"--pdf", {{"f", "my_pdf"}, {""}}},
        {"--sample", {{"f", "my_sample"}, {""}}},
        {"--options", {{"-cl-fast-relaxed-math -DX=1", "-DX"}, {""}}},
        {"--points", {{"1024", "16777216"}, no_count}},
        {"--repetitions", {{"3", "1000"}, no_count}},
        {"--minutes",
         {{"0.001", "5", "1e6", ".5", "2.5e1"},
          {"", "nan", "-nan", "inf", "-inf", "0", "-0", "-1", "1e309", "1e-309", "0x10", "5m", " 5", "1e7"}}},
        {"--slice", {{"1/1", "3/10"}, {""}}},
        {"--error", {{"0.1", "50", "1e9"}, {"", "nan", "inf", "0", "-1", "1e10", "5x", " 5"}}},
        {"--domain", {{"front", "sphere"}, {"back", "", "Front"}}},
        {"--alpha",
         {{"0.001:1", "1:1", "1e-8:1000"},
          {"", "1", "1:", ":1", "1:0.5", "0:1", "nan:1", "0.1:inf", "0.1:1x", "0.1:1e4", " 0.1:1"}}}};
    return table;
}

inline Option option_of(const std::string& command, const CLI::Option& option) {
    Option result{option.get_name(), option.get_items_expected_max() == 0, {}, {}, {}};
    for (const CLI::Option* other : option.get_excludes()) result.excludes.push_back(other->get_name());
    for (const CLI::Option* other : option.get_needs()) result.needs.push_back(other->get_name());
    if (result.flag) return result;
    const auto found = values().contains(command + " " + result.name)
                           ? values().find(command + " " + result.name)
                           : values().find(result.name);
    INFO("no values to try " << command << " " << result.name << " on: add them to support/options.h");
    REQUIRE(found != values().end());
    result.values = found->second;
    return result;
}

inline std::vector<Option> options_of(const CLI::App& app) {
    std::vector<Option> options;
    for (const CLI::Option* option : app.get_options())
        if (!option->get_positional()) options.push_back(option_of(app.get_name(), *option));
    return options;
}

inline Commands commands() {
    cli::CommandLine line;
    Commands result{options_of(line.app()), {}};
    for (const CLI::App* app : line.app().get_subcommands([](const CLI::App*) { return true; })) {
        const auto all = app->get_options();
        const bool takes_name =
            std::any_of(all.begin(), all.end(), [](const CLI::Option* o) { return o->get_positional(); });
        const bool takes_names = std::any_of(all.begin(), all.end(), [](const CLI::Option* o) {
            return o->get_positional() && o->get_items_expected_max() > 1;
        });
        result.commands.push_back({app->get_name(), takes_name, takes_names, options_of(*app)});
    }
    return result;
}

// Answered without parsing the rest.
inline bool only_informs(const Option& option) {
    return option.name == "--help" || option.name == "--version";
}

}  // namespace vndf::test
