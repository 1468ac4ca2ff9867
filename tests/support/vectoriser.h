// What PoCL says of kernels that it turns, or does not turn, into vector code across work-items.
//
// POCL_VECTORIZER_REMARKS prints remarks while a kernel is compiled, none from a warm cache, and is read once when PoCL
// starts: a child process compiles. Remarks on loops name no kernel, but those of the inliner before them do, and kernels are
// compiled one after the other.
#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "command.h"
#include "effects.h"
#include "runtime/devices.h"

namespace vndf {

constexpr const char* not_pocl = "the vectoriser's remarks are PoCL's, and the chosen device is another's";
inline bool on_pocl() {
    return runtime::choose_device().device.platform == "Portable Computing Language";
}

struct Remarks {
    int vectorised = 0;
    std::vector<std::string> failures;
};
inline bool vectorised(const Remarks& remarks) {
    return remarks.vectorised > 0 && remarks.failures.empty();
}

// The kernel of "'vndf_batch_f'" or, of one that calls nothing, "'_pocl_kernel_vndf_batch_f_workgroup'": f. Empty for others.
inline std::string kernel_of(std::string_view text, std::string_view prefix) {
    constexpr std::string_view before = "_pocl_kernel_", behind = "_workgroup";
    text = text.substr(0, text.find('\''));
    if (text.starts_with(before)) text = text.substr(before.size(), text.find(behind) - before.size());
    return text.starts_with(prefix) ? std::string(text.substr(prefix.size())) : std::string();
}

// By kernel, named without the prefix that they share: what was said about its loops.
inline std::map<std::string, Remarks> remarks_in(std::string_view text, std::string_view prefix) {
    constexpr std::string_view inlined = "inlined into '", success = "vectorized loop (vectorization width: ",
                               failure = "loop not vectorized: ";
    std::map<std::string, Remarks> all;
    Remarks* current = nullptr;
    for (std::size_t at = 0; at < text.size(); ++at) {
        const std::string_view rest = text.substr(at);
        if (rest.starts_with(inlined)) {
            const std::string kernel = kernel_of(rest.substr(inlined.size()), prefix);
            if (!kernel.empty()) current = &all[kernel];
        } else if (current && rest.starts_with(success)) {
            ++current->vectorised;
        } else if (current && rest.starts_with(failure)) {
            current->failures.emplace_back(rest.substr(0, rest.find('<')));
        }
    }
    return all;
}

// The kernels that are not vectorised, one a line, with the first reason given.
inline std::string not_vectorised(const std::map<std::string, Remarks>& all) {
    std::string names;
    for (const auto& [name, remarks] : all) {
        if (vectorised(remarks)) continue;
        names += name + ": " + (remarks.failures.empty() ? "no remark on a loop" : remarks.failures.front()) +
                 "\n";
    }
    return names;
}

// Everything that a test case of this program prints, run by a process of its own with these variables ("A='b' C='d'") and
// whatever it compiles into `cache`, a folder's name.
inline std::string remarks_of(const std::string& test_case, const std::string& variables,
                              const std::string& cache) {
    const Folder folder;
    const int status =
        shell(folder, "mkdir -p '" + cache + "'; POCL_VECTORIZER_REMARKS=1 POCL_CACHE_DIR='" + cache + "' " +
                          variables + " '" + std::filesystem::read_symlink("/proc/self/exe").string() +
                          "' '" + test_case + "' >remarks 2>&1");
    const std::string text = folder.read("remarks");
    INFO(text.substr(text.size() - std::min<std::size_t>(text.size(), 2000)));
    REQUIRE(status == 0);
    return text;
}

// Materials of every choice, each with everything on, with each effect off, and with one lobe alone.
inline std::vector<Effects> materials_of_every_choice() {
    std::vector<std::string> lists{"all", "conductor", "dielectric", "lambert"};
    for (const Effect& off : effects()) {
        std::string list;
        for (const Effect& on : effects())
            if (on.name != off.name) list += (list.empty() ? "" : ",") + on.name;
        lists.push_back(list);
    }
    std::vector<Effects> all;
    std::set<std::vector<std::string>> seen;
    for (const char* model :
         {"ndf=ggx,sampling=plain", "ndf=ggx,sampling=bounded", "ndf=ggx,sampling=conic", "ndf=beckmann"})
        for (const char* fresnel : {"none", "conductor", "schlick", "f82"})
            for (const char* masking : {"correlated", "separable"})
                for (const char* energy : {"none", "turquin", "kulla_conty"})
                    for (const std::string& list : lists) {
                        Effects one =
                            parse_effects(list + ',' + model + ",fresnel=" + fresnel + ",masking=" + masking);
                        one.choices.at("energy") = energy;
                        // The models of energy are a conductor's.
                        if (energy != std::string("none") && !one.on.at("conductor")) continue;
                        if (seen.insert(one.macros()).second) all.push_back(one);
                    }
    return all;
}

}  // namespace vndf
