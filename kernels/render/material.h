// What a surface does with light: the only file of the renderer that knows vndf_bsdf, its effects and choices.
//
// VNDF_DRAW says how directions are drawn: bsdf (default), by the material's own sampler; or, to compare with, ndf: mirrored
// about a normal of the distribution, seen or not, and cosine: by the cosine law whatever the material.
#ifndef VNDF_RENDER_MATERIAL_H
#define VNDF_RENDER_MATERIAL_H

#include "../vndf/bsdf.h"
#include "effects.h"
#include "language.h"
#include "queues.h"

#ifndef VNDF_DRAW
#define VNDF_DRAW bsdf
#endif
#define VNDF_DRAW_IS_bsdf 1
#define VNDF_DRAW_IS_ndf 2
#define VNDF_DRAW_IS_cosine 3
#if VNDF_CAT(VNDF_DRAW_IS_, VNDF_DRAW) >= 1
#else
#error "clvndf: unknown VNDF_DRAW; bsdf, ndf and cosine are allowed"
#endif
#if VNDF_CHOSEN(VNDF_DRAW, ndf) && VNDF_CONDUCTOR
#include "../vndf/beckmann_walter2007.h"
#include "../vndf/ggx_walter2007.h"
#endif

#if VNDF_RENDER_CONES
#if !VNDF_CHOSEN(VNDF_NDF, ggx)
#error "clvndf: VNDF_LIGHTS_BY cones: only GGX has them"
#endif
#include "../vndf/ggx_cone2026.h"
#endif

VNDF_RENDER_UNCONTRACTED

// BSDF times cos(theta_i) over the density of a sample, and that density.
struct vndf_render_value {
    struct vndf_rgb weight;
    float pdf;
};
struct vndf_render_direction {
    float x, y, z;
    struct vndf_render_value value;
};

// A row of the table of materials. one: 1.0f, a number that the compiler does not know.
struct vndf_render_row {
    uint count, number;
    float one;
};
VNDF_FN struct vndf_render_row vndf_render_row_of(struct vndf_render_sizes sizes, uint number) {
    struct vndf_render_row row;
    row.count = sizes.materials;
    row.number = number;
    row.one = sizes.one;
    return row;
}

// Three channels. LLVM would pack neighbours of which the same is computed, and PoCL then not vectorise across work-items: for
// the compiler each is something else.
VNDF_FN struct vndf_rgb vndf_render_rgb_at(VNDF_RENDER_FROM(float) materials, struct vndf_render_row row,
                                           uint plane) {
    // Each from a place of its own: places counted from one LLVM packs as well, where there are many.
    VNDF_RENDER_FROM(float) const from = materials + plane * row.count;
    return vndf_impl_rgb(from[row.number], row.one * (from + row.count)[row.number],
                         row.one * (row.one * (from + 2 * row.count)[row.number]));
}

// How a path's material looks at the place where it is (dress.h).
struct vndf_render_look {
    VNDF_RENDER_FROM(float) planes;
    uint stride, i;
};
VNDF_FN struct vndf_render_look vndf_render_look_of(VNDF_RENDER_FROM(float) planes, uint stride, uint i) {
    struct vndf_render_look look;
    look.planes = planes;
    look.stride = stride;
    look.i = i;
    return look;
}
VNDF_FN float vndf_render_looks_like(struct vndf_render_look look, uint plane) {
    return look.planes[plane * look.stride + look.i];
}
VNDF_FN struct vndf_rgb vndf_render_times(struct vndf_rgb rgb, struct vndf_render_look look, uint plane) {
    // Each channel waits for the one before, as in texture.h.
    const float r = rgb.r * vndf_render_looks_like(look, plane);
    const float g = rgb.g * (r >= 0.0f ? vndf_render_looks_like(look, plane + 1) : 0.0f);
    const float b = rgb.b * (g >= 0.0f ? vndf_render_looks_like(look, plane + 2) : 0.0f);
    return vndf_impl_rgb(r, g, b);
}

