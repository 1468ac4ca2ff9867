// The digests of the strict float host build, for tests/same_bits.sh, which compiles this and what it stands on with one
// compiler and set of options after the other. Usage: digest_host [--quick]
#include <cstdio>
#include <string_view>

#include "conformance/judge/digest.h"

int main(int argc, char** argv) {
    using namespace vndf;
    conformance::BitsOptions options;
    if (argc > 1 && std::string_view(argv[1]) == "--quick") options.rows = conformance::quick_digest_rows;
    runtime::HostEvaluator host(runtime::Math::strict, runtime::Real::f32);
    std::vector<const Function*> all;
    for (const Function& function : functions()) all.push_back(&function);
    std::fputs(conformance::format_digests(conformance::digests(host, all, options)).c_str(), stdout);
}
