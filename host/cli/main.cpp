// clvndf: the command line.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <string>

#include <fmt/format.h>

#include "cli/commands.h"
#include "error.h"

namespace vndf::cli {

void Target::add_to(CLI::App& command) {
    command.add_option(
        "--device", device,
        "first device whose platform or device name contains this\n(default: $CLVNDF_DEVICE, else "
        "PoCL's CPU device, else the first device)");
    command.add_option("--math", math_name, "policy of elementary functions: strict, builtin or native")
        ->check(CLI::IsMember({"strict", "builtin", "native"}))
        ->capture_default_str();
    command.add_option("--real", real_name, "real type: float or double")
        ->check(CLI::IsMember({"float", "double"}))
        ->capture_default_str();
}

runtime::Math Target::math() const {
    using runtime::Math;
    return math_name == "strict" ? Math::strict : math_name == "builtin" ? Math::builtin : Math::native;
}

runtime::Real Target::real() const {
    return real_name == "float" ? runtime::Real::f32 : runtime::Real::f64;
}

runtime::Device Target::choose(const Common& common) const {
    const runtime::Choice choice = runtime::choose_device(device);
    if (!choice.note.empty() && !common.quiet) fmt::print(stderr, "clvndf: {}\n", choice.note);
    return choice.device;
}

namespace {

int run(int argc, char** argv) {
    CLI::App app("clvndf: samplers and densities of the GGX and Beckmann distributions of visible normals");
    app.set_version_flag("--version", "clvndf " CLVNDF_VERSION);
    app.require_subcommand(1);
    app.fallthrough();
    Common common;
    app.add_option("--seed", common.seed, "seed of every random number")->capture_default_str();
    app.add_flag("--quiet", common.quiet, "no progress and no remarks on stderr");
    add_devices(app, common);
    add_list(app, common);
    add_eval(app, common);
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& help_or_version) {
        return app.exit(help_or_version);
    } catch (const CLI::ParseError& error) {
        throw InputError(fmt::format("{} (see clvndf --help)", error.what()));
    }
    if (std::fflush(stdout) != 0 || std::ferror(stdout)) throw InputError("standard output: cannot write");
    return common.exit_status;
}

}  // namespace
}  // namespace vndf::cli

int main(int argc, char** argv) {
    try {
        return vndf::cli::run(argc, argv);
    } catch (const vndf::Error& error) {
        fmt::print(stderr, "clvndf: {}\n", error.what());
        return error.exit_status();
    } catch (const std::exception& error) {
        fmt::print(stderr, "clvndf: {}\n", error.what());
        return 3;
    }
}
