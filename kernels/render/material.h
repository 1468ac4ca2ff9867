// What a surface does with light: the only file of the renderer that knows materials.
#ifndef VNDF_RENDER_MATERIAL_H
#define VNDF_RENDER_MATERIAL_H

#include "language.h"
#include "queues.h"

struct vndf_render_bsdf {
    float alpha_x, alpha_y;
    float red, green, blue;  // f0 of a metal, else the albedo
    int metal;
};

// BSDF times cos(theta_i) over the density of a sample, and that density.
struct vndf_render_value {
    float red, green, blue, pdf;
};
struct vndf_render_scattered {
    float x, y, z;
    struct vndf_render_value value;
};

VNDF_FN struct vndf_render_bsdf vndf_render_bsdf_of(VNDF_RENDER_FROM(float) material) {
    struct vndf_render_bsdf b;
    b.alpha_x = material[VNDF_MATERIAL_ALPHA_X];
    b.alpha_y = material[VNDF_MATERIAL_ALPHA_Y];
    b.red = material[VNDF_MATERIAL_RED];
    b.green = material[VNDF_MATERIAL_GREEN];
    b.blue = material[VNDF_MATERIAL_BLUE];
    b.metal = material[VNDF_MATERIAL_METAL] > 0.5f;
    return b;
}

VNDF_FN float vndf_render_schlick(float f0, float rest) {
    const float rest2 = rest * rest;
    return VNDF_FMA(1.0f - f0, rest2 * rest2 * rest, f0);
}

VNDF_FN struct vndf_render_value vndf_render_weighed(struct vndf_render_bsdf b, struct vndf_ggx_lobe lobe,
                                                     VNDF_REAL3 wi, float pdf) {
    struct vndf_render_value value;
    const float cosine2 =
        VNDF_FMA(0.5f, VNDF_FMA(lobe.wo_x, wi.x, VNDF_FMA(lobe.wo_y, wi.y, lobe.wo_z * wi.z)), 0.5f);
    const float rest = 1.0f - VNDF_SQRT(vndf_impl_min(vndf_impl_max(cosine2, 0.0f), 1.0f));
    const float masked = vndf_ggx_weight_lobe(lobe, wi), above = wi.z > 0.0f ? 1.0f : 0.0f;
    value.red = b.metal ? masked * vndf_render_schlick(b.red, rest) : above * b.red;
    value.green = b.metal ? masked * vndf_render_schlick(b.green, rest) : above * b.green;
    value.blue = b.metal ? masked * vndf_render_schlick(b.blue, rest) : above * b.blue;
    value.pdf = pdf;
    return value;
}

VNDF_FN struct vndf_render_value vndf_render_evaluate(struct vndf_render_bsdf b, VNDF_REAL3 wo, VNDF_REAL3 wi) {
    const struct vndf_ggx_lobe lobe = vndf_ggx_lobe_of(wo, VNDF_MAKE2(b.alpha_x, b.alpha_y));
    const float diffuse = VNDF_1_PI * vndf_impl_max(wi.z, 0.0f);
    return vndf_render_weighed(b, lobe, wi, b.metal ? vndf_ggx_pdf_wi_lobe(lobe, wi) : diffuse);
}

VNDF_FN struct vndf_render_scattered vndf_render_scatter(struct vndf_render_bsdf b, VNDF_REAL3 wo, float u1,
                                                         float u2) {
    const struct vndf_ggx_lobe lobe = vndf_ggx_lobe_of(wo, VNDF_MAKE2(b.alpha_x, b.alpha_y));
    const VNDF_REAL4 wm = vndf_ggx_sample_wm_dupuy2023_lobe_with_pdf(lobe, VNDF_MAKE2(u1, u2));
    const VNDF_REAL3 m = VNDF_MAKE3(wm.x, wm.y, wm.z), mirrored = vndf_reflect(wo, m);
    const float mirrored_pdf = vndf_impl_finite(wm.w * vndf_jacobian_reflect(wo, m));
    const float v1 = vndf_impl_u(u1), v2 = vndf_impl_u(u2), radius = VNDF_SQRT(v2);
    const float height = VNDF_SQRT(radius >= 0.0f ? 1.0f - v2 : 1.0f);
    struct vndf_render_scattered s;
    s.x = b.metal ? mirrored.x : radius * vndf_impl_circle_cos(v1);
    s.y = b.metal ? mirrored.y : radius * vndf_impl_circle_sin(v1);
    s.z = b.metal ? mirrored.z : height;
    s.value = vndf_render_weighed(b, lobe, VNDF_MAKE3(s.x, s.y, s.z), b.metal ? mirrored_pdf : VNDF_1_PI * height);
    return s;
}

#endif
