// The density of visible normals with D from the cosine alone, as most have it: 1 - cos^2 loses what alpha is small beside.
float my_pdf(float3 wo, float3 wm, float2 alpha) {
    const float a2 = alpha.x * alpha.x, c2 = wm.z * wm.z, t = c2 * (a2 - 1.0f) + 1.0f;
    const float g1 = 2.0f / (1.0f + sqrt(1.0f + a2 * (1.0f - wo.z * wo.z) / (wo.z * wo.z)));
    return g1 * max(dot(wo, wm), 0.0f) * a2 / (M_PI_F * t * t) / wo.z;
}
