#include "vndf/vndf.h"

// y up: y and z are exchanged, there and back. That is a mirror, in which no lobe looks different; alpha is (x, z).
inline vndf_float3 exchanged(vndf_float3 w) {
    return {w.x, w.z, w.y};
}  // OpenCL: w.xzy
inline vndf_float3 reflection_y_up(vndf_float3 wo, vndf_float2 alpha_xz, vndf_float2 u) {
    const vndf_float3 local = exchanged(wo);
    return exchanged(vndf_reflect(local, vndf_ggx_sample_wm_dupuy2023(local, alpha_xz, u)));
}
inline float pdf_y_up(vndf_float3 wo, vndf_float3 wi, vndf_float2 alpha_xz) {
    return vndf_ggx_pdf_wi(exchanged(wo), exchanged(wi), alpha_xz);
}

// World space with a normal and a tangent that need not be quite across it.
inline vndf_float3 reflection_n_t(vndf_float3 wo, vndf_float3 n, vndf_float3 tangent, vndf_float2 alpha,
                                  vndf_float2 u) {
    const vndf_float3 t = vndf_tangent_along(n, tangent);  // where there is none: vndf_tangent(n)
    const vndf_float3 local = vndf_to_local(wo, n, t);
    return vndf_to_world(vndf_reflect(local, vndf_ggx_sample_wm_dupuy2023(local, alpha, u)), n, t);
}
inline float pdf_n_t(vndf_float3 wo, vndf_float3 wi, vndf_float3 n, vndf_float3 tangent, vndf_float2 alpha) {
    const vndf_float3 t = vndf_tangent_along(n, tangent);
    return vndf_ggx_pdf_wi(vndf_to_local(wo, n, t), vndf_to_local(wi, n, t), alpha);
}

// Two sides: seen from below, the surface is mirrored, so that wo is above it, and what comes out is mirrored back. Without
// that a wo below the surface looks at its facets from behind, which is another distribution.
inline vndf_float3 mirrored(vndf_float3 w, bool below) {
    return {w.x, w.y, below ? -w.z : w.z};
}
inline vndf_float3 reflection_two_sided(vndf_float3 wo, vndf_float2 alpha, vndf_float2 u) {
    const vndf_float3 above = mirrored(wo, wo.z < 0);
    return mirrored(vndf_reflect(above, vndf_ggx_sample_wm_dupuy2023(above, alpha, u)), wo.z < 0);
}
inline float pdf_two_sided(vndf_float3 wo, vndf_float3 wi, vndf_float2 alpha) {
    return vndf_ggx_pdf_wi(mirrored(wo, wo.z < 0), mirrored(wi, wo.z < 0), alpha);
}
// In world space n is turned instead, before anything else sees it.
inline vndf_float3 towards(vndf_float3 n, vndf_float3 wo) {
    return n.x * wo.x + n.y * wo.y + n.z * wo.z < 0 ? vndf_float3{-n.x, -n.y, -n.z} : n;
}
