// What a form of a function computes, apart from its time: errors in front of and behind the surface, and what is no result.
#pragma once

#include <cstddef>
#include <map>
#include <string>

#include "inputs.h"
#include "registry.h"
#include "runtime/evaluator.h"

namespace vndf::bench {

struct Accuracy {
    std::map<std::string, double> figures;
    double useful = 1;  // the part of a sampler's directions that are reflections above the surface
};

// On `rows` inputs of points(), of plain samplers that are valid there as many again with wo below the surface:
//   err_p50, err_p99, err_p9999, err_max   in the unit of the conformance check: an angle over 1 + condition number, or a
//                                          relative error
//   angle_p50 ...                          the angle itself, in epsilon; what is not finite counts as half a turn
//   err_back_p50, angle_back_p50 ...       the same for wo below the surface
//   nonfinite, below                       results that are not finite; normals (of reflections half vectors) below the horizon
//   bias                                   of an approximate sampler: the error of its cumulative distribution
// `same_map`: whether errors mean something; without it only the counts.
Accuracy accuracy(runtime::Evaluator& evaluator, const Function& function, std::size_t rows, AlphaRange alpha,
                  bool same_map);

// Whether wo may lie below the surface where a function is timed: plain samplers of domain sphere.
bool has_back(const Function& function);

bool in_world_space(const Function& function);

}  // namespace vndf::bench
