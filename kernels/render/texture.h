// Textures at a point of a triangle: in plain buffers, so that every device has the same bits.
#ifndef VNDF_RENDER_TEXTURE_H
#define VNDF_RENDER_TEXTURE_H

#include "../vndf/effects.h"
#include "effects.h"
#include "queues.h"
#include "srgb.h"
#include "vector.h"

// What is read to know how a place looks.
struct vndf_render_looks {
    struct vndf_render_sizes sizes;
    VNDF_RENDER_FROM(float) vertices;
    VNDF_RENDER_FROM(uint) triangles;
    VNDF_RENDER_FROM(float) dressings;
    VNDF_RENDER_FROM(uint) textures;
    VNDF_RENDER_FROM(uint) texels;
};
VNDF_FN struct vndf_render_looks vndf_render_looks_of(
    struct vndf_render_sizes sizes, VNDF_RENDER_FROM(float) vertices, VNDF_RENDER_FROM(uint) triangles,
    VNDF_RENDER_FROM(float) dressings, VNDF_RENDER_FROM(uint) textures, VNDF_RENDER_FROM(uint) texels) {
    struct vndf_render_looks looks;
    looks.sizes = sizes;
    looks.vertices = vertices;
    looks.triangles = triangles;
    looks.dressings = dressings;
    looks.textures = textures;
    looks.texels = texels;
    return looks;
}

// A place on a triangle, and the material there.
struct vndf_render_spot {
    uint first, second, third, material;
    float b1, b2;
};
VNDF_FN struct vndf_render_spot vndf_render_spot_of(struct vndf_render_looks looks, uint triangle, float b1,
                                                    float b2) {
    struct vndf_render_spot spot;
    spot.first = looks.triangles[triangle];
    spot.second = looks.triangles[looks.sizes.triangles + triangle];
    spot.third = looks.triangles[2 * looks.sizes.triangles + triangle];
    spot.material = looks.triangles[VNDF_TRIANGLE_MATERIAL * looks.sizes.triangles + triangle];
    spot.b1 = b1;
    spot.b2 = b2;
    return spot;
}

// A plane of the vertices, interpolated: where all three have the same number, that one to the bit.
VNDF_FN float vndf_render_vertex(struct vndf_render_looks looks, struct vndf_render_spot spot, uint plane) {
    VNDF_RENDER_FROM(float) const from = looks.vertices + plane * looks.sizes.vertices;
    const float a = from[spot.first];
    return VNDF_FMA(spot.b1, from[spot.second] - a, VNDF_FMA(spot.b2, from[spot.third] - a, a));
}
// A number of the material's dressing.
VNDF_FN float vndf_render_dressing(struct vndf_render_looks looks, struct vndf_render_spot spot, uint plane) {
    return looks.dressings[plane * looks.sizes.materials + spot.material];
}

struct vndf_render_colour {
    float r, g, b, a;
};

// The whole number at or below x, in the range of the coordinates.
VNDF_FN float vndf_render_below(float x) {
    const float whole = (float)(int)x;
    return whole > x ? whole - 1.0f : whole;
}
// A coordinate in a texture's width, from 0 to 1.
VNDF_FN float vndf_render_wrapped(float u, uint wrap) {
    const float some = vndf_impl_max(vndf_impl_min(u, 1e6f), -1e6f);
    const float mirrored = 2.0f * (0.5f * some - vndf_render_below(0.5f * some));
    const float folded = mirrored > 1.0f ? 2.0f - mirrored : mirrored;
    const float held = vndf_impl_max(vndf_impl_min(some, 1.0f), 0.0f);
    const float repeated = some - vndf_render_below(some);
    return wrap == VNDF_WRAP_REPEAT ? repeated : (wrap == VNDF_WRAP_CLAMP ? held : folded);
}
// Two neighbours of `size` texels and the weight of the second.
struct vndf_render_pair {
    int a, b;
    float share;
};
VNDF_FN struct vndf_render_pair vndf_render_pair_of(float u, uint wrap, int nearest, int size) {
    const int last = size - 1, around = wrap == VNDF_WRAP_REPEAT;
    const float place =
        vndf_impl_min(vndf_render_wrapped(u, wrap) * (float)size - (nearest ? 0.0f : 0.5f), (float)last);
    const float low = vndf_render_below(place);
    const int first = (int)low;
    struct vndf_render_pair pair;
    pair.a = first < 0 ? (around ? last : 0) : first;
    pair.b = first >= last ? (around ? 0 : last) : first + 1;
    pair.share = nearest ? 0.0f : place - low;
    return pair;
}

