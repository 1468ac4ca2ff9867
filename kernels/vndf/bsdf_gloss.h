// How a material's specular and specular_colour change what the dielectric's interface reflects (VNDF_SPECULAR).
//
// Of a reflectance F by the index, F0 at normal incidence, a channel has specular (f + (1 - f) (F - F0) / (1 - F0)) with f = min(F0
// colour, 1): specular f at normal incidence, specular at grazing incidence, and between them F's own rise in place of the fifth
// power of glTF's KHR_materials_specular. Here as specular (F + (1 - F) x), x = min((colour - 1) F0 / (1 - F0), 1), which is F to
// the bit where both are 1. What the brightest channel does not reflect gets in, of every channel.
//
// Both sides of the interface reflect so. From inside of a body what is reflected totally stays so: it has nowhere else to go.
#ifndef VNDF_BSDF_GLOSS_H
#define VNDF_BSDF_GLOSS_H

#include "fresnel.h"
#include "impl/fresnel.h"

VNDF_BEGIN

struct vndf_impl_gloss {
    VNDF_REAL strength;
    struct vndf_rgb excess;  // x
    VNDF_REAL most;          // of the brightest channel
};

// rise: F0 / (1 - F0).
VNDF_FN VNDF_REAL vndf_impl_gloss_excess(VNDF_REAL colour, VNDF_REAL rise) {
    return vndf_impl_share((vndf_impl_max(colour, VNDF_R(0.0)) - VNDF_R(1.0)) * rise);
}
VNDF_FN struct vndf_impl_gloss vndf_impl_gloss_of(VNDF_REAL specular, struct vndf_rgb colour, VNDF_REAL ior) {
    struct vndf_impl_gloss g;
    VNDF_REAL rise = VNDF_R(0.25) * ((ior - VNDF_R(1.0)) * VNDF_DIVIDE(ior - VNDF_R(1.0), ior));
    // x is at least -250.
    VNDF_REAL red = vndf_impl_gloss_excess(colour.r, rise);
    VNDF_REAL green = vndf_impl_gloss_excess(vndf_impl_next_channel(colour.g, red + VNDF_R(1e3)), rise);
    VNDF_REAL blue = vndf_impl_gloss_excess(vndf_impl_next_channel(colour.b, green + VNDF_R(1e3)), rise);
    g.strength = vndf_impl_reflectance(specular);
    g.excess = vndf_impl_rgb(red, green, blue);
    g.most = vndf_impl_max(vndf_impl_max(red, green), blue);
    return g;
}

// Of the reflectance f by the index. Where that falls below F0, as of an index above 3, a dark colour leaves nothing. Then 1 less
// that, without the difference.
VNDF_FN VNDF_REAL vndf_impl_gloss_reflects(struct vndf_impl_gloss g, VNDF_REAL excess, VNDF_REAL f) {
    return g.strength * vndf_impl_max(VNDF_FMA(VNDF_R(1.0) - f, excess, f), VNDF_R(0.0));
}
VNDF_FN VNDF_REAL vndf_impl_gloss_passes(struct vndf_impl_gloss g, VNDF_REAL excess, VNDF_REAL f) {
    return vndf_impl_share(
        VNDF_FMA(g.strength * (VNDF_R(1.0) - excess), VNDF_R(1.0) - f, VNDF_R(1.0) - g.strength));
}

VNDF_END

#endif
