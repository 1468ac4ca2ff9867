// Known answers: inputs and results of every function in hex, for implementations that are not ours.
#pragma once

#include <string>
#include <vector>

#include "runtime/evaluator.h"

namespace vndf::conformance {

inline constexpr std::size_t answer_rows = 20;  // a function

// Lines "NAME,INPUT...,RESULT...", C99 hex floats, after a comment "# NAME: INPUTS -> RESULTS" for each function; a part of the
// inputs of the digests. The head says what they are.
std::string format_answers(runtime::Evaluator& evaluator, runtime::Math math,
                           const std::vector<const Function*>& selected);

}  // namespace vndf::conformance
