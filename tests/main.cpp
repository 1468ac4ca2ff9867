// Catch2 2.13 compiles its runner here; Catch2 3 has it in its library.
#define CATCH_CONFIG_RUNNER
#include "support/skip.h"

// 0 all passed, 1 something failed, 77 nothing failed and something was skipped. Catch's own status is the number of
// failures, which could be 77 as well.
int main(int argc, char** argv) {
    if (Catch::Session().run(argc, argv) != 0) return 1;
    return vndf::skipped_cases ? vndf::skip_status : 0;
}