// What textures change of a material.
VNDF_FN struct vndf_bsdf vndf_render_dressed(struct vndf_bsdf b, struct vndf_render_look look) {
#if VNDF_RENDER_TEXTURE || VNDF_RENDER_VERTEX_COLOUR
#if VNDF_CONDUCTOR && (VNDF_CHOSEN(VNDF_FRESNEL, schlick) || VNDF_CHOSEN(VNDF_FRESNEL, f82))
    b.f0 = vndf_render_times(b.f0, look, VNDF_LOOK_BASE);
#endif
#if VNDF_LAMBERT
    b.albedo = vndf_render_times(b.albedo, look, VNDF_LOOK_BASE);
#endif
#if VNDF_DIELECTRIC && VNDF_TINT
    b.transmittance = vndf_render_times(b.transmittance, look, VNDF_LOOK_BASE);
#endif
#endif
#if VNDF_RENDER_ROUGHNESS_TEXTURE || VNDF_RENDER_LAYER_TEXTURE
#if VNDF_CONDUCTOR || VNDF_DIELECTRIC
    b.alpha_x = vndf_render_looks_like(look, VNDF_LOOK_ALPHA_X);
#if VNDF_ANISOTROPIC
    b.alpha_y = vndf_render_looks_like(look, VNDF_LOOK_ALPHA_Y);
#endif
#endif
#endif
#if VNDF_RENDER_ROUGHNESS_TEXTURE && VNDF_CONDUCTOR && (VNDF_LAMBERT || VNDF_DIELECTRIC)
    b.metal *= vndf_render_looks_like(look, VNDF_LOOK_METAL);
#endif
#if VNDF_RENDER_LAYER_TEXTURE
#if VNDF_DIELECTRIC && VNDF_LAMBERT
    b.transmission *= vndf_render_looks_like(look, VNDF_LOOK_TRANSMISSION);
#endif
#if VNDF_DIELECTRIC && VNDF_SPECULAR
    b.specular *= vndf_render_looks_like(look, VNDF_LOOK_SPECULAR);
    b.specular_colour = vndf_render_times(b.specular_colour, look, VNDF_LOOK_SPECULAR_COLOUR);
#endif
#if VNDF_COAT
    b.coat *= vndf_render_looks_like(look, VNDF_LOOK_COAT);
    b.coat_alpha = vndf_render_looks_like(look, VNDF_LOOK_COAT_ALPHA);
#endif
#endif
    (void)look;
    return b;
}

// A material of the table, at a point with this geometric normal in its frame. channel: that light is carried in, of a surface
// with a dispersion the only one.
VNDF_FN struct vndf_bsdf vndf_render_bsdf_of(VNDF_RENDER_FROM(float) materials, struct vndf_render_row row,
                                             int channel, float ng_x, float ng_y, float ng_z) {
    struct vndf_bsdf b;
#if VNDF_CONDUCTOR || VNDF_DIELECTRIC
    b.alpha_x = materials[VNDF_MATERIAL_ALPHA_X * row.count + row.number];
#if VNDF_ANISOTROPIC
    b.alpha_y = materials[VNDF_MATERIAL_ALPHA_Y * row.count + row.number];
#endif
#endif
#if VNDF_CONDUCTOR
#if VNDF_CHOSEN(VNDF_FRESNEL, conductor)
    b.eta = vndf_render_rgb_at(materials, row, VNDF_MATERIAL_FIRST);
    b.k = vndf_render_rgb_at(materials, row, VNDF_MATERIAL_SECOND);
#elif VNDF_CHOSEN(VNDF_FRESNEL, schlick)
    b.f0 = vndf_render_rgb_at(materials, row, VNDF_MATERIAL_FIRST);
    b.f90 = materials[VNDF_MATERIAL_SECOND * row.count + row.number];
#elif VNDF_CHOSEN(VNDF_FRESNEL, f82)
    b.f0 = vndf_render_rgb_at(materials, row, VNDF_MATERIAL_FIRST);
    b.f82 = vndf_render_rgb_at(materials, row, VNDF_MATERIAL_SECOND);
#endif
#if VNDF_TINT
    b.tint = vndf_render_rgb_at(materials, row, VNDF_MATERIAL_TINT);
#endif
#endif
#if VNDF_LAMBERT
    b.albedo = vndf_render_rgb_at(materials, row, VNDF_MATERIAL_ALBEDO);
#endif
#if VNDF_CONDUCTOR && (VNDF_LAMBERT || VNDF_DIELECTRIC)
    b.metal = materials[VNDF_MATERIAL_METAL * row.count + row.number];
#endif
#if VNDF_DIELECTRIC
    b.ior = materials[VNDF_MATERIAL_IOR * row.count + row.number];
#if VNDF_LAMBERT
    b.transmission = materials[VNDF_MATERIAL_TRANSMISSION * row.count + row.number];
#endif
#if VNDF_TINT
    b.transmittance = vndf_render_rgb_at(materials, row, VNDF_MATERIAL_TRANSMITTANCE);
#endif
#if VNDF_SPECULAR
    b.specular = materials[VNDF_MATERIAL_SPECULAR * row.count + row.number];
    b.specular_colour = vndf_render_rgb_at(materials, row, VNDF_MATERIAL_SPECULAR_COLOUR);
#endif
#if VNDF_THIN_WALLED
    b.thin_walled = materials[VNDF_MATERIAL_THIN_WALLED * row.count + row.number] != 0.0f;
#endif
#if VNDF_DISPERSION
    b.dispersion = materials[VNDF_MATERIAL_DISPERSION * row.count + row.number];
    b.channel = channel;
#endif
#if VNDF_ABSORPTION
    b.absorption = vndf_render_rgb_at(materials, row, VNDF_MATERIAL_ABSORPTION);
#endif
#endif
    (void)channel;
#if VNDF_LAMBERT && VNDF_ROUGH_DIFFUSE
    b.diffuse_roughness = materials[VNDF_MATERIAL_DIFFUSE_ROUGHNESS * row.count + row.number];
#endif
#if VNDF_COAT
    b.coat = materials[VNDF_MATERIAL_COAT * row.count + row.number];
    b.coat_alpha = materials[VNDF_MATERIAL_COAT_ALPHA * row.count + row.number];
#endif
#if VNDF_SHADING_NORMAL
    b.ng_x = ng_x;
    b.ng_y = ng_y;
    b.ng_z = ng_z;
#else
    (void)ng_x;
    (void)ng_y;
    (void)ng_z;
#endif
    return b;
}

