// Vector types of a user's own, for languages.sh. OWN: 1 a class with members and constructors (as glm's and Imath's), 2 one
// without members (as Eigen's), 3 an array; 0 none. TYPES: bits 1, 2, 4 for which of VNDF_REAL2, 3 and 4. Prints a few bits.
#include <array>
#include <cstdio>
#include <cstring>

namespace user {
template <int n>
struct members;
template <>
struct members<2> {
    float x, y;
    members(float a, float b) : x(a), y(b) {}
};
template <>
struct members<3> {
    float x, y, z;
    members(float a, float b, float c) : x(a), y(b), z(c) {}
};
template <>
struct members<4> {
    float x, y, z, w;
    members(float a, float b, float c, float d) : x(a), y(b), z(c), w(d) {}
};
template <int n>
class opaque {
  public:
    template <class... T>
    explicit opaque(T... values) : v_{values...} {}
    float x() const { return v_[0]; }
    float operator[](int i) const { return v_[i]; }

  private:
    float v_[n];
};
}  // namespace user

#if OWN == 1
#define TYPE(n) user::members<n>
#define MAKE(n, ...) user::members<n>(__VA_ARGS__)
#elif OWN == 2
#define TYPE(n) user::opaque<n>
#define MAKE(n, ...) user::opaque<n>(__VA_ARGS__)
#define VNDF_GET2(v, i) v[i]
#define VNDF_GET3(v, i) v[i]
#elif OWN == 3
#define TYPE(n) array##n
#define MAKE(n, ...) (array##n{{__VA_ARGS__}})
#define VNDF_GET2(v, i) v[i]
#define VNDF_GET3(v, i) v[i]
using array2 = std::array<float, 2>;
using array3 = std::array<float, 3>;
using array4 = std::array<float, 4>;
#endif
#if TYPES & 1
#define VNDF_REAL2 TYPE(2)
#define VNDF_MAKE2(x, y) MAKE(2, x, y)
using real2 = VNDF_REAL2;
#else
#undef VNDF_GET2
#endif
#if TYPES & 2
#define VNDF_REAL3 TYPE(3)
#define VNDF_MAKE3(x, y, z) MAKE(3, x, y, z)
using real3 = VNDF_REAL3;
#else
#undef VNDF_GET3
#endif
#if TYPES & 4
#define VNDF_REAL4 TYPE(4)
#define VNDF_MAKE4(x, y, z, w) MAKE(4, x, y, z, w)
using real4 = VNDF_REAL4;
#endif
#define VNDF_CONDUCTOR 1
#define VNDF_DIELECTRIC 1
#define VNDF_LAMBERT 1
#define VNDF_COAT 1
#define VNDF_SHADING_NORMAL 1
#define VNDF_ENERGY turquin
#include "../../kernels/vndf/bsdf.h"
#include "../../kernels/vndf/vndf.h"
#if !(TYPES & 1)
using real2 = vndf_float2;
#endif
#if !(TYPES & 2)
using real3 = vndf_float3;
#endif
#if !(TYPES & 4)
using real4 = vndf_float4;
#endif

// The types are floats and nothing else.
template <class T>
void print(const T& v) {
    unsigned bits[sizeof(T) / sizeof(float)];
    std::memcpy(bits, &v, sizeof v);
    for (unsigned b : bits) std::printf("%08x ", b);
    std::printf("\n");
}

int main() {
#if OWN && (TYPES & 2)
    const real3 wo = MAKE(3, 0.6f, 0.0f, -0.8f);
#else
    const real3 wo = {0.6f, 0.0f, -0.8f};
#endif
#if OWN && (TYPES & 1)
    const real2 alpha = MAKE(2, 0.5f, 0.1f), u = MAKE(2, 0.25f, 0.75f);
#else
    const real2 alpha = {0.5f, 0.1f}, u = {0.25f, 0.75f};
#endif
    const real3 wm = vndf_ggx_sample_wm_dupuy2023(wo, alpha, u), wi = vndf_reflect(wo, wm);
    const real4 with_pdf = vndf_ggx_sample_wi_conic2026_with_pdf(wo, alpha, u);
    const real2 inverse = vndf_ggx_invert_wi_conic2026(wo, wi, alpha);
    print(wm);
    print(wi);
    print(with_pdf);
    print(inverse);
    print(vndf_beckmann_pdf_wi(wo, wi, alpha));
    vndf_bsdf material = {};
    material.alpha_x = 0.3f;
    material.albedo.g = 0.5f;
    material.metal = 0.2f;
    material.ior = 1.5f;
    material.transmission = 0.5f;
    material.coat = 0.5f;
    material.coat_alpha = 0.1f;
    material.ng_z = 1;
    const vndf_bsdf_direction drawn = vndf_bsdf_sample(wi, material, u, 0.9f);
    print(vndf_bsdf_eval_pdf(wi, wm, material));
    print(drawn);
}
