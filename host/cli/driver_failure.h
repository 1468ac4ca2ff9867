// What becomes of the process where a driver, or the compiler in it, fails without a word to us.
#pragma once

namespace vndf::cli {

// From now on the process ends with a line on stderr and status 3 where memory runs out or abort() is called. To be
// called again once the drivers are loaded: LLVM, which is in many, puts its own handler before ours.
void end_where_drivers_fail();

}  // namespace vndf::cli