#if VNDF_DIELECTRIC && VNDF_ABSORPTION
// What the body (VNDF_PATH_BODY) leaves of light after a way through it; everything outside of all.
VNDF_FN struct vndf_rgb vndf_render_left(struct vndf_render_sizes sizes, VNDF_RENDER_FROM(float) materials,
                                         float body, float length) {
    const struct vndf_render_row row = vndf_render_row_of(sizes, body > 0.0f ? (uint)(int)body - 1 : 0);
    return vndf_bsdf_transmittance(vndf_render_bsdf_of(materials, row, 0, 0.0f, 0.0f, 1.0f),
                                   body > 0.0f ? length : 0.0f);
}
#endif

#if VNDF_RENDER_CAPS_ALONE
// Whether samples of lights that fill a cap bring all of them here. Cones are those of the base's facets: what a coat reflects is
// left to even samples and to the material's own, weighed.
VNDF_FN int vndf_render_caps_alone(struct vndf_bsdf b) {
#if VNDF_RENDER_CONES && VNDF_COAT
    return !(b.coat > 0.0f);
#else
    (void)b;
    return 1;
#endif
}
#endif

#if VNDF_RENDER_CONES
// Of what a material without a coat sends from wo into a cap, the part that its facets reflect: about, from how often it draws them. 1
// where there is nothing else. Of a cap that the horizon cuts, half of it, since many reflections go into the part below.
VNDF_FN float vndf_render_facets_part(VNDF_REAL3 wo, VNDF_REAL3 l, float one_minus_cos, struct vndf_bsdf b) {
    const struct vndf_impl_bsdf_view v = vndf_impl_bsdf_view_of(wo, b);
    const VNDF_REAL3 on_side = VNDF_MAKE3(l.x, l.y, v.side * l.z);
    const float metal = vndf_impl_bsdf_metal_drawn(v);
#if VNDF_DIELECTRIC
    const float f =
        vndf_fresnel_dielectric(vndf_impl_half_cosine(vndf_impl_real3(v.o), on_side), v.media.eta);
    const float facets = metal + vndf_impl_odds_of(v.media, f).reflected;
    const float others = vndf_impl_max((1.0f - metal) - v.media.specular, 0.0f);
#else
    const float facets = metal, others = 1.0f - metal;
#endif
    const float reflected = facets * vndf_ggx_cap_probability(vndf_impl_real3(v.o), on_side, one_minus_cos,
                                                              vndf_impl_bsdf_alpha(b));
    // Of light that is spread by the cosine; of a cap at the horizon a part counts.
    const float spread = others * 2.0f * one_minus_cos * vndf_impl_max(on_side.z, 0.1f);
    const float sum = reflected + spread;
    const int cut = on_side.z <= 0.0f || on_side.z * on_side.z < one_minus_cos * (2.0f - one_minus_cos);
    return sum > 0.0f ? (cut ? 0.5f : 1.0f) * reflected / sum : 0.0f;
}
#endif

// f / pdf.
VNDF_FN struct vndf_rgb vndf_render_over(struct vndf_rgb f, float pdf) {
    return vndf_impl_rgb_scaled(f, 1.0f / vndf_impl_max(pdf, 1e-30f));
}

#if VNDF_CHOSEN(VNDF_DRAW, bsdf)

