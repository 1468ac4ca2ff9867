// What the tests of a lobe counted, drawn: one SVG a lobe.
#pragma once

#include <string>

#include "conformance/judge/lobes.h"

namespace vndf::conformance {

// What all pictures of a page share; comes before them.
std::string picture_definitions();

// Directions measured, expected and their difference; the pivots' difference and their marginal histograms; and the means, in
// tolerances.
std::string draw(const LobePicture& picture);

// The number of standard deviations by which a count differs from its expectation; good for small counts, too.
double deviations(double count, double expected);

}  // namespace vndf::conformance
