// A material: a rough conductor, Lambert's diffuse reflection, or a mix of both, with the effects of effects.h alone.
//
// Conventions of vndf.h: wo and wi are unit vectors in the local frame, z the shading normal. All functions take the material
// by value; a member exists only where its effect is on.
//
// What is reflected. Light passes only between directions on the same side of the surface: wi and wo must both lie above the
// shading normal's horizon and above the geometric one's, so that nothing leaks through the surface on either account. Seen
// from behind, a surface is black, or with VNDF_BACK_FACING the mirror image of its front: both normals are turned around
// where wo lies below the geometric horizon. A wo above one horizon and below the other sees black: where a normal map or a
// coarse mesh makes that happen, bend the shading normal towards wo before the frame is made.
//
// Where shading and geometric normal differ, light ends abruptly at the geometric horizon; VNDF_TERMINATOR fades it out
// before, and is not reciprocal, as no such correction is.
#ifndef VNDF_BSDF_H
#define VNDF_BSDF_H

#include "effects.h"
#include "fresnel.h"
#include "impl/exact.h"
#if VNDF_CONDUCTOR
#include "bsdf_conductor.h"
#endif
#if VNDF_LAMBERT
#include "bsdf_lambert.h"
#endif

VNDF_BEGIN

// A material at a point. Every member of a reflectance is in [0, 1].
struct vndf_bsdf {
#if VNDF_CONDUCTOR
    // alpha as everywhere in the library, in [1e-8, 1e3]; alpha_x stands for both without VNDF_ANISOTROPIC.
    VNDF_REAL alpha_x;
#if VNDF_ANISOTROPIC
    VNDF_REAL alpha_y;
#endif
    // conductor: eta, k for each channel, over the index outside. schlick: f0 for each channel, f90. f82: f0 and the tint at 82
    // degrees for each channel.
    VNDF_IMPL_FRESNEL_MEMBERS
#if VNDF_TINT
    struct vndf_rgb tint;  // a factor on the whole conductor
#endif
#endif
#if VNDF_LAMBERT
    struct vndf_rgb albedo;
#endif
#if VNDF_CONDUCTOR && VNDF_LAMBERT
    VNDF_REAL metal;  // the share of the conductor, and the probability that it is sampled; the rest is Lambert's
#endif
#if VNDF_SHADING_NORMAL
    VNDF_REAL ng_x, ng_y, ng_z;  // the geometric normal, a unit vector in the local frame; (0, 0, 1): no other than the shading one
#endif
};

// What vndf_bsdf_sample tells of the lobe that it drew from.
#define VNDF_BSDF_CONDUCTOR 0
#define VNDF_BSDF_LAMBERT 1

// BSDF times |cos(theta_i)|, and the density of vndf_bsdf_sample.
struct vndf_bsdf_value {
    struct vndf_rgb f;
    VNDF_REAL pdf;
};

// A direction, BSDF times |cos(theta_i)| over its density, the density per steradian, and the lobe.
struct vndf_bsdf_direction {
    VNDF_REAL wi_x, wi_y, wi_z;
    struct vndf_rgb weight;
    VNDF_REAL pdf;
    int lobe;
};
