// Heitz, Sampling the GGX Distribution of Visible Normals, 2018, as restated by Dupuy & Benyoub 2023: Listings 1 and 2,
// line by line in float OpenCL C. Corrected: the last warp acts on the sampled normal, not on the view direction.
#pragma OPENCL FP_CONTRACT ON

static inline float3 published_impl_hemisphere_heitz2018(float2 u, float3 wi) {
    // orthonormal basis, with a special case where the cross product vanishes
    float tmp = wi.x * wi.x + wi.y * wi.y;
    float3 w1 = tmp > 0.0f ? (float3)(-wi.y, wi.x, 0.0f) * rsqrt(tmp) : (float3)(1.0f, 0.0f, 0.0f);
    float3 w2 = cross(wi, w1);
    // parameterisation of the cross section
    float phi = 2.0f * M_PI_F * u.x;
    float r = sqrt(u.y);
    float cos_phi;
    float sin_phi = sincos(phi, &cos_phi);
    float t1 = r * cos_phi;
    float t2 = r * sin_phi;
    float s = (1.0f + wi.z) / 2.0f;
    t2 = (1.0f - s) * sqrt(1.0f - t1 * t1) + s * t2;
    float ti = sqrt(max(1.0f - t1 * t1 - t2 * t2, 0.0f));
    // reprojection onto the hemisphere
    return t1 * w1 + t2 * w2 + ti * wi;
}

static inline float3 published_ggx_sample_wm_heitz2018(float3 wi, float2 alpha, float2 u) {
    float3 wi_std = normalize((float3)(wi.xy * alpha, wi.z));
    float3 wm_std = published_impl_hemisphere_heitz2018(u, wi_std);
    return normalize((float3)(wm_std.xy * alpha, wm_std.z));
}
