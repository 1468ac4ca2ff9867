// Each stage is vectorised across work-items on PoCL, for the effects of every built-in scene and for all of them; those
// that cannot be are named.
#include <cstdlib>
#include <set>

#include "scenes.h"
#include "support/command.h"
#include "support/shard.h"
#include "support/skip.h"
#include "support/vectoriser.h"

using namespace vndf;
using namespace vndf::test;

namespace {

// A walk through a tree has no fixed number of steps; counts of paths add up one after the other.
const std::set<std::string> serial{"packets", "traverse", "shadow", "count", "offsets", "list"};

// What is not as it should be: stages that are vectorised and need not be, and the other way round.
std::string surprises(const std::map<std::string, Remarks>& all,
                      const std::set<std::string>& named = serial) {
    std::map<std::string, Remarks> others = all;
    std::string text;
    for (const std::string& stage : named) {
        const auto found = others.find(stage);
        if (found == others.end()) continue;
        if (vectorised(found->second)) text += stage + ": vectorised, and is said not to be\n";
        others.erase(found);
    }
    return text + not_vectorised(others);
}

std::map<std::string, Remarks> remarks_of_command(const std::string& options) {
    const Folder folder;
    CHECK(shell(folder,
                "mkdir cache; POCL_VECTORIZER_REMARKS=1 POCL_CACHE_DIR=$PWD/cache \"$clvndf\" --quiet render "
                "--size 16x8 --spp 1 -o a.png " +
                    options + " >out 2>&1") == 0);
    return remarks_in(folder.read("out"), "vndf_render_");
}

// The stages that know materials, with these switches; the others come from the cache.
std::string surprises_with(const std::string& switches, const Folder& cache) {
    auto all = remarks_in(remarks_of("renders with switches of the environment",
                                     "CLVNDF_REMARKS_SWITCHES='" + switches + "'", cache.string()),
                          "vndf_render_");
    all["surface"], all["connect"], all["scatter"];  // without remarks: not vectorised
    // Draws that are there to compare with evaluate what they have drawn: LLVM packs the halves.
    std::set<std::string> named = serial;
    if (switches.find("VNDF_DRAW") != std::string::npos) named.insert("scatter");
    const std::string text = surprises(all, named);
    return text.empty() ? text : switches + ":\n" + text;
}

}  // namespace

TEST_CASE("renders with switches of the environment", "[.]") {
    const char* switches = std::getenv("CLVNDF_REMARKS_SWITCHES");
    if (!switches) return;  // not the child process of surprises_with()
    const auto stages = render::device_stages(runtime::choose_device().device, runtime::Math::strict,
                                              {"-DVNDF_RANDOM=sobol", switches});
    rendered(floor_of(render::conductor({1, 1, 1}, 0.5f, 0.5f), 0.5), 8, 8, 1).on(*stages);
}

TEST_CASE("every stage of the renderer is vectorised on PoCL, but those that cannot be") {
    if (!on_pocl()) VNDF_SKIP(not_pocl);
    for (const std::string options :
         {"", "--effects all", "--effects all --random philox", "--orbs diffuse", "--orbs anisotropy",
          "--orbs metals", "--effects all --light-radius 0.3 --lights-by cones"}) {
        CAPTURE(options);
        const auto all = remarks_of_command(options);
        CHECK(all.size() >= 12);
        CHECK(surprises(all) == "");
    }
}

// By hand.
TEST_CASE("stages that know materials are vectorised for every choice", "[.stages-vectorised]") {
    std::vector<std::string> all;
    const auto add = [&](const Effects& material, const std::string& more) {
        std::string switches;
        for (const std::string& macro : material.macros()) switches += "-D" + macro + ' ';
        all.push_back(switches + more);
    };
    for (const Effects& material : materials_of_every_choice()) {
        add(material, "");
        const bool plain = material.choices.at("sampling") == "plain";
        if (plain && std::ranges::all_of(material.on, [](const auto& effect) { return effect.second; }))
            for (const char* draw : {"-DVNDF_DRAW=ndf", "-DVNDF_DRAW=cosine"}) add(material, draw);
    }
    const Folder cache;
    const auto [part, parts] = shard();
    for (std::size_t i = part; i < all.size(); i += parts) CHECK(surprises_with(all[i], cache) == "");
}
