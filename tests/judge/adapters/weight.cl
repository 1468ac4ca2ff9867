// Theirs: a sample with its weight, value times cosine over density, and the value; no density, which the two tell.
#include "../right.cl"
float g1(float3 w, float2 alpha) {
    return 2.0f / (1.0f + sqrt(1.0f + dot(alpha * w.xy, alpha * w.xy) / (w.z * w.z)));
}
float g2(float3 wo, float3 wi, float2 alpha) {
    return 1.0f / (1.0f / g1(wo, alpha) + 1.0f / g1(wi, alpha) - 1.0f);
}
float value(float3 wo, float3 wi, float2 alpha) {
    const float3 m = normalize(wo + wi);
    return my_pdf(wo, m, alpha) * g2(wo, wi, alpha) / g1(wo, alpha) / (4.0f * dot(wo, m) * wi.z);
}
float4 theirs(float3 wo, float2 alpha, float2 u) {
    const float3 m = my_sample(wo, alpha, u), wi = 2.0f * dot(wo, m) * m - wo;
    return (float4)(wi, wi.z > 0.0f ? g2(wo, wi, alpha) / g1(wo, alpha) : 0.0f);
}

// clvndf check --kernel weight.cl --function adapted --as ggx_sample_wi --pdf adapted_pdf
float3 adapted(float3 wo, float2 alpha, float2 u) {
    return theirs(wo, alpha, u).xyz;
}
// What the weight would be of a sample that happens to be wi.
float adapted_pdf(float3 wo, float3 wi, float2 alpha) {
    const float weight = g2(wo, wi, alpha) / g1(wo, alpha);
    return value(wo, wi, alpha) * wi.z / weight;
}
