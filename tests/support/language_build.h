/* Every registered function over arrays, as in host/runtime/host_build.cpp, in the language that includes this: C, C++ or
 * CUDA, there on the CPU or, with ON_GPU, on the GPU. languages.sh puts it in place of the host build. */
#include <stddef.h>
#include <string.h>

#ifdef EMITTED /* emit.sh: one emitted file in place of the headers */
#include EMITTED
#define VNDF_REAL float
#define VNDF_REAL2 vndf_float2
#define VNDF_REAL3 vndf_float3
#define VNDF_REAL4 vndf_float4
#ifdef __cplusplus
#define VNDF_MAKE2(x, y) \
    vndf_float2 {        \
        x, y             \
    }
#define VNDF_MAKE3(x, y, z) \
    vndf_float3 {           \
        x, y, z             \
    }
#else
#define VNDF_MAKE2(x, y) ((vndf_float2){x, y})
#define VNDF_MAKE3(x, y, z) ((vndf_float3){x, y, z})
#endif
#else
#include "../../kernels/vndf/vndf.h"
#endif
#include "../../kernels/batch/shapes.h"

#define VNDF_HOST_IN(v) const VNDF_REAL* const in_##v = (const VNDF_REAL*)*inputs++;
#define VNDF_HOST_OUT(v, member) VNDF_REAL* const out_##v = (VNDF_REAL*)*outputs++;
#define VNDF_HOST_LOAD(v) const VNDF_REAL v = in_##v[i];
#define VNDF_HOST_STORE(v, member) out_##v[i] = result member;
#ifdef ON_GPU
#include "gpu_batch.h"
#else
#define VNDF_FUNCTION(name, arguments, result_)                                           \
    static void batch_##name(const void* const* inputs, void* const* outputs, size_t n) { \
        size_t i;                                                                         \
        VNDF_SCALARS_##arguments(VNDF_HOST_IN)                                            \
            VNDF_RESULTS_##result_(VNDF_HOST_OUT) for (i = 0; i < n; ++i) {               \
            VNDF_SCALARS_##arguments(VNDF_HOST_LOAD) const VNDF_TYPE_##result_ result =   \
                name(VNDF_CALL_##arguments);                                              \
            VNDF_RESULTS_##result_(VNDF_HOST_STORE)                                       \
        }                                                                                 \
    }
#endif
#include "../../kernels/registry.def"

typedef void (*function_of_language)(const void* const*, void* const*, size_t);
#ifdef __cplusplus
extern "C"
#endif
    function_of_language
    find_function_of_language(const char* name);

function_of_language find_function_of_language(const char* name) {
#define VNDF_FUNCTION(function, arguments, result) \
    if (strcmp(name, #function) == 0) return batch_##function;
#include "../../kernels/registry.def"
    return 0;
}
