// Eto & Tokuyoshi 2023, Listing 1.

static inline float3 lean_ggx_sample_wi_eto2023(float3 wo, float2 alpha, float2 u) {
    float x = alpha.x * wo.x, y = alpha.y * wo.y, r = lean_rcp_length(x, y, wo.z);
    x *= r, y *= r;
    float z = wo.z * r, l2 = fma(x, x, y * y);
    float a = min(min(alpha.x, alpha.y), 1.0f), a2 = a * a;
    float s = 1.0f + sqrt(fma(wo.x, wo.x, wo.y * wo.y)), s2 = s * s, rcp = 1.0f / fma(a2 * wo.z, wo.z, s2);
#if LEAN_FACTORED
    float rest = wo.z > 0.0f ? a2 * fma(wo.z, wo.z, s2) * rcp : 0.0f;  // 1 - k
    float k = 1.0f - rest, sum = wo.z > 0.0f ? fma(k, z, 1.0f) : lean_sum(z, l2);
    float square = u.y * sum * fma(1.0f - u.y, sum, fma(k, lean_sum(-z, l2), rest));
    float hz = fma(1.0f - u.y, sum, rest * z);
#else
    float k = (1.0f - a2) * s2 * rcp, b = wo.z > 0.0f ? k * z : z;
    float cz = fma(1.0f - u.y, 1.0f + b, -b), square = fma(-cz, cz, 1.0f), hz = cz + z;
#endif
    float st = sqrt(max(0.0f, square));
    float3 m = lean_unstretch(fma(st, vndf_impl_circle_cos(u.x), x), fma(st, vndf_impl_circle_sin(u.x), y),
                              hz, alpha);
    float twice = 2.0f * fma(wo.x, m.x, fma(wo.y, m.y, wo.z * m.z));
    return (float3)(fma(twice, m.x, -wo.x), fma(twice, m.y, -wo.y), fma(twice, m.z, -wo.z));
}