VNDF_FN struct vndf_render_value vndf_render_evaluate(VNDF_REAL3 wo, VNDF_REAL3 wi, struct vndf_bsdf b) {
    const struct vndf_bsdf_value known = vndf_bsdf_eval_pdf(wo, wi, b);
    struct vndf_render_value value;
    value.weight = vndf_render_over(known.f, known.pdf);
    value.pdf = known.pdf;
    return value;
}

VNDF_FN struct vndf_render_direction vndf_render_draw(VNDF_REAL3 wo, struct vndf_bsdf b, VNDF_REAL2 u,
                                                      float u_lobe) {
    const struct vndf_bsdf_direction drawn = vndf_bsdf_sample(wo, b, u, u_lobe);
    struct vndf_render_direction d;
    d.x = drawn.wi_x;
    d.y = drawn.wi_y;
    d.z = drawn.wi_z;
    d.value.weight = drawn.weight;
    d.value.pdf = drawn.pdf;
    return d;
}

#else

// The share of the samples that are normals of the distribution.
VNDF_FN float vndf_render_mirrored_share(struct vndf_bsdf b) {
#if !VNDF_CONDUCTOR || VNDF_CHOSEN(VNDF_DRAW, cosine)
    (void)b;
    return 0.0f;
#elif VNDF_LAMBERT || VNDF_DIELECTRIC
    return b.metal;
#else
    (void)b;
    return 1.0f;
#endif
}

#if VNDF_CONDUCTOR && VNDF_CHOSEN(VNDF_DRAW, ndf)
VNDF_FN float vndf_render_mirrored_pdf(VNDF_REAL3 wo, VNDF_REAL3 wi, struct vndf_bsdf b) {
    const float x = wo.x + wi.x, y = wo.y + wi.y, z = wo.z + wi.z;
    const float scale = 1.0f / VNDF_SQRT(vndf_impl_max(VNDF_FMA(x, x, VNDF_FMA(y, y, z * z)), 1e-30f));
    const VNDF_REAL3 wm = VNDF_MAKE3(x * scale, y * scale, z * scale);
#if VNDF_CHOSEN(VNDF_NDF, beckmann)
    const float pdf = vndf_beckmann_pdf_wm_walter2007(wm, vndf_impl_bsdf_alpha(b));
#else
    const float pdf = vndf_ggx_pdf_wm_walter2007(wm, vndf_impl_bsdf_alpha(b));
#endif
    return vndf_impl_bounded_product(vndf_jacobian_reflect(wo, wm), pdf);
}
#endif

VNDF_FN float vndf_render_pdf(VNDF_REAL3 wo, VNDF_REAL3 wi, struct vndf_bsdf b) {
    const float share = vndf_render_mirrored_share(b), cosine = (1.0f - share) * vndf_lambert_pdf_wi(wi);
#if VNDF_CONDUCTOR && VNDF_CHOSEN(VNDF_DRAW, ndf)
    return VNDF_FMA(share, vndf_render_mirrored_pdf(wo, wi, b), cosine);
#else
    (void)wo;
    return cosine;
#endif
}

VNDF_FN struct vndf_render_value vndf_render_evaluate(VNDF_REAL3 wo, VNDF_REAL3 wi, struct vndf_bsdf b) {
    struct vndf_render_value value;
    value.pdf = vndf_render_pdf(wo, wi, b);
    value.weight = vndf_render_over(vndf_bsdf_eval(wo, wi, b), value.pdf);
    return value;
}

VNDF_FN struct vndf_render_direction vndf_render_draw(VNDF_REAL3 wo, struct vndf_bsdf b, VNDF_REAL2 u,
                                                      float u_lobe) {
    const VNDF_REAL3 even = vndf_lambert_sample_wi(u);
    const int mirrored = u_lobe < vndf_render_mirrored_share(b);
    struct vndf_render_direction d;
    VNDF_REAL3 wi = even;
#if VNDF_CONDUCTOR && VNDF_CHOSEN(VNDF_DRAW, ndf)
#if VNDF_CHOSEN(VNDF_NDF, beckmann)
    const VNDF_REAL3 wm = vndf_beckmann_sample_wm_walter2007(vndf_impl_bsdf_alpha(b), u);
#else
    const VNDF_REAL3 wm = vndf_ggx_sample_wm_walter2007(vndf_impl_bsdf_alpha(b), u);
#endif
    const VNDF_REAL3 turned = vndf_reflect(wo, wm);
    wi = VNDF_MAKE3(mirrored ? turned.x : even.x, mirrored ? turned.y : even.y, mirrored ? turned.z : even.z);
#else
    (void)mirrored;
#endif
    d.x = wi.x;
    d.y = wi.y;
    d.z = wi.z;
    d.value = vndf_render_evaluate(wo, wi, b);
    return d;
}

#endif

#endif
