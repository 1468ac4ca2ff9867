// clvndf devices
#include <fmt/format.h>

#include "cli/commands.h"
#include "cli/streams.h"
#include "error.h"
#include "runtime/no_device.h"

namespace vndf::cli {
namespace {

std::string_view yes_no(bool b) {
    return b ? "yes" : "no";
}

void print(const runtime::Device& d) {
    put("{}\n", d.label());
    put("  {:32}{}\n", "platform version", d.platform_version);
    put("  {:32}{}\n", "driver version", d.driver);
    put("  {:32}{}\n", "OpenCL C version", d.c_version);
    put("  {:32}{}\n", "compiler", yes_no(d.compiler));
    put("  {:32}{}\n", "double (fp64)", yes_no(d.fp64));
    put("  {:32}{}\n", "fma in hardware", yes_no(d.fma));
    put("  {:32}{}\n", "denormals", yes_no(d.denormals));
    put("  {:32}{}\n", "correctly rounded / and sqrt", yes_no(d.correct_divide_sqrt));
    put("  {:32}{}\n", "compute units", d.compute_units);
    put("  {:32}{} MHz\n", "clock", d.clock_mhz);
    put("  {:32}{}\n", "largest work-group", d.group_limit);
    put("  {:32}{:.1f} GiB\n", "memory", static_cast<double>(d.memory_bytes) / (1u << 30));
    put("  {:32}{} bits\n", "addresses", d.address_bits);
}

void print_devices() {
    const auto devices = runtime::devices();
    if (devices.empty()) throw DeviceError(runtime::no_device());
    for (const runtime::Device& device : devices) print(device);
}

}  // namespace

void add_devices(CLI::App& app, Common& common) {
    app.add_subcommand("devices", "every OpenCL device, with the capabilities that matter here")
        ->callback([&common] { common.action = print_devices; });
}

}  // namespace vndf::cli
