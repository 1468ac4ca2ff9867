// The forms in which a function is measured: math policies and types, the listings, other build options and layouts.
#pragma once

#include <string>
#include <vector>

#include "registry.h"
#include "runtime/devices.h"
#include "runtime/program.h"

namespace vndf::bench {

// stream: arrays in memory. The others run on arrays that stay in a cache: compute with one lobe, cached with a lobe of its own
// for each sample, half of them back-facing where that is valid; cached_front: none back-facing.
enum class Mode { stream, compute, cached, cached_front };
std::string to_string(Mode);

struct Rung {
    std::string name;  // RUNG of FUNCTION/RUNG/REAL/MODE
    std::vector<Mode> modes;
    runtime::Math math = runtime::Math::strict;
    runtime::Real real = runtime::Real::f32;
    std::string callee;                           // the OpenCL C function behind it
    std::string root = "kernels/batch/batch.cl";  // the source with its entry point
    std::string flags = {};                       // instead of -cl-fp32-correctly-rounded-divide-sqrt
    std::string layout = {};  // of bench/layouts.cl, or "readme"; empty: an array for each scalar
    bool same_map = true;     // whether the function's reference is its own
    bool on_device = true;    // or the C++ build
    const runtime::ProgramOptions* program =
        nullptr;  // that holds a function of somebody else, in place of the library's

    // "strict/float"
    std::string key() const { return name + "/" + std::string(runtime::to_string(real)); }
};

std::vector<Rung> rungs(const Function& function, const runtime::Device& device);

// The function in strict float once more, as "strict_again" and a number: what it differs by is noise.
Rung again(const Function& function, std::size_t number);

// What is to be measured together, the smallest first: strict float with what it is compared with; other policies; double; other
// options and layouts.
int batch_of(const Rung& rung);

// FUNCTION/RUNG/REAL/MODE, the name of an entry; and its parts, of which copies ("copy_40B/stream") have no form.
std::string entry_name(const Function& function, const std::string& form, Mode mode);
struct EntryName {
    std::string function, form, mode;  // form: "strict/float"
};
EntryName split(const std::string& entry);

// Those of a quick run: strict float, lean and factored.
bool is_quick(const Rung& rung);

// Whether the listing of this function's paper is among those ported.
bool is_published(const Function& function);

}  // namespace vndf::bench
