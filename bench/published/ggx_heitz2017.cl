// Heitz, A Simpler and Exact Sampling Routine for the GGX Distribution of Visible Normals, 2017: its listing, line by
// line in float OpenCL C. Corrected: the parentheses of P2, without which `?:` binds last; T1 = (1, 0, 0) only where
// the cross product vanishes, because elsewhere it is not perpendicular to V.
#pragma OPENCL FP_CONTRACT ON

static inline float3 published_ggx_sample_wm_heitz2017(float3 V_, float2 alpha, float2 U) {
    // stretch view
    float3 V = normalize((float3)(alpha.x * V_.x, alpha.y * V_.y, V_.z));

    // orthonormal basis
    float3 T1 = V.x != 0.0f || V.y != 0.0f ? normalize(cross(V, (float3)(0.0f, 0.0f, 1.0f)))
                                           : (float3)(1.0f, 0.0f, 0.0f);
    float3 T2 = cross(T1, V);

    // sample point with polar coordinates (r, phi)
    float a = 1.0f / (1.0f + V.z);
    float r = sqrt(U.x);
    float phi = U.y < a ? U.y / a * M_PI_F : M_PI_F + (U.y - a) / (1.0f - a) * M_PI_F;
    float P1 = r * cos(phi);
    float P2 = r * sin(phi) * (U.y < a ? 1.0f : V.z);

    // compute normal
    float3 N = P1 * T1 + P2 * T2 + sqrt(max(0.0f, 1.0f - P1 * P1 - P2 * P2)) * V;

    // unstretch
    return normalize((float3)(alpha.x * N.x, alpha.y * N.y, max(0.0f, N.z)));
}
