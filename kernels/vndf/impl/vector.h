// Directions and samples as structs of numbers: a user's own vectors need not be members of one.
#ifndef VNDF_IMPL_VECTOR_H
#define VNDF_IMPL_VECTOR_H

#include "shim.h"

VNDF_BEGIN

struct vndf_impl_vector {
    VNDF_REAL x, y, z;
};
VNDF_FN struct vndf_impl_vector vndf_impl_vector_of(VNDF_REAL x, VNDF_REAL y, VNDF_REAL z) {
    struct vndf_impl_vector v;
    v.x = x;
    v.y = y;
    v.z = z;
    return v;
}
VNDF_FN VNDF_REAL3 vndf_impl_real3(struct vndf_impl_vector v) {
    return VNDF_MAKE3(v.x, v.y, v.z);
}

struct vndf_impl_sample {
    VNDF_REAL x, y, z, pdf;
};
VNDF_FN VNDF_REAL3 vndf_impl_direction(struct vndf_impl_sample s) {
    return VNDF_MAKE3(s.x, s.y, s.z);
}
VNDF_FN VNDF_REAL4 vndf_impl_direction_pdf(struct vndf_impl_sample s) {
    return VNDF_MAKE4(s.x, s.y, s.z, s.pdf);
}

VNDF_END

#endif
