// Dupuy & Benyoub, Sampling Visible GGX Normals with Spherical Caps, 2023: Listings 1 and 3, line by line in float
// OpenCL C, as one would paste them. Corrected: the last warp acts on the sampled normal, not on the view direction.
#pragma OPENCL FP_CONTRACT ON

static inline float3 published_impl_hemisphere_dupuy2023(float2 u, float3 wi) {
    // sample a spherical cap in (-wi.z, 1]
    float phi = 2.0f * M_PI_F * u.x;
    float z = fma(1.0f - u.y, 1.0f + wi.z, -wi.z);
    float sin_theta = sqrt(clamp(1.0f - z * z, 0.0f, 1.0f));
    float cos_phi;
    float sin_phi = sincos(phi, &cos_phi);
    float3 c = (float3)(sin_theta * cos_phi, sin_theta * sin_phi, z);
    // the halfway direction, normalised by the caller
    return c + wi;
}

static inline float3 published_ggx_sample_wm_dupuy2023(float3 wi, float2 alpha, float2 u) {
    // warp to the hemisphere
    float3 wi_std = normalize((float3)(wi.xy * alpha, wi.z));
    float3 wm_std = published_impl_hemisphere_dupuy2023(u, wi_std);
    // warp back to the ellipsoid
    return normalize((float3)(wm_std.xy * alpha, wm_std.z));
}
