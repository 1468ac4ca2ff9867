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
#define VNDF_PATH_PDF \
    9  // negative with VNDF_RENDER_CAPS_ALONE: samples have brought all of the lights that fill a cap
#define VNDF_PATH_BODY \
    10  // that it is in: 1 + the number of its material, 0 outside of all; with VNDF_ABSORPTION
#define VNDF_PATH_PLANES 11

// Where a ray met the mesh: barycentric coordinates of corners 1 and 2. Of a ray that met nothing the triangle is VNDF_MISS.
#define VNDF_HIT_B1 0
#define VNDF_HIT_B2 1
#define VNDF_HIT_PLANES 2
#define VNDF_HIT_WAY 2  // how far it went, behind the others with VNDF_RENDER_SPHERE_LIGHT
#define VNDF_MISS 0xffffffffu
#define VNDF_RENDER_ANYWHERE 3.0e38f  // farther than any hit

// A direction towards the lights, in the world and in the surface's frame, what comes from there, later what of it arrives, and
// its density: negative where no other sample meets the light, as one without extent.
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
#define VNDF_LIGHT_DISTANCE 10  // with lights that have a place
#define VNDF_LIGHT_PLANES 11
// Behind them with VNDF_RENDER_CONES, of a light that fills a cap 1 - cos of its half angle, else 0. Of such a light the direction is
// its middle, the distance that of its centre, and the density the chance that it was picked, until the stage cones, which leaves in
// this place the density of the material above which the sample counts nothing.
#define VNDF_LIGHT_GAP 11
#define VNDF_LIGHT_MOST 11

// A surface: normal and tangent in the world; where the path comes from and the geometric normal in the frame that they make.
#define VNDF_SURFACE_NORMAL 0
#define VNDF_SURFACE_TANGENT 3
#define VNDF_SURFACE_WO 6
#define VNDF_SURFACE_GEOMETRIC 9
#define VNDF_SURFACE_OFFSET 12  // how far rays begin from the surface; negative where it is seen from behind
#define VNDF_SURFACE_SOLID 13   // with VNDF_RENDER_LAMP: squared way to it over the cosine there
#define VNDF_SURFACE_PLANES 14

// How a material looks at a place, where that differs from place to place: factors, but for the alphas (dress.h).
#define VNDF_LOOK_BASE 0
#define VNDF_LOOK_METAL 3
#define VNDF_LOOK_ALPHA_X 4
#define VNDF_LOOK_ALPHA_Y 5
#define VNDF_LOOK_TRANSMISSION 6
#define VNDF_LOOK_COAT 7
#define VNDF_LOOK_COAT_ALPHA 8
#define VNDF_LOOK_SPECULAR 9
#define VNDF_LOOK_SPECULAR_COLOUR 10
#define VNDF_LOOK_EMISSION 13
#define VNDF_LOOK_PLANES 16

// The film, by pixel: sums over the samples, the luminance of one half of them, and how often a sample was no number.
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
// Behind those of all bounces, one for each: a: which light or part of the sky, b: whether it or its alias.
#define VNDF_QUAD_PICK(bounces) (1 + VNDF_QUAD_BOUNCE * (bounces))
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
#define VNDF_VERTEX_UV 6  // of two sets
#define VNDF_VERTEX_TANGENT 10
#define VNDF_VERTEX_COLOUR 14
#define VNDF_VERTEX_PLANES 18
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

// What textures make of a material: for each slot the texture, or -1, the set of coordinates and their transform; and the factors
// that a texture's value goes into before the material's numbers are made.
#define VNDF_SLOT_BASE_COLOUR 0
#define VNDF_SLOT_METALLIC_ROUGHNESS 1
#define VNDF_SLOT_NORMAL 2
#define VNDF_SLOT_EMISSIVE 3
#define VNDF_SLOT_TRANSMISSION 4
#define VNDF_SLOT_COAT 5
#define VNDF_SLOT_COAT_ROUGHNESS 6
#define VNDF_SLOT_SPECULAR 7
#define VNDF_SLOT_SPECULAR_COLOUR 8
#define VNDF_SLOT_ANISOTROPY 9
#define VNDF_DRESSING_SLOT(slot) (8 * (slot))
#define VNDF_DRESSING_ROUGHNESS 80
#define VNDF_DRESSING_ANISOTROPY 81
#define VNDF_DRESSING_TURN 82  // cosine and sine of the angle from the mesh's tangent to the material's
#define VNDF_DRESSING_NORMAL_SCALE 84
#define VNDF_DRESSING_OPACITY 85
#define VNDF_DRESSING_CUTOFF 86  // of the opacity; or one of the two below
#define VNDF_DRESSING_COAT_ROUGHNESS 87
#define VNDF_DRESSING_UNLIT 88
#define VNDF_DRESSING_PLANES 89
#define VNDF_ALPHA_OPAQUE -1.0f
#define VNDF_ALPHA_BLEND -2.0f

