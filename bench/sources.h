// The files of this folder that a run needs: the listings and kernels in OpenCL C, and the script that makes the report.
#pragma once

#include <vector>

#include "runtime/sources.h"

namespace vndf::bench {

const std::vector<runtime::SourceFile>& sources();

}  // namespace vndf::bench
