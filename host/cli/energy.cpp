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
    std::string of = "conductor", device, output = "-", cache;
};

// What there is of each kind of table.
struct Conductor {
    using Table = energy::Table;
    static constexpr const char* prefix = "energy";
    static Table read(const energy::Surface& s, const std::string& text, const std::string& path) {
        return energy::read_kept(s, text, path);
    }
    static Table measured(const runtime::Device& d, const energy::Surface& s) {
        return energy::measured(d, s);
    }
};
struct Glass {
    using Table = energy::GlassTable;
    static constexpr const char* prefix = "energy-glass";
    static Table read(const energy::Surface& s, const std::string& text, const std::string& path) {
        return energy::read_kept_glass(s, text, path);
    }
    static Table measured(const runtime::Device& d, const energy::Surface& s) {
        return energy::measured_glass(d, s);
    }
};

// A folder of the user for what can be made again; empty where there is none.
std::string default_cache() {
    if (const char* folder = std::getenv("XDG_CACHE_HOME"); folder && *folder)
        return std::string(folder) + "/clvndf";
    if (const char* home = std::getenv("HOME"); home && *home) return std::string(home) + "/.cache/clvndf";
    return {};
}

// What was kept, if it is whole.
template <class Kind>
std::optional<typename Kind::Table> found(const Energy& e, const std::string& path, const Common& common) {
    std::ifstream file(path, std::ios::binary);
    if (!file) return {};
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    try {
        return Kind::read(e.surface, text, path);
    } catch (const InputError& error) {
        if (!common.quiet) remark("clvndf: {}; it is made again\n", error.what());
        return {};
    }
}

// A table that cannot be kept is made all the same.
template <class Table>
void keep(const Table& table, const std::string& path, const Common& common) {
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

template <class Kind>
void run(const Energy& e, const Common& common) {
    OutputFile output(e.output);
    const std::string path =
        e.cache.empty() ? ""
                        : fmt::format("{}/{}-{}-{}", e.cache, Kind::prefix, e.surface.ndf, e.surface.masking);
    std::optional<typename Kind::Table> table;
    if (!path.empty()) table = found<Kind>(e, path, common);
    if (!table) {
        Target target;
        target.device = e.device;
        table = Kind::measured(target.choose(common), e.surface);
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
    command->add_option("--of", e->of, "surface: conductor or glass")
        ->check(CLI::IsMember({"conductor", "glass"}))
        ->capture_default_str();
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
    command->callback([e, &common] {
        common.action = [e, &common] {
            e->of == "glass" ? run<Glass>(*e, common) : run<Conductor>(*e, common);
        };
    });
}

}  // namespace vndf::cli
