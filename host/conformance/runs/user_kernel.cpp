#include "conformance/runs/user_kernel.h"

#include <algorithm>
#include <filesystem>
#include <regex>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "error.h"
#include "file.h"

namespace vndf::conformance {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t largest_file = std::uint64_t{1} << 24;
constexpr int deepest_include = 32;

// A distribution that any map may draw from: one of the samplers that do, and the density.
struct General {
    const char *name, *sampler, *density;
};
constexpr General general[] = {
    {"ggx_sample_wm", "vndf_ggx_sample_wm_dupuy2023", "vndf_ggx_pdf_wm"},
    {"ggx_sample_wi", "vndf_ggx_sample_wi_eto2023", "vndf_ggx_pdf_wi"},
    {"ggx_sample_ndf", "vndf_ggx_sample_wm_walter2007", "vndf_ggx_pdf_wm_walter2007"},
    {"beckmann_sample_wm", "vndf_beckmann_sample_wm_jakob2014", "vndf_beckmann_pdf_wm"},
    {"beckmann_sample_wi", "vndf_ggx_sample_wi_eto2023", "vndf_beckmann_pdf_wi"},
    {"beckmann_sample_ndf", "vndf_beckmann_sample_wm_walter2007", "vndf_beckmann_pdf_wm_walter2007"}};

const General* general_named(const std::string& name) {
    const auto found = std::find_if(std::begin(general), std::end(general),
                                    [&](const General& g) { return g.name == name; });
    return found == std::end(general) ? nullptr : found;
}

// By its name with or without vndf_, among those that numbers alone are the arguments of, in the plain form.
const Function* registered(const std::string& name) {
    const Function* function = find_function(name.starts_with("vndf_") ? name : "vndf_" + name);
    return function && function->lobe.empty() && !function->with_pdf ? function : nullptr;
}

InputError unknown(const std::string& as) {
    return InputError(fmt::format(
        "--as '{}': allowed are {}, bsdf (of check), {} (of eval), and functions of clvndf list that take no "
        "lobe; the nearest of these are {}",
        as, fmt::join(general_names(), ", "), fmt::join(bsdf_parts(), ", "),
        fmt::join(nearest_names("vndf_" + as), ", ")));
}

bool is_identifier(const std::string& text) {
    static const std::regex identifier("[A-Za-z_][A-Za-z0-9_]*");
    return std::regex_match(text, identifier);
}

// The scalars of a function in a row that make one argument: "wo" of wo_x, wo_y, wo_z; "u" of u1, u2; "eta".
struct Argument {
    std::string name;
    std::size_t first = 0, count = 1;
};
std::string vector_of(const std::string& scalar) {
    if (scalar.size() > 2 && scalar[scalar.size() - 2] == '_' && scalar.back() >= 'x' && scalar.back() <= 'z')
        return scalar.substr(0, scalar.size() - 2);
    return scalar.size() == 2 && scalar[0] == 'u' ? "u" : scalar;
}
std::vector<Argument> arguments_of(const std::vector<std::string>& scalars) {
    std::vector<Argument> all;
    for (std::size_t i = 0; i < scalars.size(); ++i) {
        const std::string name = vector_of(scalars[i]);
        if (name != scalars[i] && !all.empty() && all.back().name == name)
            ++all.back().count;
        else
            all.push_back({name, i, 1});
    }
    return all;
}

std::string type_of(std::size_t components, const std::string& real) {
    return components == 1 ? real : fmt::format("{}{}", real, components);
}

// "float3 NAME(float3 wo, float2 alpha, float2 u)"
std::string signature(const Function& function, const std::string& real) {
    std::vector<std::string> arguments;
    for (const Argument& a : arguments_of(function.inputs))
        arguments.push_back(type_of(a.count, real) + ' ' + a.name);
    return fmt::format("{} {}({})", type_of(function.outputs.size(), real), function.name,
                       fmt::join(arguments, ", "));
}

std::string call(const Function& function, const std::string& real, const char* scalar) {
    std::vector<std::string> arguments;
    for (const Argument& a : arguments_of(function.inputs)) {
        std::vector<std::string> scalars;
        for (std::size_t k = 0; k < a.count; ++k)
            scalars.push_back(fmt::format(fmt::runtime(scalar), function.inputs[a.first + k]));
        arguments.push_back(a.count == 1
                                ? scalars.front()
                                : fmt::format("({})({})", type_of(a.count, real), fmt::join(scalars, ", ")));
    }
    return fmt::format("{}({})", function.name, fmt::join(arguments, ", "));
}

// Like those of kernels/batch/entry_point.h, whose headers a user's program need not hold. A vector where a number is expected
// is refused by the compiler; a number where a vector is, by a component that it lacks.
std::string entry_point(const Function& function, const std::string& real) {
    static constexpr const char* components[] = {"s0", "s1", "s2", "s3"};
    const std::size_t outputs = function.outputs.size();
    std::string text = fmt::format("#line 1 \"{}\"\n", signature(function, real));
    if (outputs > 1)
        text += fmt::format("static void clvndf_probe_{0}(void) {{ (void)sizeof({1}.{2}); }}\n",
                            function.name, call(function, real, "0"), components[outputs - 1]);
    text += fmt::format("__kernel void vndf_batch_{}(", function.name);
    for (const std::string& in : function.inputs)
        text += fmt::format("__global const {}* restrict clvndf_in_{}, ", real, in);
    for (const std::string& out : function.outputs)
        text += fmt::format("__global {}* restrict clvndf_out_{}, ", real, out);
    text += fmt::format(
        "const uint clvndf_first) {{\n    const size_t clvndf_i = clvndf_first + get_global_id(0);\n"
        "    const {} clvndf_result = {};\n",
        type_of(outputs, real), call(function, real, "clvndf_in_{}[clvndf_i]"));
    for (std::size_t k = 0; k < outputs; ++k)
        text += fmt::format("    clvndf_out_{}[clvndf_i] = clvndf_result{}{};\n", function.outputs[k],
                            outputs > 1 ? "." : "", outputs > 1 ? components[k] : "");
    return text + "}\n";
}

// Names that a text seems to define as functions, for an error.
std::vector<std::string> defined_in(const std::string& text) {
    static const std::regex definition(R"re(\b([A-Za-z_]\w*)\s*\([^;{}()]*\)\s*\{)re");
    static const std::set<std::string> words{"if", "for", "while", "switch"};
    std::vector<std::string> names;
    for (std::sregex_iterator i(text.begin(), text.end(), definition), end; i != end; ++i)
        if (!words.contains((*i)[1]) && std::find(names.begin(), names.end(), (*i)[1]) == names.end())
            names.push_back((*i)[1]);
    return names;
}

Function plain_function(const std::string& name, Kind kind, std::vector<std::string> inputs,
                        std::vector<std::string> outputs, const char* result) {
    Function f;
    f.name = f.plain = name, f.kind = kind, f.result = result;
    f.inputs = std::move(inputs), f.outputs = std::move(outputs);
    return f;
}

// As bsdf_parts() names it.
Function bsdf_part(const std::string& part) {
    const std::vector<std::string> pair{"wo_x", "wo_y", "wo_z", "wi_x", "wi_y", "wi_z", "alpha_x", "alpha_y"};
    if (part == "bsdf_value") return plain_function({}, Kind::term, pair, {"value"}, "VALUE");
    if (part == "bsdf_pdf") return plain_function({}, Kind::density, pair, {"pdf"}, "VALUE");
    return plain_function({}, Kind::sampler, {"wo_x", "wo_y", "wo_z", "alpha_x", "alpha_y", "u1", "u2", "u3"},
                          {"wi_x", "wi_y", "wi_z", "weight"}, "WI");
}

bool is_bsdf_part(const std::string& as) {
    return std::find(bsdf_parts().begin(), bsdf_parts().end(), as) != bsdf_parts().end();
}

}  // namespace

