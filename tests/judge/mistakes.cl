// Known mistakes in samplers and densities, each where it is defined; without any they are right.

// --- What alpha and wo are ---
#ifdef EXCHANGED
#define ALPHA(a) ((a).yx)
#elif defined(SQUARED)
#define ALPHA(a) ((a) * (a))
#elif defined(ROOT)
#define ALPHA(a) sqrt(a)
#elif defined(ISOTROPIC)
#define ALPHA(a) ((a).xx)
#else
#define ALPHA(a) (a)
#endif

#ifdef TO_SURFACE
#define WO(w) (-(w))
#elif defined(TURNED)
#define WO(w) ((float3)(-(w).xy, (w).z))
#elif defined(Y_UP)
#define WO(w) ((w).xzy)
#else
#define WO(w) (w)
#endif

#ifdef HALF_AZIMUTH
#define TURN M_PI_F
#else
#define TURN (2.0f * M_PI_F)
#endif

// The result, in the frame and of the kind that is asked for.
float3 result_of(float3 wo, float3 wm) {
#ifdef Y_UP
    return wm.xzy;
#elif defined(INTO_SURFACE)
    return -wm;
#elif defined(REFLECTED)
    return 2.0f * dot(wo, wm) * wm - wo;
#else
    return wm;
#endif
}

float3 stretched(float3 w, float2 alpha) {
    return normalize((float3)(alpha * w.xy, w.z));
}
float3 frame_x(float3 v) {
    return v.z < 0.9999f ? normalize((float3)(-v.y, v.x, 0.0f)) : (float3)(1.0f, 0.0f, 0.0f);
}

// --- GGX: normals by the spherical cap ---
float3 ggx_cap(float3 wo_in, float2 alpha_in, float2 u) {
    const float2 alpha = ALPHA(alpha_in);
    const float3 wo = WO(wo_in);
#ifdef VIEW_NOT_STRETCHED
    const float3 v = wo;
#else
    const float3 v = stretched(wo, alpha);
#endif
#ifdef ONE_NUMBER
    u.y = u.x;
#endif
    const float phi = TURN * u.x;
    const float z = fma(1.0f - u.y, 1.0f + v.z, -v.z);
    const float s = sqrt(clamp(1.0f - z * z, 0.0f, 1.0f));
    const float3 h = (float3)(s * cos(phi), s * sin(phi), z) + v;
#ifdef NOT_STRETCHED_BACK
    return normalize(h);
#elif defined(VIEW_FOR_SAMPLE)
    return result_of(wo_in, stretched(v, alpha));
#else
    return result_of(wo_in, stretched(h, alpha));
#endif
}
float3 ggx_reflection(float3 wo, float2 alpha, float2 u) {
    const float3 wm = ggx_cap(wo, alpha, u);
    return 2.0f * dot(wo, wm) * wm - wo;
}

// --- GGX: normals by the cross section ---
float3 ggx_section(float3 wo, float2 alpha_in, float2 u) {
    const float2 alpha = ALPHA(alpha_in);
    const float3 v = stretched(wo, alpha), t1 = frame_x(v);
#ifdef T2_FLIPPED
    const float3 t2 = cross(t1, v);
#else
    const float3 t2 = cross(v, t1);
#endif
#ifdef NO_ROOT
    const float r = u.x;
#else
    const float r = sqrt(u.x);
#endif
    const float phi = TURN * u.y, s = 0.5f * (1.0f + v.z), p1 = r * cos(phi);
    const float p2 = (1.0f - s) * sqrt(1.0f - p1 * p1) + s * r * sin(phi);
    const float3 n = p1 * t1 + p2 * t2 + sqrt(max(0.0f, 1.0f - p1 * p1 - p2 * p2)) * v;
    return normalize((float3)(alpha * n.xy, max(0.0f, n.z)));
}

// --- GGX: normals by two half disks ---
float3 ggx_disks(float3 wo, float2 alpha, float2 u) {
    const float3 v = stretched(wo, alpha), t1 = -frame_x(v);
#ifdef T2_FLIPPED
    const float3 t2 = cross(v, t1);
#else
    const float3 t2 = cross(t1, v);
#endif
    const float a = 1.0f / (1.0f + v.z), r = sqrt(u.x);
#ifdef ONE_DISK
    const float phi = u.y * M_PI_F;
#else
    const float phi = u.y < a ? u.y / a * M_PI_F : M_PI_F + (u.y - a) / (1.0f - a) * M_PI_F;
#endif
    const float p1 = r * cos(phi);
#ifdef PRECEDENCE
    const float p2 = r * sin(phi) * (u.y < a) != 0.0f ? 1.0f : v.z;
#else
    const float p2 = r * sin(phi) * (phi < M_PI_F ? 1.0f : v.z);
#endif
    const float3 n = p1 * t1 + p2 * t2 + sqrt(max(0.0f, 1.0f - p1 * p1 - p2 * p2)) * v;
    return normalize((float3)(alpha * n.xy, max(0.0f, n.z)));
}

