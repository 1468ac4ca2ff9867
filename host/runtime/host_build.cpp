// kernels/vndf as C++: compiled once for each VNDF_REAL and VNDF_MATH, both set by CMake.
#include "runtime/host_build.h"

#include <cstring>

#include "../../kernels/vndf/vndf.h"
#include "../../kernels/batch/shapes.h"

namespace vndf::runtime {
namespace {

#define VNDF_HOST_IN(v) const VNDF_REAL* const in_##v = static_cast<const VNDF_REAL*>(*inputs++);
#define VNDF_HOST_OUT(v, member) VNDF_REAL* const out_##v = static_cast<VNDF_REAL*>(*outputs++);
#define VNDF_HOST_LOAD(v) const VNDF_REAL v = in_##v[i];
#define VNDF_HOST_STORE(v, member) out_##v[i] = result member;

#define VNDF_HOST(name, arguments, result_)                                             \
    void batch_##name(const void* const* inputs, void* const* outputs, std::size_t n) { \
        VNDF_SCALARS_##arguments(VNDF_HOST_IN)                                          \
            VNDF_RESULTS_##result_(VNDF_HOST_OUT) for (std::size_t i = 0; i < n; ++i) { \
            VNDF_SCALARS_##arguments(VNDF_HOST_LOAD) const VNDF_TYPE_##result_ result = \
                name(VNDF_CALL_##arguments);                                            \
            VNDF_RESULTS_##result_(VNDF_HOST_STORE)                                     \
        }                                                                               \
    }

#define VNDF_FUNCTION VNDF_HOST
#include "../../kernels/registry.def"

struct Entry {
    const char* name;
    HostFunction function;
};

constexpr Entry entries[] = {
#define VNDF_FUNCTION(name, arguments, result) {#name, batch_##name},
#include "../../kernels/registry.def"
};

}  // namespace

HostFunction VNDF_CAT(VNDF_CAT(find_host_function_, VNDF_REAL), VNDF_CAT(_, VNDF_MATH))(const char* name) {
    for (const Entry& entry : entries) {
        if (std::strcmp(entry.name, name) == 0) return entry.function;
    }
    return nullptr;
}

}  // namespace vndf::runtime
