// Kernels that only the benchmark needs, as OpenCL C to append to a program.
#pragma once

#include <cstddef>
#include <string>

#include "registry.h"
#include "runtime/evaluator.h"

namespace vndf::bench {

// How many work-groups' worth of items one group of a compute kernel goes through before it begins again.
struct ComputeShape {
    std::size_t groups, local, chunk;
    std::size_t items() const { return groups * local * chunk; }  // of its arrays
};

// vndf_compute: `callee`, with the arguments of `function`, over and over on arrays that stay in the cache, for
// one lobe: wo, n, alpha and eta are numbers, the rest arrays of shape.items(). Arguments: inputs, outputs,
// passes; each group computes `passes` items for each of its work-items.
std::string compute_source(const Function& function, const std::string& callee, const ComputeShape& shape);

// Whether an input of a compute kernel is one number instead of an array.
bool is_lobe(const std::string& scalar);

enum class Copy { scalar, vector, streaming };
constexpr Copy copies[] = {Copy::scalar, Copy::vector, Copy::streaming};
std::string to_string(Copy);
// Items of a copy's arrays for each work-item: the vector forms move 8 (float) or 4 (double) at once.
std::size_t items_per_work_item(Copy, runtime::Real);

// vndf_copy: reads `reads` arrays and writes `writes`, as a function of so many inputs and outputs does,
// without its arithmetic: output k is input k plus the inputs that have no output of their own.
std::string copy_source(Copy copy, std::size_t reads, std::size_t writes, runtime::Real real);

}  // namespace vndf::bench
