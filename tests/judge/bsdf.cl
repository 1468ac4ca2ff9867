// A rough conductor that reflects all: value times the cosine, density and samples; and mistakes in each.
#ifdef BRIGHT
#define REFLECTED 1.2f
#else
#define REFLECTED 1.0f
#endif
float3 stretched(float3 w, float2 alpha) {
    return normalize((float3)(alpha * w.xy, w.z));
}
float d_of(float3 m, float2 alpha) {
    const float3 s = (float3)(m.xy / alpha, m.z);
    return 1.0f / (M_PI_F * alpha.x * alpha.y * dot(s, s) * dot(s, s));
}
float lambda(float3 w, float2 alpha) {
    return (sqrt(1.0f + dot(alpha * w.xy, alpha * w.xy) / (w.z * w.z)) - 1.0f) / 2.0f;
}
float my_value(float3 wo, float3 wi, float2 alpha) {
    if (wo.z <= 0.0f || wi.z <= 0.0f) return 0.0f;
#ifdef ONE_SIDED
    const float g = 1.0f / (1.0f + lambda(wo, alpha));
#elif defined(NO_G)
    const float g = 1.0f;
#else
    const float g = 1.0f / (1.0f + lambda(wo, alpha) + lambda(wi, alpha));
#endif
    const float f = REFLECTED * d_of(normalize(wo + wi), alpha) * g / (4.0f * wo.z);
#ifdef NO_COSINE
    return f / wi.z;
#else
    return f;
#endif
}
float my_pdf(float3 wo, float3 wi, float2 alpha) {
    if (wo.z <= 0.0f || wi.z <= 0.0f) return 0.0f;
    const float3 m = normalize(wo + wi);
    const float visible = d_of(m, alpha) / ((1.0f + lambda(wo, alpha)) * wo.z);
#ifdef OTHER_PDF
    return d_of(m, alpha) * m.z / (4.0f * dot(wo, m));
#elif defined(DOUBLED)
    return visible / 2.0f;
#else
    return visible / 4.0f;
#endif
}
float4 my_sample(float3 wo, float2 alpha, float3 u) {
    const float3 v = stretched(wo, alpha);
    const float phi = 2.0f * M_PI_F * u.x, z = fma(1.0f - u.y, 1.0f + v.z, -v.z);
    const float s = sqrt(clamp(1.0f - z * z, 0.0f, 1.0f));
    const float3 m = stretched((float3)(s * cos(phi), s * sin(phi), z) + v, alpha);
    const float3 wi = 2.0f * dot(wo, m) * m - wo;
    if (wi.z <= 0.0f) return (float4)(0.0f, 0.0f, 1.0f, 0.0f);
#ifdef NO_DIRECTION
    if (u.z < 0.25f) return (float4)(NAN, NAN, NAN, 1.0f);
#endif
    const float weight =
        REFLECTED * (1.0f + lambda(wo, alpha)) / (1.0f + lambda(wo, alpha) + lambda(wi, alpha));
#ifdef WEIGHT_WITH_COSINE
    return (float4)(wi, weight * wi.z);
#else
    return (float4)(wi, weight);
#endif
}
