// What cannot run is reported as skipped, never as passed, and hides no failure.
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>

#include "support/catch.h"
#include "support/skip.h"

namespace {

// The exit status of this program with only the cases `which`.
int run_alone(const std::string& which) {
    const std::string program = std::filesystem::read_symlink("/proc/self/exe").string();
    const int status = std::system(("'" + program + "' '" + which + "' >/dev/null").c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace

TEST_CASE("a skipped case", "[.planted_skip]") {
    VNDF_SKIP("to see what comes of it");
    FAIL("run on");
}
TEST_CASE("77 failed cases", "[.planted_failures]") {
    for (int i = 0; i < 77; ++i) CHECK(i < 0);
}
TEST_CASE("a passed case", "[.planted_pass]") {
    CHECK(true);
}

TEST_CASE("a run with a skipped case is skipped, unless something failed") {
    CHECK(run_alone("[.planted_pass]") == 0);
    CHECK(run_alone("[.planted_pass],[.planted_skip]") == vndf::skip_status);
    CHECK(run_alone("[.planted_failures]") == 1);
    CHECK(run_alone("[.planted_failures],[.planted_skip]") == 1);
}
