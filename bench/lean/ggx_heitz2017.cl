// Heitz 2017, its listing: wo above the surface.

static inline float3 lean_ggx_sample_wm_heitz2017(float3 wo, float2 alpha, float2 u) {
    float x = alpha.x * wo.x, y = alpha.y * wo.y, r = lean_rcp_length(x, y, wo.z);
    x *= r, y *= r;
    float z = wo.z * r, l2 = fma(x, x, y * y), rcp = 1.0f / sqrt(l2);
    float ex = l2 > 0.0f ? x * rcp : 0.0f, ey = l2 > 0.0f ? y * rcp : 1.0f, sine = l2 * rcp;
    // T1 = (ey, -ex, 0), T2 = T1 x V = (-ex z, -ey z, sine).
    float a = 1.0f / (1.0f + z), radius = sqrt(u.x);
    int facing = u.y < a;
    float turn = 0.5f * (facing ? u.y / a : 1.0f + (u.y - a) / (1.0f - a));
    float p1 = radius * vndf_impl_circle_cos(turn);
    float p2 = radius * vndf_impl_circle_sin(turn) * (facing ? 1.0f : z);
    float depth = sqrt(max(0.0f, fma(-p1, p1, fma(-p2, p2, 1.0f))));
    float along = fma(depth, l2 > 0.0f ? sine : 0.0f, -p2 * z);
    return lean_unstretch(fma(along, ex, p1 * ey), fma(along, ey, -p1 * ex),
                          max(0.0f, fma(depth, z, l2 > 0.0f ? p2 * sine : 0.0f)), alpha);
}
