// What a sampler of reflections costs in noise: the part of its samples that is lost below the surface, and the variance
// of one sample under white light.
#pragma once

#include <string>
#include <vector>

namespace vndf::bench {

struct LobeNoise {
    std::string sampler;
    double alpha_x, alpha_y, cos_theta;
    double rejected;        // part of the samples whose reflection is below the surface
    double mean, variance;  // of brdf cos(theta_i) / density, 0 for rejected samples: GGX without Fresnel
};

// Over roughness, anisotropy and angle of incidence; 2^16 samples each, in double on the host. The means of one
// lobe are the same integral.
std::vector<LobeNoise> lobe_noise();

}  // namespace vndf::bench
