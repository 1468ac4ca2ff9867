// What is in the queues: structures of arrays in one buffer each, plane k of item i at k * stride + i. Stages and host read
// this file.
#ifndef VNDF_RENDER_QUEUES_H
#define VNDF_RENDER_QUEUES_H

// A path: its next ray, what the light at the end of it is worth, and the density that the ray was sampled with.
#define VNDF_PATH_X 0
#define VNDF_PATH_Y 1
#define VNDF_PATH_Z 2
#define VNDF_PATH_DX 3
#define VNDF_PATH_DY 4
#define VNDF_PATH_DZ 5
#define VNDF_PATH_RED 6
#define VNDF_PATH_GREEN 7
#define VNDF_PATH_BLUE 8
#define VNDF_PATH_PDF 9
#define VNDF_PATH_BODY \
    10  // that it is in: 1 + the number of its material, 0 outside of all; with VNDF_ABSORPTION
#define VNDF_PATH_PLANES 11

// Where a ray met the mesh: barycentric coordinates of corners 1 and 2. Of a ray that met nothing the triangle is VNDF_MISS.
#define VNDF_HIT_B1 0
#define VNDF_HIT_B2 1
#define VNDF_HIT_PLANES 2
#define VNDF_MISS 0xffffffffu

// A direction towards the lights, in the world and in the surface's frame, what comes from there, later what of it arrives, and
// its density.
#define VNDF_LIGHT_DX 0
#define VNDF_LIGHT_DY 1
#define VNDF_LIGHT_DZ 2
#define VNDF_LIGHT_RED 3
#define VNDF_LIGHT_GREEN 4
#define VNDF_LIGHT_BLUE 5
#define VNDF_LIGHT_PDF 6
#define VNDF_LIGHT_X 7
#define VNDF_LIGHT_Y 8
#define VNDF_LIGHT_Z 9
#define VNDF_LIGHT_PLANES 10

// A surface: normal and tangent in the world; where the path comes from and the geometric normal in the frame that they make.
#define VNDF_SURFACE_NORMAL 0
#define VNDF_SURFACE_TANGENT 3
#define VNDF_SURFACE_WO 6
#define VNDF_SURFACE_GEOMETRIC 9
#define VNDF_SURFACE_OFFSET 12  // how far rays begin from the surface; negative where it is seen from behind
#define VNDF_SURFACE_PLANES 13

// The film, by pixel: sums over the samples, the luminance of those with an odd number, and how often a sample was no number.
#define VNDF_FILM_RED 0
#define VNDF_FILM_GREEN 1
#define VNDF_FILM_BLUE 2
#define VNDF_FILM_ODD 3
#define VNDF_FILM_BAD 4
#define VNDF_FILM_PLANES 5

// Random numbers come four at a time: of the camera, then of each bounce the light's and the BSDF's. Each use has its own, so
// that leaving one out moves the numbers of no other. Of each four the host prepares some words (random.h).
#define VNDF_QUAD_CAMERA 0  // a, b: the place in the pixel
#define VNDF_QUAD_LIGHT 1   // a: which light, b, c: the direction, d: the channel of a dispersion
#define VNDF_QUAD_BSDF 2    // a, b: the direction, c: the lobe, d: survival
#define VNDF_QUAD_BOUNCE 2  // of each bounce
#define VNDF_QUAD_WORDS 9

// A node of the tree: eight boxes and children, 64 floats. A child >= 0 is a node, one below is the leaf ~child.
#define VNDF_NODE_LOW_X 0
#define VNDF_NODE_LOW_Y 8
#define VNDF_NODE_LOW_Z 16
#define VNDF_NODE_HIGH_X 24
#define VNDF_NODE_HIGH_Y 32
#define VNDF_NODE_HIGH_Z 40
#define VNDF_NODE_CHILD 48
#define VNDF_NODE_SIZE 64
// A leaf: the corners of eight triangles, their numbers, and the box around them: 96 floats, whole lines of a cache.
#define VNDF_LEAF_CORNER(k) (24 * (k))
#define VNDF_LEAF_TRIANGLE 72
#define VNDF_LEAF_LOW 80
#define VNDF_LEAF_HIGH 84
#define VNDF_LEAF_SIZE 96
#define VNDF_TREE_DEPTH 32

// Tables for shading, structures of arrays as well: neighbours in memory LLVM would load as one vector of few, and then not
// vectorise across work-items.
#define VNDF_TRIANGLE_CORNER 0
#define VNDF_TRIANGLE_MATERIAL 3
#define VNDF_TRIANGLE_PLANES 4
#define VNDF_VERTEX_PLACE 0
#define VNDF_VERTEX_NORMAL 3
#define VNDF_VERTEX_PLANES 6
#define VNDF_MATERIAL_ALPHA_X 0
#define VNDF_MATERIAL_ALPHA_Y 1
#define VNDF_MATERIAL_METAL 2
#define VNDF_MATERIAL_FIRST 3   // f0 or eta
#define VNDF_MATERIAL_SECOND 6  // f90, k or the tint at 82 degrees
#define VNDF_MATERIAL_TINT 9
#define VNDF_MATERIAL_ALBEDO 12
#define VNDF_MATERIAL_IOR 15
#define VNDF_MATERIAL_TRANSMISSION 16
#define VNDF_MATERIAL_TRANSMITTANCE 17
#define VNDF_MATERIAL_DISPERSION 20
#define VNDF_MATERIAL_ABSORPTION 21
#define VNDF_MATERIAL_DIFFUSE_ROUGHNESS 24
#define VNDF_MATERIAL_COAT 25
#define VNDF_MATERIAL_COAT_ALPHA 26
#define VNDF_MATERIAL_SPECULAR 27
#define VNDF_MATERIAL_SPECULAR_COLOUR 28
#define VNDF_MATERIAL_THIN_WALLED 31
#define VNDF_MATERIAL_EMISSION 32
#define VNDF_MATERIAL_PLANES 35

// How many rows the tables have, and 1.0f for material.h.
struct vndf_render_sizes {
    unsigned int vertices, triangles, materials;
    float one;
};

// Paths counted by one item of the compaction.
#define VNDF_CHUNK 256

// The view and the lights, passed by value. Floats and uints alone: the same layout everywhere.
struct vndf_render_view {
    float x, y, z;                    // the eye
    float right_x, right_y, right_z;  // from the middle of the film to its right edge, at distance 1
    float up_x, up_y, up_z;           // to its upper edge
    float forward_x, forward_y, forward_z;
    unsigned int width, height;
};

// A sky that goes from the horizon's colour to the zenith's with the fourth power of 1 - sin(elevation), the ground's colour
// below the horizon, and a sun: a disc of even brightness.
struct vndf_render_sky {
    float zenith_red, zenith_green, zenith_blue;
    float horizon_red, horizon_green, horizon_blue;
    float ground_red, ground_green, ground_blue;
    float sun_red, sun_green, sun_blue;
    float sun_x, sun_y, sun_z;  // towards its middle
    float sun_gap;              // 1 - cos of its radius
    float sun_share;            // of the samples of light that go there
};

#endif
