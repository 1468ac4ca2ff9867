// Theirs: the slopes of the facet.
#include "../right.cl"
float2 theirs(float3 wo, float2 alpha, float2 u) {
    const float3 m = my_sample(wo, alpha, u);
    return -m.xy / max(m.z, 1e-6f);
}

// clvndf check --kernel unnormalised.cl --function adapted --as ggx_sample_wm
float3 adapted(float3 wo, float2 alpha, float2 u) {
    return normalize((float3)(-theirs(wo, alpha, u), 1.0f));
}