const std::vector<std::string>& bsdf_parts() {
    static const std::vector<std::string> names{"bsdf_value", "bsdf_pdf", "bsdf_sample"};
    return names;
}

const std::vector<std::string>& general_names() {
    static const auto names = [] {
        std::vector<std::string> all;
        for (const General& g : general) all.push_back(g.name);
        return all;
    }();
    return names;
}

UserKernel::UserKernel(UserOptions options) : options_(std::move(options)) {
    describe();
    if (options_.file.find_first_of("\"\\\n") != std::string::npos)
        throw InputError(
            fmt::format("--kernel '{}': a path without quotes and backslashes is needed", options_.file));
    const std::string path = fs::path(options_.file).lexically_normal().generic_string();
    files_.push_back({path, read_file(options_.file, largest_file)});
    load(path, 0);
}

void UserKernel::describe() {
    const auto named = [](const char* option, const std::string& name) {
        if (!is_identifier(name))
            throw InputError(fmt::format("{} '{}': expected the name of a function in C", option, name));
        return name;
    };
    named("--function", options_.function);
    if (!options_.pdf.empty()) named("--pdf", options_.pdf);
    if (!options_.sample.empty()) named("--sample", options_.sample);
    const auto add = [&](Function f, const std::string& name) {
        for (const Function& other : functions_)
            if (other.name == name)
                throw InputError(fmt::format("'{}' is given as two functions; each has one name", name));
        f.name = name;
        functions_.push_back(std::move(f));
    };

    if (is_bsdf()) {
        if (options_.pdf.empty() || options_.sample.empty())
            throw InputError(
                "--as bsdf: --function names its value, and it needs --pdf and --sample as well");
        add(bsdf_part("bsdf_value"), options_.function);
        add(bsdf_part("bsdf_pdf"), options_.pdf);
        add(bsdf_part("bsdf_sample"), options_.sample);
        return;
    }
    if (!options_.sample.empty())
        throw InputError(fmt::format("--sample '{}': of --as bsdf alone", options_.sample));
    if (is_bsdf_part(options_.as)) return add(bsdf_part(options_.as), options_.function);
    const General* any_map = general_named(options_.as);
    ours_ = any_map ? find_function(any_map->sampler) : registered(options_.as);
    if (!ours_) throw unknown(options_.as);
    Function f = *ours_;
    if (any_map) f.model.clear(), f.method = Method::exact, f.density = any_map->density;
    if (f.kind == Kind::sampler) f.ndf = find_function(f.density)->ndf;
    if (options_.scope.domain == Domain::upper) f.domain = Domain::upper;
    add(f, options_.function);
    if (options_.pdf.empty()) return;
    if (f.kind != Kind::sampler)
        throw InputError(
            fmt::format("--pdf '{}': of a sampler or a bsdf; --as {} is none", options_.pdf, options_.as));
    Function density = *find_function(f.density);
    density.domain = f.domain;
    add(density, options_.pdf);
}

