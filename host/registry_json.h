// The registry as JSON, for programs: an array with an object for each function and each lobe.
#pragma once

#include <string>

namespace vndf {

std::string registry_json();

}  // namespace vndf
