// The command where something that it needs is short or shut.
#include <string>

#include "support/catch.h"
#include "support/command.h"

namespace {

using namespace vndf;
using Catch::Matchers::ContainsSubstring;

const std::string header = "w_x,w_y,w_z,alpha_x,alpha_y\n";

}  // namespace

#if !defined(__SANITIZE_ADDRESS__)  // which reserves terabytes
TEST_CASE("too little memory ends a command with an error, soon and without a signal") {
    // From too little to load a driver, by way of its threads and its compiler, to enough.
    for (const char* kib : {"200000", "260000", "300000", "350000", "500000", "1000000", "2000000"}) {
        CAPTURE(kib);
        // A cache of its own: the compiler runs.
        const Outcome run = clvndf_after("export POCL_CACHE_DIR=$PWD/cache; ulimit -v " + std::string(kib),
                                         "eval vndf_ggx_g1", header + "0.6,0,0.8,0.5,0.1\n");
        CAPTURE(run.status, run.out, run.err);
        CHECK((run.status == 0 || run.status == 2 || run.status == 3));
        CHECK((run.status == 0) == (run.out == "value\n0.9671178\n"));
        CHECK((run.status == 0) == run.err.empty());
        if (run.status != 0) CHECK_THAT(run.err, ContainsSubstring("clvndf: "));
    }
}
#endif

TEST_CASE(
    "a driver that is installed but offers no device is not to be installed: the error says what it lacks") {
    const std::string unset = "unset POCL_CACHE_DIR XDG_CACHE_HOME; ";
    const std::pair<std::string, std::string> cases[] = {
        {"export POCL_CACHE_DIR=/dev/null/x", "'/dev/null/x' (Not a directory)"},
        {unset + "export XDG_CACHE_HOME=/dev/null/y", "'/dev/null/y/pocl/kcache' (Not a directory)"},
        {unset + "export HOME=/dev/null", "'/dev/null/.cache/pocl/kcache' (Not a directory)"}};
    for (const auto& [before, folder] : cases) {
        const Outcome run = clvndf_after(before, "eval vndf_ggx_g1 --device 'portable computing'", header);
        CAPTURE(before, run.status, run.err);
        CHECK(run.status == 3);
        CHECK(one_line(run.err));
        CHECK_THAT(run.err,
                   ContainsSubstring("'Portable Computing Language' is installed but offers no device"));
        CHECK_THAT(run.err, ContainsSubstring("cannot write to its cache folder " + folder));
        CHECK_THAT(run.err, !ContainsSubstring("install an implementation"));
    }
}

TEST_CASE("where no driver is found, the error says what to install, and what hides those there are") {
    for (const std::string command : {"devices", "eval vndf_ggx_g1"}) {
        const Outcome run = clvndf_after("export OCL_ICD_VENDORS=/nonexistent", command, header);
        CAPTURE(command, run.err);
        CHECK(run.status == 3);
        CHECK(one_line(run.err));
        CHECK_THAT(run.err, ContainsSubstring("install an implementation such as pocl-opencl-icd"));
        CHECK_THAT(run.err, ContainsSubstring("OCL_ICD_VENDORS is '/nonexistent'"));
    }
}