// Textures: where their texels begin, and bits: how the coordinates go on beyond 0 and 1, each way, and whether the nearest texel
// is taken as it is.
#define VNDF_TEXTURE_OFFSET 0
#define VNDF_TEXTURE_WIDTH 1
#define VNDF_TEXTURE_HEIGHT 2
#define VNDF_TEXTURE_MODE 3
#define VNDF_TEXTURE_PLANES 4
#define VNDF_WRAP_REPEAT 0u
#define VNDF_WRAP_CLAMP 1u
#define VNDF_WRAP_MIRROR 2u

// Triangles that shine, to pick one by Walker's alias method: what it is kept with, and twice its chance; and in whole numbers
// what it stands for else, and the triangle.
#define VNDF_LAMP_KEEP 0
#define VNDF_LAMP_TWICE_CHANCE 1
#define VNDF_LAMP_PLANES 2
#define VNDF_LAMP_OTHER 0
#define VNDF_LAMP_TRIANGLE 1
#define VNDF_LAMP_NUMBER_PLANES 2

// Lights at a point, or at infinity: as above; where they are, where they shine, candela over the chance to be picked (or lux),
// and what the cosine to their axis is multiplied with and raised by for the share that arrives.
#define VNDF_POINT_KEEP 0
#define VNDF_POINT_OTHER 1
#define VNDF_POINT_FAR 2  // 1: directional
#define VNDF_POINT_PLACE 3
#define VNDF_POINT_AXIS 6
#define VNDF_POINT_RED 9
#define VNDF_POINT_SLOPE 12
#define VNDF_POINT_OFFSET 13
#define VNDF_POINT_CHANCE 14
#define VNDF_POINT_PLANES 15

// Lights that are spheres: as above, with their radius; radiance in place of candela.
#define VNDF_SPHERE_KEEP 0
#define VNDF_SPHERE_OTHER 1
#define VNDF_SPHERE_RADIUS 2
#define VNDF_SPHERE_PLACE 3
#define VNDF_SPHERE_AXIS 6
#define VNDF_SPHERE_RED 9
#define VNDF_SPHERE_SLOPE 12
#define VNDF_SPHERE_OFFSET 13
#define VNDF_SPHERE_CHANCE 14
#define VNDF_SPHERE_PLANES 15

// How many rows the tables have, and 1.0f for material.h.
struct vndf_render_sizes {
    unsigned int vertices, triangles, materials;
    float one;
    unsigned int textures;
};

// Paths counted by one item of the compaction.
#define VNDF_CHUNK 256

// The view and the lights, passed by value. Floats and uints alone: the same layout everywhere.
struct vndf_render_view {
    float x, y, z;                    // the eye
    float right_x, right_y, right_z;  // from the middle of the film to its right edge, at distance 1
    float up_x, up_y, up_z;           // to its upper edge
    float forward_x, forward_y, forward_z;
    // The same from where a ray at the middle of the film begins to where one at its edge does; 0 but of parallel rays.
    float shift_right_x, shift_right_y, shift_right_z;
    float shift_up_x, shift_up_y, shift_up_z;
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
    // Shares of the samples of light: of the sun, of the sky or the environment, of triangles that shine, of lights at a point,
    // of spheres.
    float sun_share, sky_share, lamp_share, point_share, sphere_share;
    unsigned int side;  // cells of the environment each way; 0: there is none, but the sky
    unsigned int lamps, points, spheres;
};

#endif
