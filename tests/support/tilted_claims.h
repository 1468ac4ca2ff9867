// What is claimed of reflections above two normals and of masses between arcs, counted: over random lobes, on all cores.
#pragma once

#include "cone_claims.h"

namespace vndf::claims {

// A geometric normal, and wo and alphas as of a Lobe.
struct TiltedLobe {
    Lobe at;
    double x, y, z;
};
// Of tilts from 1e-3 to 1.5, with wo above it.
TiltedLobe random_tilt(Random& random, double least_alpha, double most_alpha);

struct Kept {
    std::uint64_t outside =
        0;  // kept below one of the normals, not of unit length, or with a density that is not positive
    double over_tilt = 0;  // the largest part that is lost, over the tilt in half turns, for alpha up to 1
};
// `samples` random u (float), one in eight next to the rim.
Kept count_kept(std::uint64_t samples);

// The largest difference of the areas (double) to quadrature over directions, over |alpha wo|: above two normals; of triangles and quadrilaterals, one in two through the horizon; of caps
// anywhere, wo above the surface or below.
double worst_sigma_tilted(std::uint64_t lobes);
double worst_polygon_mass(std::uint64_t polygons);
double worst_cap_mass(std::uint64_t caps);

}  // namespace vndf::claims
