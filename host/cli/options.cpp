#include <fmt/ranges.h>

#include "cli/options.h"

#include "conformance/runs/check.h"

namespace vndf::cli {

CLI::Option* add_device(CLI::App& command, std::string& device, const std::string& several) {
    std::string description =
        "first device whose platform or device name contains this; with #N behind it the N-th of them\n"
        "(default: $CLVNDF_DEVICE, else PoCL's CPU device, else the first device with a compiler)";
    if (!several.empty())
        description += ";\nall, or all:NAME: every device, or all of that name, which " + several;
    return command.add_option("--device", device, description);
}

CLI::Option* add_only(CLI::App& command, std::string& pattern) {
    return command.add_option("--only", pattern,
                              "only functions whose name contains this, or matches it with * and ?");
}

CLI::Option* add_kernel(CLI::App& command, conformance::UserOptions& user, const std::string& kernel,
                        const std::string& as, const std::string& function) {
    CLI::Option* file = command.add_option("--kernel", user.file, kernel)->type_name("FILE");
    const auto needed = [&](const char* name, std::string& value, const std::string& description) {
        file->needs(command.add_option(name, value, description)->needs(file));
    };
    if (!function.empty()) needed("--function", user.function, function);
    needed("--as", user.as, as);
    command.add_option("--options", user.options, "build options for the file")->needs(file);
    return file;
}

CLI::Option* add_alpha(CLI::App& command, conformance::AlphaRange& range, const std::string& description) {
    const auto parse = [&range](const std::string& text) {
        const char *const first = text.data(), *const last = first + text.size();
        const auto low = std::from_chars(first, last, range.low);
        const bool colon = low.ec == std::errc() && low.ptr != last && *low.ptr == ':';
        const auto high = std::from_chars(colon ? low.ptr + 1 : last, last, range.high);
        if (!colon || high.ec != std::errc() || high.ptr != last || !(range.low >= 1e-8) ||
            !(range.low <= range.high) || !(range.high <= 1e3))
            throw InputError(
                fmt::format("--alpha: '{}' is no range LO:HI with 1e-8 <= LO <= HI <= 1000", text));
    };
    return command.add_option_function<std::string>("--alpha", parse, description)->type_name("LO:HI");
}

std::vector<const Function*> selected_by(const std::string& pattern) {
    auto selected = conformance::select(pattern);
    if (!selected.empty()) return selected;
    throw InputError(
        fmt::format("--only '{}': no function of that name; the nearest are {} (see clvndf list)", pattern,
                    fmt::join(nearest_names(pattern), ", ")));
}

}  // namespace vndf::cli
