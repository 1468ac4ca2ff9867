// One entry point for each registered function: vndf_batch_<name>, arrays in, arrays out (entry_point.h).
#include "../vndf/vndf.h"
#include "entry_point.h"

#define VNDF_SAMPLER(name, ndf, arguments, result, density, method, domain, p99_front, p99_back, source) \
    VNDF_ENTRY_POINT(vndf_batch_##name, name, arguments, result)                                         \
    VNDF_ENTRY_POINT(vndf_batch_##name##_with_pdf, name##_with_pdf, arguments, result##_PDF)
#define VNDF_FUNCTION(name, ndf, arguments, result, kind, bound, source) \
    VNDF_ENTRY_POINT(vndf_batch_##name, name, arguments, result)
#include "../samplers.def"