// --- All normals: D cos ---
float3 ggx_all(float2 alpha_in, float2 u) {
    const float2 alpha = ALPHA(alpha_in);
    const float r = sqrt(u.x / (1.0f - u.x)), phi = TURN * u.y;
    return normalize((float3)(alpha * r * (float2)(cos(phi), sin(phi)), 1.0f));
}
float3 ggx_whatever_the_view(float3 wo, float2 alpha, float2 u) {
    return ggx_all(alpha, u);
}
float3 beckmann_all(float2 alpha_in, float2 u) {
    const float2 alpha = ALPHA(alpha_in);
    const float r = sqrt(-log(1.0f - u.x)), phi = TURN * u.y;
    return normalize((float3)(alpha * r * (float2)(cos(phi), sin(phi)), 1.0f));
}
float3 beckmann_whatever_the_view(float3 wo, float2 alpha, float2 u) {
    return beckmann_all(alpha, u);
}

// --- Densities ---
float ggx_d(float3 wm, float2 alpha) {
    const float3 s = (float3)(wm.xy / alpha, wm.z);
    return 1.0f / (M_PI_F * alpha.x * alpha.y * dot(s, s) * dot(s, s));
}
float ggx_g1(float3 w, float2 alpha) {
    return 2.0f / (1.0f + sqrt(1.0f + dot(alpha * w.xy, alpha * w.xy) / (w.z * w.z)));
}
float ggx_g2(float3 wo, float3 wi, float2 alpha) {
    return 1.0f / (1.0f / ggx_g1(wo, alpha) + 1.0f / ggx_g1(wi, alpha) - 1.0f);
}
float ggx_pdf(float3 wo_in, float3 wm, float2 alpha_in) {
    const float2 alpha = ALPHA(alpha_in);
    const float3 wo = WO(wo_in);
#ifdef NO_G1
    return ggx_d(wm, alpha) * wm.z;
#elif defined(NO_G1_ALONE)
    return ggx_d(wm, alpha) * max(dot(wo, wm), 0.0f) / wo.z;
#elif defined(ONLY_D)
    return ggx_d(wm, alpha);
#else
    const float visible = ggx_g1(wo, alpha) * max(dot(wo, wm), 0.0f) * ggx_d(wm, alpha);
#ifdef NO_COSINE
    return visible;
#elif defined(HALVED)
    return 0.5f * visible / wo.z;
#elif defined(OF_REFLECTION)
    return visible / (4.0f * dot(wo, wm) * wo.z);
#else
    return visible / wo.z;
#endif
#endif
}
float ggx_pdf_of_reflection(float3 wo, float3 wi, float2 alpha) {
    const float3 wm = normalize(wo + wi);
#ifdef NO_JACOBIAN
    return ggx_pdf(wo, wm, alpha);
#elif defined(OTHER_COSINE)
    return ggx_pdf(wo, wm, alpha) / (4.0f * wm.z);
#elif defined(WEIGHT)
    return ggx_g2(wo, wi, alpha) / ggx_g1(wo, alpha);
#elif defined(BRDF)
    return ggx_d(wm, alpha) * ggx_g2(wo, wi, alpha) / (4.0f * wo.z * wi.z);
#else
    return ggx_pdf(wo, wm, alpha) / (4.0f * dot(wo, wm));
#endif
}
float beckmann_d(float3 wm, float2 alpha) {
    const float2 s = wm.xy / (alpha * wm.z);
    return exp(-dot(s, s)) / (M_PI_F * alpha.x * alpha.y * wm.z * wm.z * wm.z * wm.z);
}
float beckmann_pdf_of_all(float3 wm, float2 alpha) {
#ifdef ONLY_D
    return beckmann_d(wm, ALPHA(alpha));
#else
    return beckmann_d(wm, ALPHA(alpha)) * wm.z;
#endif
}
