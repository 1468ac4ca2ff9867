// Benyoub 2024, its GLSL listing.

static inline float3 lean_ggx_sample_wm_benyoub2024(float3 wo, float3 n, float alpha, float2 u) {
    float zo = fma(wo.x, n.x, fma(wo.y, n.y, wo.z * n.z));
    // The stretched view direction, mirrored across n, as the listing has it.
    float px = zo * n.x, py = zo * n.y, pz = zo * n.z;
    float sx = fma(-alpha, wo.x - px, px), sy = fma(-alpha, wo.y - py, py), sz = fma(-alpha, wo.z - pz, pz);
    float r = lean_rcp_length(sx, sy, sz);
    sx *= r, sy *= r, sz *= r;
    float z = fma(sx, n.x, fma(sy, n.y, sz * n.z));
#if LEAN_FACTORED
    float tx = fma(-z, n.x, sx), ty = fma(-z, n.y, sy), tz = fma(-z, n.z, sz);
    float l2 = fma(tx, tx, fma(ty, ty, tz * tz)), sum = lean_sum(z, l2), cz = fma(1.0f - u.y, sum, -z);
    float st = sqrt(max(0.0f, lean_cap_square(u.y, cz, sum, lean_sum(-z, l2))));
#else
    float cz = fma(1.0f - u.y, 1.0f + z, -z), st = sqrt(max(0.0f, fma(-cz, cz, 1.0f)));
#endif
    // phi = (2 u1 - 1) pi: the other way round.
    float cx = -st * vndf_impl_circle_cos(u.x), cy = -st * vndf_impl_circle_sin(u.x);
    float up = n.z < 0.0f ? -1.0f : 1.0f, wz = n.z + up;
    float along = fma(n.x, cx, fma(n.y, cy, wz * (cz * up))) / fabs(wz);
    float hx = fma(along, n.x, sx - cx), hy = fma(along, n.y, sy - cy), hz = fma(along, wz, fma(-cz, up, sz));
    float height = fma(hx, n.x, fma(hy, n.y, hz * n.z));
    float ax = height * n.x, ay = height * n.y, az = height * n.z;
    float gx = fma(alpha, ax - hx, ax), gy = fma(alpha, ay - hy, ay), gz = fma(alpha, az - hz, az);
    float rcp = lean_rcp_length(gx, gy, gz);
    return (float3)(gx * rcp, gy * rcp, gz * rcp);
}
