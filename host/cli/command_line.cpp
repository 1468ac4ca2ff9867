#include "cli/command_line.h"

#include <charconv>
#include <cstdio>
#include <iostream>
#include <limits>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "cli/commands.h"
#include "cli/driver_failure.h"
#include "error.h"

namespace vndf::cli {

void Target::add_to(CLI::App& command) {
    command.add_option(
        "--device", device,
        "first device whose platform or device name contains this\n(default: $CLVNDF_DEVICE, else "
        "PoCL's CPU device, else the first device)");
    command
        .add_option("--math", math_name,
                    "policy of elementary functions: strict, builtin or native (float only)")
        ->check(CLI::IsMember({"strict", "builtin", "native"}))
        ->capture_default_str();
    command.add_option("--real", real_name, "real type: float or double")
        ->check(CLI::IsMember({"float", "double"}))
        ->capture_default_str();
}

runtime::Math Target::math() const {
    using runtime::Math;
    const Math math = math_name == "strict"    ? Math::strict
                      : math_name == "builtin" ? Math::builtin
                                               : Math::native;
    runtime::require_policy(math, real());
    return math;
}

runtime::Real Target::real() const {
    return real_name == "float" ? runtime::Real::f32 : runtime::Real::f64;
}

runtime::Device Target::choose(const Common& common) const {
    const runtime::Choice choice = runtime::choose_device(device);
    end_where_drivers_fail();
    if (!choice.note.empty() && !common.quiet) fmt::print(stderr, "clvndf: {}\n", choice.note);
    return choice.device;
}

namespace {

// What CLI11 found wrong, in one line; with the commands there are if it was the command.
std::string explain(const CLI::App& app, const CLI::ParseError& error) {
    if (const auto chosen = app.get_subcommands(); !chosen.empty()) {
        return fmt::format("{} (see clvndf {} --help)", error.what(), chosen.front()->get_name());
    }
    std::vector<std::string> commands;
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
        commands.push_back(command->get_name());
    }
    const auto rest = app.remaining();
    const std::string found =
        rest.empty() ? error.what() : fmt::format("unknown command or option '{}'", rest.front());
    return fmt::format("{}; the commands are {} (see clvndf --help)", found, fmt::join(commands, ", "));
}

// Takes the seed from its text; CLI11 would let -1 wrap around.
void add_seed(CLI::App& app, Common& common) {
    const auto parse = [&common](const std::string& text) {
        const char* const last = text.data() + text.size();
        const auto [end, error] = std::from_chars(text.data(), last, common.seed);
        if (error == std::errc() && end == last) return;
        throw InputError(fmt::format("--seed: '{}' is no seed; 0 to {} are allowed", text,
                                     std::numeric_limits<std::uint64_t>::max()));
    };
    app.add_option_function<std::string>("--seed", parse, "seed of every random number")->default_str("1");
}

}  // namespace

CommandLine::CommandLine()
    : app_("clvndf: samplers and densities of the GGX and Beckmann distributions of visible normals",
           "clvndf") {
    app_.set_version_flag("--version", "clvndf " CLVNDF_VERSION);
    app_.require_subcommand(1);
    app_.fallthrough();
    add_seed(app_, common_);
    app_.add_flag("--quiet", common_.quiet, "no progress and no remarks on stderr");
    add_devices(app_, common_);
    add_list(app_, common_);
    add_eval(app_, common_);
    add_check(app_, common_);
    add_policies(app_, common_);
#ifdef CLVNDF_BENCH
    add_bench(app_, common_);
#endif
}

void CommandLine::parse(int argc, const char* const* argv) {
    try {
        app_.parse(argc, argv);
    } catch (const CLI::Success& help_or_version) {
        common_.action = [this, help_or_version] { app_.exit(help_or_version, std::cout, std::cerr); };
    } catch (const CLI::ParseError& error) {
        throw InputError(explain(app_, error));
    }
}

int CommandLine::run() {
    common_.action();
    if (!std::cout.flush() || std::fflush(stdout) != 0 || std::ferror(stdout))
        throw InputError("standard output: cannot write");
    return common_.exit_status;
}

}  // namespace vndf::cli
