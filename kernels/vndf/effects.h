// The switches of a material (bsdf.h): what a program holds and what it leaves out. Every switch may be set with -D or before
// the include; a value that is not listed here is an error. The list for programs is kernels/effects.def.
//
// A choice is one of several models and changes results:
//   VNDF_NDF       ggx (default), beckmann
//   VNDF_SAMPLING  how specular reflections are drawn: plain, visible normals mirrored; bounded (default), from the
//                  smaller cap of ggx_eto2023.h; conic, above the horizon alone, ggx_conic2026.h; tilted, above that of the
//                  geometric normal as well, ggx_tilted2026.h (conic without VNDF_SHADING_NORMAL). From the denser side of a
//                  body all are as plain; through a thin wall tilted is as conic. Beckmann has plain alone
//   VNDF_FRESNEL   of the conductor: none, it reflects everything; conductor, eta and k; schlick (default), f0 and f90; f82,
//                  f0 and the tint at 82 degrees
//   VNDF_MASKING   of reflections: correlated (default), separable. Of refractions always separable
//   VNDF_TRANSPORT of refractions: radiance (default), 1 / eta^2 times importance
//   VNDF_ENERGY    what scatters between facets: none (default), it is lost; turquin, single scattering raised by it, of the
//                  conductor (energy.h) and of a dielectric that transmits (energy_glass.h); kulla_conty, a diffuse lobe of its own
//                  for the conductor, while a dielectric loses it
//
// An effect is 1 (default) or 0. Without it the program lacks its arguments and its code, and the results for inputs that do
// not call for it have the same bits:
//
// For every renderer, by what its scene holds (bench/effects.py counts what each costs):
//   VNDF_CONDUCTOR       the rough conductor; 0: every material has metal = 0
//   VNDF_DIELECTRIC      the rough dielectric; 0: every material with metal < 1 has ior = 1 and transmission = 0
//   VNDF_SPECULAR        how strong the dielectric's interface reflects, and its colour; 0: both are 1 in every material
//   VNDF_THIN_WALLED     walls without thickness, which light goes straight through; 0: every material that transmits bounds a body
//   VNDF_LAMBERT         the diffuse lobe; 0: every material has metal = 1 or transmission = 1
//   VNDF_ROUGH_DIFFUSE   the roughness of the diffuse lobe; 0: it is 0 in every material, which is Lambert's law
//   VNDF_COAT            a rough dielectric layer over all; 0: coat = 0 in every material
//   VNDF_ANISOTROPIC     alpha_y; 0: alpha_y = alpha_x in every material. It saves the argument, a number of each material that a
//                        renderer keeps and reads, and two or three instructions: no time that could be told from noise
//   VNDF_TINT            factors on the conductor and on what is transmitted; 0: every tint and transmittance is 1
//   VNDF_ABSORPTION      what the body behind a surface absorbs of light on its way through; 0: nothing. vndf_bsdf_transmittance alone
//                        asks for it
//   VNDF_DISPERSION      an index for each channel, of which one is asked for at a time; 0: every dispersion is 0
//   VNDF_BACK_FACING     surfaces with two sides; 0: none is seen from behind, or those are black
// For renderers whose normals are interpolated or mapped:
//   VNDF_SHADING_NORMAL  a geometric normal beside the shading one; 0: both are the same
//   VNDF_TERMINATOR      the shadow terminator softened, where there are two normals; 0: not softened
#ifndef VNDF_EFFECTS_H
#define VNDF_EFFECTS_H

#include "config.h"

// The values allowed, as in config.h.
#define VNDF_NDF_IS_ggx 1
#define VNDF_NDF_IS_beckmann 2
#define VNDF_SAMPLING_IS_plain 1
#define VNDF_SAMPLING_IS_bounded 2
#define VNDF_SAMPLING_IS_conic 3
#define VNDF_SAMPLING_IS_tilted 4
#define VNDF_FRESNEL_IS_none 1
#define VNDF_FRESNEL_IS_conductor 2
#define VNDF_FRESNEL_IS_schlick 3
#define VNDF_FRESNEL_IS_f82 4
#define VNDF_MASKING_IS_correlated 1
#define VNDF_MASKING_IS_separable 2
#define VNDF_ENERGY_IS_none 1
#define VNDF_ENERGY_IS_turquin 2
#define VNDF_ENERGY_IS_kulla_conty 3
#define VNDF_TRANSPORT_IS_radiance 1
#define VNDF_TRANSPORT_IS_importance 2

