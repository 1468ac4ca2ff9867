// Heitz & d'Eon, Importance Sampling Microfacet-Based BSDFs with the Distribution of Visible Normals, 2014, supplemental
// material 1: the C++ of Sections 1.1, 3.5 and 4.5, line by line in float OpenCL C, erfinv after Giles 2010.
//
// Corrected: theta and phi come from atan2 for every direction (the threshold 0.99999 acts on the stretched cosine and
// takes a mirror-like lobe for normal incidence at nearly every angle); the missing end of the Beckmann function;
// numbers that float rounds to the end of a domain are kept inside it, as renderers that took these listings over do.
#pragma OPENCL FP_CONTRACT ON

// The inverse error function in single precision: Giles, Approximating the erfinv function, 2010.
static inline float published_impl_erfinv(float x) {
    x = clamp(x, -0.99999994f, 0.99999994f);
    float w = -log((1.0f - x) * (1.0f + x));
    float p;
    if (w < 5.0f) {
        w = w - 2.5f;
        p = 2.81022636e-08f;
        p = 3.43273939e-07f + p * w;
        p = -3.5233877e-06f + p * w;
        p = -4.39150654e-06f + p * w;
        p = 0.00021858087f + p * w;
        p = -0.00125372503f + p * w;
        p = -0.00417768164f + p * w;
        p = 0.246640727f + p * w;
        p = 1.50140941f + p * w;
    } else {
        w = sqrt(w) - 3.0f;
        p = -0.000200214257f;
        p = 0.000100950558f + p * w;
        p = 0.00134934322f + p * w;
        p = -0.00367342844f + p * w;
        p = 0.00573950773f + p * w;
        p = -0.0076224613f + p * w;
        p = 0.00943887047f + p * w;
        p = 1.00167406f + p * w;
        p = 2.83297682f + p * w;
    }
    return p * x;
}

static inline float2 published_impl_sample11_beckmann(float theta_i, float U1, float U2) {
    U1 = max(U1, 0x1p-33f);
    // special case (normal incidence)
    if (theta_i < 0.0001f) {
        const float r = sqrt(-log(U1));
        const float phi = 6.28318530718f * U2;
        return (float2)(r * cos(phi), r * sin(phi));
    }
    // precomputations
    const float sin_theta_i = sin(theta_i);
    const float cos_theta_i = cos(theta_i);
    const float tan_theta_i = sin_theta_i / cos_theta_i;
    const float a = 1.0f / tan_theta_i;
    const float erf_a = erf(a);
    const float exp_a2 = exp(-a * a);
    const float SQRT_PI_INV = 0.56418958354f;
    const float Lambda = 0.5f * (erf_a - 1.0f) + 0.5f * SQRT_PI_INV * exp_a2 / a;
    const float G1 = 1.0f / (1.0f + Lambda);
    const float C = 1.0f - G1 * erf_a;

    // sample slope x
    float slope_x;
    if (U1 < C) {
        // rescale U1
        U1 = U1 / C;
        const float w_1 = 0.5f * SQRT_PI_INV * sin_theta_i * exp_a2;
        const float w_2 = cos_theta_i * (0.5f - 0.5f * erf_a);
        const float p = w_1 / (w_1 + w_2);
        if (U1 < p) {
            U1 = U1 / p;
            slope_x = -sqrt(-log(U1 * exp_a2));
        } else {
            U1 = (U1 - p) / (1.0f - p);
            slope_x = published_impl_erfinv(U1 - 1.0f - U1 * erf_a);
        }
    } else {
        // rescale U1
        U1 = (U1 - C) / (1.0f - C);
        slope_x = published_impl_erfinv((-1.0f + 2.0f * U1) * erf_a);
        const float p = (-slope_x * sin_theta_i + cos_theta_i) / (2.0f * cos_theta_i);
        if (U2 > p) {
            slope_x = -slope_x;
            U2 = (U2 - p) / (1.0f - p);
        } else {
            U2 = U2 / p;
        }
    }
    // sample slope y
    return (float2)(slope_x, published_impl_erfinv(2.0f * U2 - 1.0f));
}

static inline float2 published_impl_sample11_ggx(float theta_i, float U1, float U2) {
    // special case (normal incidence)
    if (theta_i < 0.0001f) {
        const float r = sqrt(U1 / (1.0f - U1));
        const float phi = 6.28318530718f * U2;
        return (float2)(r * cos(phi), r * sin(phi));
    }
    // precomputations
    const float tan_theta_i = tan(theta_i);
    const float a = 1.0f / tan_theta_i;
    const float G1 = 2.0f / (1.0f + sqrt(1.0f + 1.0f / (a * a)));

    // sample slope x
    const float A = 2.0f * U1 / G1 - 1.0f;
    const float tmp = clamp(1.0f / (A * A - 1.0f), -1e10f, 1e10f);
    const float B = tan_theta_i;
    const float D = sqrt(max(0.0f, B * B * tmp * tmp - (A * A - B * B) * tmp));
    const float slope_x_1 = B * tmp - D;
    const float slope_x_2 = B * tmp + D;
    const float slope_x = A < 0.0f || slope_x_2 > 1.0f / tan_theta_i ? slope_x_1 : slope_x_2;

    // sample slope y
    float S;
    if (U2 > 0.5f) {
        S = 1.0f;
        U2 = 2.0f * (U2 - 0.5f);
    } else {
        S = -1.0f;
        U2 = 2.0f * (0.5f - U2);
    }
    const float z = (U2 * (U2 * (U2 * 0.27385f - 0.73369f) + 0.46341f)) /
                    (U2 * (U2 * (U2 * 0.093073f + 0.309420f) - 1.000000f) + 0.597999f);
    return (float2)(slope_x, S * z * sqrt(1.0f + slope_x * slope_x));
}

#define PUBLISHED_SAMPLE(name, sample11)                                                            \
    static inline float3 name(float3 omega_i, float2 alpha, float2 U) {                             \
        /* 1. stretch omega_i, and its polar coordinates */                                         \
        float3 omega_i_ = normalize((float3)(alpha.x * omega_i.x, alpha.y * omega_i.y, omega_i.z)); \
        float theta_ = atan2(length(omega_i_.xy), omega_i_.z);                                      \
        float phi_ = atan2(omega_i_.y, omega_i_.x);                                                 \
        /* 2. sample P22_{omega_i}(x_slope, y_slope, 1, 1) */                                       \
        float2 slope = sample11(theta_, U.x, U.y);                                                  \
        /* 3. rotate */                                                                             \
        float tmp = cos(phi_) * slope.x - sin(phi_) * slope.y;                                      \
        slope.y = sin(phi_) * slope.x + cos(phi_) * slope.y;                                        \
        slope.x = tmp;                                                                              \
        /* 4. unstretch */                                                                          \
        slope.x = alpha.x * slope.x;                                                                \
        slope.y = alpha.y * slope.y;                                                                \
        /* 5. compute normal */                                                                     \
        float inv_omega_m = sqrt(slope.x * slope.x + slope.y * slope.y + 1.0f);                     \
        return (float3)(-slope.x / inv_omega_m, -slope.y / inv_omega_m, 1.0f / inv_omega_m);        \
    }

PUBLISHED_SAMPLE(published_ggx_sample_wm_heitz_deon2014, published_impl_sample11_ggx)
PUBLISHED_SAMPLE(published_beckmann_sample_wm_heitz_deon2014, published_impl_sample11_beckmann)
#undef PUBLISHED_SAMPLE
