// The Fresnel reflectance that VNDF_FRESNEL chooses: the parameters that it adds to a material, and its value.
#ifndef VNDF_FRESNEL_H
#define VNDF_FRESNEL_H

#include "effects.h"
#include "impl/shim.h"

#if !VNDF_CONDUCTOR
#elif VNDF_CHOSEN(VNDF_FRESNEL, conductor)
#include "fresnel_conductor.h"
#elif VNDF_CHOSEN(VNDF_FRESNEL, schlick)
#include "fresnel_schlick.h"
#elif VNDF_CHOSEN(VNDF_FRESNEL, f82)
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

// A parameter of the next channel, made dependent on what the last one has made, at least 0, so that LLVM's SLP pass does not pack
// the alike formulas (impl/stretch.h); the other choice is never taken.
VNDF_FN VNDF_REAL vndf_impl_next_channel(VNDF_REAL parameter, VNDF_REAL last) {
    return last >= VNDF_R(0.0) ? parameter : VNDF_R(1.0);
}

// The parameters: members of struct vndf_bsdf.
#if VNDF_CHOSEN(VNDF_FRESNEL, conductor)
#define VNDF_IMPL_FRESNEL_MEMBERS struct vndf_rgb eta, k;
#elif VNDF_CHOSEN(VNDF_FRESNEL, schlick)
#define VNDF_IMPL_FRESNEL_MEMBERS \
    struct vndf_rgb f0;           \
    VNDF_REAL f90;
#elif VNDF_CHOSEN(VNDF_FRESNEL, f82)
#define VNDF_IMPL_FRESNEL_MEMBERS struct vndf_rgb f0, f82;
#else
#define VNDF_IMPL_FRESNEL_MEMBERS
#endif

VNDF_END

#endif
