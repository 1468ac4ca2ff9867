// The arguments of the entry points of materials (bsdf.cl), in their order, read by C++ too: S of each. `first` and `second` are eta
// and k, f0 and (f90, -, -), or f0 and f82.
#ifndef VNDF_BATCH_BSDF_PARAMETERS_H
#define VNDF_BATCH_BSDF_PARAMETERS_H

#define VNDF_BSDF_RGB(S, c) S(c##_r) S(c##_g) S(c##_b)
#define VNDF_BSDF_XYZ(S, v) S(v##_x) S(v##_y) S(v##_z)
// clang-format off
#define VNDF_BSDF_PARAMETERS(S)                                                             \
    S(alpha_x) S(alpha_y)                                                                   \
    VNDF_BSDF_RGB(S, first) VNDF_BSDF_RGB(S, second) VNDF_BSDF_RGB(S, tint)                 \
    VNDF_BSDF_RGB(S, albedo)                                                                \
    S(metal) S(ior) S(transmission) VNDF_BSDF_RGB(S, transmittance)                         \
    S(specular) VNDF_BSDF_RGB(S, specular_colour) S(thin_walled)                            \
    S(dispersion) S(channel) VNDF_BSDF_RGB(S, absorption)                                   \
    S(diffuse_roughness) S(coat) S(coat_alpha)                                              \
    VNDF_BSDF_XYZ(S, ng)
// clang-format on

#endif