// Each channel waits for the one before, and a texel for the last of another, for the compiler alone, which would pack them, and
// PoCL then not vectorise.
VNDF_FN struct vndf_render_colour vndf_render_texel(VNDF_RENDER_FROM(uint) texels, uint number, float before,
                                                    int srgb) {
    const float scale = 1.0f / 255.0f;
    const uint texel = texels[before >= 0.0f ? number : 0];
    struct vndf_render_colour c;
    const uint r = texel & 255u;
    c.r = srgb ? vndf_render_srgb[r] : scale * (float)(int)r;
    const uint g = (c.r >= 0.0f ? texel : 0u) >> 8 & 255u;
    c.g = srgb ? vndf_render_srgb[g] : scale * (float)(int)g;
    const uint b = (c.g >= 0.0f ? texel : 0u) >> 16 & 255u;
    c.b = srgb ? vndf_render_srgb[b] : scale * (float)(int)b;
    c.a = scale * (float)(int)((c.b >= 0.0f ? texel : 0u) >> 24);
    return c;
}
VNDF_FN float vndf_render_between(float a, float b, float share) {
    return VNDF_FMA(share, b - a, a);
}
VNDF_FN struct vndf_render_colour vndf_render_blended(struct vndf_render_colour a,
                                                      struct vndf_render_colour b, float share) {
    struct vndf_render_colour c;
    c.r = vndf_render_between(a.r, b.r, share);
    c.g = vndf_render_between(a.g, b.g, share);
    c.b = vndf_render_between(a.b, b.b, share);
    c.a = vndf_render_between(a.a, b.a, share);
    return c;
}

// Whether the material has a texture for this.
VNDF_FN int vndf_render_has(struct vndf_render_looks looks, struct vndf_render_spot spot, uint slot) {
    return vndf_render_dressing(looks, spot, VNDF_DRESSING_SLOT(slot)) >= 0.0f;
}

// What a texture of the material says; white where there is none. srgb: its colours are encoded. before: what of another has to
// be known first, >= 0, as above.
VNDF_FN struct vndf_render_colour vndf_render_look(struct vndf_render_looks looks,
                                                   struct vndf_render_spot spot, uint slot, int srgb,
                                                   float before) {
    const uint use = VNDF_DRESSING_SLOT(slot);
    const float own = vndf_render_dressing(looks, spot, use), number = before >= 0.0f ? own : -1.0f;
    const uint set = VNDF_VERTEX_UV + 2 * (uint)(int)vndf_render_dressing(looks, spot, use + 1);
    const float u = vndf_render_vertex(looks, spot, set), v = vndf_render_vertex(looks, spot, set + 1);
    const float x = VNDF_FMA(
        vndf_render_dressing(looks, spot, use + 2), u,
        VNDF_FMA(vndf_render_dressing(looks, spot, use + 3), v, vndf_render_dressing(looks, spot, use + 4)));
    const float y = VNDF_FMA(
        vndf_render_dressing(looks, spot, use + 5), u,
        VNDF_FMA(vndf_render_dressing(looks, spot, use + 6), v, vndf_render_dressing(looks, spot, use + 7)));
    const uint texture = number >= 0.0f ? (uint)(int)number : 0, count = looks.sizes.textures;
    const uint offset = looks.textures[VNDF_TEXTURE_OFFSET * count + texture],
               mode = looks.textures[VNDF_TEXTURE_MODE * count + texture];
    const int width = (int)looks.textures[VNDF_TEXTURE_WIDTH * count + texture],
              height = (int)looks.textures[VNDF_TEXTURE_HEIGHT * count + texture];
    const int nearest = (int)((mode >> 4) & 1u);
    const struct vndf_render_pair column = vndf_render_pair_of(x, mode & 3u, nearest, width);
    // As above.
    const int known = column.share >= 0.0f && column.b >= 0;
    const struct vndf_render_pair row =
        vndf_render_pair_of(known ? y : 0.0f, (mode >> 2) & 3u, nearest, known ? height : 0);
    const uint upper = offset + (uint)(row.a * width), lower = offset + (uint)(row.b * width);
    const struct vndf_render_colour first =
        vndf_render_texel(looks.texels, upper + (uint)column.a, row.share, srgb);
    const struct vndf_render_colour second =
        vndf_render_texel(looks.texels, upper + (uint)column.b, first.a, srgb);
    const struct vndf_render_colour third =
        vndf_render_texel(looks.texels, lower + (uint)column.a, second.a, srgb);
    const struct vndf_render_colour fourth =
        vndf_render_texel(looks.texels, lower + (uint)column.b, third.a, srgb);
    struct vndf_render_colour c =
        vndf_render_blended(vndf_render_blended(first, second, column.share),
                            vndf_render_blended(third, fourth, column.share), row.share);
    const int there = number >= 0.0f;
    c.r = there ? c.r : 1.0f;
    c.g = there ? c.g : 1.0f;
    c.b = there ? c.b : 1.0f;
    c.a = there ? c.a : 1.0f;
    return c;
}

