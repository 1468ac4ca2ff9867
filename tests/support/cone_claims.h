// What is claimed of the reflections into caps, counted: over random lobes and caps, on all cores.
#pragma once

#include "conic_claims.h"

namespace vndf::claims {

// A cap, and wo and alphas as of a Lobe.
struct CapLobe {
    Lobe at;
    double lx, ly, lz, one_minus_cos;
};
// Half of the caps about the mirror image of wo or near it, the others anywhere; of half angles from 1e-3 to 2, or about z with
// 90 degrees. Contained: with their cones of normals above the
// surface, wo.z above 1e-2.
CapLobe random_cap(Random& random, double least_alpha, double most_alpha, bool contained);

// Reflections of `samples` random u, one in eight next to the rim, into caps without -wo, that are outside their cap by more
// than 32 * 2^-24 in angle, not finite or not of unit length (float).
std::uint64_t count_missed(std::uint64_t samples);

// `directions` random directions in random caps through the inverse (double).
Lost count_lost_in_caps(std::uint64_t directions);

// The largest relative difference of sigma_C (double) to quadrature over directions.
double worst_sigma_cap(std::uint64_t caps);

// The largest difference of the density's integral over the cap (double) to 1.
double worst_cap_integral(std::uint64_t caps);

}  // namespace vndf::claims
