// A sampler of GGX visible normals and its density, as one writes them who knows how: by the spherical cap.
float3 my_sample(float3 wo, float2 alpha, float2 u) {
    const float3 v = normalize((float3)(alpha * wo.xy, wo.z));
    const float phi = 2.0f * M_PI_F * u.x;
    const float z = fma(1.0f - u.y, 1.0f + v.z, -v.z);
    const float s = sqrt(clamp(1.0f - z * z, 0.0f, 1.0f));
    const float3 h = (float3)(s * cos(phi), s * sin(phi), z) + v;
    return normalize((float3)(alpha * h.xy, h.z));
}

float my_pdf(float3 wo, float3 wm, float2 alpha) {
    const float3 s = (float3)(wm.xy / alpha, wm.z);
    const float d = 1.0f / (M_PI_F * alpha.x * alpha.y * dot(s, s) * dot(s, s));
    const float lambda = (-1.0f + sqrt(1.0f + dot(alpha * wo.xy, alpha * wo.xy) / (wo.z * wo.z))) / 2.0f;
    return d * max(dot(wo, wm), 0.0f) / ((1.0f + lambda) * wo.z);
}
