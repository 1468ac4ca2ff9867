// Heitz & d'Eon 2014, supplemental material 1, Sections 3.5 and 4.5: wo above the surface. Cosine and sine of the angles are
// quotients; what the listing branches to is selected.

static inline float lean_erfinv(float x) {
    return x * vndf_impl_erfinv_ratio((1.0f - x) * (1.0f + x));
}

// Cosine, sine and azimuth of the stretched view direction.
struct lean_view {
    float c, s, ex, ey;
};
static inline struct lean_view lean_view_of(float3 wo, float2 alpha) {
    struct lean_view v;
    float x = alpha.x * wo.x, y = alpha.y * wo.y, l = sqrt(fma(x, x, y * y));
    float r = 1.0f / sqrt(fma(wo.z, wo.z, l * l)), rcp = l > 0.0f ? 1.0f / l : 0.0f;
    v.c = wo.z * r;
    v.s = l * r;
    v.ex = l > 0.0f ? x * rcp : 1.0f;
    v.ey = y * rcp;
    return v;
}

// The normal of the slopes, rotated and unstretched.
static inline float3 lean_normal(struct lean_view v, float slope_x, float slope_y, float2 alpha) {
    float x = alpha.x * fma(v.ex, slope_x, -v.ey * slope_y), y = alpha.y * fma(v.ey, slope_x, v.ex * slope_y);
    float rcp = lean_rcp_length(x, y, 1.0f);
    return (float3)(-x * rcp, -y * rcp, rcp);
}

static inline float3 lean_beckmann_sample_wm_heitz_deon2014(float3 wo, float2 alpha, float2 u) {
    struct lean_view v = lean_view_of(wo, alpha);
    // Normal incidence is the listing's: below the sine of 0.0001.
    float a = v.c / max(v.s, 0.0001f), exp_a2 = vndf_impl_expx2(a);
    float erf_a = fma(-vndf_impl_scaled_erfc_of(a).erfcx, exp_a2, 1.0f);
    float edge = 0.5f * VNDF_1_SQRT_PI * exp_a2;
    float lambda = fma(0.5f, erf_a - 1.0f, edge / a), cap = 1.0f - erf_a / (1.0f + lambda);
    // Sections: beyond the edge, the rest of the tail, the centre.
    int tail = u.x < cap;
    float t = u.x / cap, w1 = v.s * edge, p = w1 / fma(v.c, 0.5f - 0.5f * erf_a, w1);
    int beyond = tail && t < p;
    // The rest of its section, or of the centre: one quotient for both.
    float part = (tail ? t - p : u.x - cap) / (1.0f - (tail ? p : cap));
    float x_log = -sqrt(-vndf_impl_log((beyond ? t / p : 0.5f) * exp_a2));
    float x_erf = lean_erfinv(tail ? part - 1.0f - part * erf_a : (2.0f * part - 1.0f) * erf_a);
    float keep = fma(-x_erf, v.s, v.c) / (2.0f * v.c);
    int mirror = !tail && u.y > keep;
    float slope_x = beyond ? x_log : mirror ? -x_erf : x_erf;
    float u2 = tail ? u.y : (mirror ? u.y - keep : u.y) / (mirror ? 1.0f - keep : keep);
    float slope_y = lean_erfinv(2.0f * u2 - 1.0f);
    return lean_normal(v, slope_x, slope_y, alpha);
}

static inline float3 lean_ggx_sample_wm_heitz_deon2014(float3 wo, float2 alpha, float2 u) {
    struct lean_view v = lean_view_of(wo, alpha);
    float b = v.s / v.c, g1 = 2.0f / (1.0f + sqrt(fma(b, b, 1.0f)));
    float a = 2.0f * u.x / g1 - 1.0f, tmp = 1.0f / fma(a, a, -1.0f);
    tmp = min(tmp, 1e10f);
    float d = sqrt(max(0.0f, fma(b * b * tmp, tmp, -(fma(a, a, -b * b) * tmp))));
    float x1 = fma(b, tmp, -d), x2 = fma(b, tmp, d);
    float slope_x = a < 0.0f || x2 * b > 1.0f ? x1 : x2;
    int right = u.y > 0.5f;
    float w = 2.0f * fabs(u.y - 0.5f);
    float z = w * fma(w, fma(w, 0.27385f, -0.73369f), 0.46341f) /
              fma(w, fma(w, fma(w, 0.093073f, 0.309420f), -1.0f), 0.597999f);
    float slope_y = (right ? z : -z) * sqrt(fma(slope_x, slope_x, 1.0f));
    return lean_normal(v, slope_x, slope_y, alpha);
}
