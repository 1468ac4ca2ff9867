// Eto & Tokuyoshi, Bounded VNDF Sampling for Smith-GGX Reflections, 2023: Listing 1, line by line in float OpenCL C.
#pragma OPENCL FP_CONTRACT ON

static inline float3 published_ggx_sample_wi_eto2023(float3 i, float2 alpha, float2 u) {
    float3 i_std = normalize((float3)(i.xy * alpha, i.z));
    // sample a spherical cap
    float phi = 2.0f * M_PI_F * u.x;
    float a = clamp(min(alpha.x, alpha.y), 0.0f, 1.0f);
    float s = 1.0f + length(i.xy);
    float a2 = a * a;
    float s2 = s * s;
    float k = (1.0f - a2) * s2 / (s2 + a2 * i.z * i.z);
    float b = i.z > 0.0f ? k * i_std.z : i_std.z;
    float z = mad(1.0f - u.y, 1.0f + b, -b);
    float sin_theta = sqrt(clamp(1.0f - z * z, 0.0f, 1.0f));
    float cos_phi;
    float sin_phi = sincos(phi, &cos_phi);
    float3 o_std = (float3)(sin_theta * cos_phi, sin_theta * sin_phi, z);
    // compute the microfacet normal
    float3 m_std = i_std + o_std;
    float3 m = normalize((float3)(m_std.xy * alpha, m_std.z));
    // return the reflected direction
    return 2.0f * dot(i, m) * m - i;
}
