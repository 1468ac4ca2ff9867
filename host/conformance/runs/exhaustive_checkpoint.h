// A walk that goes on where another stopped, as a text that people can read.
#pragma once

#include <string>

#include "conformance/runs/exhaustive.h"

namespace vndf::conformance {

// The text of a file, JSON. `run` names all that the report depends on: kernels, samplers, slice, device.
std::string checkpoint(const ExhaustiveWalk& walk, const std::string& run, double seconds);

// Has the walk, which is at its beginning, go on from there; returns the seconds that it has taken before. Throws InputError,
// naming the file and what in it is wrong, if the text is none of these, of another run, or contradicts itself.
double resume(ExhaustiveWalk& walk, const std::string& text, const std::string& run, const std::string& file);

}  // namespace vndf::conformance
