// clvndf energy
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>

#include <fmt/format.h>

#include "cli/commands.h"
#include "cli/options.h"
#include "cli/output_file.h"
#include "cli/streams.h"
#include "energy/measure.h"
#include "error.h"

namespace vndf::cli {
namespace {

namespace fs = std::filesystem;

struct Energy {
    energy::Surface surface{"ggx", "correlated"};
    std::string device, output = "-", cache;
};

// A folder of the user for what can be made again; empty where there is none.
std::string default_cache() {
    if (const char* folder = std::getenv("XDG_CACHE_HOME"); folder && *folder)
        return std::string(folder) + "/clvndf";
    if (const char* home = std::getenv("HOME"); home && *home) return std::string(home) + "/.cache/clvndf";
    return {};
}

// What was kept, if it is whole.
std::optional<energy::Table> found(const Energy& e, const std::string& path, const Common& common) {
    std::ifstream file(path, std::ios::binary);
    if (!file) return {};
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    try {
        return energy::read_kept(e.surface, text, path);
    } catch (const InputError& error) {
        if (!common.quiet) remark("clvndf: {}; it is made again\n", error.what());
        return {};
    }
}

// A table that cannot be kept is made all the same.
void keep(const energy::Table& table, const std::string& path, const Common& common) {
    try {
        std::error_code none;
        fs::create_directories(fs::path(path).parent_path(), none);
        OutputFile file(path);
        file.write(energy::kept(table));
        file.commit();
    } catch (const InputError& error) {
        if (!common.quiet) remark("clvndf: not kept: {}\n", error.what());
    }
}

void run(const Energy& e, const Common& common) {
    OutputFile output(e.output);
    const std::string path =
        e.cache.empty() ? "" : fmt::format("{}/energy-{}-{}", e.cache, e.surface.ndf, e.surface.masking);
    std::optional<energy::Table> table = path.empty() ? std::nullopt : found(e, path, common);
    if (!table) {
        Target target;
        target.device = e.device;
        table = energy::measured(target.choose(common), e.surface);
        if (!path.empty()) keep(*table, path, common);
    }
    output.write(energy::header(*table));
    output.commit();
}

}  // namespace

void add_energy(CLI::App& app, Common& common) {
    CLI::App* command = app.add_subcommand(
        "energy", "measure what scattering between facets takes, and write it as constants");
    const auto e = std::make_shared<Energy>();
    e->cache = default_cache();
    add_device(*command, e->device);
    command->add_option("--ndf", e->surface.ndf, "distribution: ggx or beckmann")
        ->check(CLI::IsMember({"ggx", "beckmann"}))
        ->capture_default_str();
    command->add_option("--masking", e->surface.masking, "masking: correlated or separable")
        ->check(CLI::IsMember({"correlated", "separable"}))
        ->capture_default_str();
    command->add_option("-o,--output", e->output, "header to write, or -")->capture_default_str();
    command->add_option("--cache", e->cache,
                        "folder where measured tables are kept\n"
                        "(default: clvndf in $XDG_CACHE_HOME, else in ~/.cache)");
    command->add_flag_callback(
        "--no-cache", [e] { e->cache.clear(); }, "measure, and keep nothing");
    command->callback([e, &common] { common.action = [e, &common] { run(*e, common); }; });
}

}  // namespace vndf::cli
