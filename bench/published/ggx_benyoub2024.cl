// Benyoub, VNDF Importance Sampling for an Isotropic Smith-GGX Distribution, 2024: its GLSL listing, line by line in
// float OpenCL C. Corrected: the axis `up` points to the side of n, so that wr.z is nowhere near 0.
#pragma OPENCL FP_CONTRACT ON

static inline float3 published_ggx_sample_wm_benyoub2024(float3 wi, float3 n, float alpha, float2 u) {
    // decompose the vector into parallel and perpendicular components
    float3 wi_z = n * dot(wi, n);
    float3 wi_xy = wi - wi_z;
    // warp to the hemisphere
    float3 wi_std = normalize(wi_z - alpha * wi_xy);
    // sample a spherical cap in (-wi_std.z, 1]
    float wi_std_z = dot(wi_std, n);
    float phi = (2.0f * u.x - 1.0f) * M_PI_F;
    float z = (1.0f - u.y) * (1.0f + wi_std_z) - wi_std_z;
    float sin_theta = sqrt(clamp(1.0f - z * z, 0.0f, 1.0f));
    float cos_phi;
    float sin_phi = sincos(phi, &cos_phi);
    // reflect the sample to align it with the normal
    float3 up = (float3)(0.0f, 0.0f, n.z < 0.0f ? -1.0f : 1.0f);
    float3 c_std = (float3)(sin_theta * cos_phi, sin_theta * sin_phi, z * up.z);
    float3 wr = n + up;
    float3 c = dot(wr, c_std) * wr / fabs(wr.z) - c_std;
    // compute the halfway direction as standard normal
    float3 wm_std = c + wi_std;
    float3 wm_std_z = n * dot(n, wm_std);
    float3 wm_std_xy = wm_std_z - wm_std;
    // warp back to the ellipsoid
    return normalize(wm_std_z + alpha * wm_std_xy);
}
