// clvndf list
#include <algorithm>
#include <memory>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/commands.h"
#include "cli/streams.h"
#include "registry.h"
#include "registry_json.h"

namespace vndf::cli {
namespace {

void print_table() {
    std::size_t widest = 0;
    for (const Function& f : functions()) widest = std::max(widest, f.name.size());
    for (const Function& f : functions()) {
        put("{:{}}  {:8}  {} -> {}\n", f.name, widest, to_string(f.kind), fmt::join(f.inputs, ","),
            fmt::join(f.outputs, ","));
    }
}

}  // namespace

void add_list(CLI::App& app, Common& common) {
    CLI::App* command = app.add_subcommand("list", "the functions, with their arguments and results");
    const auto json = std::make_shared<bool>(false);
    command->add_flag("--json", *json, "everything that the registry knows, as JSON");
    command->callback([json, &common] {
        common.action = [json] { *json ? put("{}\n", registry_json()) : print_table(); };
    });
}

}  // namespace vndf::cli
