// Theirs: the direction of the ray that arrives, and that of the one that leaves.
#include "../right.cl"
float3 theirs(float3 ray, float2 alpha, float2 u) {
    const float3 m = my_sample(-ray, alpha, u);
    return ray - 2.0f * dot(ray, m) * m;
}

// clvndf check --kernel to_surface.cl --function adapted --as ggx_sample_wi
float3 adapted(float3 wo, float2 alpha, float2 u) {
    return theirs(-wo, alpha, u);
}
