// Stage: what textures and the colours of vertices make of a material at the place where a path met it. Only in programs with one of
// these effects; each writes its own planes (VNDF_LOOK_), which material.h reads.
#ifndef VNDF_RENDER_DRESS_H
#define VNDF_RENDER_DRESS_H

#include "texture.h"

#if VNDF_RENDER_DRESSED

#if VNDF_RENDER_TEXTURE || VNDF_RENDER_VERTEX_COLOUR
VNDF_FN struct vndf_render_vector vndf_render_base(struct vndf_render_looks looks,
                                                   struct vndf_render_spot spot) {
    struct vndf_render_vector base = vndf_render_vector_of(1.0f, 1.0f, 1.0f);
#if VNDF_RENDER_TEXTURE
    const struct vndf_render_colour texture = vndf_render_base_texture(looks, spot, 1.0f);
    base = vndf_render_vector_of(texture.r, texture.g, texture.b);
#endif
#if VNDF_RENDER_VERTEX_COLOUR
    const struct vndf_render_colour painted = vndf_render_vertex_colour(looks, spot);
    base = vndf_render_vector_of(painted.r * base.x, painted.g * base.y, painted.b * base.z);
#endif
    return base;
}
#endif

#if VNDF_RENDER_ROUGHNESS_TEXTURE || VNDF_RENDER_LAYER_TEXTURE
// alpha_x and alpha_y by KHR_materials_anisotropy: along the tangent mix(alpha, 1, strength^2); as the material has them where
// no texture says otherwise.
VNDF_FN void vndf_render_rough(struct vndf_render_looks looks, struct vndf_render_spot spot,
                               VNDF_RENDER_FROM(float) materials, float roughness, float stretch, uint stride,
                               uint i, VNDF_RENDER_TO(float) look) {
    const int says = vndf_render_has(looks, spot, VNDF_SLOT_METALLIC_ROUGHNESS) ||
                     vndf_render_has(looks, spot, VNDF_SLOT_ANISOTROPY);
    const float own = roughness * vndf_render_dressing(looks, spot, VNDF_DRESSING_ROUGHNESS);
    const float strength = stretch * vndf_render_dressing(looks, spot, VNDF_DRESSING_ANISOTROPY);
    const float alpha_y = own * own, alpha_x = VNDF_FMA(1.0f - alpha_y, strength * strength, alpha_y);
    const uint count = looks.sizes.materials;
    look[VNDF_LOOK_ALPHA_X * stride + i] =
        says ? alpha_x : materials[VNDF_MATERIAL_ALPHA_X * count + spot.material];
    look[VNDF_LOOK_ALPHA_Y * stride + i] =
        says ? alpha_y : materials[VNDF_MATERIAL_ALPHA_Y * count + spot.material];
}
#endif

VNDF_RENDER_KERNEL vndf_render_dress(const struct vndf_render_sizes sizes, VNDF_RENDER_IN(float) vertices,
                                     VNDF_RENDER_IN(uint) triangles, VNDF_RENDER_IN(float) dressings,
                                     VNDF_RENDER_IN(uint) textures, VNDF_RENDER_IN(uint) texels,
                                     VNDF_RENDER_IN(float) materials, VNDF_RENDER_IN(float) hit,
                                     VNDF_RENDER_IN(uint) triangle, const uint count, const uint stride,
                                     VNDF_RENDER_OUT(float) look) {
    const uint i = VNDF_RENDER_ITEM;
    const struct vndf_render_looks looks =
        vndf_render_looks_of(sizes, vertices, triangles, dressings, textures, texels);
    const struct vndf_render_spot spot = vndf_render_spot_of(
        looks, i < count ? triangle[i] : 0, hit[VNDF_HIT_B1 * stride + i], hit[VNDF_HIT_B2 * stride + i]);
    // What the next texture waits for (texture.h).
    float known = 1.0f;
#if VNDF_RENDER_TEXTURE || VNDF_RENDER_VERTEX_COLOUR
    const struct vndf_render_vector base = vndf_render_base(looks, spot);
    vndf_render_store(base, look, VNDF_LOOK_BASE, stride, i);
    known = base.z;
#endif
#if VNDF_RENDER_EMISSION && (VNDF_RENDER_EMISSION_TEXTURE || VNDF_RENDER_VERTEX_COLOUR)
    const struct vndf_render_vector emission = vndf_render_emission_look(looks, spot, known);
    vndf_render_store(emission, look, VNDF_LOOK_EMISSION, stride, i);
    known = emission.z;
#endif
#if VNDF_RENDER_ROUGHNESS_TEXTURE || VNDF_RENDER_LAYER_TEXTURE
    float roughness = 1.0f, stretch = 1.0f;
#if VNDF_RENDER_ROUGHNESS_TEXTURE
    const struct vndf_render_colour rough = vndf_render_roughness_texture(looks, spot, known);
    roughness = rough.g;
    look[VNDF_LOOK_METAL * stride + i] = rough.b;
    known = rough.b;
#endif
#if VNDF_RENDER_LAYER_TEXTURE
    stretch = vndf_render_layer_texture(looks, spot, VNDF_SLOT_ANISOTROPY, known).b;
    known = stretch;
#endif
    vndf_render_rough(looks, spot, materials, roughness, stretch, stride, i, look);
#else
    (void)materials;
#endif
#if VNDF_RENDER_LAYER_TEXTURE
    const float transmission = vndf_render_layer_texture(looks, spot, VNDF_SLOT_TRANSMISSION, known).r;
    look[VNDF_LOOK_TRANSMISSION * stride + i] = transmission;
    const float coat = vndf_render_layer_texture(looks, spot, VNDF_SLOT_COAT, transmission).r;
    look[VNDF_LOOK_COAT * stride + i] = coat;
    const float coat_rough = vndf_render_layer_texture(looks, spot, VNDF_SLOT_COAT_ROUGHNESS, coat).g;
    const float coat_roughness = coat_rough * vndf_render_dressing(looks, spot, VNDF_DRESSING_COAT_ROUGHNESS);
    look[VNDF_LOOK_COAT_ALPHA * stride + i] =
        vndf_render_has(looks, spot, VNDF_SLOT_COAT_ROUGHNESS)
            ? coat_roughness * coat_roughness
            : materials[VNDF_MATERIAL_COAT_ALPHA * sizes.materials + spot.material];
    const float specular = vndf_render_layer_texture(looks, spot, VNDF_SLOT_SPECULAR, coat_rough).a;
    look[VNDF_LOOK_SPECULAR * stride + i] = specular;
    const struct vndf_render_colour tinted =
        vndf_render_layer_texture(looks, spot, VNDF_SLOT_SPECULAR_COLOUR, specular);
    vndf_render_store(vndf_render_vector_of(tinted.r, tinted.g, tinted.b), look, VNDF_LOOK_SPECULAR_COLOUR,
                      stride, i);
#endif
    (void)known;
}

#endif

#endif
