#include "cli/options.h"

#include "conformance/runs/check.h"

namespace vndf::cli {

CLI::Option* add_device(CLI::App& command, std::string& device) {
    return command.add_option(
        "--device", device,
        "first device whose platform or device name contains this\n(default: $CLVNDF_DEVICE, else "
        "PoCL's CPU device, else the first device)");
}

CLI::Option* add_only(CLI::App& command, std::string& pattern) {
    return command.add_option("--only", pattern,
                              "only functions whose name contains this, or matches it with * and ?");
}

std::vector<const Function*> selected_by(const std::string& pattern) {
    auto selected = conformance::select(pattern);
    if (!selected.empty()) return selected;
    throw InputError(
        fmt::format("--only '{}': no function of that name; the nearest are {} (see clvndf list)", pattern,
                    fmt::join(nearest_names(pattern), ", ")));
}

}  // namespace vndf::cli
