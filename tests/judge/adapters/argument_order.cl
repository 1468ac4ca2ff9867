// Theirs: u first, the two alphas as numbers.
#include "../right.cl"
float3 theirs(float2 u, float alpha_x, float alpha_y, float3 view) {
    return my_sample(view, (float2)(alpha_x, alpha_y), u);
}

// clvndf check --kernel argument_order.cl --function adapted --as ggx_sample_wm
float3 adapted(float3 wo, float2 alpha, float2 u) {
    return theirs(u, alpha.x, alpha.y, wo);
}
