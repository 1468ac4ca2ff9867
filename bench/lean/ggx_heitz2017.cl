// Heitz 2017, its listing: wo above the surface.

static inline float3 lean_ggx_sample_wm_heitz2017(float3 wo, float2 alpha, float2 u) {
    float x = alpha.x * wo.x, y = alpha.y * wo.y, r = lean_rcp_length(x, y, wo.z);
    x *= r, y *= r;
    float z = wo.z * r, sine = sqrt(fma(x, x, y * y)), rcp = sine > 0.0f ? 1.0f / sine : 0.0f;
    float ex = x * rcp, ey = sine > 0.0f ? y * rcp : 1.0f;
    // T1 = (ey, -ex, 0), T2 = T1 x V = (-ex z, -ey z, sine).
    float a = 1.0f / (1.0f + z), radius = sqrt(u.x);
    int facing = u.y < a;
    float turn = 0.5f * ((facing ? u.y : u.y - a) / (facing ? a : 1.0f - a) + (facing ? 0.0f : 1.0f));
    float p1 = radius * vndf_impl_circle_cos(turn);
    float p2 = radius * vndf_impl_circle_sin(turn) * (facing ? 1.0f : z);
    float depth = sqrt(max(0.0f, fma(-p1, p1, fma(-p2, p2, 1.0f))));
    float along = fma(depth, sine, -p2 * z);
    return lean_unstretch(fma(along, ex, p1 * ey), fma(along, ey, -p1 * ex),
                          max(0.0f, fma(depth, z, p2 * sine)), alpha);
}
