// The Fresnel reflectance that VNDF_FRESNEL chooses: the parameters that it adds to a material, and its value.
#ifndef VNDF_FRESNEL_H
#define VNDF_FRESNEL_H

#include "effects.h"
#include "impl/shim.h"

#if !VNDF_CONDUCTOR
#elif VNDF_IS(FRESNEL, conductor)
#include "fresnel_conductor.h"
#elif VNDF_IS(FRESNEL, schlick)
#include "fresnel_schlick.h"
#elif VNDF_IS(FRESNEL, f82)
#include "fresnel_f82.h"
#endif

VNDF_BEGIN

// Three channels of a reflectance, a weight or a radiance.
struct vndf_rgb {
    VNDF_REAL r, g, b;
};

VNDF_FN struct vndf_rgb vndf_impl_rgb(VNDF_REAL r, VNDF_REAL g, VNDF_REAL b) {
    struct vndf_rgb c;
    c.r = r;
    c.g = g;
    c.b = b;
    return c;
}
VNDF_FN struct vndf_rgb vndf_impl_rgb_scaled(struct vndf_rgb c, VNDF_REAL s) {
    return vndf_impl_rgb(c.r * s, c.g * s, c.b * s);
}
VNDF_FN struct vndf_rgb vndf_impl_rgb_product(struct vndf_rgb a, struct vndf_rgb b) {
    return vndf_impl_rgb(a.r * b.r, a.g * b.g, a.b * b.b);
}

// The parameters: members of struct vndf_bsdf.
#if VNDF_IS(FRESNEL, conductor)
#define VNDF_IMPL_FRESNEL_MEMBERS struct vndf_rgb eta, k;
#elif VNDF_IS(FRESNEL, schlick)
#define VNDF_IMPL_FRESNEL_MEMBERS \
    struct vndf_rgb f0;           \
    VNDF_REAL f90;
#elif VNDF_IS(FRESNEL, f82)
#define VNDF_IMPL_FRESNEL_MEMBERS struct vndf_rgb f0, f82;
#else
#define VNDF_IMPL_FRESNEL_MEMBERS
#endif

VNDF_END

#endif
