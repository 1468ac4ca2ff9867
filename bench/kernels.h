// Kernels that only the benchmark needs, as OpenCL C to append to a program.
#pragma once

#include <cstddef>
#include <string>

#include "registry.h"
#include "runtime/evaluator.h"

namespace vndf::bench {

// `callee`, with the arguments of `function`, over arrays that stay in the cache: every further group of work-items goes over
// them again. Arguments: inputs, outputs; any global size.
//   vndf_compute  for one lobe: wo, n, alpha, eta, cos_theta and the cap are numbers, the rest arrays of compute_groups groups
//   vndf_cached   arrays of cached_groups groups
std::string cached_source(const Function& function, const std::string& callee);

// The same of a function of somebody else, in a program that has none of the library's macros, or all of them.
std::string foreign_source(const Function& function, runtime::Real real);

// 0.6 MB at a local size of 64, 3 outputs and u. A prime, so that threads that take the groups in even portions do not
// write to the same place at the same time.
constexpr std::size_t compute_groups = 509;
// 0.33 MB of 10 float arrays, 0.65 MB of double: a second-level cache.
constexpr std::size_t cached_groups = 127;

// Whether an input of vndf_compute is one number instead of an array.
bool is_lobe(const std::string& scalar);

enum class Copy { scalar, vector, streaming };
constexpr Copy copies[] = {Copy::scalar, Copy::vector, Copy::streaming};
std::string to_string(Copy);
// Items of a copy's arrays for each work-item: the vector forms move 8 (float) or 4 (double) at once.
std::size_t items_per_work_item(Copy, runtime::Real);

// vndf_copy: reads `reads` arrays and writes `writes`, as a function of so many inputs and outputs does,
// without its arithmetic: output k is input k plus the inputs that have no output of their own.
std::string copy_source(Copy copy, std::size_t reads, std::size_t writes, runtime::Real real);

// vndf_arithmetic(out, x): nothing but fma on registers, in 8 independent vectors of 8 floats. Each work-item does
// arithmetic_operations of them, two for an fma.
std::string arithmetic_source();
constexpr std::size_t arithmetic_operations = 2 * 8 * 8 * 4096;

// Floating-point operations of one sample in strict float (operations.def), or 0 where they were not counted.
double operations(const Function& function);

}  // namespace vndf::bench
