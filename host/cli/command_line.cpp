#include "cli/command_line.h"

#include <charconv>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/commands.h"
#include "cli/driver_failure.h"
#include "cli/options.h"
#include "cli/streams.h"
#include "error.h"
#include "hash.h"
#include "runtime/sources.h"
#include "text.h"

namespace vndf::cli {

void add_switches(CLI::App& command, std::string& math, std::string& real) {
    command
        .add_option("--math", math, "policy of elementary functions: strict, builtin or native (float only)")
        ->check(CLI::IsMember({"strict", "builtin", "native"}))
        ->capture_default_str();
    command.add_option("--real", real, "real type: float or double")
        ->check(CLI::IsMember({"float", "double"}))
        ->capture_default_str();
}

runtime::Math math_named(const std::string& name) {
    using runtime::Math;
    return name == "strict" ? Math::strict : name == "builtin" ? Math::builtin : Math::native;
}

runtime::Real real_named(const std::string& name) {
    return name == "float" ? runtime::Real::f32 : runtime::Real::f64;
}

void Target::add_to(CLI::App& command, const std::string& several) {
    add_device(command, device, several);
    add_switches(command, math_name, real_name);
}

runtime::Math Target::math() const {
    const runtime::Math math = math_named(math_name);
    runtime::require_policy(math, real());
    return math;
}

runtime::Real Target::real() const {
    return real_named(real_name);
}

runtime::Device Target::choose(const Common& common) const {
    const runtime::Choice choice = runtime::choose_device(device);
    end_where_drivers_fail();
    if (!choice.note.empty() && !common.quiet) remark("clvndf: {}\n", choice.note);
    return choice.device;
}

std::vector<runtime::Device> Target::choose_all(const Common& common) const {
    if (!runtime::wants_all(device)) return {choose(common)};
    const std::vector<runtime::Device> all = runtime::choose_devices(runtime::devices(), device);
    end_where_drivers_fail();
    // In turns; where there are more ranks than devices, several have the same one.
    std::vector<runtime::Device> mine;
    for (std::size_t i = static_cast<std::size_t>(common.ranks->place()) % all.size(); i < all.size();
         i += static_cast<std::size_t>(common.ranks->neighbours()))
        mine.push_back(all[i]);
    return mine;
}

void Common::require_one_process(const std::string& what) const {
    if (ranks->size() > 1)
        throw InputError(
            fmt::format("clvndf {} is done by one process, and mpirun started {}", what, ranks->size()));
}

namespace {

// How long a rank may be silent.
std::chrono::duration<double> patience() {
    const char* const text = std::getenv("CLVNDF_RANK_TIMEOUT");
    if (!text) return runtime::Team::Options().patience;
    double seconds = 0;
    const auto [end, error] = std::from_chars(text, text + std::strlen(text), seconds);
    if (error != std::errc() || *end != '\0' || !(seconds >= 1 && seconds <= 1e6))
        throw InputError(fmt::format("CLVNDF_RANK_TIMEOUT '{}': expected seconds, from 1 to 1e6", text));
    return std::chrono::duration<double>(seconds);
}

// Of all kernels in this binary.
std::uint64_t kernels_hash() {
    std::uint64_t hash = fnv1a("");
    for (const runtime::SourceFile& file : runtime::embedded_sources())
        hash = fnv1a(file.text, fnv1a(file.path, hash));
    return hash;
}

}  // namespace

std::string with_version(const std::string& what) {
    return fmt::format("clvndf " CLVNDF_VERSION ", kernels {:016x}, {}", kernels_hash(), what);
}

runtime::Team::Options team_options(const std::string& what) {
    runtime::Team::Options options;
    options.identity = with_version(what);
    options.patience = patience();
    options.lost = [](const std::string& text) { remark("clvndf: {}\n", text); };
    return options;
}

std::string Target::in_words() const {
    const Target usual;
    std::string words;
    // Of several devices, which are alike, any will do.
    const std::string one = runtime::one_of_all(device);
    if (!one.empty()) words += " --device " + quoted_for_shell(one);
    if (math_name != usual.math_name) words += " --math " + math_name;
    if (real_name != usual.real_name) words += " --real " + real_name;
    return words;
}

namespace {

bool takes_value(const CLI::Option& option) {
    return option.get_items_expected_max() > 0;
}

std::vector<CLI::App*> commands_of(CLI::App& app) {
    return app.get_subcommands([](const CLI::App*) { return true; });
}

std::string command_names(CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::App* command : commands_of(app)) names.push_back(command->get_name());
    return fmt::format("the commands are {} (see clvndf --help)", fmt::join(names, ", "));
}

// What may stand behind the command, or (null) before one.
std::string allowed(CLI::App& app, const CLI::App* command) {
    std::vector<std::string> words;
    for (const CLI::App* level : {command, static_cast<const CLI::App*>(&app)}) {
        if (!level) continue;
        for (const CLI::Option* option : level->get_options()) {
            if (option->get_positional()) words.insert(words.begin(), "a " + option->get_name());
            const auto& names = option->get_lnames();
            if (!names.empty() && names[0] != "help" && names[0] != "version")
                words.push_back("--" + names[0]);
        }
    }
    return fmt::format(
        "{} takes {}; {}", command ? "clvndf " + command->get_name() : "clvndf", fmt::join(words, ", "),
        command ? fmt::format("see clvndf {} --help", command->get_name()) : command_names(app));
}

// What is wrong with the first word that does not fit, read from left to right; empty if each fits. CLI11 speaks of
// whichever word it has left at the end.
std::string misfit(CLI::App& app, const std::vector<std::string>& words) {
    const CLI::App* command = nullptr;
    std::size_t free_places = 0;
    std::set<const CLI::Option*> seen;
    for (std::size_t i = 0; i < words.size(); ++i) {
        const std::string &word = words[i], name = word.substr(0, word.find('='));
        if (word == "--") continue;
        if (word.size() > 1 && word[0] == '-') {
            const CLI::Option* option = command ? command->get_option_no_throw(name) : nullptr;
            if (!option) option = app.get_option_no_throw(name);
            if (!option) return fmt::format("unknown option '{}'; {}", word, allowed(app, command));
            const bool attached = name != word;
            if (!takes_value(*option)) {
                if (attached) return fmt::format("'{}': {} takes no value", word, name);
                continue;
            }
            if (!seen.insert(option).second) return fmt::format("{} is given twice", name);
            if (word == name + "=") return fmt::format("{}: its value is empty", name);
            if (!attached && ++i == words.size()) return fmt::format("{}: its value is missing", name);
        } else if (!command) {
            for (const CLI::App* candidate : commands_of(app))
                if (candidate->get_name() == word) command = candidate;
            if (!command) return fmt::format("unknown command '{}'; {}", word, command_names(app));
            for (const CLI::Option* option : command->get_options())
                if (option->get_positional())
                    free_places += static_cast<std::size_t>(option->get_items_expected_max());
        } else if (free_places-- == 0) {
            return fmt::format("'{}' is one word too many; {}", word, allowed(app, command));
        }
    }
    return {};
}

// What CLI11 found wrong, in one line; with the commands there are if it was the command.
std::string explain(CLI::App& app, const CLI::ParseError& error, const std::vector<std::string>& words) {
    if (const std::string found = misfit(app, words); !found.empty()) return found;
    if (const auto chosen = app.get_subcommands(); !chosen.empty()) {
        return fmt::format("{} (see clvndf {} --help)", error.what(), chosen.front()->get_name());
    }
    return fmt::format("{}; {}", error.what(), command_names(app));
}

// An empty value has no meaning for any option.
void refuse_empty_values(CLI::App& app) {
    const CLI::Validator not_empty(
        [](const std::string& value) { return value.empty() ? "its value is empty" : ""; }, "", "");
    for (CLI::Option* option : app.get_options([](const CLI::Option*) { return true; }))
        if (takes_value(*option)) option->check(not_empty);
    for (CLI::App* command : commands_of(app)) refuse_empty_values(*command);
}

}  // namespace

