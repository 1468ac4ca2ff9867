// Theirs: y along the normal. Exchanging two axes mirrors directions, which no distribution of normals minds; a map does.
#include "../right.cl"
float3 theirs(float3 wo, float2 alpha, float2 u) {
    return my_sample(wo.xzy, alpha, u).xzy;
}

// clvndf check --kernel y_up.cl --function adapted --as ggx_sample_wm
float3 adapted(float3 wo, float2 alpha, float2 u) {
    return theirs(wo.xzy, alpha, u).xzy;
}
