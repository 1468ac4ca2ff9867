// How a function of the registry becomes an entry point over arrays.
//
// Arguments: one array for each scalar that the function takes, one for each that it returns, in the registry's
// order, then the index of the first item in them, 0 unless a table goes through in parts. Launch in whole groups of a fixed
// local size (64), with arrays as long as the global size: no bound is compared with, since an `if` around the body masks
// every operation on PoCL and costs a factor of 3, and a second body for the last group costs time to build.
//
// Separate arrays and scalar loads and stores, because a CPU device turns them into vector code across items.
#ifndef VNDF_BATCH_ENTRY_POINT_H
#define VNDF_BATCH_ENTRY_POINT_H

#include "shapes.h"

#define VNDF_BATCH_IN(v) __global const VNDF_REAL *restrict in_##v,
#define VNDF_BATCH_OUT(v, member) __global VNDF_REAL *restrict out_##v,
#define VNDF_BATCH_LOAD(v) const VNDF_REAL v = in_##v[i];
#define VNDF_BATCH_STORE(v, member) out_##v[i] = result member;

// Macros that stand for statements:
// clang-format off
#define VNDF_BATCH_BODY(function, arguments, result_)                                                        \
    VNDF_SCALARS_##arguments(VNDF_BATCH_LOAD)                                                                \
    const VNDF_TYPE_##result_ result = function(VNDF_CALL_##arguments);                                      \
    VNDF_RESULTS_##result_(VNDF_BATCH_STORE)

#define VNDF_ENTRY_POINT(kernel_name, function, arguments, result_)                                          \
    __kernel void kernel_name(VNDF_SCALARS_##arguments(VNDF_BATCH_IN)                                        \
                                  VNDF_RESULTS_##result_(VNDF_BATCH_OUT) const uint first) {                 \
        const size_t i = first + get_global_id(0);                                                           \
        VNDF_BATCH_BODY(function, arguments, result_)                                                        \
    }

// clang-format on

#endif
