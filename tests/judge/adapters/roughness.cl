// Theirs: a perceptual roughness, whose square is alpha.
#include "../right.cl"
float3 theirs(float3 wo, float roughness, float2 u) {
    return my_sample(wo, (float2)(roughness * roughness), u);
}

// clvndf check --kernel roughness.cl --function adapted --as ggx_sample_wm --isotropic
float3 adapted(float3 wo, float2 alpha, float2 u) {
    return theirs(wo, sqrt(alpha.x), u);
}
