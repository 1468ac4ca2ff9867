// Each stage is vectorised across work-items on PoCL, for the effects of every built-in scene and for all of them; those
// that cannot be are named.
#include <map>
#include <regex>
#include <set>

#include "runtime/devices.h"
#include "support/command.h"
#include "support/skip.h"

using namespace vndf;

namespace {

// A walk through a tree has no fixed number of steps; counts of paths add up one after the other.
const std::set<std::string> serial{"packets", "traverse", "shadow", "rank", "offsets"};

struct Remarks {
    int vectorised = 0, failures = 0;
};

std::map<std::string, Remarks> remarks(const std::string& options) {
    const Folder folder;
    CHECK(shell(folder,
                "mkdir cache; POCL_VECTORIZER_REMARKS=1 POCL_CACHE_DIR=$PWD/cache \"$clvndf\" --quiet render "
                "--size 16x8 --spp 1 -o a.png " +
                    options + " >out 2>&1") == 0);
    static const std::regex said(
        R"(inlined into '(?:_pocl_kernel_)?vndf_render_([a-z]+)|(vectorized loop \(vectorization width)|(loop not vectorized: ))");
    std::map<std::string, Remarks> all;
    std::string stage;
    const std::string text = folder.read("out");
    for (std::sregex_iterator i(text.begin(), text.end(), said), end; i != end; ++i) {
        if ((*i)[1].matched)
            stage = (*i)[1];
        else if (!stage.empty())
            ++((*i)[2].matched ? all[stage].vectorised : all[stage].failures);
    }
    return all;
}

}  // namespace

TEST_CASE("every stage of the renderer is vectorised on PoCL, but those that cannot be") {
    if (runtime::choose_device().device.platform != "Portable Computing Language")
        VNDF_SKIP("the vectoriser's remarks are PoCL's, and the chosen device is another's");
    for (const std::string options : {"", "--effects all", "--effects all --random philox", "--orbs diffuse",
                                      "--orbs anisotropy", "--orbs metals"}) {
        CAPTURE(options);
        const auto all = remarks(options);
        CHECK(all.size() >= 12);
        for (const auto& [stage, said] : all) {
            CAPTURE(stage, said.vectorised, said.failures);
            CHECK(((said.vectorised > 0 && said.failures == 0) != serial.contains(stage)));
        }
    }
}
