// The renderer's own switches (effects.def), each by itself or VNDF_RENDER_ALL: on, unless said otherwise. Without one its code is gone, and the images of scenes
// that do not call for it keep their bits.
//
// And a choice: VNDF_LIGHTS_BY says how lights that fill a cap of directions, spheres and the sun, are sampled: mis (default), evenly in
// the cap and by the material, weighed; cap, evenly alone; bsdf, by the material alone; cones, GGX facets by all their reflections
// into the cap and no other (cones.h). The mean is the same.
#ifndef VNDF_RENDER_EFFECTS_H
#define VNDF_RENDER_EFFECTS_H

#include "../vndf/effects.h"

#ifndef VNDF_LIGHTS_BY
#define VNDF_LIGHTS_BY mis
#endif
#define VNDF_LIGHTS_BY_IS_mis 1
#define VNDF_LIGHTS_BY_IS_cap 2
#define VNDF_LIGHTS_BY_IS_bsdf 3
#define VNDF_LIGHTS_BY_IS_cones 4
#if VNDF_CAT(VNDF_LIGHTS_BY_IS_, VNDF_LIGHTS_BY) >= 1
#else
#error "clvndf: unknown VNDF_LIGHTS_BY; mis, cap, bsdf and cones are allowed"
#endif

#ifndef VNDF_RENDER_ALL
#define VNDF_RENDER_ALL 1
#endif
#ifndef VNDF_RENDER_ALPHA
#define VNDF_RENDER_ALPHA VNDF_RENDER_ALL
#endif
#ifndef VNDF_RENDER_TANGENT
#define VNDF_RENDER_TANGENT VNDF_RENDER_ALL
#endif
#ifndef VNDF_RENDER_NORMAL_MAP
#define VNDF_RENDER_NORMAL_MAP VNDF_RENDER_ALL
#endif
#ifndef VNDF_RENDER_VERTEX_COLOUR
#define VNDF_RENDER_VERTEX_COLOUR VNDF_RENDER_ALL
#endif
#ifndef VNDF_RENDER_TEXTURE
#define VNDF_RENDER_TEXTURE VNDF_RENDER_ALL
#endif
#ifndef VNDF_RENDER_ROUGHNESS_TEXTURE
#define VNDF_RENDER_ROUGHNESS_TEXTURE VNDF_RENDER_ALL
#endif
#ifndef VNDF_RENDER_LAYER_TEXTURE
#define VNDF_RENDER_LAYER_TEXTURE VNDF_RENDER_ALL
#endif
#ifndef VNDF_RENDER_EMISSION
#define VNDF_RENDER_EMISSION VNDF_RENDER_ALL
#endif
#ifndef VNDF_RENDER_EMISSION_TEXTURE
#define VNDF_RENDER_EMISSION_TEXTURE VNDF_RENDER_ALL
#endif
#ifndef VNDF_RENDER_LAMP
#define VNDF_RENDER_LAMP VNDF_RENDER_ALL
#endif
#ifndef VNDF_RENDER_POINT_LIGHT
#define VNDF_RENDER_POINT_LIGHT VNDF_RENDER_ALL
#endif
#ifndef VNDF_RENDER_SPHERE_LIGHT
#define VNDF_RENDER_SPHERE_LIGHT VNDF_RENDER_ALL
#endif
#ifndef VNDF_RENDER_SUN
#define VNDF_RENDER_SUN VNDF_RENDER_ALL
#endif
#ifndef VNDF_RENDER_SKY
#define VNDF_RENDER_SKY VNDF_RENDER_ALL
#endif
#ifndef VNDF_RENDER_ENVIRONMENT
#define VNDF_RENDER_ENVIRONMENT VNDF_RENDER_ALL
#endif

// Lights at a distance, behind which nothing is in their way.
#define VNDF_RENDER_NEAR_LIGHT (VNDF_RENDER_LAMP || VNDF_RENDER_POINT_LIGHT || VNDF_RENDER_SPHERE_LIGHT)
// Lights of which one is picked.
#define VNDF_RENDER_PICKED_LIGHT (VNDF_RENDER_NEAR_LIGHT || VNDF_RENDER_ENVIRONMENT)
// The stage that samples lights that fill a cap by cones: where there are facets.
#define VNDF_RENDER_CONES                                                                   \
    (VNDF_CHOSEN(VNDF_LIGHTS_BY, cones) && (VNDF_RENDER_SUN || VNDF_RENDER_SPHERE_LIGHT) && \
     (VNDF_CONDUCTOR || VNDF_DIELECTRIC))
// Lights that fill a cap and that samples of them bring all of: where paths meet them by chance they count nothing.
#define VNDF_RENDER_CAPS_ALONE (VNDF_CHOSEN(VNDF_LIGHTS_BY, cap) || VNDF_RENDER_CONES)
// Samples that no other meets.
#define VNDF_RENDER_LONE_LIGHT (VNDF_RENDER_POINT_LIGHT || VNDF_RENDER_CAPS_ALONE)
// Materials that differ from place to place (dress.h).
#define VNDF_RENDER_DRESSED                                                               \
    (VNDF_RENDER_VERTEX_COLOUR || VNDF_RENDER_TEXTURE || VNDF_RENDER_ROUGHNESS_TEXTURE || \
     VNDF_RENDER_LAYER_TEXTURE || VNDF_RENDER_EMISSION_TEXTURE)

#endif