CommandLine::CommandLine(runtime::Ranks* ranks)
    : app_("clvndf: samplers and densities of the GGX and Beckmann distributions of visible normals",
           "clvndf") {
    common_.ranks = ranks ? ranks : &alone_.emplace();
    app_.option_defaults()->disable_flag_override();  // --json=a.json is no flag
    app_.set_version_flag("--version", "clvndf " CLVNDF_VERSION);
    app_.require_subcommand(1);
    app_.fallthrough();
    add_number(app_, "--seed", common_.seed, std::uint64_t{0}, std::numeric_limits<std::uint64_t>::max(),
               "seed of every random number")
        ->default_str("1");
    app_.add_flag("--quiet", common_.quiet, "no progress and no remarks on stderr");
    add_devices(app_, common_);
    add_list(app_, common_);
    add_eval(app_, common_);
    add_check(app_, common_);
    add_policies(app_, common_);
    add_emit(app_, common_);
    add_energy(app_, common_);
    add_render(app_, common_);
#ifdef CLVNDF_BENCH
    add_bench(app_, common_);
#endif
    refuse_empty_values(app_);
}

void CommandLine::parse(int argc, const char* const* argv) {
    try {
        app_.parse(argc, argv);
    } catch (const CLI::Success& help_or_version) {
        common_.action = [this, help_or_version] {
            std::ostringstream text;
            app_.exit(help_or_version, text, text);
            put(text.str());
        };
    } catch (const CLI::ParseError& error) {
        throw InputError(explain(app_, error, {argv + 1, argv + argc}));
    }
}

int CommandLine::run() {
    if (!common_.leads()) common_.quiet = true;
    static const std::set<std::string> shared = {"check", "bench", "render"};
    for (const CLI::App* command : app_.get_subcommands())
        if (!shared.contains(command->get_name())) common_.require_one_process(command->get_name());
    common_.action();
    flush_output();
    return common_.exit_status;
}

}  // namespace vndf::cli
