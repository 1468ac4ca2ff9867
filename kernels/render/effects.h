// The renderer's own switches (effects.def), each by itself or VNDF_RENDER_ALL: on, unless said otherwise. Without one its code is gone, and the images of scenes
// that do not call for it keep their bits.
#ifndef VNDF_RENDER_EFFECTS_H
#define VNDF_RENDER_EFFECTS_H

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
#define VNDF_RENDER_NEAR_LIGHT (VNDF_RENDER_LAMP || VNDF_RENDER_POINT_LIGHT)
// Lights of which one is picked.
#define VNDF_RENDER_PICKED_LIGHT (VNDF_RENDER_NEAR_LIGHT || VNDF_RENDER_ENVIRONMENT)
// Materials that differ from place to place (dress.h).
#define VNDF_RENDER_DRESSED                                                               \
    (VNDF_RENDER_VERTEX_COLOUR || VNDF_RENDER_TEXTURE || VNDF_RENDER_ROUGHNESS_TEXTURE || \
     VNDF_RENDER_LAYER_TEXTURE || VNDF_RENDER_EMISSION_TEXTURE)

#endif
