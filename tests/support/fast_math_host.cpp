// The promise of fast math for the host build, whatever fast_math_build.cpp was compiled with: the table of `clvndf policies
// --flags` for it.
//
//   fast_math_host NAME [--quick]      exit status 0: the promise is kept, 1: not
#include <cstdio>
#include <cstring>

#include "support/fast_math.h"

int main(int argc, char** argv) {
    using namespace vndf;
    std::vector<const Function*> all;
    for (const Function& function : functions()) all.push_back(&function);
    conformance::CheckOptions options;
    options.quick = argc > 2 && std::strcmp(argv[2], "--quick") == 0;
    const auto report = conformance::measure_host_fast_math(argc > 1 ? argv[1] : "fast math", all, options);
    std::fputs(conformance::format_table(report).c_str(), stdout);
    return report.passed() ? 0 : 1;
}