// The files that are there among those that a file includes, as it names them; the compiler says which are not.
void UserKernel::load(const std::string& path, int depth) {
    if (depth > deepest_include) return;
    const std::string text = files_.back().text;
    for (const std::string& name : runtime::quoted_includes(text)) {
        const std::string beside = (fs::path(path).parent_path() / name).lexically_normal().generic_string();
        const bool known =
            std::any_of(files_.begin(), files_.end(), [&](const File& f) { return f.path == beside; });
        std::error_code error;
        if (known || !fs::is_regular_file(beside, error)) continue;
        files_.push_back({beside, read_file(beside, largest_file)});
        load(beside, depth + 1);
    }
}

const Function* UserKernel::pdf() const {
    return functions_.size() > 1 ? &functions_[1] : nullptr;
}
const Function* UserKernel::sample() const {
    return functions_.size() > 2 ? &functions_[2] : nullptr;
}

runtime::ProgramOptions UserKernel::program(runtime::Real real) const {
    return program_of(files_, real);
}

runtime::ProgramOptions UserKernel::program_of(const std::deque<File>& files, runtime::Real real) const {
    runtime::ProgramOptions program;
    program.build_options = options_.options;
    program.correct_divide_sqrt = false;
    program.root = files.front().path;
    for (const File& file : files) program.more_files.push_back({file.path, file.text});
    // The library by the name that users include it by.
    constexpr std::string_view folder = "kernels/";
    for (const runtime::SourceFile& file : runtime::embedded_sources())
        if (file.path.starts_with("kernels/vndf/"))
            program.more_files.push_back({file.path.substr(folder.size()), file.text});
    for (const Function& f : functions_) program.more_source += entry_point(f, std::string(to_string(real)));
    return program;
}

std::optional<runtime::DeviceEvaluator> UserKernel::in_double(const runtime::Device& device) const {
    static const std::vector<std::pair<std::regex, const char*>> words{
        {std::regex(R"re(\bfloat(\d*)\b)re"), "double$1"},
        {std::regex(R"re(\b(M_\w+)_F\b)re"), "$1"},
        {std::regex(R"re(\b(?:native|half)_(\w+))re"), "$1"},
        {std::regex(R"re((\b\d+\.?\d*(?:[eE][-+]?\d+)?|\.\d+(?:[eE][-+]?\d+)?)[fF]\b)re"), "$1"}};
    if (!device.fp64) return std::nullopt;
    std::deque<File> files = files_;
    for (File& file : files)
        for (const auto& [word, instead] : words) file.text = std::regex_replace(file.text, word, instead);
    try {
        return runtime::DeviceEvaluator(device, runtime::Math::strict, runtime::Real::f64,
                                        program_of(files, runtime::Real::f64));
    } catch (const BuildError&) {
        return std::nullopt;
    }
}

runtime::DeviceEvaluator UserKernel::evaluator(const runtime::Device& device, runtime::Real real) const {
    const runtime::ProgramOptions whole = program(real);
    const auto fails = [&](const runtime::ProgramOptions& options) -> std::string {
        try {
            runtime::Program(device, runtime::Math::strict, real, options);
            return {};
        } catch (const BuildError& error) {
            return error.what();
        }
    };
    try {
        return runtime::DeviceEvaluator(device, runtime::Math::strict, real, whole);
    } catch (const BuildError&) {
        runtime::ProgramOptions alone = whole;
        alone.more_source.clear();
        // Whether it is the user's text that does not compile, or the calls of it.
        if (const std::string log = fails(alone); !log.empty()) throw Error(2, log);
        for (const Function& f : functions_) {
            runtime::ProgramOptions one = alone;
            one.more_source = entry_point(f, std::string(to_string(real)));
            if (fails(one).empty()) continue;
            const std::string& text = files_.front().text;
            if (std::none_of(files_.begin(), files_.end(), [&](const File& file) {
                    return std::regex_search(file.text, std::regex("\\b" + f.name + "\\b"));
                }))
                throw InputError(fmt::format("{}: there is no function '{}' in it; there are {}",
                                             options_.file, f.name, fmt::join(defined_in(text), ", ")));
            throw InputError(
                fmt::format("{}: '{}' is no function {}; a few lines adapt another one: kernels/README.md, "
                            "Adapters",
                            options_.file, f.name, signature(f, std::string(to_string(real)))));
        }
        throw;
    }
}

}  // namespace vndf::conformance
