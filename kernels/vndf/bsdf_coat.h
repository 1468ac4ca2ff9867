// The coat of a material: a rough dielectric layer of index 1.5 over all that it has else.
//
// It reflects the part E of the light, E(wo) with a factor that says how much of a coat there is, and lets the rest through. What
// the base does between wo and wi counts times min(1 - E(wo), 1 - E(wi)): the most that is the same for both directions exchanged
// and by which no base whatever reflects more than falls on it. On a body that light goes through it lies outside: it has no
// lobe from within, and light that leaves counts times 1 - E of the direction outside.
#ifndef VNDF_BSDF_COAT_H
#define VNDF_BSDF_COAT_H

#include "bsdf_facets.h"
#include "bsdf_material.h"
#include "fresnel_dielectric.h"

VNDF_BEGIN

#if VNDF_COAT

// As wo sees it.
struct vndf_impl_coat {
    struct vndf_impl_facets facets;
    VNDF_REAL alpha, factor;
    VNDF_REAL share;  // E(wo), and the probability of its lobe; 0 from within
    int within;
};

#define VNDF_IMPL_COAT_IOR VNDF_R(1.5)

// E of a whole coat: the reflectance at a cosine that the roughness widens, less what facets hide. A fit of the directional
// albedo, correlated masking, alpha in [0, 1]: at most 0.004 less than that, so that hardly more is reflected than there is, and
// more than it by 0.02 in the mean over the hemisphere, at grazing incidence by up to 0.13.
VNDF_FN VNDF_REAL vndf_impl_coat_reflects(VNDF_REAL cosine, VNDF_REAL alpha) {
    VNDF_REAL c = vndf_impl_fresnel_cosine(cosine), rest = VNDF_R(1.0) - c, square = alpha * alpha;
#if VNDF_CHOSEN(VNDF_NDF, beckmann)
    VNDF_REAL wide =
        VNDF_DIVIDE(square, VNDF_FMA(alpha, VNDF_FMA(alpha, VNDF_R(5.6), VNDF_R(-1.0)), VNDF_R(1.75)));
    VNDF_REAL tail = VNDF_FMA(c, VNDF_R(-0.49), VNDF_R(1.0)),
              hidden = square * VNDF_FMA(square, VNDF_R(0.36), VNDF_R(-0.2));
#else
    VNDF_REAL wide =
        VNDF_DIVIDE(square, VNDF_FMA(alpha, VNDF_FMA(alpha, VNDF_R(5.25), VNDF_R(0.7)), VNDF_R(0.3)));
    VNDF_REAL tail = VNDF_FMA(c, VNDF_R(0.19), VNDF_R(1.0)),
              hidden = square * VNDF_FMA(square, VNDF_R(-0.27), VNDF_R(0.62));
#endif
    VNDF_REAL f = vndf_fresnel_dielectric(VNDF_SQRT(VNDF_FMA(c, c, wide * rest * tail)), VNDF_IMPL_COAT_IOR);
    return vndf_impl_share(f * (VNDF_R(1.0) - hidden));
}

// within: whether wo is inside of a body. last: at least 0, of what was computed before: made dependent on it, so that LLVM's SLP
// pass does not pack the two; the other choice is never taken.
VNDF_FN struct vndf_impl_coat vndf_impl_coat_of(VNDF_REAL3 o, VNDF_REAL3 ng, struct vndf_bsdf b, int within,
                                                VNDF_REAL last) {
    struct vndf_impl_coat c;
    VNDF_REAL z = last >= VNDF_R(0.0) ? o.z : VNDF_R(1.0);
    c.alpha = vndf_impl_share(vndf_impl_alpha(last >= VNDF_R(0.0) ? b.coat_alpha : VNDF_R(1.0)));
    c.factor = vndf_impl_reflectance(b.coat);
    c.facets = vndf_impl_facets_of(VNDF_MAKE3(o.x, o.y, z), VNDF_MAKE2(c.alpha, c.alpha), ng);
    c.share = within ? VNDF_R(0.0) : c.factor * vndf_impl_coat_reflects(z, c.alpha);
    c.within = within;
    return c;
}

// What the base's weight is multiplied by for being drawn with the probability 1 - E(wo). last: as above.
VNDF_FN VNDF_REAL vndf_impl_coat_lets_through(struct vndf_impl_coat c, VNDF_REAL3 i, int crosses,
                                              VNDF_REAL last) {
    VNDF_REAL rest = VNDF_R(1.0) - c.share, z = last >= VNDF_R(0.0) ? vndf_impl_abs(i.z) : VNDF_R(1.0);
    VNDF_REAL out = VNDF_FMA(-c.factor, vndf_impl_coat_reflects(z, c.alpha), VNDF_R(1.0));
    VNDF_REAL part = vndf_impl_share(VNDF_DIVIDE(out, rest > VNDF_R(0.0) ? rest : VNDF_R(1.0)));
    return crosses == c.within ? part : VNDF_R(1.0);
}

#endif

VNDF_END

#endif
