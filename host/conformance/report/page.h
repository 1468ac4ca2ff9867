// A run as one HTML page that needs no other file: a row a function, and what its histograms and means looked like.
#pragma once

#include <string>

#include "conformance/report/report.h"

namespace vndf::conformance {

struct PageOptions {
    std::string software;  // "clvndf 1.0"
    bool all = false;      // functions that pass in full, too
    // Commands that evaluate a function at rows of CSV on the standard input, and that check it alone as this run did.
    CommandOf evaluate, check;
};

// The same run makes the same page.
std::string format_page(const Report& report, const PageOptions& options);

}  // namespace vndf::conformance
