// The pointwise part of `clvndf check` on the host build, for tests/random_mutants.py, which compiles
// host/runtime/host_build.cpp with a changed header and links it in here.
//
//   mutant_host float|double strict|builtin POINTS STRIDE           "NAME HASH" of the results, for each function
//   mutant_host float|double strict|builtin POINTS STRIDE HASHES
//
// Inputs: those of the check, with POINTS random ones and every STRIDEth hard one. The second form prints "changed NAME"
// for each function whose hash is not the one in the file HASHES, then checks these until one fails:
// "caught NAME: CHECK ...". Exit status 0, whatever it finds.
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <set>
#include <string>

#include <fmt/format.h>

#include "conformance/judge/pointwise.h"

using namespace vndf;

namespace {

// FNV-1a; every NaN counts as the same.
std::string hash_line(runtime::Evaluator& host, const Function& f,
                      const conformance::PointwiseOptions& options) {
    const auto table = conformance::pointwise_table(f, host.input_real(), options);
    std::uint64_t hash = 0xcbf29ce484222325;
    for (const auto& column : conformance::evaluate(host, f, table))
        for (const double x : column)
            hash = (hash ^ (std::isnan(x) ? 1 : std::bit_cast<std::uint64_t>(x))) * 0x100000001b3;
    return fmt::format("{} {:016x}", f.name, hash);
}

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
    if (argc != 5 && argc != 6) return 2;
    const runtime::Real real = std::string(argv[1]) == "double" ? runtime::Real::f64 : runtime::Real::f32;
    conformance::PointwiseOptions options;
    options.math = std::string(argv[2]) == "builtin" ? runtime::Math::builtin : runtime::Math::strict;
    options.random_points = std::strtoul(argv[3], nullptr, 10);
    options.hard_stride = std::strtoul(argv[4], nullptr, 10);
    runtime::HostEvaluator host(options.math, real);
    std::set<std::string> known;
    if (argc == 6) {
        std::ifstream file(argv[5]);
        for (std::string line; std::getline(file, line);) known.insert(line);
    }
    std::vector<const Function*> changed;
    for (const Function& f : functions()) {
        const std::string line = hash_line(host, f, options);
        if (argc == 5) fmt::print("{}\n", line);
        if (argc == 6 && !known.count(line)) changed.push_back(&f);
    }
    for (const Function* f : changed) fmt::print("changed {}\n", f->name);
    for (const Function* f : changed)
        if (judge(host, *f, options)) break;
    return 0;
}
