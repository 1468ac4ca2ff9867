// clvndf: samplers and densities of the GGX and Beckmann distributions of visible normals, after Walter et al. 2007,
// Heitz & d'Eon 2014, Jakob 2014, Heitz 2017, Heitz 2018, Dupuy & Benyoub 2023, Eto & Tokuyoshi 2023 and Benyoub 2024,
// and of this package.
//
// One header set for OpenCL C 1.2 to 3.0, C++ for OpenCL, C99, C++11, CUDA, HIP, and later ones of each. Include this file, or
// only the sampler you need; each header includes what it uses. Nothing here has state, takes a pointer or calls out: copy
// the folder, or have `clvndf emit` write one file with the functions that you name.
// Every name begins with vndf_ or VNDF_.
//
// Conventions
//   wo      the known direction (towards the viewer), wi the sampled one, wm the microfacet normal: unit
//           vectors that point away from the surface. Papers differ: their omega_i or V is often our wo.
//   frame   local, z the macroscopic normal; the world-space sampler and functions ending in _world take the normal n
//           instead, those ending in _cosines nothing but dot products, both with one alpha. frame.h has the ways there.
//   alpha   (alpha_x, alpha_y), the parameters of the distribution, not a perceptual roughness. Clamped to
//           [1e-8, 1e3]: below, the surface is a mirror to working precision.
//   u       two uniform numbers in [0, 1], clamped to [2^-33, 1 - 2^-24] (double: [2^-65, 1 - 2^-53]), the
//           ends being singular. Each sampler says what its u.x and u.y mean.
//   pdf_wm, pdf_wi   per steradian of the normal, per steradian of the reflected direction. The measure is in
//           the name: never mix them without vndf_jacobian_reflect or vndf_jacobian_refract.
//   sample_*_with_pdf   (x, y, z, density): the density from the sampler's own terms, accurate where
//           evaluating at the rounded direction is not (alpha below 1e-2, grazing directions).
//   Accuracy of functions   the largest relative error, or what is stated, in eps: 2^-24, in double 2^-53; with `strict`
//           (`builtin`: 4 times). The numbers are those of the registry, which `clvndf check` asserts.
//
// What holds for which arguments (asserted by `clvndf check` and tests/kernels/exceptions_test.cpp; said here alone)
//   wo of a sampler   its direction alone counts. The bounds of a function hold for |wo| within 2^-10 of 1; from
//           1e-3 to 1e3 the result is a unit vector.
//   vectors otherwise, and those of terms and densities   are taken literally: bounds are for vectors that are unit
//           but for rounding.
//   out of the domain   what the function says, with density 0: at wo = -z, where nothing is visible, a normal on
//           the horizon or its reflection -wo; (0, 0, 1) from a map that ends at the horizon.
//   anything finite   gives a finite result, whatever its size or sign. Inside the domain nothing on the way to it
//           overflows or is divided by 0: results do not hang on infinities.
//
// Materials: bsdf.h, which this header does not include, since its switches (effects.h) are a program's own.
//
// Precision and policy: see config.h (VNDF_REAL, VNDF_MATH).
#ifndef VNDF_H
#define VNDF_H

#define VNDF_VERSION_MAJOR 0
#define VNDF_VERSION_MINOR 1
#define VNDF_VERSION_PATCH 0
// Counts the versions in which a result of `strict` has other bits than in the one before, for whoever keeps results.
#define VNDF_BITS_VERSION 1

#include "config.h"
#include "frame.h"
#include "geometry.h"

#include "ggx.h"
#include "ggx_lobe.h"
#include "ggx_world.h"
#include "ggx_cosines.h"
#include "ggx_heitz_deon2014.h"
#include "ggx_heitz2017.h"
#include "ggx_heitz2018.h"
#include "ggx_dupuy2023.h"
#include "ggx_eto2023.h"
#include "ggx_eto2023_polygon.h"
#include "ggx_benyoub2024.h"
#include "ggx_conic2026.h"
#include "ggx_cone2026.h"
#include "ggx_tilted2026.h"
#include "ggx_polygon.h"
#include "ggx_walter2007.h"

#include "beckmann.h"
#include "beckmann_lobe.h"
#include "beckmann_world.h"
#include "beckmann_cosines.h"
#include "beckmann_heitz_deon2014.h"
#include "beckmann_jakob2014.h"
#include "beckmann_walter2007.h"

#include "bsdf_lambert.h"
#include "fresnel_conductor.h"
#include "fresnel_dielectric.h"
#include "fresnel_f82.h"
#include "fresnel_schlick.h"
#include "medium.h"

#endif