#ifndef VNDF_NDF
#define VNDF_NDF ggx
#endif
#ifndef VNDF_SAMPLING
#if VNDF_CAT(VNDF_NDF_IS_, VNDF_NDF) == 2
#define VNDF_SAMPLING plain
#else
#define VNDF_SAMPLING bounded
#endif
#endif
#ifndef VNDF_FRESNEL
#define VNDF_FRESNEL schlick
#endif
#ifndef VNDF_MASKING
#define VNDF_MASKING correlated
#endif
#ifndef VNDF_ENERGY
#define VNDF_ENERGY none
#endif
#ifndef VNDF_CONDUCTOR
#define VNDF_CONDUCTOR 1
#endif
#ifndef VNDF_TRANSPORT
#define VNDF_TRANSPORT radiance
#endif
#ifndef VNDF_DIELECTRIC
#define VNDF_DIELECTRIC 1
#endif
#ifndef VNDF_SPECULAR
#define VNDF_SPECULAR 1
#endif
#ifndef VNDF_THIN_WALLED
#define VNDF_THIN_WALLED 1
#endif
#ifndef VNDF_LAMBERT
#define VNDF_LAMBERT 1
#endif
#ifndef VNDF_ROUGH_DIFFUSE
#define VNDF_ROUGH_DIFFUSE 1
#endif
#ifndef VNDF_COAT
#define VNDF_COAT 1
#endif
#ifndef VNDF_ANISOTROPIC
#define VNDF_ANISOTROPIC 1
#endif
#ifndef VNDF_TINT
#define VNDF_TINT 1
#endif
#ifndef VNDF_ABSORPTION
#define VNDF_ABSORPTION 1
#endif
#ifndef VNDF_DISPERSION
#define VNDF_DISPERSION 1
#endif
#ifndef VNDF_BACK_FACING
#define VNDF_BACK_FACING 1
#endif
#ifndef VNDF_SHADING_NORMAL
#define VNDF_SHADING_NORMAL 1
#endif
#ifndef VNDF_TERMINATOR
#define VNDF_TERMINATOR 1
#endif

