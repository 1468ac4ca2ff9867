#include "cli/driver_failure.h"

#include <csignal>
#include <cstddef>
#include <new>

#include <unistd.h>

#include "cli/leftovers.h"

namespace vndf::cli {
namespace {

// At once, without another call of the driver: safe wherever it may stand.
template <std::size_t size>
[[noreturn]] void give_up(const char (&line)[size]) {
    remove_leftovers();
    [[maybe_unused]] const auto written = write(STDERR_FILENO, line, size - 1);
    _exit(3);
}

}  // namespace

void end_where_drivers_fail() {
    // An exception of `new` that left the driver's code would leave its locks taken, and the release of whatever we
    // hold would then wait for ever.
    std::set_new_handler([] { give_up("clvndf: out of memory\n"); });
    std::signal(SIGABRT, [](int) {
        give_up("clvndf: aborted, as OpenCL drivers do that lack memory; the reason they give is above\n");
    });
}

}  // namespace vndf::cli
