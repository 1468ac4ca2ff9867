// A test case that this machine cannot run, on either version of Catch2 (2 has no SKIP).
#pragma once

#include <cstdio>
#include <string>

#include "catch.h"

namespace vndf {

// What main.cpp exits with if nothing failed and something was skipped; ctest then reports the file as skipped, not as
// passed (SKIP_RETURN_CODE).
inline constexpr int skip_status = 77;
inline int skipped_cases = 0;

inline void note_skip(const std::string& reason) {
    ++skipped_cases;
    std::printf("skipped: %s: %s\n", Catch::getResultCapture().getCurrentTestName().c_str(), reason.c_str());
}

}  // namespace vndf

// Ends the test case.
#define VNDF_SKIP(reason)          \
    do {                           \
        ::vndf::note_skip(reason); \
        return;                    \
    } while (false)
