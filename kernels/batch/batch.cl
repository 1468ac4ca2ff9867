// One entry point for each registered function: vndf_batch_<name>, arrays in, arrays out.
//
// Arguments: one array for each scalar that the function takes, one for each that it returns, in the registry's
// order, then the number of items. Launch with a fixed local size (64), the global size padded to its multiple.
//
// Separate arrays and scalar loads and stores, because a CPU device turns them into vector code across items.
#include "../vndf/vndf.h"
#include "shapes.h"

#define VNDF_BATCH_IN(v) __global const VNDF_REAL *restrict in_##v,
#define VNDF_BATCH_OUT(v, member) __global VNDF_REAL *restrict out_##v,
#define VNDF_BATCH_LOAD(v) const VNDF_REAL v = in_##v[i];
#define VNDF_BATCH_STORE(v, member) out_##v[i] = result member;

#define VNDF_BATCH_BODY(name, arguments, result_)                                                            \
    VNDF_SCALARS_##arguments(VNDF_BATCH_LOAD)                                                                \
    const VNDF_TYPE_##result_ result = name(VNDF_CALL_##arguments);                                          \
    VNDF_RESULTS_##result_(VNDF_BATCH_STORE)

// Whole groups take the first branch, whose condition is the same for every item of a group: an `if (i < count)`
// alone masks every operation on PoCL and costs a factor of 3.
#define VNDF_BATCH(name, arguments, result_)                                                                 \
    __kernel void vndf_batch_##name(VNDF_SCALARS_##arguments(VNDF_BATCH_IN)                                  \
                                        VNDF_RESULTS_##result_(VNDF_BATCH_OUT) const uint count) {           \
        const size_t i = get_global_id(0);                                                                   \
        if ((get_group_id(0) + 1) * get_local_size(0) <= count) {                                            \
            VNDF_BATCH_BODY(name, arguments, result_)                                                        \
        } else if (i < count) {                                                                              \
            VNDF_BATCH_BODY(name, arguments, result_)                                                        \
        }                                                                                                    \
    }

#define VNDF_SAMPLER(name, ndf, arguments, result, density, method, domain, p99_front, p99_back, source)     \
    VNDF_BATCH(name, arguments, result)                                                                      \
    VNDF_BATCH(name##_with_pdf, arguments, result##_PDF)
#define VNDF_FUNCTION(name, ndf, arguments, result, kind, bound, source) VNDF_BATCH(name, arguments, result)
#include "../samplers.def"

#undef VNDF_BATCH
#undef VNDF_BATCH_BODY
#undef VNDF_BATCH_STORE
#undef VNDF_BATCH_LOAD
#undef VNDF_BATCH_OUT
#undef VNDF_BATCH_IN