// After an error the default takes over, so that the error stays alone.
#if VNDF_CAT(VNDF_NDF_IS_, VNDF_NDF) >= 1
#else
#error "clvndf: unknown VNDF_NDF; ggx and beckmann are allowed"
#undef VNDF_NDF
#define VNDF_NDF ggx
#endif
#if VNDF_CAT(VNDF_FRESNEL_IS_, VNDF_FRESNEL) >= 1
#else
#error "clvndf: unknown VNDF_FRESNEL; none, conductor, schlick and f82 are allowed"
#undef VNDF_FRESNEL
#define VNDF_FRESNEL schlick
#endif
#if VNDF_CAT(VNDF_MASKING_IS_, VNDF_MASKING) >= 1
#else
#error "clvndf: unknown VNDF_MASKING; correlated and separable are allowed"
#undef VNDF_MASKING
#define VNDF_MASKING correlated
#endif
#if VNDF_CAT(VNDF_ENERGY_IS_, VNDF_ENERGY) >= 1
#else
#error "clvndf: unknown VNDF_ENERGY; none, turquin and kulla_conty are allowed"
#undef VNDF_ENERGY
#define VNDF_ENERGY none
#endif
#if VNDF_CAT(VNDF_SAMPLING_IS_, VNDF_SAMPLING) >= 1
#else
#error "clvndf: unknown VNDF_SAMPLING; plain, bounded, conic and tilted are allowed"
#undef VNDF_SAMPLING
#define VNDF_SAMPLING plain
#endif
#if VNDF_CAT(VNDF_SWITCH_IS_, VNDF_CONDUCTOR) >= 1
#else
#error "clvndf: unknown VNDF_CONDUCTOR; 0 and 1 are allowed"
#undef VNDF_CONDUCTOR
#define VNDF_CONDUCTOR 1
#endif
#if VNDF_CAT(VNDF_TRANSPORT_IS_, VNDF_TRANSPORT) >= 1
#else
#error "clvndf: unknown VNDF_TRANSPORT; radiance and importance are allowed"
#undef VNDF_TRANSPORT
#define VNDF_TRANSPORT radiance
#endif
#if VNDF_CAT(VNDF_SWITCH_IS_, VNDF_DIELECTRIC) >= 1
#else
#error "clvndf: unknown VNDF_DIELECTRIC; 0 and 1 are allowed"
#undef VNDF_DIELECTRIC
#define VNDF_DIELECTRIC 1
#endif
#if VNDF_CAT(VNDF_SWITCH_IS_, VNDF_SPECULAR) >= 1
#else
#error "clvndf: unknown VNDF_SPECULAR; 0 and 1 are allowed"
#undef VNDF_SPECULAR
#define VNDF_SPECULAR 1
#endif
#if VNDF_CAT(VNDF_SWITCH_IS_, VNDF_THIN_WALLED) >= 1
#else
#error "clvndf: unknown VNDF_THIN_WALLED; 0 and 1 are allowed"
#undef VNDF_THIN_WALLED
#define VNDF_THIN_WALLED 1
#endif
#if VNDF_CAT(VNDF_SWITCH_IS_, VNDF_LAMBERT) >= 1
#else
#error "clvndf: unknown VNDF_LAMBERT; 0 and 1 are allowed"
#undef VNDF_LAMBERT
#define VNDF_LAMBERT 1
#endif
#if VNDF_CAT(VNDF_SWITCH_IS_, VNDF_ROUGH_DIFFUSE) >= 1
#else
#error "clvndf: unknown VNDF_ROUGH_DIFFUSE; 0 and 1 are allowed"
#undef VNDF_ROUGH_DIFFUSE
#define VNDF_ROUGH_DIFFUSE 1
#endif
#if VNDF_CAT(VNDF_SWITCH_IS_, VNDF_COAT) >= 1
#else
#error "clvndf: unknown VNDF_COAT; 0 and 1 are allowed"
#undef VNDF_COAT
#define VNDF_COAT 1
#endif
#if VNDF_CAT(VNDF_SWITCH_IS_, VNDF_ANISOTROPIC) >= 1
#else
#error "clvndf: unknown VNDF_ANISOTROPIC; 0 and 1 are allowed"
#undef VNDF_ANISOTROPIC
#define VNDF_ANISOTROPIC 1
#endif
#if VNDF_CAT(VNDF_SWITCH_IS_, VNDF_TINT) >= 1
#else
#error "clvndf: unknown VNDF_TINT; 0 and 1 are allowed"
#undef VNDF_TINT
#define VNDF_TINT 1
#endif
#if VNDF_CAT(VNDF_SWITCH_IS_, VNDF_ABSORPTION) >= 1
#else
#error "clvndf: unknown VNDF_ABSORPTION; 0 and 1 are allowed"
#undef VNDF_ABSORPTION
#define VNDF_ABSORPTION 1
#endif
#if VNDF_CAT(VNDF_SWITCH_IS_, VNDF_DISPERSION) >= 1
#else
#error "clvndf: unknown VNDF_DISPERSION; 0 and 1 are allowed"
#undef VNDF_DISPERSION
#define VNDF_DISPERSION 1
#endif
#if VNDF_CAT(VNDF_SWITCH_IS_, VNDF_BACK_FACING) >= 1
#else
#error "clvndf: unknown VNDF_BACK_FACING; 0 and 1 are allowed"
#undef VNDF_BACK_FACING
#define VNDF_BACK_FACING 1
#endif
#if VNDF_CAT(VNDF_SWITCH_IS_, VNDF_SHADING_NORMAL) >= 1
#else
#error "clvndf: unknown VNDF_SHADING_NORMAL; 0 and 1 are allowed"
#undef VNDF_SHADING_NORMAL
#define VNDF_SHADING_NORMAL 1
#endif
#if VNDF_CAT(VNDF_SWITCH_IS_, VNDF_TERMINATOR) >= 1
#else
#error "clvndf: unknown VNDF_TERMINATOR; 0 and 1 are allowed"
#undef VNDF_TERMINATOR
#define VNDF_TERMINATOR 1
#endif

// VNDF_CHOSEN(VNDF_FRESNEL, schlick): whether the choice is that one.
#define VNDF_CHOSEN(choice, value) (VNDF_CAT(choice##_IS_, choice) == choice##_IS_##value)

#if VNDF_CHOSEN(VNDF_NDF, beckmann) && !VNDF_CHOSEN(VNDF_SAMPLING, plain)
#error "clvndf: VNDF_NDF beckmann has VNDF_SAMPLING plain alone"
#undef VNDF_SAMPLING
#define VNDF_SAMPLING plain
#endif
#if !VNDF_CONDUCTOR && !VNDF_DIELECTRIC && !VNDF_LAMBERT
#error "clvndf: VNDF_CONDUCTOR, VNDF_DIELECTRIC and VNDF_LAMBERT are 0: nothing is left of a material"
#undef VNDF_LAMBERT
#define VNDF_LAMBERT 1
#endif

#endif