// The same by its use, so that the effects are told apart.
#if VNDF_RENDER_TEXTURE
VNDF_FN struct vndf_render_colour vndf_render_base_texture(struct vndf_render_looks looks,
                                                           struct vndf_render_spot spot, float before) {
    return vndf_render_look(looks, spot, VNDF_SLOT_BASE_COLOUR, 1, before);
}
#endif
#if VNDF_RENDER_ROUGHNESS_TEXTURE
VNDF_FN struct vndf_render_colour vndf_render_roughness_texture(struct vndf_render_looks looks,
                                                                struct vndf_render_spot spot, float before) {
    return vndf_render_look(looks, spot, VNDF_SLOT_METALLIC_ROUGHNESS, 0, before);
}
#endif
#if VNDF_RENDER_LAYER_TEXTURE
VNDF_FN struct vndf_render_colour vndf_render_layer_texture(struct vndf_render_looks looks,
                                                            struct vndf_render_spot spot, uint slot,
                                                            float before) {
    return vndf_render_look(looks, spot, slot, slot == VNDF_SLOT_SPECULAR_COLOUR, before);
}
#endif
#if VNDF_RENDER_EMISSION_TEXTURE
VNDF_FN struct vndf_render_colour vndf_render_emission_texture(struct vndf_render_looks looks,
                                                               struct vndf_render_spot spot, float before) {
    return vndf_render_look(looks, spot, VNDF_SLOT_EMISSIVE, 1, before);
}
#endif
#if VNDF_RENDER_VERTEX_COLOUR
VNDF_FN struct vndf_render_colour vndf_render_vertex_colour(struct vndf_render_looks looks,
                                                            struct vndf_render_spot spot) {
    struct vndf_render_colour c;
    c.r = vndf_render_vertex(looks, spot, VNDF_VERTEX_COLOUR);
    c.g = vndf_render_vertex(looks, spot, VNDF_VERTEX_COLOUR + 1);
    c.b = vndf_render_vertex(looks, spot, VNDF_VERTEX_COLOUR + 2);
    c.a = vndf_render_vertex(looks, spot, VNDF_VERTEX_COLOUR + 3);
    return c;
}
#endif

#if VNDF_RENDER_EMISSION_TEXTURE || VNDF_RENDER_VERTEX_COLOUR
// A factor on what a surface shines with. Where it does nothing else (KHR_materials_unlit) vertices colour that.
VNDF_FN struct vndf_render_vector vndf_render_emission_look(struct vndf_render_looks looks,
                                                            struct vndf_render_spot spot, float before) {
    struct vndf_render_vector look = vndf_render_vector_of(1.0f, 1.0f, 1.0f);
#if VNDF_RENDER_EMISSION_TEXTURE
    const struct vndf_render_colour texture = vndf_render_emission_texture(looks, spot, before);
    look = vndf_render_vector_of(texture.r, texture.g, texture.b);
#else
    (void)before;
#endif
#if VNDF_RENDER_VERTEX_COLOUR
    const struct vndf_render_colour painted = vndf_render_vertex_colour(looks, spot);
    const int unlit = vndf_render_dressing(looks, spot, VNDF_DRESSING_UNLIT) > 0.0f;
    look = vndf_render_vector_of(unlit ? painted.r * look.x : look.x, unlit ? painted.g * look.y : look.y,
                                 unlit ? painted.b * look.z : look.z);
#endif
    return look;
}
#endif

#if VNDF_RENDER_ALPHA
// Whether light goes through a place as if there were nothing. chance: in [0, 1), of this ray at this triangle.
VNDF_FN int vndf_render_lets_pass(struct vndf_render_looks looks, uint triangle, float b1, float b2,
                                  float chance) {
    const struct vndf_render_spot spot = vndf_render_spot_of(looks, triangle, b1, b2);
    const float cutoff = vndf_render_dressing(looks, spot, VNDF_DRESSING_CUTOFF);
    if (cutoff == VNDF_ALPHA_OPAQUE) return 0;
    float alpha = vndf_render_dressing(looks, spot, VNDF_DRESSING_OPACITY);
#if VNDF_RENDER_TEXTURE
    alpha *= vndf_render_base_texture(looks, spot, 1.0f).a;
#endif
#if VNDF_RENDER_VERTEX_COLOUR
    alpha *= vndf_render_vertex_colour(looks, spot).a;
#endif
    return cutoff == VNDF_ALPHA_BLEND ? chance >= alpha : alpha < cutoff;
}
#endif

#endif
