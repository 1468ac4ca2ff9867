// One entry point for each registered function: vndf_batch_<name>, arrays in, arrays out (entry_point.h).
#include "../vndf/vndf.h"
#include "entry_point.h"

#define VNDF_FUNCTION(name, arguments, result) VNDF_ENTRY_POINT(vndf_batch_##name, name, arguments, result)
#include "../registry.def"
