// The commands. Each add_* defines its options and the action when it is chosen.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "runtime/devices.h"
#include "runtime/evaluator.h"
#include "runtime/team.h"

namespace vndf::cli {

// Options of every command, and what is to be done.
struct Common {
    std::uint64_t seed = 1;
    bool quiet = false;
    runtime::Ranks* ranks = nullptr;  // of this run
    std::function<void()> action;     // of the command chosen; runs once every argument is found good
    int exit_status = 0;  // set by a command that ran to its end with a verdict: 1 for a failed check

    // Whether this process reports and writes: the only one, or the first of several.
    bool leads() const { return ranks->leads(); }
    // Throws InputError if several ranks are to do what one process does, such as "check --digest".
    void require_one_process(const std::string& what) const;
};

// --math and --real.
void add_switches(CLI::App& command, std::string& math, std::string& real);
runtime::Math math_named(const std::string& name);
runtime::Real real_named(const std::string& name);

// Options of the commands that run kernels.
struct Target {
    std::string device, math_name = "strict", real_name = "float";

    void add_to(CLI::App& command, const std::string& several = {});
    runtime::Math math() const;  // throws InputError if it does not exist for real()
    runtime::Real real() const;
    // The device asked for; unless quiet, stderr says which one was taken of several.
    runtime::Device choose(const Common& common) const;
    // Those that this rank is to use: of --device all its share of the host's, else that one.
    std::vector<runtime::Device> choose_all(const Common& common) const;
    // " --device 'pocl' --math builtin": for a shell, what is not the default.
    std::string in_words() const;
};

// `what`, by this version and with these kernels: what must be the same for results to go together.
std::string with_version(const std::string& what);

// For the team of a command that does `what`.
runtime::Team::Options team_options(const std::string& what);

void add_devices(CLI::App& app, Common& common);
void add_list(CLI::App& app, Common& common);
void add_eval(CLI::App& app, Common& common);
void add_check(CLI::App& app, Common& common);
void add_policies(CLI::App& app, Common& common);
void add_emit(CLI::App& app, Common& common);
void add_energy(CLI::App& app, Common& common);
void add_render(CLI::App& app, Common& common);
void add_bench(CLI::App& app, Common& common);  // defined where Google Benchmark is there

}  // namespace vndf::cli
