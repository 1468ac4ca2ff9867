// Does not compile: alpa, in line 4.
float3 my_sample(float3 wo, float2 alpha, float2 u) {
    const float phi = 2.0f * M_PI_F * u.x;
    return normalize((float3)(alpa * wo.xy + phi, wo.z));
}
