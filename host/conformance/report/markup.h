// Text in XML and HTML.
#pragma once

#include <string>
#include <string_view>

namespace vndf::conformance {

// Text as character data or the value of an attribute; control characters, which XML 1.0 forbids, become spaces.
std::string escaped(std::string_view text);

}  // namespace vndf::conformance
