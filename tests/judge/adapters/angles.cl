// Theirs: angles in, angles out, the view in the plane of azimuth 0, one alpha.
#include "../right.cl"
float2 theirs(float theta_o, float alpha, float2 u) {
    const float3 m = my_sample((float3)(sin(theta_o), 0.0f, cos(theta_o)), (float2)(alpha), u);
    return (float2)(acos(clamp(m.z, -1.0f, 1.0f)), atan2(m.y, m.x));
}

// clvndf check --kernel angles.cl --function adapted --as ggx_sample_wm --isotropic --alpha 0.05:1
float3 adapted(float3 wo, float2 alpha, float2 u) {
    const float2 m = theirs(acos(clamp(wo.z, -1.0f, 1.0f)), alpha.x, u);
    const float theta = m.x, phi = m.y + atan2(wo.y, wo.x);
    return (float3)(sin(theta) * cos(phi), sin(theta) * sin(phi), cos(theta));
}
