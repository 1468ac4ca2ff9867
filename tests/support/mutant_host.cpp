// The pointwise part of `clvndf check` on the host build, for tests/random_mutants.py, which compiles
// host/runtime/host_build.cpp with a changed header and links it in here.
//
//   mutant_host float|double strict|builtin ROWS     the digests (digest.h) of ROWS inputs a function
//   mutant_host float|double strict|builtin ROWS DIGESTS POINTS STRIDE
//
// The second form prints "changed NAME" for each function whose digest is not the one in the file DIGESTS, then checks
// these with POINTS random points and every STRIDEth hard one until one fails: "caught NAME: CHECK ...".
// Exit status 0, whatever it finds.
#include <cstdlib>
#include <fstream>
#include <set>
#include <string>

#include <fmt/format.h>

#include "conformance/judge/digest.h"
#include "conformance/judge/pointwise.h"

using namespace vndf;

namespace {

// Whether the function is caught.
bool judge(runtime::Evaluator& host, const Function& f, const conformance::PointwiseOptions& options) {
    for (const conformance::Finding& finding : conformance::check_pointwise(host, f, options)) {
        if (finding.passed()) continue;
        fmt::print("caught {}: {}: {:.3g} of {:.3g} {} at {}\n", f.name, finding.check, finding.figure,
                   finding.limit, finding.unit, finding.worst);
        return true;
    }
    return false;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 4 && argc != 7) return 2;
    const runtime::Real real = std::string(argv[1]) == "double" ? runtime::Real::f64 : runtime::Real::f32;
    const runtime::Math math =
        std::string(argv[2]) == "builtin" ? runtime::Math::builtin : runtime::Math::strict;
    runtime::HostEvaluator host(math, real);
    conformance::BitsOptions bits;
    bits.rows = std::strtoul(argv[3], nullptr, 10), bits.math = math;
    std::vector<const Function*> all;
    for (const Function& function : functions()) all.push_back(&function);
    const auto digests = conformance::digests(host, all, bits);
    if (argc == 4) {
        fmt::print("{}", conformance::format_digests(digests));
        return 0;
    }
    std::ifstream file(argv[4]);
    std::set<std::string> known;
    for (std::string line; std::getline(file, line);) known.insert(line + "\n");
    std::vector<const Function*> changed;
    for (const auto& digest : digests)
        if (!known.count(conformance::format_digests({digest}))) changed.push_back(digest.function);
    for (const Function* f : changed) fmt::print("changed {}\n", f->name);
    conformance::PointwiseOptions options;
    options.math = math;
    options.random_points = std::strtoul(argv[5], nullptr, 10);
    options.hard_stride = std::strtoul(argv[6], nullptr, 10);
    for (const Function* f : changed)
        if (judge(host, *f, options)) break;
    return 0;
}
