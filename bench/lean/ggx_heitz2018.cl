// Heitz 2018 as restated by Dupuy & Benyoub 2023, Listings 1 and 2.

static inline float3 lean_ggx_sample_wm_heitz2018(float3 wo, float2 alpha, float2 u) {
    float x = alpha.x * wo.x, y = alpha.y * wo.y, r = lean_rcp_length(x, y, wo.z);
    x *= r, y *= r;
    float z = wo.z * r, l2 = fma(x, x, y * y), rcp = 1.0f / sqrt(l2);
    float ex = l2 > 0.0f ? x * rcp : 0.0f, ey = l2 > 0.0f ? y * rcp : -1.0f,
          sine = l2 > 0.0f ? l2 * rcp : 0.0f;
    // w1 = (-ey, ex, 0), w2 = V x w1 = (-ex z, -ey z, sine).
    float radius = sqrt(u.y), t1 = radius * vndf_impl_circle_cos(u.x),
          t2 = radius * vndf_impl_circle_sin(u.x);
    float s = 0.5f * (1.0f + z);
    t2 = fma(1.0f - s, sqrt(fma(-t1, t1, 1.0f)), s * t2);
    float depth = sqrt(max(0.0f, fma(-t1, t1, fma(-t2, t2, 1.0f))));
    float along = fma(depth, sine, -t2 * z);
    return lean_unstretch(fma(along, ex, -t1 * ey), fma(along, ey, t1 * ex), fma(depth, z, t2 * sine), alpha);
}
