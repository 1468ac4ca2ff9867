// Dupuy & Benyoub 2023, Listings 1 and 3.

// The tangential length of a point of the cap, squared: 1 - cz^2 with cz = (1 - u2)(1 + z) - z.
static inline float lean_cap_square(float u2, float cz, float sum, float difference) {
#if LEAN_FACTORED
    return u2 * sum * fma(1.0f - u2, sum, difference);
#else
    return fma(-cz, cz, 1.0f);
#endif
}

static inline float3 lean_ggx_sample_wm_dupuy2023(float3 wo, float2 alpha, float2 u) {
    float x = alpha.x * wo.x, y = alpha.y * wo.y, r = lean_rcp_length(x, y, wo.z);
    x *= r, y *= r;
    float z = wo.z * r, l2 = fma(x, x, y * y), sum = lean_sum(z, l2);
    float cz = fma(1.0f - u.y, sum, -z);
    float st = sqrt(max(0.0f, lean_cap_square(u.y, cz, sum, lean_sum(-z, l2))));
    float hz = LEAN_FACTORED ? (1.0f - u.y) * sum : cz + z;
    return lean_unstretch(fma(st, vndf_impl_circle_cos(u.x), x), fma(st, vndf_impl_circle_sin(u.x), y), hz,
                          alpha);
}
